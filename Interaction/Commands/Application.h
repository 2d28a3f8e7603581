// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Short names for what the window's application has.
#ifndef BrainShift_Application_h
#define BrainShift_Application_h

#include <pqApplicationCore.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <QCoreApplication>
#include <QString>

namespace brainshift
{
/// The sources, representations and views of the window.
inline pqServerManagerModel* serverManagerModel()
{
  return pqApplicationCore::instance()->getServerManagerModel();
}

/// Whether undo or redo is bringing something back.
inline bool isReplayed()
{
  const pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  return stack && (stack->getInUndo() || stack->getInRedo());
}

/// Calls `forget` when a server comes or goes, as at Reset Session: the next session gives the
/// global numbers of former proxies to others. `context`: ends it.
template <typename Forget>
void onNewSession(QObject* context, Forget forget)
{
  pqServerManagerModel* model = serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::serverAdded, context, forget);
  QObject::connect(model, &pqServerManagerModel::serverRemoved, context, forget);
}

/// A container by the global numbers of proxies that is emptied for each session. One for each
/// `Owner`.
template <typename Owner, typename Container>
Container& keptBySession()
{
  static Container kept;
  static const bool isWatched = (onNewSession(serverManagerModel(), [] { kept.clear(); }), true);
  static_cast<void>(isWatched);
  return kept;
}

/// Translates a text of a function that belongs to no QObject.
inline QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}
}

#endif
