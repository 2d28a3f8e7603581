// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/InSight.h"

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
  const QEvent::Type type = event->type();
  const bool fit = type == QEvent::Show || type == QEvent::Resize || type == QEvent::LayoutRequest;
  if (fit && this->Panel)
  {
    this->fitMargin();
  }
  return this->QObject::eventFilter(watched, event);
}

// The part asks for the width of its contents alone. If the margin counted as well, contents wider
// than what is seen would widen the part, and the part its margin: Qt resizes without end.
void InSight::fitMargin()
{
  QLayout* layout = this->Part->layout();
  QMargins margins = layout->contentsMargins();
  const int begin = this->Part->mapTo(this->Panel->widget(), QPoint(0, 0)).x();
  const int seen = this->Panel->viewport()->width() - begin;
  const int needed = layout->totalMinimumSize().width() - margins.right();
  this->Part->setMinimumWidth(needed);
  margins.setRight(std::max(0, this->Part->width() - std::max(seen, needed)));
  layout->setContentsMargins(margins);
}
}
