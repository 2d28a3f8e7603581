// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/Docks.h"

#include <QDockWidget>
#include <QEvent>
#include <QLayout>
#include <QList>
#include <QMainWindow>
#include <QScrollArea>
#include <QScrollBar>
#include <QTimer>

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

// The part requests the width of its contents alone. If the margin counted as well, contents wider
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

namespace
{
constexpr double MostOfWindow = 0.4;  // of its width; the views need the rest
constexpr double LeastOfWindow = 0.6; // of its height; the pipeline browser needs the rest

int given = 0; // width of the dock, pixels; 0: as ParaView made it

// At the cost of the docks above and below it, which must be set in Qt as well.
void makeHigher(QDockWidget* dock, QMainWindow* window)
{
  QList<QDockWidget*> docks;
  for (QDockWidget* other : window->findChildren<QDockWidget*>())
  {
    if (other != dock && other->isVisible() && !other->isFloating() &&
      window->dockWidgetArea(other) == window->dockWidgetArea(dock) &&
      !window->tabifiedDockWidgets(dock).contains(other))
    {
      docks.append(other);
    }
  }
  const int lacking = static_cast<int>(LeastOfWindow * window->height()) - dock->height();
  if (lacking <= 0 || docks.isEmpty())
  {
    return;
  }
  QList<int> heights;
  for (const QDockWidget* other : docks)
  {
    heights.append(other->height() - lacking / static_cast<int>(docks.size()));
  }
  docks.append(dock);
  heights.append(dock->height() + lacking);
  window->resizeDocks(docks, heights, Qt::Vertical);
}

template <class T>
T* around(QWidget* widget)
{
  while (widget && !qobject_cast<T*>(widget))
  {
    widget = widget->parentWidget();
  }
  return qobject_cast<T*>(widget);
}
}

RoomyDock::RoomyDock(QWidget* part)
  : QObject(part)
  , Part(part)
{
  part->installEventFilter(this);
}

bool RoomyDock::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Show && !this->Panel)
  {
    this->watch();
  }
  return this->QObject::eventFilter(watched, event);
}

void RoomyDock::watch()
{
  this->Panel = around<QScrollArea>(this->Part);
  if (this->Panel)
  {
    // Later: while the panel is being filled, its parts have no sizes of their own yet.
    this->connect(this->Panel->horizontalScrollBar(), &QScrollBar::rangeChanged, this,
      [this] { QTimer::singleShot(0, this, &RoomyDock::widen); });
    QTimer::singleShot(0, this, &RoomyDock::widen);
  }
}

void RoomyDock::widen()
{
  const int lacking = this->Panel->horizontalScrollBar()->maximum();
  auto dock = around<QDockWidget>(this->Panel);
  auto window = dock ? around<QMainWindow>(dock) : nullptr;
  const bool isUsers = dock && given > 0 && dock->width() != given; // the user made it narrower
  if (isUsers || lacking == 0 || !this->Part->isVisible() || !window || dock->isFloating())
  {
    return;
  }
  const int width = dock->width() + lacking;
  if (width <= MostOfWindow * window->width())
  {
    const bool isFirst = given == 0;
    given = width;
    window->resizeDocks({ dock }, { width }, Qt::Horizontal);
    if (isFirst)
    {
      makeHigher(dock, window);
    }
  }
}
}
