// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/DisagreementPlot.h"

#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double HeightInLines = 5.0; // of text, that of the labels included
constexpr double LineWidth = 1.5;     // pixels
constexpr double PointRadius = 3.0;   // pixels
constexpr double Margin = 4.0;        // pixels around the curve

QString percent(double share)
{
  return DisagreementPlot::tr("%1 %").arg(std::lround(100.0 * share));
}
}

DisagreementPlot::DisagreementPlot(QWidget* parent)
  : QWidget(parent)
{
  this->setAccessibleName(tr("Disagreement over the steps"));
  this->setToolTip(tr("How far the volumes still disagree by the chosen similarity, after each "
                      "step. 100 % is the disagreement at the beginning, 0 % means that they "
                      "agree. The curve may jump where a finer level begins."));
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->setShares({});
}

void DisagreementPlot::setShares(const QList<double>& shares)
{
  this->Shares = QList<double>{ 1.0 } + shares;
  const int steps = static_cast<int>(shares.size());
  this->setAccessibleDescription(steps == 0
      ? tr("no steps")
      : tr("after %n step(s): %1", nullptr, steps).arg(percent(shares.back())));
  this->update();
}

QRectF DisagreementPlot::area() const
{
  const double line = this->fontMetrics().height();
  return QRectF(this->rect()).adjusted(Margin, line + Margin, -Margin, -line - Margin);
}

QSize DisagreementPlot::minimumSizeHint() const
{
  const QFontMetrics metrics = this->fontMetrics();
  return { metrics.averageCharWidth() * 16, static_cast<int>(metrics.height() * HeightInLines) };
}

void DisagreementPlot::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF area = this->area();
  const double most = std::max(1.0, *std::max_element(this->Shares.begin(), this->Shares.end()));
  const auto last = static_cast<double>(std::max<qsizetype>(this->Shares.size() - 1, 1));
  QPolygonF curve;
  for (qsizetype step = 0; step < this->Shares.size(); ++step)
  {
    curve.append({ area.left() + area.width() * static_cast<double>(step) / last,
      area.bottom() - area.height() * this->Shares[step] / most });
  }
  const QColor ink = this->palette().color(QPalette::WindowText);
  painter.setPen(ink);
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  painter.drawText(this->rect(), Qt::AlignLeft | Qt::AlignTop,
    tr("Disagreement: %1").arg(percent(this->Shares.back())));
  painter.drawText(this->rect(), Qt::AlignLeft | Qt::AlignBottom, "0");
  painter.drawText(this->rect(), Qt::AlignHCenter | Qt::AlignBottom, tr("steps"));
  painter.drawText(
    this->rect(), Qt::AlignRight | Qt::AlignBottom, QString::number(this->Shares.size() - 1));
  const QColor color = this->palette().color(QPalette::Highlight);
  painter.setPen(QPen(color, LineWidth));
  painter.drawPolyline(curve);
  painter.setPen(QPen(ink, LineWidth));
  painter.setBrush(color);
  painter.drawEllipse(curve.back(), PointRadius, PointRadius);
}
}
