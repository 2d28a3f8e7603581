// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/WrappedLabel.h"

#include <QResizeEvent>
#include <QScrollArea>
#include <QStyle>
#include <QTimer>

#include <algorithm>
#include <cstdlib>

namespace brainshift
{
namespace
{
// Ends the resizes that Qt's scroll area answers with another resize, within one turn of the event
// loop. The next layout request puts the size right.
class ResizeLimit : public QObject
{
public:
  explicit ResizeLimit(QWidget* contents)
    : QObject(contents)
  {
    this->setObjectName("BrainShiftResizeLimit");
    contents->installEventFilter(this);
  }

  bool eventFilter(QObject* watched, QEvent* event) override
  {
    constexpr int most = 40;
    if (event->type() != QEvent::Resize)
    {
      return this->QObject::eventFilter(watched, event);
    }
    if (this->Count++ == 0)
    {
      QTimer::singleShot(0, this, [this] { this->Count = 0; });
    }
    return this->Count > most;
  }

private:
  int Count = 0;
};
}

WrappedLabel::WrappedLabel(QWidget* parent)
  : QLabel(parent)
{
  this->setWordWrap(true);
}

QSize WrappedLabel::minimumSizeHint() const
{
  const int line = this->fontMetrics().lineSpacing();
  const int narrowest = 20 * this->fontMetrics().averageCharWidth();
  if (this->MeasuredText != this->text())
  {
    this->MeasuredText = this->text();
    this->MeasuredHeight = 0;
  }
  if (this->MeasuredWidth > 0)
  {
    const int height = this->QLabel::heightForWidth(std::max(this->MeasuredWidth, narrowest));
    this->MeasuredHeight = std::max(this->MeasuredHeight, height);
  }
  return { narrowest, std::max(this->MeasuredHeight, line) };
}

void WrappedLabel::resizeEvent(QResizeEvent* event)
{
  this->QLabel::resizeEvent(event);
  const int width = event->size().width();
  const int scrollBar = 2 * this->style()->pixelMetric(QStyle::PM_ScrollBarExtent);
  const bool otherPanel = std::abs(width - this->MeasuredWidth) > scrollBar;
  if (otherPanel || width < this->MeasuredWidth)
  {
    this->MeasuredHeight = otherPanel ? 0 : this->MeasuredHeight;
    this->MeasuredWidth = width;
    this->updateGeometry();
  }
}

void WrappedLabel::showEvent(QShowEvent* event)
{
  this->QLabel::showEvent(event);
  for (QWidget* widget = this->parentWidget(); widget; widget = widget->parentWidget())
  {
    if (auto area = qobject_cast<QScrollArea*>(widget))
    {
      area->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
      QWidget* contents = area->widget();
      if (contents && !contents->findChild<QObject*>("BrainShiftResizeLimit"))
      {
        new ResizeLimit(contents);
      }
      return;
    }
  }
}
}
