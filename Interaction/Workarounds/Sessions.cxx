// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/Sessions.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkPVSessionBase.h>
#include <vtkSMProperty.h>
#include <vtkSMProxy.h>
#include <vtkSMSession.h>

#include <QSet>

namespace brainshift
{
namespace
{
// Sessions whose connection was lost.
QSet<const vtkObject*>& lostSessions()
{
  return keptBySession<vtkSMSession, QSet<const vtkObject*>>();
}

void noteLost(vtkObject* session, unsigned long, void*, void*)
{
  lostSessions().insert(session);
}
}

bool hasServer(vtkSMProxy* proxy)
{
  static const vtkNew<vtkCallbackCommand> lost;
  lost->SetCallback(noteLost);
  vtkSMSession* session = proxy ? proxy->GetSession() : nullptr;
  if (session && !session->HasObserver(vtkPVSessionBase::ConnectionLost, lost))
  {
    constexpr float beforeTheWindowAsks = 1e6f;
    session->AddObserver(vtkPVSessionBase::ConnectionLost, lost, beforeTheWindowAsks);
  }
  return session && !lostSessions().contains(session);
}

void pull(vtkSMProxy* proxy, vtkSMProperty* property)
{
  if (hasServer(proxy) && property)
  {
    proxy->UpdatePropertyInformation(property);
  }
  else if (hasServer(proxy))
  {
    proxy->UpdatePropertyInformation();
  }
}
}
