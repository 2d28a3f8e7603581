// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/Advice.h"

#include "Interaction/Commands/Application.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr double LeastAmount = 0.05;     // mm; less is shown as 0.0
constexpr double DoubtfulReach = 0.8;    // fraction of the amount
constexpr double DoubtfulJacobian = 0.3; // few users want to compress tissue to less than a third
constexpr double LeastPercent = 0.01;    // less is not shown as 0 %, which folds
constexpr float QuietShare = 0.7F;       // of the colour of text; the rest is the window's
constexpr double Rounding = 0.01;        // percent; the determinant of no stroke is a bound below 1
}

QString radiusAdvice(const QString& name, double radius, double spacing)
{
  if (radius >= spacing)
  {
    return {};
  }
  return tr(
    "%1, %2 mm, is smaller than the spacing of the control points, %3 mm. The lattice cannot "
    "follow it. Increase the radius, or add control points.")
    .arg(name)
    .arg(radius, 0, 'f', 1)
    .arg(spacing, 0, 'f', 1);
}

QString guardAdvice(double amount, double share)
{
  if (share >= 1.0)
  {
    return {};
  }
  return tr("The guard against folding applies %1 of %2 mm. More would fold the tissue.")
    .arg(share * amount, 0, 'f', 1)
    .arg(amount, 0, 'f', 1);
}

QString reachAdvice(double amount, double reached)
{
  if (std::abs(amount) < LeastAmount || reached / amount >= DoubtfulReach)
  {
    return {};
  }
  return tr(
    "The tissue at the centre moved %1 of %2 mm. Near the edge of a mask, increase Mask Growth, "
    "lower Feather, or use the mask as Segmentation instead. Elsewhere, increase the "
    "radius or add control points.")
    .arg(reached, 0, 'f', 1)
    .arg(amount, 0, 'f', 1);
}

QString guardAdvice(int shortenedStrokes)
{
  if (shortenedStrokes == 0)
  {
    return {};
  }
  return shortenedStrokes == 1
    ? tr("1 stroke is shortened. Its full length would fold the tissue.")
    : tr("%1 strokes are shortened. Their full length would fold the tissue.")
        .arg(shortenedStrokes);
}

Grade jacobianGrade(double determinant)
{
  if (determinant <= 0.0)
  {
    return Grade::Bad;
  }
  return determinant < DoubtfulJacobian ? Grade::Doubtful : Grade::Good;
}

QString jacobianText(double determinant)
{
  if (determinant <= 0.0)
  {
    return tr("folds over itself");
  }
  if (determinant < LeastPercent)
  {
    return tr("squeezed to less than 1 %");
  }
  const int percent = static_cast<int>(std::floor(100.0 * determinant + Rounding));
  return percent >= 100 ? tr("not squeezed") : tr("squeezed to %1 %").arg(percent);
}

QString jacobianTip(double determinant)
{
  return tr(
    "The remaining volume of the most squeezed tissue. 100 %: unchanged. Below 30 %: strongly "
    "squeezed. 0 % or less: tissue folds over itself. The smallest Jacobian determinant is "
    "%1.")
    .arg(determinant, 0, 'f', 3);
}

QColor gradeColor(Grade grade, const QPalette& palette, bool blueAndOrange)
{
  const bool dark = palette.color(QPalette::Window).lightness() < 128;
  if (blueAndOrange)
  {
    const QColor blue = dark ? QColor(130, 190, 255) : QColor(0, 70, 160);
    const QColor orange = dark ? QColor(255, 160, 60) : QColor(150, 65, 0);
    return grade == Grade::Good ? blue
      : grade == Grade::Bad     ? orange
                                : palette.color(QPalette::WindowText);
  }
  switch (grade)
  {
    case Grade::Bad:
      return dark ? QColor(255, 128, 120) : QColor(176, 16, 32);
    case Grade::Doubtful:
      return dark ? QColor(255, 200, 90) : QColor(138, 84, 0);
    case Grade::Good:
      break;
  }
  return dark ? QColor(120, 215, 140) : QColor(20, 110, 50);
}

QColor quietColor(const QPalette& palette)
{
  const QColor text = palette.color(QPalette::Active, QPalette::WindowText);
  const QColor window = palette.color(QPalette::Active, QPalette::Window);
  const auto mixed = [](float of, float with) { return QuietShare * of + (1 - QuietShare) * with; };
  return QColor::fromRgbF(mixed(text.redF(), window.redF()), mixed(text.greenF(), window.greenF()),
    mixed(text.blueF(), window.blueF()));
}
}
