// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/QuietLinks.h"

#include "Interaction/Workarounds/Sessions.h"

#include <pqApplicationCore.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPVXMLElement.h>
#include <vtkSMLink.h>
#include <vtkSMPropertyLink.h>
#include <vtkSMProxy.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSession.h>
#include <vtkSMSessionProxyManager.h>

#include <QTimer>

#include <cstring>
#include <iterator>

namespace brainshift
{
namespace
{
constexpr float Priority = 1.0f;                  // before ParaView's link manager
constexpr const char* NamePrefix = "BrainShift "; // as Python/brainshift/links.py names them

using Information = vtkSMProxyManager::RegisteredProxyInformation;

bool isOurs(const char* link)
{
  return link && std::strncmp(link, NamePrefix, std::strlen(NamePrefix)) == 0;
}

bool isIn(const Information* registered, const char* group)
{
  return registered && registered->Type == Information::PROXY && registered->GroupName &&
    std::strcmp(registered->GroupName, group) == 0;
}

// Of a view or display; null for all else.
vtkSMProxy* linkedProxy(const Information* registered)
{
  const bool isLinked = isIn(registered, "views") || isIn(registered, "representations");
  return isLinked ? registered->Proxy : nullptr;
}

// Calls a method for each server that there is and that comes.
template <typename Owner>
void watchServers(Owner* owner, void (Owner::*watch)(pqServer*))
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::serverAdded, owner, watch);
  for (pqServer* server : model->findItems<pqServer*>())
  {
    (owner->*watch)(server);
  }
}

void removeAll(const ManagerObservers& observers)
{
  for (const auto& [manager, observer] : observers)
  {
    if (manager)
    {
      manager->RemoveObserver(observer);
    }
  }
}

// As ParaView writes a link into a state.
vtkSmartPointer<vtkPVXMLElement> describe(const std::string& name, vtkSMPropertyLink* link)
{
  auto described = vtkSmartPointer<vtkPVXMLElement>::New();
  described->SetName("PropertyLink");
  described->AddAttribute("name", name.c_str());
  for (unsigned int i = 0; i < link->GetNumberOfLinkedObjects(); ++i)
  {
    const int index = static_cast<int>(i);
    if (vtkSMProxy* proxy = link->GetLinkedProxy(index))
    {
      vtkNew<vtkPVXMLElement> member;
      member->SetName("Property");
      member->AddAttribute("id", static_cast<unsigned int>(proxy->GetGlobalID()));
      member->AddAttribute("name", link->GetLinkedPropertyName(index));
      const bool isInput = (link->GetLinkedObjectDirection(index) & vtkSMLink::INPUT) != 0;
      member->AddAttribute("direction", isInput ? "input" : "output");
      described->AddNestedElement(member);
    }
  }
  return described;
}
}

QuietLinks::QuietLinks(QObject* parent)
  : QObject(parent)
{
  watchServers(this, &QuietLinks::watch);
  onNewSession(this, [this] { this->Gone.clear(); });
}

QuietLinks::~QuietLinks()
{
  removeAll(this->Observers);
}

void QuietLinks::watch(pqServer* server)
{
  vtkSMSessionProxyManager* manager = server->proxyManager();
  this->Observers.emplace_back(manager,
    manager->AddObserver(vtkCommand::RegisterEvent, this, &QuietLinks::onRegister, Priority));
  this->Observers.emplace_back(manager,
    manager->AddObserver(vtkCommand::UnRegisterEvent, this, &QuietLinks::onUnRegister, Priority));
  this->Observers.emplace_back(
    manager, manager->AddObserver(vtkCommand::SaveStateEvent, this, &QuietLinks::onSaveState));
}

bool QuietLinks::onRegister(vtkObject* manager, unsigned long, void* information)
{
  auto registered = static_cast<const Information*>(information);
  const bool isLink =
    registered && registered->Type == Information::LINK && isOurs(registered->ProxyName);
  if (isLink || linkedProxy(registered))
  {
    const vtkWeakPointer<vtkSMSessionProxyManager> weak =
      vtkSMSessionProxyManager::SafeDownCast(manager);
    // Later: ParaView registers within a step of undo that it has not ended.
    QTimer::singleShot(0, this, [this, weak] {
      if (weak)
      {
        SCOPED_UNDO_EXCLUDE();
        this->takeOver(weak);
      }
    });
    // Later still: a view that comes back gets its own zoom first (RevivedViews), and then that of
    // the views that stayed.
    QTimer::singleShot(0, this, [this, weak] {
      QTimer::singleShot(0, this, [this, weak] {
        if (weak)
        {
          SCOPED_UNDO_EXCLUDE();
          this->takeIn(weak);
        }
      });
    });
  }
  return isLink;
}

