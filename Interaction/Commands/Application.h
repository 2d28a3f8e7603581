// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Short names for what the window's application has.
#ifndef BrainShift_Application_h
#define BrainShift_Application_h

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkSMProxyManager.h>
#include <vtkSMUndoStackBuilder.h>

#include <QCoreApplication>
#include <QString>

namespace brainshift
{
/// The sources, representations and views of the window.
inline pqServerManagerModel* serverManagerModel()
{
  return pqApplicationCore::instance()->getServerManagerModel();
}

/// The source of the window that a proxy is; null if it is none.
inline pqPipelineSource* sourceOf(vtkSMProxy* proxy)
{
  return serverManagerModel()->findItem<pqPipelineSource*>(proxy);
}

/// Whether undo or redo is bringing something back.
inline bool isReplayed()
{
  const pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  return stack && (stack->getInUndo() || stack->getInRedo());
}

/// Lets the step to undo that is being recorded hold nothing so far. For an order that failed: it
/// left nothing to undo but the way there and back.
inline void forgetStep()
{
  if (vtkSMUndoStackBuilder* builder = vtkSMProxyManager::GetProxyManager()->GetUndoStackBuilder())
  {
    builder->Clear();
  }
}

/// Translates a text of a function that belongs to no QObject.
inline QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}
}

#endif
