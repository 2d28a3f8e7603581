// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/RefineEditor.h"

#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"

#include <pqApplicationCore.h>
#include <pqOutputPort.h>
#include <pqPipelineSource.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkCommand.h>
#include <vtkSMParaViewPipelineController.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSession.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>

#include <QApplication>
#include <QKeyEvent>
#include <QScopedValueRollback>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace brainshift
{
namespace
{
// As in brainshift.fit and brainshift.refine of Python: sources that are BrainShift's own.
constexpr const char* MadeByUs = "BrainShiftFit";

// What a refinement stands on, beside the settings of the lattice. Whoever changes one of these in
// the meantime ends it.
constexpr const char* Ground[] = { "Input", "Lattice", "Strokes", "Strength" };

void setNumbers(vtkSMProxy* proxy, const char* name, const std::vector<double>& numbers)
{
  vtkSMPropertyHelper property(proxy, name);
  if (numbers.empty())
  {
    property.SetNumberOfElements(0);
  }
  else
  {
    property.Set(numbers.data(), static_cast<unsigned int>(numbers.size()));
  }
}

bool isRefined(vtkSMProxy* lattice)
{
  return lattice && std::strcmp(lattice->GetXMLName(), "RefinedLattice") == 0;
}

// Whether another source takes a lattice, too: a fit as its base, say.
bool isTakenByOthers(vtkSMProxy* lattice, vtkSMProxy* deformation)
{
  for (unsigned int i = 0; i < lattice->GetNumberOfConsumers(); ++i)
  {
    vtkSMProxy* taker = lattice->GetConsumerProxy(i);
    taker = taker ? taker->GetTrueParentProxy() : nullptr;
    if (taker && taker != deformation && taker->IsA("vtkSMSourceProxy") &&
      !taker->IsA("vtkSMRepresentationProxy"))
    {
      return true;
    }
  }
  return false;
}
}

RefineEditor* RefineEditor::of(pqPipelineSource* source)
{
  if (!isDeformation(source))
  {
    return nullptr;
  }
  auto editor = source->findChild<RefineEditor*>(QString(), Qt::FindDirectChildrenOnly);
  return editor ? editor : new RefineEditor(source);
}

RefineEditor::RefineEditor(pqPipelineSource* source)
  : QObject(source)
  , Source(source)
{
  this->Next.setSingleShot(true);
  this->Next.setInterval(0);
  this->connect(&this->Next, &QTimer::timeout, this, &RefineEditor::step);
  this->OfSource->Connect(source->getProxy(), vtkCommand::PropertyModifiedEvent, this,
    SLOT(notice(vtkObject*, unsigned long, void*, void*)));
  this->followApplication();
}

void RefineEditor::followApplication()
{
  // A hand that begins in the meantime has its way from what was reached.
  const auto giveWay = [this](bool begins) {
    if (begins)
    {
      this->stop();
    }
  };
  this->connect(StrokeEditor::of(this->Source), &StrokeEditor::editing, this, giveWay);
  this->connect(FitEditor::of(this->Source), &FitEditor::editing, this, giveWay);
  pqApplicationCore* core = pqApplicationCore::instance();
  this->connect(
    core, &pqApplicationCore::aboutToWriteState, this, [this] { this->Unselected.putBack(); });
  this->connect(qApp, &QCoreApplication::aboutToQuit, this, [this] { this->abandon({}); });
  pqServerManagerModel* model = core->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this, [this](auto* source) {
    if (!this->isActive())
    {
      return;
    }
    if (source->getProxy() == this->Held.Get())
    {
      this->abandon({}); // all goes
    }
    else if (source == this->Source)
    {
      this->putBack(); // undo brings it back as it was before
      this->leaveHeld();
      this->forget(State::Idle);
    }
    else if (source == this->Reference)
    {
      const QString name = source->getSMName();
      // Later: what deletes the reference is an undo step of its own.
      QTimer::singleShot(0, this, [this, name] {
        if (!this->isActive())
        {
          return;
        }
        this->stop();
        this->Problem = tr("%1 was deleted. What was reached until then is kept.").arg(name);
        Q_EMIT this->changed();
      });
      this->Next.stop();
    }
  });
  this->connect(model, &pqServerManagerModel::preServerRemoved, this, [this](pqServer* server) {
    if (server == this->Source->getServer())
    {
      this->abandon({}); // all proxies go
    }
  });
}

