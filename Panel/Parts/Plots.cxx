// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/Plots.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double HeightInLines = 6.0; // of text, that of the labels included
constexpr double Gap = 1.0;           // pixels between two bars

double mostOf(const QList<double>& counts)
{
  return counts.isEmpty() ? 0.0 : *std::max_element(counts.begin(), counts.end());
}
}

HistogramPlot::HistogramPlot(QWidget* parent)
  : QWidget(parent)
{
  this->setObjectName("BrainShiftHistogram");
  this->setAccessibleName(tr("Histogram of distances"));
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->setHistogram(0.0, {});
}

void HistogramPlot::setHistogram(double width, const QList<double>& counts)
{
  const bool any = width > 0.0 && mostOf(counts) > 0.0;
  this->Width = any ? width : 0.0;
  this->Counts = any ? counts : QList<double>();
  QString said = tr("no points");
  if (any)
  {
    const auto tallest = std::max_element(this->Counts.begin(), this->Counts.end());
    said = tr("Bins of %1 mm. The tallest bin: %2.")
             .arg(this->Width)
             .arg(this->textOf(static_cast<int>(tallest - this->Counts.begin())));
  }
  this->setAccessibleDescription(said);
  this->update();
}

double HistogramPlot::edgeOf(int bin) const
{
  return this->Width * (bin - 0.5 * static_cast<double>(this->Counts.size()));
}

QString HistogramPlot::textOf(int bin) const
{
  return tr("%1 mm to %2 mm: %n point(s)", nullptr, static_cast<int>(this->Counts.at(bin)))
    .arg(this->edgeOf(bin))
    .arg(this->edgeOf(bin + 1));
}

QRectF HistogramPlot::barsArea() const
{
  return QRectF(this->rect()).adjusted(0.0, 0.0, 0.0, -this->fontMetrics().height());
}

int HistogramPlot::binAt(const QPointF& place) const
{
  const QRectF area = this->barsArea();
  if (this->Counts.isEmpty() || !area.contains(place))
  {
    return -1;
  }
  const auto bins = static_cast<int>(this->Counts.size());
  return std::min(static_cast<int>((place.x() - area.left()) / area.width() * bins), bins - 1);
}

QSize HistogramPlot::sizeHint() const
{
  return { this->fontMetrics().averageCharWidth() * 30, this->minimumSizeHint().height() };
}

QSize HistogramPlot::minimumSizeHint() const
{
  const QFontMetrics metrics = this->fontMetrics();
  return { metrics.averageCharWidth() * 16, static_cast<int>(metrics.height() * HeightInLines) };
}

bool HistogramPlot::event(QEvent* event)
{
  if (event->type() != QEvent::ToolTip)
  {
    return QWidget::event(event);
  }
  const auto* help = static_cast<QHelpEvent*>(event);
  const int bin = this->binAt(help->pos());
  QToolTip::showText(help->globalPos(), bin < 0 ? this->toolTip() : this->textOf(bin), this);
  return true;
}

void HistogramPlot::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  const QRectF area = this->barsArea();
  const QRectF labels(0.0, area.bottom(), area.width(), this->height() - area.bottom());
  painter.setPen(this->palette().color(QPalette::WindowText));
  if (this->Counts.isEmpty())
  {
    painter.drawText(this->rect(), Qt::AlignCenter, tr("no points"));
    return;
  }
  const double column = area.width() / static_cast<double>(this->Counts.size());
  const double unit = (area.height() - Gap) / mostOf(this->Counts);
  for (qsizetype bin = 0; bin < this->Counts.size(); ++bin)
  {
    const double tall = this->Counts[bin] * unit;
    const QRectF bar(area.left() + static_cast<double>(bin) * column, area.bottom() - tall,
      std::max(column - Gap, Gap), tall);
    painter.fillRect(bar, this->palette().color(QPalette::Highlight));
  }
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  painter.drawLine(
    QPointF(area.center().x(), area.top()), QPointF(area.center().x(), area.bottom()));
  const QString end = tr("%1 mm").arg(this->edgeOf(static_cast<int>(this->Counts.size())));
  painter.drawText(labels, Qt::AlignLeft, "\u2212" + end);
  painter.drawText(labels, Qt::AlignHCenter, tr("cortex"));
  painter.drawText(labels, Qt::AlignRight, "+" + end);
}

namespace
{
constexpr double PointRadius = 2.5;   // pixels
constexpr double CurrentRadius = 4.5; // pixels
constexpr double LineWidth = 1.5;     // pixels
constexpr double Margin = 6.0;        // pixels around the points: half of the marked one and more

QString millimetres(double length)
{
  return CurvePlot::tr("%1 mm").arg(length, 0, 'f', 2);
}
}

CurvePlot::CurvePlot(QWidget* parent)
  : QWidget(parent)
{
  this->setObjectName("BrainShiftCurve");
  this->setAccessibleName(tr("RMS distance over the strokes"));
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->setLengths({});
}

void CurvePlot::setLengths(const QList<double>& lengths)
{
  this->Lengths = lengths;
  this->Longest = 0.0;
  for (const double length : lengths)
  {
    this->Longest = std::isfinite(length) ? std::max(this->Longest, length) : this->Longest;
  }
  QString said = tr("no strokes");
  if (!lengths.isEmpty())
  {
    said = this->textOf(0);
    said += lengths.size() > 1 ? "; " + this->textOf(static_cast<int>(lengths.size()) - 1) : "";
  }
  this->setAccessibleDescription(said);
  this->update();
}

