// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/WrappedLabel.h"

#include <QResizeEvent>
#include <QScrollArea>
#include <QStyle>

#include <algorithm>
#include <cstdlib>

namespace brainshift
{
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
      return;
    }
  }
}
}
