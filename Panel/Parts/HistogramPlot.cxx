// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/HistogramPlot.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>

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
}
