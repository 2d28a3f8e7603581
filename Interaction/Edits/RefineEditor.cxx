// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/RefineEditor.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/Lineage.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>

#include <QJsonDocument>
#include <QJsonObject>
#include <QScopedValueRollback>
#include <QStringList>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace brainshift
{
namespace
{
QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

void setInput(vtkSMProxy* filter, const char* name, pqPipelineSource* source)
{
  if (source)
  {
    vtkSMPropertyHelper(filter, name).Set(source->getProxy());
  }
}

void setLattice(vtkSMProxy* deformation, vtkSMProxy* lattice)
{
  vtkSMPropertyHelper property(deformation, "Lattice");
  lattice ? property.Set(lattice) : property.RemoveAllValues();
}

// The reason against a refinement that the client knows: a sentence; empty if there is none.
QString whyNot(pqPipelineSource* deformation, const RefineSettings& settings)
{
  for (pqPipelineSource* source : { deformation, settings.reference, settings.cavity })
  {
    const QString unapplied = whyUnapplied(source);
    if (!unapplied.isEmpty())
    {
      return unapplied;
    }
  }
  if (!settings.reference)
  {
    return tr("There is no reference. Open the volume that %1 should match.")
      .arg(deformation->getSMName());
  }
  if (settings.reference->getServer() != deformation->getServer())
  {
    return tr("%1 and %2 are on different servers.")
      .arg(settings.reference->getSMName(), deformation->getSMName());
  }
  return {};
}

// The Compare Volumes of the settings. If they have a volume instead, a new one that is not
// registered and lives as long as the pointer.
vtkSmartPointer<vtkSMProxy> comparisonFor(
  pqPipelineSource* deformation, const RefineSettings& settings)
{
  if (isComparison(settings.reference))
  {
    return settings.reference->getProxy();
  }
  vtkSMProxy* proxy = deformation->getProxy();
  auto made =
    vtk::TakeSmartPointer(proxy->GetSessionProxyManager()->NewProxy("filters", "CompareVolumes"));
  made->PrototypeOn(); // so that it is no step to undo
  setInput(made, "Input", deformation);
  setInput(made, "Reference", settings.reference);
  setInput(made, "Cavity", settings.cavity);
  made->UpdateVTKObjects();
  return made;
}

// A refinement depends on these properties, beside the settings of the lattice. A change of one of
// them ends it.
constexpr const char* BendDependencies[] = { "Input", "Lattice", "Strokes", "Strength" };
// And on these of its Compare Volumes.
constexpr const char* CompareDependencies[] = { "Input", "Reference", "ReferenceRotation",
  "ReferenceTranslation", "Cavity", "CavityLabels" };

bool isRefined(vtkSMProxy* lattice)
{
  return lattice && std::strcmp(lattice->GetXMLName(), "RefinedLattice") == 0;
}

constexpr char UnderWay[] = "BrainShift.UnderWay"; // annotation of a temporary lattice

// Whether another source uses a lattice, too, such as a fit as its base.
bool isUsedByOthers(vtkSMProxy* lattice, vtkSMProxy* deformation)
{
  for (unsigned int i = 0; i < lattice->GetNumberOfConsumers(); ++i)
  {
    vtkSMProxy* user = lattice->GetConsumerProxy(i);
    user = user ? user->GetTrueParentProxy() : nullptr;
    if (user && user != deformation && user->IsA("vtkSMSourceProxy") &&
      !user->IsA("vtkSMRepresentationProxy"))
    {
      return true;
    }
  }
  return false;
}

void unregisterQuietly(const vtkWeakPointer<vtkSMProxy>& lattice)
{
  if (lattice && lattice->GetSession())
  {
    SCOPED_UNDO_EXCLUDE();
    lattice->GetSessionProxyManager()->UnRegisterProxy(lattice);
  }
}

// ParaView's steps bring back all that was registered when they were recorded: also the temporary
// lattice, if the user deleted or made a source while a refinement ran.
void dropRevived(pqPipelineSource* source)
{
  const vtkWeakPointer<vtkSMProxy> lattice = source->getProxy();
  if (isReplayed() && lattice->HasAnnotation(UnderWay))
  {
    QTimer::singleShot(0, qApp, [lattice] { // later: undo is running
      lattice && !isUsedByOthers(lattice, nullptr) ? unregisterQuietly(lattice) : void();
    });
  }
}
}

bool isComparison(pqPipelineSource* source)
{
  return source && std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") == 0;
}

QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation)
{
  QList<pqPipelineSource*> visited{ deformation };
  QList<pqPipelineSource*> found;
  for (int next = 0; next < visited.size(); ++next)
  {
    for (pqPipelineSource* consumer : visited[next]->getAllConsumers())
    {
      // A second deformation moves the tissue again; and a comparison may have it as its reference.
      if (visited.contains(consumer) || isDeformation(consumer) ||
        deformationUpstream(consumer) != deformation)
      {
        continue;
      }
      visited.append(consumer);
      if (isComparison(consumer))
      {
        found.append(consumer);
      }
    }
  }
  return found;
}