vtkSmartPointer<vtkSMProxy> RefineEditor::lattice() const
{
  return vtkSMPropertyHelper(this->Source->getProxy(), "Lattice", /*quiet*/ true).GetAsProxy();
}

void RefineEditor::begin(const RefineSettings& settings)
{
  this->cancel();
  StrokeEditor::of(this->Source)->cancel();
  FitEditor::of(this->Source)->cancel();
  this->Problem = this->Run.begin(this->Source, settings);
  if (!this->Problem.isEmpty())
  {
    this->forget(State::Idle);
    return;
  }
  this->Reference = settings.reference;
  this->IsDrawn = true;
  this->Unselected.leaveOut(this->Source);
  this->hold();
  this->Now = State::Running;
  qApp->installEventFilter(this);
  this->Next.start();
  Q_EMIT this->changed();
}

vtkSmartPointer<vtkSMProxy> RefineEditor::makeLattice() const
{
  vtkSMProxy* deformation = this->Source->getProxy();
  auto made = vtk::TakeSmartPointer(
    deformation->GetSessionProxyManager()->NewProxy("filters", "RefinedLattice"));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->PreInitializeProxy(made);
  shareLattice(deformation, made);
  controller->PostInitializeProxy(made);
  made->SetAnnotation(MadeByUs, "1");
  made->UpdateVTKObjects();
  return made;
}

// Not by the controller, which would make the lattice the active source.
void RefineEditor::hold()
{
  SCOPED_UNDO_EXCLUDE();
  this->Base = this->lattice();
  this->Strokes = vtkSMPropertyHelper(this->Source->getProxy(), "Strokes").GetDoubleArray();
  const vtkSmartPointer<vtkSMProxy> made = this->makeLattice();
  made->SetLogName(made->GetSessionProxyManager()->RegisterProxy("sources", made).c_str());
  this->Held = made;
  this->putIn(made, this->Run.start());
}

// The lattice holds what base and strokes did, so it takes the place of both.
void RefineEditor::putIn(vtkSMProxy* lattice, const std::vector<double>& controlPoints)
{
  const QScopedValueRollback<bool> writing(this->Writing, true);
  setNumbers(lattice, "ControlPoints", controlPoints);
  lattice->UpdateVTKObjects();
  vtkSMProxy* deformation = this->Source->getProxy();
  vtkSMPropertyHelper(deformation, "Lattice").Set(lattice);
  setNumbers(deformation, "Strokes", {});
  deformation->UpdateVTKObjects();
}

void RefineEditor::show()
{
  this->IsDrawn = true;
  const QScopedValueRollback<bool> writing(this->Writing, true);
  setNumbers(this->Held, "ControlPoints", this->Run.points());
  drawMoving(this->Source, this->Held);
}

void RefineEditor::step()
{
  if (this->Now != State::Running)
  {
    return;
  }
  if (!this->Held || !this->Held->GetSession()->GetIsAlive())
  {
    this->abandon(tr("The lattice of the refinement is gone, so it ended."));
    return;
  }
  if (!this->IsDrawn) // a turn of its own, so that Stop waits for a step or a picture, not for both
  {
    this->show();
    if (this->Now == State::Running) // a picture may have let something else happen
    {
      this->Next.start();
    }
    return;
  }
  const int taken = this->figures().steps;
  const bool worked = this->Run.step();
  const bool isMoved =
    worked && this->figures().steps > taken; // else it tried, or prepared a level
  this->IsDrawn = !isMoved;
  if (!worked)
  {
    this->cancel();
    this->Problem = tr("The refinement failed, see the messages. All is as it was before.");
  }
  else if (isMoved && this->figures().compared <= 0.0)
  {
    const QString reference = this->Reference ? this->Reference->getSMName() : QString();
    this->cancel();
    this->Problem = tr("0 % of %1 lies within %2; some of it must. All is as it was before.")
                      .arg(this->Source->getSMName(), reference);
  }
  else if (this->figures().done >= 1.0)
  {
    this->keep(State::Finished);
    return;
  }
  else
  {
    this->Next.start();
  }
  Q_EMIT this->changed();
}

void RefineEditor::pause(bool on)
{
  if (!this->isActive())
  {
    return;
  }
  this->Now = on ? State::Paused : State::Running;
  on ? this->Next.stop() : this->Next.start();
  if (on && !this->IsDrawn)
  {
    this->show();
  }
  if (on)
  {
    drawFully(this->Source);
  }
  Q_EMIT this->changed();
}

