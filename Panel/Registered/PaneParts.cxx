// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/PaneParts.h"

#include "Interaction/Displays/SharedSettings.h"
#include "Interaction/Landmarks/LandmarkErrors.h"
#include "Panel/Parts/Advice.h"

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

QString figure(double value, int digits)
{
  return QString::number(value, 'f', digits);
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

QString changedText(const QString& ended, int steps)
{
  return CostPlot::tr("%1 after %2 steps. The deformation or its reference has changed since, so "
                      "the figures no longer hold.")
    .arg(ended, QString::number(steps));
}

QString checkingText()
{
  return CostPlot::tr("Checking the result ...");
}

QToolButton* makeKeep(const char* name)
{
  return makeButton(name, CostPlot::tr("Keep Anyway"),
    CostPlot::tr("Keep the result that failed its checks, as one undo step."));
}

namespace
{
QString tableRow(const QString& name, double before, double now)
{
  return QString("<tr><td>%1&nbsp;&nbsp;</td><td align='right'>%2&nbsp;&nbsp;</td>"
                 "<td align='right'>%3</td></tr>")
    .arg(name, QString::number(before, 'f', 2), QString::number(now, 'f', 2));
}
}

QString errorTable(const QList<LandmarkError>& errors, const QString& note)
{
  if (errors.isEmpty())
  {
    return {};
  }
  LandmarkError mean;
  LandmarkError largest;
  QString rows;
  bool hasFitted = false;
  for (const LandmarkError& error : errors)
  {
    mean.before += error.before / static_cast<double>(errors.size());
    mean.now += error.now / static_cast<double>(errors.size());
    largest.before = std::max(largest.before, error.before);
    largest.now = std::max(largest.now, error.now);
    hasFitted = hasFitted || error.wasInFit;
    rows +=
      tableRow(error.name.toHtmlEscaped() + (error.wasInFit ? " *" : ""), error.before, error.now);
  }
  const QString head =
    QString("<tr><th align='left'>%1&nbsp;&nbsp;</th><th>%2&nbsp;&nbsp;</th><th>%3</th></tr>")
      .arg(CostPlot::tr("Landmark error (mm)"), CostPlot::tr("before"), CostPlot::tr("now"));
  return "<table>" + head + tableRow(CostPlot::tr("mean"), mean.before, mean.now) +
    tableRow(CostPlot::tr("largest"), largest.before, largest.now) + rows + "</table>" +
    (hasFitted ? "<p>" + CostPlot::tr("* fitted before, so its error before is no judge") + "</p>"
               : QString()) +
    (note.isEmpty() ? QString() : "<p>" + note + "</p>");
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
