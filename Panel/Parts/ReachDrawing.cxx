// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/ReachDrawing.h"

#include "Interaction/Commands/Application.h"

#include <QPainter>
#include <QPainterPath>
#include <QRadialGradient>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr int Rows = 7;            // height, in lines of text
constexpr int Stops = 24;          // of the shade, from the centre to the edge
constexpr double FullShade = 0.75; // opacity where tissue follows the whole stroke
constexpr double Border = 3.0;     // pixels
constexpr double ArrowHead = 4.0;  // pixels

QString shownMm(double value)
{
  return tr("%1 mm").arg(value, 0, 'f', 1);
}

// Pixels per mm in coarse steps, at most `most`: between two steps, the drawing grows with its
// numbers.
double scaleBelow(double most)
{
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  double scale = power;
  for (const double step : { 1.5, 2.0, 3.0, 5.0, 7.0 })
  {
    scale = step * power <= most ? step * power : scale;
  }
  return scale;
}
}

double halfDistance(const Reach& reach)
{
  double inside = 0.0;
  double outside = 1.0;
  for (int step = 0; step < 30; ++step) // to 1e-9 of the reach
  {
    const double middle = 0.5 * (inside + outside);
    (reach.weight(middle) >= 0.5 ? inside : outside) = middle;
  }
  return inside;
}

QString describe(const Reach& reach)
{
  if (reach.along <= 0.0)
  {
    return {};
  }
  const double half = halfDistance(reach);
  if (!reach.hasAxis)
  {
    return tr("Tissue within %1 of the cursor moves. At the centre it moves fully, at %2 half as "
              "far (dashed), at the edge not at all.")
      .arg(shownMm(reach.along), shownMm(half * reach.along));
  }
  return tr(
    "Tissue within %1 of the cursor along the push and %2 across it moves. At the centre it moves "
    "fully, at %3 along and %4 across half as far (dashed), at the edge not at all.")
    .arg(shownMm(reach.along), shownMm(reach.across), shownMm(half * reach.along),
      shownMm(half * reach.across));
}

ReachDrawing::ReachDrawing(QWidget* parent)
  : QWidget(parent)
{
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->setAccessibleName(tr("Radius of the tool"));
}

void ReachDrawing::setReach(const Reach& reach)
{
  this->Shown = reach;
  const QString words = describe(reach);
  this->setToolTip(words);
  this->setAccessibleDescription(words);
  this->update();
}

QSize ReachDrawing::sizeHint() const
{
  return { 0, Rows * this->fontMetrics().height() };
}

void ReachDrawing::paintEvent(QPaintEvent*)
{
  const Reach& reach = this->Shown;
  if (reach.along <= 0.0 || reach.across <= 0.0)
  {
    return;
  }
  const double line = this->fontMetrics().height();
  const double ends = reach.hasAxis // what stands at both ends of the axis
    ? this->fontMetrics().horizontalAdvance(tr("push")) + 2.0 * line
    : 0.0;
  const QSizeF room(0.5 * this->width() - ends - Border, 0.5 * (this->height() - line) - Border);
  if (room.width() <= 0.0)
  {
    return;
  }
  const double scale =
    scaleBelow(std::min(room.width() / reach.along, room.height() / reach.across));
  const QSizeF half(scale * reach.along, scale * reach.across);
  const QPointF centre(0.5 * this->width(), 0.5 * (this->height() - line));
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  this->drawTissue(painter, centre, half);
  if (reach.hasAxis)
  {
    this->drawAxis(painter, centre, half.width());
  }
  this->drawSizes(painter, centre, half);
  this->drawText(painter, { centre.x(), this->height() - 0.5 * line }, Qt::AlignHCenter,
    tr("dashed: moves half as far"));
}

