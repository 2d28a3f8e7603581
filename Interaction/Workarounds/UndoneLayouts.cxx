// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/UndoneLayouts.h"

#include <pqApplicationCore.h>
#include <pqProxy.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkSMViewLayoutProxy.h>
#include <vtkSmartPointer.h>

#include <QCoreApplication>
#include <QEvent>

#include <vector>

namespace brainshift
{
namespace
{
// Names a protected function of its base.
class Opened : public vtkSMViewLayoutProxy
{
public:
  static void push(vtkSMViewLayoutProxy* layout) { (layout->*&Opened::UpdateState)(); }
};

void pushLayouts()
{
  SCOPED_UNDO_EXCLUDE();
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  std::vector<vtkSmartPointer<vtkSMViewLayoutProxy>> layouts; // pushing one can end other proxies
  for (pqProxy* proxy : model->findItems<pqProxy*>())
  {
    if (auto layout = vtkSMViewLayoutProxy::SafeDownCast(proxy->getProxy()))
    {
      layouts.emplace_back(layout);
    }
  }
  for (vtkSMViewLayoutProxy* layout : layouts)
  {
    Opened::push(layout);
  }
}

void follow(pqUndoStack* stack, QObject* context)
{
  if (stack)
  {
    QObject::connect(stack, &pqUndoStack::undone, context, pushLayouts);
    QObject::connect(stack, &pqUndoStack::redone, context, pushLayouts);
  }
}
}

UndoneLayouts::UndoneLayouts(QObject* parent)
  : QObject(parent)
{
  pqApplicationCore* core = pqApplicationCore::instance();
  follow(core->getUndoStack(), this);
  QObject::connect(core, &pqApplicationCore::undoStackChanged, this,
    [this](pqUndoStack* stack) { follow(stack, this); });
}

WaitingEditors::WaitingEditors(QObject* parent)
  : QObject(parent)
{
  qApp->installEventFilter(this);
}

// ParaView's own timers alone. One whose event is not delivered runs on, and comes again.
bool WaitingEditors::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::Timer || !watched->inherits("pqTimer"))
  {
    return false;
  }
  const pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  return stack && (stack->getInUndo() || stack->getInRedo());
}
}
