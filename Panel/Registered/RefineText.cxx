// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/RefineText.h"

#include "Interaction/Edits/RefineRun.h"

#include <QCoreApplication>
#include <QStringList>

namespace brainshift
{
namespace
{
constexpr double LeastCompared = 0.25; // as for an alignment

QString said(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

QString figure(double value, int digits = 2)
{
  return QString::number(value, 'f', digits);
}

QString percent(double share)
{
  return figure(100.0 * share, 0);
}

// Of what `compared` is a share.
QString whole(const RefineFigures& figures)
{
  return figures.isBySweep ? said("what ultrasound saw") : said("the volume");
}
}

QString refineProgress(const RefineFigures& figures)
{
  return said("Step %1: control points moved %2 mm at most, %3 mm on average. %4 % of %5 is "
              "compared.")
    .arg(QString::number(figures.steps), figure(figures.largestChange), figure(figures.meanChange),
      percent(figures.compared), whole(figures));
}

QString refineResult(const QString& ended, const RefineFigures& figures)
{
  QStringList lines;
  lines += said("%1 after %2 steps. Disagreement: %3 before, %4 now (0: the volumes agree).")
             .arg(ended, QString::number(figures.steps), figure(figures.disagreementBefore, 3),
               figure(figures.disagreement, 3));
  lines += said("Control points moved %1 mm at most, %2 mm on average.")
             .arg(figure(figures.largestChange), figure(figures.meanChange));
  if (figures.smallestDeterminant)
  {
    lines += said("Smallest Jacobian determinant: %1 (0 or less: folded).")
               .arg(figure(*figures.smallestDeterminant));
  }
  lines += figures.share < 1.0
    ? said("The guard against folding shortened steps, one of them to %1 %.")
        .arg(percent(figures.share))
    : said("The guard against folding shortened no step.");
  lines += said("%1 % of %2 was compared.").arg(percent(figures.compared), whole(figures));
  return lines.join(' ');
}

QString refineWarning(const RefineFigures& figures)
{
  QStringList lines;
  if (figures.disagreement > figures.disagreementBefore)
  {
    lines += said("By its own measure the result is worse than before: %1 instead of %2. Undo it.")
               .arg(figure(figures.disagreement, 3), figure(figures.disagreementBefore, 3));
  }
  if (figures.smallestDeterminant && *figures.smallestDeterminant <= 0.0)
  {
    lines += said("Tissue is folded: the smallest Jacobian determinant is %1, and it must be above "
                  "0.")
               .arg(figure(*figures.smallestDeterminant));
  }
  if (figures.compared < LeastCompared)
  {
    lines += said("Only %1 % of %2 has a partner; at least 25 % should.")
               .arg(percent(figures.compared), whole(figures));
  }
  return lines.join(' ');
}
}