void ReachDrawing::drawTissue(QPainter& painter, const QPointF& centre, const QSizeF& half) const
{
  QRadialGradient shade(QPointF(0.0, 0.0), 1.0);
  QColor color = this->palette().color(QPalette::Highlight);
  for (int stop = 0; stop <= Stops; ++stop)
  {
    const double distance = double(stop) / Stops;
    color.setAlphaF(float(FullShade * this->Shown.weight(distance)));
    shade.setColorAt(distance, color);
  }
  painter.save();
  painter.translate(centre);
  painter.scale(half.width(), half.height());
  painter.setPen(Qt::NoPen);
  painter.setBrush(shade);
  painter.drawEllipse(QPointF(0.0, 0.0), 1.0, 1.0);
  painter.restore();
  const double dashed = halfDistance(this->Shown);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(this->palette().color(QPalette::WindowText), 1.0));
  painter.drawEllipse(centre, half.width(), half.height());
  painter.setPen(QPen(this->palette().color(QPalette::WindowText), 1.0, Qt::DashLine));
  painter.drawEllipse(centre, dashed * half.width(), dashed * half.height());
}

// The wheel pushes towards the cross, the point of interest, and pulls away from it.
void ReachDrawing::drawAxis(QPainter& painter, const QPointF& centre, double halfLength) const
{
  const double line = this->fontMetrics().height();
  const double begin = centre.x() - halfLength;
  const double end = centre.x() + halfLength;
  const double y = centre.y();
  painter.setPen(QPen(this->palette().color(QPalette::WindowText), 1.0));
  const double cross = begin - this->fontMetrics().horizontalAdvance(tr("push")) - 1.5 * line;
  painter.drawLine(QPointF(cross, y), QPointF(end + 1.2 * line, y));
  painter.drawLine(QPointF(cross - ArrowHead, y), QPointF(cross + ArrowHead, y));
  painter.drawLine(QPointF(cross, y - ArrowHead), QPointF(cross, y + ArrowHead));
  for (const auto& [tip, back] :
    { std::pair{ cross + 2.0 * ArrowHead, 1.0 }, std::pair{ end + 1.2 * line, -1.0 } })
  {
    painter.drawLine(QPointF(tip, y), QPointF(tip + back * ArrowHead, y - ArrowHead));
    painter.drawLine(QPointF(tip, y), QPointF(tip + back * ArrowHead, y + ArrowHead));
  }
  this->drawText(painter, { begin - 3.0, y - 0.5 * line }, Qt::AlignRight, tr("push"));
  this->drawText(painter, { end + 3.0, y - 0.5 * line }, Qt::AlignLeft, tr("pull"));
}

void ReachDrawing::drawSizes(QPainter& painter, const QPointF& centre, const QSizeF& half) const
{
  const double line = this->fontMetrics().height();
  painter.setPen(QPen(this->palette().color(QPalette::WindowText), 1.0));
  if (!this->Shown.hasAxis)
  {
    painter.drawLine(centre, centre + QPointF(half.width(), 0.0));
    this->drawText(painter, centre + QPointF(half.width() + 4.0, 0.0), Qt::AlignLeft,
      shownMm(this->Shown.along));
    return;
  }
  painter.drawLine(centre, centre - QPointF(0.0, half.height()));
  this->drawText(painter, centre + QPointF(0.5 * half.width(), 0.5 * line), Qt::AlignHCenter,
    shownMm(this->Shown.along));
  this->drawText(painter, centre + QPointF(3.0, -0.5 * (half.height() + line) + 0.5 * line),
    Qt::AlignLeft, shownMm(this->Shown.across));
}

// `at`: the middle of the text's height, at its left end, middle or right end. A seam of the
// window's colour keeps it legible on the shade.
void ReachDrawing::drawText(
  QPainter& painter, const QPointF& at, Qt::Alignment side, const QString& text) const
{
  const double width = this->fontMetrics().horizontalAdvance(text);
  const double back = side == Qt::AlignRight ? width : side == Qt::AlignHCenter ? 0.5 * width : 0.0;
  const double left = std::clamp(at.x() - back, 0.0, std::max(0.0, this->width() - width));
  const double base = at.y() + 0.5 * (this->fontMetrics().ascent() - this->fontMetrics().descent());
  QPainterPath letters;
  letters.addText(left, base, this->font(), text);
  QColor seam = this->palette().color(QPalette::Window);
  seam.setAlphaF(0.8F);
  painter.save();
  painter.strokePath(letters, QPen(seam, 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setPen(this->palette().color(QPalette::WindowText));
  painter.drawText(QPointF(left, base), text);
  painter.restore();
}
}