bool QuietLinks::onUnRegister(vtkObject* object, unsigned long, void* information)
{
  auto registered = static_cast<const Information*>(information);
  if (vtkSMProxy* gone = linkedProxy(registered))
  {
    SCOPED_UNDO_EXCLUDE();
    this->takeOver(vtkSMSessionProxyManager::SafeDownCast(object));
    this->leaveOut(gone);
  }
  return registered && registered->Type == Information::LINK && isOurs(registered->ProxyName);
}

void QuietLinks::onSaveState(vtkObject*, unsigned long, void* information)
{
  auto saved = static_cast<const vtkSMProxyManager::LoadStateInformation*>(information);
  vtkPVXMLElement* state = saved->RootElement->FindNestedElementByName("ServerManagerState");
  vtkPVXMLElement* links = state ? state->FindNestedElementByName("Links") : nullptr;
  for (const auto& [name, link] : this->Links)
  {
    if (links && link->GetNumberOfLinkedObjects() > 2) // two directions each
    {
      links->AddNestedElement(describe(name, link));
    }
  }
}

void QuietLinks::takeOver(vtkSMSessionProxyManager* manager)
{
  for (int i = manager->GetNumberOfLinks(); i-- > 0;)
  {
    const std::string name = manager->GetLinkName(i);
    vtkSmartPointer<vtkSMPropertyLink> link = isOurs(name.c_str())
      ? vtkSMPropertyLink::SafeDownCast(manager->GetRegisteredLink(name.c_str()))
      : nullptr;
    if (link)
    {
      this->Links.insert({ name, link });
      manager->UnRegisterLink(name.c_str());
    }
  }
}

void QuietLinks::leaveOut(vtkSMProxy* gone)
{
  for (const auto& named : this->Links)
  {
    vtkSMPropertyLink* link = named.second;
    for (unsigned int member = link->GetNumberOfLinkedObjects(); member-- > 0;)
    {
      const int index = static_cast<int>(member);
      if (link->GetLinkedProxy(index) == gone)
      {
        const std::string property = link->GetLinkedPropertyName(index);
        link->RemoveLinkedProperty(gone, property.c_str()); // one of its two directions
        this->Gone.push_back({ link, gone->GetGlobalID(), property });
      }
    }
  }
}

void QuietLinks::takeIn(vtkSMSessionProxyManager* manager)
{
  std::vector<LeftOut> still;
  for (LeftOut& left : this->Gone)
  {
    auto back = vtkSMProxy::SafeDownCast(manager->GetSession()->GetRemoteObject(left.proxy));
    const bool isBack = back &&
      (manager->GetProxyName("views", back) || manager->GetProxyName("representations", back));
    if (!isBack)
    {
      still.push_back(std::move(left));
      continue;
    }
    left.link->AddLinkedProperty(back, left.property.c_str(), vtkSMLink::INPUT);
    left.link->AddLinkedProperty(back, left.property.c_str(), vtkSMLink::OUTPUT);
    back->UpdateProperty(left.property.c_str(), 1); // the link changes the property alone
  }
  this->Gone = std::move(still);
}

KeptColors::KeptColors(QObject* parent)
  : QObject(parent)
{
  watchServers(this, &KeptColors::watch);
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::aboutToRemoveServer, this, &KeptColors::forget);
}

KeptColors::~KeptColors()
{
  removeAll(this->Observers);
}

void KeptColors::watch(pqServer* server)
{
  vtkSMSessionProxyManager* manager = server->proxyManager();
  this->Observers.emplace_back(
    manager, manager->AddObserver(vtkCommand::RegisterEvent, this, &KeptColors::onRegister));
}

void KeptColors::forget(pqServer* server)
{
  for (auto table = this->Tables.begin(); table != this->Tables.end();)
  {
    const bool isGone = (*table)->GetSession() == server->session();
    table = isGone ? this->Tables.erase(table) : std::next(table);
  }
}

void KeptColors::onRegister(vtkObject*, unsigned long, void* information)
{
  auto registered = static_cast<const Information*>(information);
  if (isIn(registered, "lookup_tables"))
  {
    this->Tables.insert(registered->Proxy);
  }
}
}