QList<SimilarityChoice> similaritiesFor(pqPipelineSource* source)
{
  const vtkSmartPointer<vtkSMProxy> run = makeReport(source->getProxy(), "RegistrationRun");
  const QStringList labels = textOf(run, "SimilarityLabels").split('\n');
  const QStringList tooltips = textOf(run, "SimilarityTooltips").split('\n');
  QList<SimilarityChoice> choices;
  for (qsizetype i = 0; i < labels.size() && i < tooltips.size(); ++i)
  {
    choices.append({ labels[i], tooltips[i] });
  }
  return choices;
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
  : LiveRun(source)
{
  // If the user edits meanwhile, the result so far is kept and the edit follows it.
  this->connect(StrokeEditor::of(source), &StrokeEditor::aboutToEdit, this, &RefineEditor::stop);
  this->connect(FitEditor::of(source), &FitEditor::aboutToEdit, this, &RefineEditor::stop);
  pqServerManagerModel* model = serverManagerModel();
  static const auto dropping [[maybe_unused]] = // one for all: a deformation may be gone
    QObject::connect(model, &pqServerManagerModel::sourceAdded, model, &dropRevived);
  this->connect(model, &pqServerManagerModel::sourceAdded, this, &RefineEditor::forgetProblemOf);
}

// What undo brings back was not deleted.
void RefineEditor::forgetProblemOf(pqPipelineSource* source)
{
  if (this->Deleted != 0 && source->getProxy()->GetGlobalID() == this->Deleted)
  {
    this->Deleted = 0;
    this->forgetProblem();
  }
}

void RefineEditor::followRemoval(pqPipelineSource* source)
{
  if (source->getProxy() == this->Held.Get())
  {
    this->abandon({}); // nothing is left to restore
  }
  else if (source == this->Source)
  {
    this->putBack(); // undo brings it back as it was before
    this->releaseHeldSoon();
    this->end(State::Idle, {});
  }
  else if (source == this->Reference)
  {
    this->Deleted = source->getProxy()->GetGlobalID();
    this->followReference(tr("%1 was deleted").arg(source->getSMName()));
  }
}

// Later: what happened to the reference is an undo step of its own.
void RefineEditor::followReference(const QString& happened)
{
  this->Next.stop();
  QTimer::singleShot(0, this, [this, happened] {
    if (this->isActive())
    {
      this->stop();
      this->Problem = this->Now == State::Kept ? tr("%1. The result so far is kept.").arg(happened)
                                               : tr("%1. %2").arg(happened, this->Problem);
      Q_EMIT this->changed();
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
  this->stopAligning(settings.reference);
  this->Figures = {};
  this->Costs.clear();
  this->Deleted = 0;
  const QString problem = this->beginRefinement(settings);
  if (!problem.isEmpty())
  {
    this->end(State::Idle, problem);
    return;
  }
  this->Reference = settings.reference;
  this->watch(isComparison(settings.reference) ? settings.reference->getProxy() : nullptr);
  this->IsDrawn = true;
  this->Unselected.leaveOut(this->Source);
  this->hold();
  this->start();
}

// What is compared is the position that is kept, not one of a search that goes on.
void RefineEditor::stopAligning(pqPipelineSource* reference)
{
  QList<pqPipelineSource*> comparisons = comparisonsOf(this->Source);
  comparisons.append(reference);
  for (pqPipelineSource* compare : comparisons)
  {
    stopOn(compare);
  }
}

QString RefineEditor::beginRefinement(const RefineSettings& settings)
{
  const QString refused = whyNot(this->Source, settings);
  if (!refused.isEmpty())
  {
    return refused;
  }
  SCOPED_UNDO_EXCLUDE();
  const vtkSmartPointer<vtkSMProxy> compared = comparisonFor(this->Source, settings);
  vtkSMSourceProxy::SafeDownCast(compared)->UpdatePipeline();
  this->Compared = comparedBy(this->Source->getProxy(), compared);
  vtkSMProxy* run = this->makeRun(compared);
  vtkSMPropertyHelper(run, "Similarity").Set(settings.similarity);
  vtkSMPropertyHelper(run, "Stiffness").Set(settings.stiffness);
  const QString problem = this->beginRun("BeginRefinement");
  this->Start = this->numbers("ControlPoints");
  this->Points = this->Start;
  return problem;
}

void RefineEditor::readFigures()
{
  RefineFigures& at = this->Figures;
  const int former = at.steps;
  at.steps = static_cast<int>(this->figure("Steps"));
  at.done = this->figure("Done");
  at.overlap = this->figure("Overlap");
  at.overlapOf = this->text("OverlapOf");
  at.cost = this->figure("Cost");
  at.costBefore = this->figure("CostBefore");
  at.stepFraction = this->figure("StepFraction");
  at.largestChange = this->figure("LargestChange");
  at.meanChange = this->figure("MeanChange");
  at.refusal = this->text("Refusal");
  at.warning = this->text("Warning");
  at.trust = this->text("Trust");
  at.isChecking = this->figure("Checking") != 0.0;
  std::vector<double> points = this->numbers("ControlPoints");
  // Else the call tried a length of a step, or prepared a level. Where a refinement goes on from
  // elsewhere, or back to a better result, it moves between steps.
  this->IsDrawn = this->IsDrawn && points == this->Points && at.steps <= former;
  this->Points = std::move(points);
  if (at.steps > former)
  {
    this->Costs.append(at.costBefore > 0.0 ? at.cost / at.costBefore : 1.0);
  }
}

void RefineEditor::hold()
{
  SCOPED_UNDO_EXCLUDE();
  this->Base = this->lattice();
  this->Strokes = vtkSMPropertyHelper(this->Source->getProxy(), "Strokes").GetDoubleArray();
  const vtkSmartPointer<vtkSMProxy> made =
    makeLatticeFilter(this->Source->getProxy(), "RefinedLattice");
  made->SetAnnotation(UnderWay, "1");
  registerQuietly(made, "refined");
  this->Held = made;
  this->putIn(made, this->Points);
}

// The lattice contains the effect of base and strokes, so it replaces both.
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
  setNumbers(this->Held, "ControlPoints", this->Points);
  drawMoving(this->Source, this->Held);
}

void RefineEditor::takeStep()
{
  if (!hasServer(this->Held))
  {
    this->abandon(tr("The lattice of the refinement was deleted, so the refinement ended."));
    return;
  }
  if (
    !this
      ->IsDrawn) // in an event of its own, so that Stop waits for a step or a picture, not for both
  {
    this->show();
    if (this->Now == State::Running) // drawing may have processed an event that ended it
    {
      this->Next.start();
    }
    return;
  }
  if (!this->advance())
  {
    this->cancel(tr("The refinement failed. See the messages. Nothing was changed."));
    return;
  }
  this->readFigures();
  if (!this->Figures.refusal.isEmpty())
  {
    this->discard(tr("%1. Nothing was changed.").arg(this->Figures.refusal));
  }
  else if (this->Figures.done >= 1.0)
  {
    this->keep(State::Finished);
  }
  else
  {
    this->Next.start();
    Q_EMIT this->changed();
  }
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
  if (end == State::Kept && this->settle())
  {
    this->readFigures();
    if (!this->Figures.refusal.isEmpty())
    {
      this->discard(tr("%1. Nothing was changed.").arg(this->Figures.refusal));
      return;
    }
  }
  // Undo returns to the last state that the session saw, so restore the start first.
  this->restore();
  this->putResult();
  this->end(end, {});
}

void RefineEditor::putResult()
{
  StrokeEditor::of(this->Source)->showBefore(false); // its Strength is no part of the step
  if (this->Points != this->Start)
  {
    vtkSMProxy* deformation = this->Source->getProxy();
    SCOPED_UNDO_SET(tr("Refine"));
    vtkSmartPointer<vtkSMProxy> lattice = this->lattice();
    const QJsonArray landmarks = landmarksFittedBy(lattice);
    // The lattice of an earlier refinement is used again, unless another source uses it.
    if (isRefined(lattice) && !isUsedByOthers(lattice, deformation))
    {
      shareLattice(deformation, lattice);
    }
    else
    {
      lattice = makeLatticeFilter(deformation, "RefinedLattice");
      SM_SCOPED_TRACE(RegisterPipelineProxy).arg("proxy", lattice);
      registerQuietly(lattice, "refined");
    }
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", lattice);
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", deformation);
    this->putIn(lattice, this->Points);
    lattice->SetAnnotation("BrainShift.Refined", this->found().constData());
    keepFitted(lattice, landmarks);
    this->watch(lattice); // undo may change its control points alone
  }
  vtkSMProxy* proxy = this->Source->getProxy();
  vtkSMSourceProxy::SafeDownCast(proxy)->UpdatePipeline();
  pull(proxy, proxy->GetProperty("MinimumJacobian"));
  this->Figures.smallestDeterminant = vtkSMPropertyHelper(proxy, "MinimumJacobian").GetAsDouble();
}

// For registering.py, also once a state brings the lattice back.
QByteArray RefineEditor::found() const
{
  const RefineFigures& at = this->Figures;
  const QJsonObject told{ { "steps", at.steps }, { "finished", at.done >= 1.0 },
    { "cost", at.cost }, { "before", at.costBefore }, { "trust", at.trust },
    { "warning", at.warning }, { "of", this->Compared } };
  return QJsonDocument(told).toJson(QJsonDocument::Compact);
}

void RefineEditor::restore()
{
  this->Unselected.putBack();
  this->putBack();
  unregisterQuietly(std::exchange(this->Held, nullptr)); // its removal ends nothing
}

void RefineEditor::comeBack()
{
  this->Unselected.leaveOut(this->Source);
  this->hold();
  this->IsDrawn = true;
}

void RefineEditor::putBack()
{
  SCOPED_UNDO_EXCLUDE();
  const QScopedValueRollback<bool> writing(this->Writing, true);
  vtkSMProxy* deformation = this->Source->getProxy();
  this->putBaseBack();
  setNumbers(deformation, "Strokes", this->Strokes);
  deformation->UpdateVTKObjects();
}

void RefineEditor::putBaseBack()
{
  const bool isThere = this->Base && serverManagerModel()->findItem<pqPipelineSource*>(this->Base);
  setLattice(this->Source->getProxy(), isThere ? this->Base.GetPointer() : nullptr);
}

// Later: ParaView is iterating over its sources now, or undo is running.
void RefineEditor::releaseHeldSoon()
{
  QTimer::singleShot(0, qApp, [held = this->Held] { unregisterQuietly(held); });
}

void RefineEditor::release()
{
  this->Unselected.putBack();
  this->Held = nullptr;
  this->Base = nullptr;
  this->Reference = nullptr;
  this->Strokes = {};
}

void RefineEditor::abandon(const QString& problem)
{
  if (this->Held && this->lattice() != this->Held.Get())
  {
    this->releaseHeldSoon();
  }
  this->end(State::Idle, problem);
}

bool RefineEditor::dependsOn(vtkObject* object, const char* property) const
{
  if (object == this->Source->getProxy() && StrokeEditor::of(this->Source)->bringsBack(property))
  {
    return false;
  }
  const auto isChanged = [property](const char* name) { return std::strcmp(property, name) == 0; };
  if (object != this->Source->getProxy())
  {
    return isRefined(vtkSMProxy::SafeDownCast(object))
      ? isChanged("ControlPoints")
      : std::any_of(std::begin(CompareDependencies), std::end(CompareDependencies), isChanged);
  }
  return std::any_of(std::begin(BendDependencies), std::end(BendDependencies), isChanged) ||
    isLatticeSetting(this->Source->getProxy(), property);
}

// The result would not fit to what was changed, so base and strokes come back, before the change
// that is under way is sent: undo of it finds them.
void RefineEditor::followChange(vtkObject* object, const char* property)
{
  if (object != this->Source->getProxy())
  {
    const auto compare = vtkSMProxy::SafeDownCast(object);
    this->followReference(tr("%1 of %2 was changed")
        .arg(QString(compare->GetProperty(property)->GetXMLLabel()),
          this->Reference ? this->Reference->getSMName() : QString()));
    return;
  }
  vtkSMProxy* deformation = this->Source->getProxy();
  const pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  const bool bringsAll = stack && (stack->getInUndo() || stack->getInRedo());
  QString problem =
    tr("%1 of %2 was changed, so the refinement ended.")
      .arg(QString(deformation->GetProperty(property)->GetXMLLabel()), this->Source->getSMName());
  if (!bringsAll && std::strcmp(property, "Strokes") != 0)
  {
    problem += tr(" Its result is discarded.");
    const QScopedValueRollback<bool> writing(this->Writing, true);
    setNumbers(deformation, "Strokes", this->Strokes);
    const vtkSmartPointer<vtkSMProxy> lattice = this->lattice();
    this->putBaseBack();
    {
      SCOPED_UNDO_EXCLUDE(); // or undo of the change would bring what was under way
      deformation->UpdateProperty("Strokes");
      deformation->UpdateProperty("Lattice");
    }
    if (std::strcmp(property, "Lattice") == 0)
    {
      setLattice(deformation, lattice); // the change itself, to be sent by who made it
    }
    QTimer::singleShot(0, this->Source, [deformation] {
      SCOPED_UNDO_EXCLUDE();
      deformation->UpdateVTKObjects(); // what sent one property alone
    });
  }
  this->abandon(problem);
}
}
