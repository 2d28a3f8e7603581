// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/LiveRun.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Views/Reports.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqPipelineSource.h>
#include <pqServer.h>

#include <vtkCommand.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>

#include <QApplication>
#include <QKeyEvent>

#include <utility>

namespace brainshift
{
QString whyUnapplied(pqPipelineSource* source)
{
  if (source && source->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return LiveRun::tr("%1 has not been applied yet. Press Apply first.").arg(source->getSMName());
  }
  if (source && source->modifiedState() == pqProxy::MODIFIED)
  {
    return LiveRun::tr("%1 has changes that are not applied. Press Apply or Reset first.")
      .arg(source->getSMName());
  }
  return {};
}

LiveRun::LiveRun(pqPipelineSource* source)
  : QObject(source)
  , Source(source)
{
  this->Next.setSingleShot(true);
  this->Next.setInterval(0);
  this->connect(&this->Next, &QTimer::timeout, this, [this] {
    if (this->Now == State::Running)
    {
      this->takeStep();
    }
  });
  this->OfSource->Connect(source->getProxy(), vtkCommand::PropertyModifiedEvent, this,
    SLOT(notice(vtkObject*, unsigned long, void*, void*)));
  this->followApplication();
}

void LiveRun::followApplication()
{
  const auto abandonIf = [this](bool isGone) {
    if (isGone && this->isActive())
    {
      this->abandon({}); // all proxies are deleted
    }
  };
  this->connect(qApp, &QCoreApplication::aboutToQuit, this, [abandonIf] { abandonIf(true); });
  constexpr float first = 1.0f; // before others, which add to the state (QuietLinks)
  this->OfSource->Connect(this->Source->getServer()->proxyManager(), vtkCommand::SaveStateEvent,
    this, SLOT(writeStart(vtkObject*, unsigned long, void*, void*)), nullptr, first);
  pqServerManagerModel* model = serverManagerModel();
  this->connect(model, &pqServerManagerModel::preServerRemoved, this,
    [this, abandonIf](pqServer* server) { abandonIf(server == this->Source->getServer()); });
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this, [this](auto* source) {
    if (this->isActive())
    {
      this->followRemoval(source);
    }
  });
}

// What is under way is neither kept nor checked. ParaView announces a state when it has described
// the proxies, so they are described again. Menu, Python and crash recovery all come here.
void LiveRun::writeStart(vtkObject* manager, unsigned long, void*, void* saved)
{
  vtkPVXMLElement* root =
    static_cast<const vtkSMProxyManager::LoadStateInformation*>(saved)->RootElement;
  vtkPVXMLElement* state = root ? root->FindNestedElementByName("ServerManagerState") : nullptr;
  if (this->isActive() && state)
  {
    this->standAside();
    root->RemoveNestedElement(state);
    root->AddNestedElement(vtkSMSessionProxyManager::SafeDownCast(manager)->GetXMLState());
  }
}

void LiveRun::standAside()
{
  if (std::exchange(this->IsAside, true)) // two states may be saved before it comes back
  {
    return;
  }
  this->Next.stop();
  this->restore();
  QTimer::singleShot(0, this, [this] {
    if (std::exchange(this->IsAside, false) && this->isActive())
    {
      this->comeBack();
      drawFully(this->Source);
      this->Now == State::Running ? this->Next.start() : void();
    }
  });
}

vtkSMProxy* LiveRun::makeRun(vtkSMProxy* compared)
{
  this->Proxy = makeReport(compared, "RegistrationRun");
  pointAt(this->Proxy, "Source", compared);
  return this->Proxy;
}

QString LiveRun::beginRun(const char* command)
{
  this->OfOthers->Disconnect();
  this->Proxy->UpdateVTKObjects();
  this->Proxy->InvokeCommand(command);
  pull(this->Proxy);
  const QString problem = this->text("Problem");
  return problem.isEmpty() ? QString() : problem + ".";
}

