// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/QuietLinks.h"

#include <pqApplicationCore.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>

#include <vtkCommand.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>

#include <cstring>

namespace brainshift
{
namespace
{
constexpr float Priority = 1.0f;                  // before ParaView's link manager
constexpr const char* NamePrefix = "BrainShift "; // as Python/brainshift/links.py names them
}

QuietLinks::QuietLinks(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::serverAdded, this, &QuietLinks::watch);
  for (pqServer* server : model->findItems<pqServer*>())
  {
    this->watch(server);
  }
}

QuietLinks::~QuietLinks()
{
  for (const auto& [manager, observer] : this->Observers)
  {
    if (manager)
    {
      manager->RemoveObserver(observer);
    }
  }
}

void QuietLinks::watch(pqServer* server)
{
  vtkSMSessionProxyManager* manager = server->proxyManager();
  this->Observers.emplace_back(manager,
    manager->AddObserver(vtkCommand::RegisterEvent, this, &QuietLinks::onRegister, Priority));
}

bool QuietLinks::onRegister(vtkObject*, unsigned long, void* information)
{
  using Information = vtkSMProxyManager::RegisteredProxyInformation;
  auto registered = static_cast<const Information*>(information);
  return registered && registered->Type == Information::LINK && registered->ProxyName &&
    std::strncmp(registered->ProxyName, NamePrefix, std::strlen(NamePrefix)) == 0;
}
}
