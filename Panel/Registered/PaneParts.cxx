// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/PaneParts.h"

#include "Interaction/Displays/SharedSettings.h"
#include "Panel/Parts/Advice.h"

#include <QCheckBox>
#include <QLabel>
#include <QPainter>
#include <QPolygonF>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double HeightInLines = 5.0; // of text, with the labels
constexpr double LineWidth = 1.5;     // pixels
constexpr double PointRadius = 3.0;   // pixels
constexpr double Margin = 4.0;        // pixels around the curve

QString percent(double fraction)
{
  return CostPlot::tr("%1 %").arg(std::lround(100.0 * fraction));
}
}

QToolButton* makeButton(const char* name, const QString& text, const QString& tip)
{
  auto button = new QToolButton;
  button->setObjectName(name);
  button->setText(text);
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::TabFocus); // a click leaves the keyboard where it is
  return button;
}

QLabel* makeText(const char* name)
{
  auto text = new QLabel;
  text->setObjectName(name);
  text->setWordWrap(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
  return text;
}

QString trustText(const QString& trust)
{
  if (trust == "good")
  {
    return CostPlot::tr("Its checks found no fault.");
  }
  if (trust == "doubtful")
  {
    return CostPlot::tr("The result is doubtful.");
  }
  return trust == "failed" ? CostPlot::tr("The result failed its checks.")
                           : CostPlot::tr("The result was not checked.");
}

QCheckBox* makeKeepFailed(const char* name)
{
  auto box = new QCheckBox(CostPlot::tr("Keep a failed result"));
  box->setObjectName(name);
  box->setToolTip(CostPlot::tr(
    "Keep the result even if it fails its checks. Else it is discarded, and nothing changes."));
  box->setFocusPolicy(Qt::TabFocus);
  return box;
}

void showTexts(QLabel* report, const QString& text, QLabel* warning, const QString& warningText)
{
  report->setText(text);
  report->setVisible(!text.isEmpty());
  warning->setText(warningText);
  warning->setVisible(!warningText.trimmed().isEmpty());
  QPalette palette = warning->parentWidget() ? warning->parentWidget()->palette() : QPalette();
  palette.setColor(QPalette::WindowText, gradeColor(Grade::Bad, palette, wantsBlueAndOrange()));
  warning->setPalette(palette);
}

CostPlot::CostPlot(QWidget* parent)
  : QWidget(parent)
{
  this->setAccessibleName(tr("Cost over the steps"));
  this->setToolTip(
    tr("Cost of the chosen similarity after each step. 100 % is the cost at the "
       "start, 0 % means that the volumes match. The curve may jump where a finer level begins."));
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->setCosts({});
}

void CostPlot::setCosts(const QList<double>& costs)
{
  this->Costs = QList<double>{ 1.0 } + costs;
  const int steps = static_cast<int>(costs.size());
  this->setAccessibleDescription(steps == 0
      ? tr("no steps")
      : tr("after %n step(s): %1", nullptr, steps).arg(percent(costs.back())));
  this->update();
}

QRectF CostPlot::area() const
{
  const double line = this->fontMetrics().height();
  return QRectF(this->rect()).adjusted(Margin, line + Margin, -Margin, -line - Margin);
}

QSize CostPlot::minimumSizeHint() const
{
  const QFontMetrics metrics = this->fontMetrics();
  return { metrics.averageCharWidth() * 16, static_cast<int>(metrics.height() * HeightInLines) };
}

void CostPlot::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF area = this->area();
  const double most = std::max(1.0, *std::max_element(this->Costs.begin(), this->Costs.end()));
  const auto last = static_cast<double>(std::max<qsizetype>(this->Costs.size() - 1, 1));
  QPolygonF curve;
  for (qsizetype step = 0; step < this->Costs.size(); ++step)
  {
    curve.append({ area.left() + area.width() * static_cast<double>(step) / last,
      area.bottom() - area.height() * this->Costs[step] / most });
  }
  const QColor ink = this->palette().color(QPalette::WindowText);
  painter.setPen(ink);
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  painter.drawText(
    this->rect(), Qt::AlignLeft | Qt::AlignTop, tr("Cost: %1").arg(percent(this->Costs.back())));
  painter.drawText(this->rect(), Qt::AlignLeft | Qt::AlignBottom, "0");
  painter.drawText(this->rect(), Qt::AlignHCenter | Qt::AlignBottom, tr("steps"));
  painter.drawText(
    this->rect(), Qt::AlignRight | Qt::AlignBottom, QString::number(this->Costs.size() - 1));
  const QColor color = this->palette().color(QPalette::Highlight);
  painter.setPen(QPen(color, LineWidth));
  painter.drawPolyline(curve);
  painter.setPen(QPen(ink, LineWidth));
  painter.setBrush(color);
  painter.drawEllipse(curve.back(), PointRadius, PointRadius);
}
}