bool LiveRun::advance()
{
  if (!hasServer(this->Proxy))
  {
    return false;
  }
  this->Proxy->InvokeCommand("Step");
  pull(this->Proxy);
  return this->text("Problem").isEmpty();
}

bool LiveRun::settle()
{
  if (!hasServer(this->Proxy))
  {
    return false;
  }
  this->Proxy->InvokeCommand("Stop");
  pull(this->Proxy);
  return true;
}

double LiveRun::figure(const char* name) const
{
  return vtkSMPropertyHelper(this->Proxy, name).GetAsDouble();
}

QString LiveRun::text(const char* name) const
{
  return QString::fromUtf8(vtkSMPropertyHelper(this->Proxy, name).GetAsString());
}

std::vector<double> LiveRun::numbers(const char* name) const
{
  return vtkSMPropertyHelper(this->Proxy, name).GetDoubleArray();
}

void LiveRun::start()
{
  this->Problem = QString();
  this->HasDiscarded = false;
  this->HasChangedSince = false;
  this->Now = State::Running;
  qApp->installEventFilter(this);
  this->Next.start();
  Q_EMIT this->changed();
}

void LiveRun::stopOn(pqPipelineSource* source)
{
  const auto runs = source ? source->findChildren<LiveRun*>(QString(), Qt::FindDirectChildrenOnly)
                           : QList<LiveRun*>();
  for (LiveRun* run : runs)
  {
    run->stop();
  }
}

void LiveRun::stop()
{
  if (this->isActive())
  {
    this->keep(State::Kept);
  }
}

void LiveRun::cancel(const QString& problem)
{
  if (this->isActive())
  {
    this->restore();
    this->end(State::Idle, problem);
  }
}

void LiveRun::discard(const QString& reason)
{
  const bool canBeKept = this->text("Trust") == "failed";
  this->cancel(reason);
  this->HasDiscarded = canBeKept;
  Q_EMIT this->changed();
}

void LiveRun::keepDiscarded()
{
  if (!this->HasDiscarded)
  {
    return;
  }
  this->HasDiscarded = false;
  this->HasChangedSince = false;
  this->putResult();
  this->end(State::Finished, {});
}

void LiveRun::end(State end, const QString& problem)
{
  this->HasDiscarded = false;
  this->IsAside = false;
  qApp->removeEventFilter(this);
  this->Next.stop();
  this->release();
  this->Proxy = nullptr;
  this->Now = end;
  this->Problem = problem;
  drawFully(this->Source);
  Q_EMIT this->changed();
}

void LiveRun::forgetProblem()
{
  this->Problem.clear();
  Q_EMIT this->changed();
}

void LiveRun::watch(vtkSMProxy* proxy)
{
  if (proxy)
  {
    this->OfOthers->Connect(proxy, vtkCommand::PropertyModifiedEvent, this,
      SLOT(notice(vtkObject*, unsigned long, void*, void*)));
  }
}

void LiveRun::notice(vtkObject* proxy, unsigned long, void*, void* name)
{
  const auto property = static_cast<const char*>(name);
  const bool hasResult = this->Now == State::Kept || this->Now == State::Finished;
  if (this->Writing || !(this->isActive() || this->HasDiscarded || hasResult) ||
    this->HasChangedSince || !this->dependsOn(proxy, property))
  {
    return;
  }
  if (this->isActive())
  {
    this->followChange(proxy, property);
    return;
  }
  this->HasDiscarded = false; // it started from something else
  this->HasChangedSince = hasResult;
  hasResult ? this->forgetProblem() : Q_EMIT this->changed();
}

bool LiveRun::eventFilter(QObject* watched, QEvent* event)
{
  const bool isKey = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (isKey && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && this->isActive() &&
    !QApplication::activeModalWidget() && !QApplication::activePopupWidget())
  {
    if (event->type() == QEvent::KeyPress)
    {
      this->cancel();
    }
    event->accept(); // else a shortcut of the window takes the key
    return true;
  }
  return QObject::eventFilter(watched, event);
}
}
