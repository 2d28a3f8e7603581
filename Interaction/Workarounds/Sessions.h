// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the window asks of a server that may have gone, and keeps by the global numbers of proxies.
/// ParaView gives them to others after Reset Session and with another server.
#ifndef BrainShift_Sessions_h
#define BrainShift_Sessions_h

#include <pqApplicationCore.h>
#include <pqServerManagerModel.h>

class vtkSMProperty;
class vtkSMProxy;

namespace brainshift
{
/// Whether the server of a proxy is there. ParaView's GetIsAlive is true even if it was lost.
bool hasServer(vtkSMProxy* proxy);

/// Gets a value of the server's object, or all of them. They stay as they were if the server was
/// lost: ParaView ends the whole program then, with all strokes.
void pull(vtkSMProxy* proxy, vtkSMProperty* property = nullptr);

/// Calls `forget` when a server comes or goes, as at Reset Session: the next session gives the
/// global numbers of former proxies to others. `context`: ends it.
template <typename Forget>
void onNewSession(QObject* context, Forget forget)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::serverAdded, context, forget);
  QObject::connect(model, &pqServerManagerModel::serverRemoved, context, forget);
}

/// A container by the global numbers of proxies that is emptied for each session. One for each
/// `Owner`.
template <typename Owner, typename Container>
Container& keptBySession()
{
  static Container kept;
  static const bool isWatched =
    (onNewSession(pqApplicationCore::instance(), [] { kept.clear(); }), true);
  static_cast<void>(isWatched);
  return kept;
}
}

#endif