QString CurvePlot::textOf(int strokes) const
{
  const double length = this->Lengths.at(strokes);
  const QString rms =
    std::isfinite(length) ? tr("RMS %1").arg(millimetres(length)) : tr("not measured");
  return strokes == 0 ? tr("before the first stroke: %1").arg(rms)
                      : tr("after stroke %1: %2").arg(QString::number(strokes), rms);
}

QRectF CurvePlot::area() const
{
  const double line = this->fontMetrics().height();
  return QRectF(this->rect()).adjusted(Margin, line + Margin + 2.0, -Margin, -line - 1.0);
}

QPointF CurvePlot::placeOf(int strokes) const
{
  const QRectF area = this->area();
  const auto last = static_cast<double>(std::max<qsizetype>(this->Lengths.size() - 1, 1));
  const double length = this->Lengths.at(strokes);
  const double share = this->Longest > 0.0 && std::isfinite(length) ? length / this->Longest : 0.0;
  return { area.left() + area.width() * strokes / last, area.bottom() - area.height() * share };
}

int CurvePlot::pointAt(const QPointF& place) const
{
  const QRectF area = this->area();
  if (this->Lengths.isEmpty() || !QRectF(this->rect()).contains(place))
  {
    return -1;
  }
  const auto last = static_cast<double>(this->Lengths.size() - 1);
  return static_cast<int>(
    std::lround(std::clamp((place.x() - area.left()) / area.width(), 0.0, 1.0) * last));
}

QSize CurvePlot::sizeHint() const
{
  return { this->fontMetrics().averageCharWidth() * 30, this->minimumSizeHint().height() };
}

QSize CurvePlot::minimumSizeHint() const
{
  const QFontMetrics metrics = this->fontMetrics();
  return { metrics.averageCharWidth() * 16, static_cast<int>(metrics.height() * HeightInLines) };
}

bool CurvePlot::event(QEvent* event)
{
  if (event->type() != QEvent::ToolTip)
  {
    return QWidget::event(event);
  }
  const auto* help = static_cast<QHelpEvent*>(event);
  const int strokes = this->pointAt(help->pos());
  QToolTip::showText(
    help->globalPos(), strokes < 0 ? this->toolTip() : this->textOf(strokes), this);
  return true;
}

void CurvePlot::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(this->palette().color(QPalette::WindowText));
  if (this->Lengths.isEmpty())
  {
    painter.drawText(this->rect(), Qt::AlignCenter, tr("no strokes"));
    return;
  }
  const QRectF area = this->area();
  const QRectF below(0.0, area.bottom() + 1.0, this->width(), this->height() - area.bottom());
  painter.drawLine(QPointF(0.0, area.bottom()), QPointF(this->width(), area.bottom()));
  painter.drawText(QRectF(this->rect()), Qt::AlignLeft | Qt::AlignTop,
    tr("0 to %1").arg(millimetres(this->Longest)));
  painter.drawText(below, Qt::AlignLeft, "0");
  painter.drawText(below, Qt::AlignHCenter, tr("strokes"));
  painter.drawText(below, Qt::AlignRight, QString::number(this->Lengths.size() - 1));
  this->drawCurve(painter);
  this->drawCurrent(painter);
}

// A dotted line leads over what was not measured.
void CurvePlot::drawCurve(QPainter& painter) const
{
  const QColor color = this->palette().color(QPalette::Highlight);
  int before = -1;
  for (int strokes = 0; strokes < this->Lengths.size(); ++strokes)
  {
    if (!std::isfinite(this->Lengths[strokes]))
    {
      continue;
    }
    const QPointF place = this->placeOf(strokes);
    if (before >= 0)
    {
      const bool next = strokes == before + 1;
      painter.setPen(QPen(color, LineWidth, next ? Qt::SolidLine : Qt::DotLine));
      painter.drawLine(this->placeOf(before), place);
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawEllipse(place, PointRadius, PointRadius);
    before = strokes;
  }
}

void CurvePlot::drawCurrent(QPainter& painter) const
{
  const int last = static_cast<int>(this->Lengths.size()) - 1;
  if (!std::isfinite(this->Lengths[last]))
  {
    return;
  }
  const QPointF place = this->placeOf(last);
  const QColor ink = this->palette().color(QPalette::WindowText);
  painter.setPen(QPen(ink, LineWidth));
  painter.setBrush(this->palette().color(QPalette::Highlight));
  painter.drawEllipse(place, CurrentRadius, CurrentRadius);
  const QString text = tr("RMS %1").arg(millimetres(this->Lengths[last]));
  const double width = this->fontMetrics().horizontalAdvance(text);
  const double left = std::clamp(place.x() - 0.5 * width, 0.0, this->width() - width);
  const double above = place.y() - Margin - this->fontMetrics().descent();
  const bool fits =
    above - this->fontMetrics().ascent() >= this->area().top(); // else the range is there
  const QPointF base(left, fits ? above : place.y() + Margin + this->fontMetrics().ascent());
  QColor ground = this->palette().color(QPalette::Window); // the curve may pass behind the number
  ground.setAlphaF(0.8F);
  painter.fillRect(QRectF(this->fontMetrics().boundingRect(text)).translated(base), ground);
  painter.drawText(base, text);
}
}