void RefineEditor::keep(State end)
{
  if (!this->isActive())
  {
    return;
  }
  const std::vector<double> found = this->Run.points();
  const bool hasChanged = found != this->Run.start();
  // What undo comes back to is what the session saw last, so it sees the beginning once more.
  this->restore();
  if (hasChanged)
  {
    vtkSMProxy* deformation = this->Source->getProxy();
    SCOPED_UNDO_SET(tr("Refine"));
    vtkSmartPointer<vtkSMProxy> lattice = this->lattice();
    // One of an earlier refinement. Who else takes it keeps it.
    if (isRefined(lattice) && !isTakenByOthers(lattice, deformation))
    {
      shareLattice(deformation, lattice);
    }
    else
    {
      lattice = this->makeLattice();
      SM_SCOPED_TRACE(RegisterPipelineProxy).arg("proxy", lattice);
      lattice->SetLogName(
        lattice->GetSessionProxyManager()->RegisterProxy("sources", lattice).c_str());
    }
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", deformation);
    this->putIn(lattice, found);
  }
  vtkSMProxy* proxy = this->Source->getProxy();
  vtkSMSourceProxy::SafeDownCast(proxy)->UpdatePipeline();
  proxy->UpdatePropertyInformation(proxy->GetProperty("MinimumJacobian"));
  this->Run.figures().smallestDeterminant =
    vtkSMPropertyHelper(proxy, "MinimumJacobian").GetAsDouble();
  this->forget(end);
}

void RefineEditor::cancel()
{
  if (this->isActive())
  {
    this->restore();
    this->forget(State::Idle);
  }
}

void RefineEditor::restore()
{
  this->putBack();
  if (this->Held)
  {
    SCOPED_UNDO_EXCLUDE();
    this->Held->GetSessionProxyManager()->UnRegisterProxy(this->Held);
  }
}

void RefineEditor::putBack()
{
  SCOPED_UNDO_EXCLUDE();
  const QScopedValueRollback<bool> writing(this->Writing, true);
  vtkSMProxy* deformation = this->Source->getProxy();
  vtkSMPropertyHelper property(deformation, "Lattice");
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  if (this->Base && model->findItem<pqPipelineSource*>(this->Base))
  {
    property.Set(this->Base);
  }
  else
  {
    property.RemoveAllValues();
  }
  setNumbers(deformation, "Strokes", this->Strokes);
  deformation->UpdateVTKObjects();
}

// Later: ParaView is going through its sources now, or undo is at work.
void RefineEditor::leaveHeld()
{
  const vtkWeakPointer<vtkSMProxy> held = this->Held;
  QTimer::singleShot(0, qApp, [held] {
    if (held && held->GetSession())
    {
      SCOPED_UNDO_EXCLUDE();
      held->GetSessionProxyManager()->UnRegisterProxy(held);
    }
  });
}

void RefineEditor::forget(State end)
{
  qApp->removeEventFilter(this);
  this->Next.stop();
  this->Unselected.putBack();
  this->Run.end();
  this->Held = nullptr;
  this->Base = nullptr;
  this->Reference = nullptr;
  this->Strokes = {};
  this->Now = end;
  drawFully(this->Source);
  Q_EMIT this->changed();
}

// What others want stands. The lattice goes, unless they want it.
void RefineEditor::abandon(const QString& problem)
{
  if (!this->isActive())
  {
    return;
  }
  this->Problem = problem;
  if (this->Held && this->lattice() != this->Held.Get())
  {
    this->leaveHeld();
  }
  this->forget(State::Idle);
}

void RefineEditor::notice(vtkObject*, unsigned long, void*, void* name)
{
  const auto isChanged = [name](const char* property) {
    return std::strcmp(property, static_cast<const char*>(name)) == 0;
  };
  if (this->isActive() && !this->Writing &&
    (std::any_of(std::begin(Ground), std::end(Ground), isChanged) ||
      isLatticeSetting(this->Source->getProxy(), static_cast<const char*>(name))))
  {
    this->abandon(tr("%1 of %2 was changed, so the refinement ended.")
        .arg(QString(static_cast<const char*>(name)), this->Source->getSMName()));
  }
}

bool RefineEditor::eventFilter(QObject* watched, QEvent* event)
{
  const bool isKey = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (isKey && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && this->isActive() &&
    !QApplication::activeModalWidget() && !QApplication::activePopupWidget())
  {
    if (event->type() == QEvent::KeyPress)
    {
      this->cancel();
    }
    event->accept(); // or a shortcut of the window comes first
    return true;
  }
  return QObject::eventFilter(watched, event);
}
}
