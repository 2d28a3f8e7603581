// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/InSight.h"

#include <QEvent>
#include <QLayout>
#include <QScrollArea>

#include <algorithm>

namespace brainshift
{
namespace
{
QScrollArea* scrollAreaAround(QWidget* widget)
{
  while (widget && !qobject_cast<QScrollArea*>(widget))
  {
    widget = widget->parentWidget();
  }
  return qobject_cast<QScrollArea*>(widget);
}
}

InSight::InSight(QWidget* part)
  : QObject(part)
  , Part(part)
{
  part->installEventFilter(this);
}

bool InSight::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Show && !this->Panel)
  {
    this->Panel = scrollAreaAround(this->Part);
    if (this->Panel)
    {
      this->Panel->viewport()->installEventFilter(this);
    }
  }
  if ((event->type() == QEvent::Show || event->type() == QEvent::Resize) && this->Panel)
  {
    const int begin = this->Part->mapTo(this->Panel->widget(), QPoint(0, 0)).x();
    const int seen = this->Panel->viewport()->width() - begin;
    QMargins margins = this->Part->layout()->contentsMargins();
    margins.setRight(std::max(0, this->Part->width() - seen));
    this->Part->layout()->setContentsMargins(margins);
  }
  return this->QObject::eventFilter(watched, event);
}
}
