// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/AlignEditor.h"

#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Edits/RefineEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Flicker.h"

#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>

#include <QElapsedTimer>
#include <QScopedValueRollback>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>

namespace brainshift
{
namespace
{
constexpr std::size_t NumbersOfPlacement = 6;

// Fields of the panel hold these digits of mm and degrees; an alignment is less exact.
constexpr double Digits = 1e4;

constexpr qint64 SearchMs = 40; // between two pictures, so that Stop takes effect soon

constexpr const char* Placement[] = { "ReferenceRotation", "ReferenceTranslation" };
// An alignment depends on these properties. A change of one of them ends it.
constexpr const char* ComparedDependencies[] = { "Input", "Reference", "Cavity", "CavityLabels" };
// Of the deformation, beside the settings of the lattice.
constexpr const char* DeformationDependencies[] = { "Input", "Lattice", "Strokes", "Strength",
  "Inverse" };

template <std::size_t Count>
bool isAmong(const char* const (&names)[Count], const char* name)
{
  return std::any_of(std::begin(names), std::end(names),
    [name](const char* known) { return std::strcmp(known, name) == 0; });
}
}

AlignEditor* AlignEditor::of(pqPipelineSource* source)
{
  if (!isComparison(source))
  {
    return nullptr;
  }
  auto editor = source->findChild<AlignEditor*>(QString(), Qt::FindDirectChildrenOnly);
  return editor ? editor : new AlignEditor(source);
}

AlignEditor::AlignEditor(pqPipelineSource* source)
  : LiveRun(source)
{
}

void AlignEditor::followRemoval(pqPipelineSource* source)
{
  if (source == this->Source)
  {
    this->cancel(); // undo brings it back as it was before
  }
}

// The deformed volume is compared. If the user edits it meanwhile, the result so far is kept.
void AlignEditor::followDeformation()
{
  pqPipelineSource* bent = deformationUpstream(this->Source);
  if (!bent)
  {
    return;
  }
  this->watch(bent->getProxy());
  this->watch(vtkSMPropertyHelper(bent->getProxy(), "Lattice", /*quiet*/ true).GetAsProxy());
  this->Edits = { this->connect(
                    StrokeEditor::of(bent), &StrokeEditor::aboutToEdit, this, &AlignEditor::stop),
    this->connect(FitEditor::of(bent), &FitEditor::aboutToEdit, this, &AlignEditor::stop) };
}

void AlignEditor::begin()
{
  this->cancel();
  Flicker::stop();
  if (pqPipelineSource* bent = deformationUpstream(this->Source))
  {
    StrokeEditor::of(bent)->cancel();
    FitEditor::of(bent)->cancel();
    stopOn(bent);
  }
  this->Figures = {};
  const QString problem = this->beginAlignment();
  if (!problem.isEmpty())
  {
    this->end(State::Idle, problem);
    return;
  }
  this->followDeformation();
  this->start();
}

QString AlignEditor::beginAlignment()
{
  const QString unapplied = whyUnapplied(this->Source);
  if (!unapplied.isEmpty())
  {
    return unapplied;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSMProxy* compare = this->Source->getProxy();
  vtkSMSourceProxy::SafeDownCast(compare)->UpdatePipeline();
  this->Start = this->now();
  vtkSMProxy* run = this->makeRun(compare);
  vtkSMPropertyHelper(run, "StartRotation").Set(&this->Start.rotation[0], 3);
  vtkSMPropertyHelper(run, "StartTranslation").Set(&this->Start.translation[0], 3);
  return this->beginRun("BeginAlignment");
}

AlignEditor::ReferencePlacement AlignEditor::now() const
{
  ReferencePlacement placement;
  vtkSMPropertyHelper(this->Source->getProxy(), Placement[0]).Get(&placement.rotation[0], 3);
  vtkSMPropertyHelper(this->Source->getProxy(), Placement[1]).Get(&placement.translation[0], 3);
  return placement;
}

AlignEditor::ReferencePlacement AlignEditor::found() const
{
  const std::vector<double> numbers = this->numbers("Placement");
  if (numbers.size() != NumbersOfPlacement)
  {
    return this->Start;
  }
  ReferencePlacement placement;
  placement.rotation = glm::round(glm::make_vec3(numbers.data()) * Digits) / Digits;
  placement.translation = glm::round(glm::make_vec3(&numbers[3]) * Digits) / Digits;
  return placement;
}

void AlignEditor::put(const ReferencePlacement& placement)
{
  const QScopedValueRollback<bool> writing(this->Writing, true);
  vtkSMProxy* compare = this->Source->getProxy();
  vtkSMPropertyHelper(compare, Placement[0]).Set(&placement.rotation[0], 3);
  vtkSMPropertyHelper(compare, Placement[1]).Set(&placement.translation[0], 3);
  compare->UpdateVTKObjects();
}

void AlignEditor::readFigures()
{
  AlignFigures& at = this->Figures;
  at.lines = static_cast<int>(this->figure("Steps"));
  at.done = this->figure("Done");
  at.overlap = this->figure("Overlap");
  at.information = this->figure("Information");
  at.informationBefore = this->figure("InformationBefore");
  at.shift = this->figure("Shift");
  at.rotation = this->figure("Rotation");
  at.refusal = this->text("Refusal");
  at.warning = this->text("Warning");
  at.trust = this->text("Trust");
  at.isChecking = this->figure("Checking") != 0.0;
}

void AlignEditor::takeStep()
{
  QElapsedTimer since;
  since.start();
  do
  {
    if (!this->advance())
    {
      this->cancel(
        tr("Align failed. See the messages. The reference is back at its previous position."));
      return;
    }
    this->readFigures();
  } while (this->Figures.done < 1.0 && since.elapsed() < SearchMs);
  this->show();
  if (!this->isActive())
  {
    return; // drawing may have processed an event that ended it
  }
  if (this->Figures.done >= 1.0)
  {
    this->keep(State::Finished);
    return;
  }
  this->Next.start();
  Q_EMIT this->changed();
}

// The checks after the last line move nothing.
void AlignEditor::show()
{
  const ReferencePlacement now = this->now();
  const ReferencePlacement found = this->found();
  if (found.rotation != now.rotation || found.translation != now.translation)
  {
    {
      SCOPED_UNDO_EXCLUDE();
      this->put(found);
    }
    drawMoving(this->Source);
  }
}

void AlignEditor::keep(State end)
{
  const bool hasBegun = this->Figures.lines > 0;
  this->Result = hasBegun ? this->found() : this->Start;
  if (!this->Figures.refusal.isEmpty())
  {
    this->discard(
      tr("%1. The reference is back at its previous position.").arg(this->Figures.refusal));
    return;
  }
  // Undo returns to the last state that the session saw, so restore the start first.
  this->restore();
  this->putResult();
  this->end(end, {});
}

void AlignEditor::putResult()
{
  const ReferencePlacement& found = this->Result;
  if (found.rotation != this->Start.rotation || found.translation != this->Start.translation)
  {
    SCOPED_UNDO_SET(tr("Align"));
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->Source->getProxy());
    this->put(found);
  }
}

void AlignEditor::restore()
{
  SCOPED_UNDO_EXCLUDE();
  this->put(this->Start);
}

void AlignEditor::comeBack()
{
  SCOPED_UNDO_EXCLUDE();
  this->put(this->found());
}

void AlignEditor::release()
{
  for (const QMetaObject::Connection& edit : this->Edits)
  {
    QObject::disconnect(edit);
  }
  this->Edits.clear();
}

bool AlignEditor::dependsOn(vtkObject* object, const char* property) const
{
  if (object == this->Source->getProxy())
  {
    return isAmong(Placement, property) || isAmong(ComparedDependencies, property);
  }
  auto proxy = vtkSMProxy::SafeDownCast(object);
  if (!proxy->GetProperty("Strokes")) // a lattice; an edit of it has stopped a search already
  {
    vtkSMProperty* changed = proxy->GetProperty(property);
    return !this->isActive() && changed && !changed->GetInformationOnly();
  }
  const StrokeEditor* strokes = StrokeEditor::of(vtkSMSourceProxy::SafeDownCast(proxy));
  if (strokes && strokes->bringsBack(property))
  {
    return false;
  }
  return isAmong(DeformationDependencies, property) || isLatticeSetting(proxy, property);
}

void AlignEditor::followChange(vtkObject* object, const char* property)
{
  auto proxy = vtkSMProxy::SafeDownCast(object);
  vtkSMProperty* changed = proxy->GetProperty(property);
  const QString label = changed ? changed->GetXMLLabel() : property;
  const bool isOwn = proxy == this->Source->getProxy();
  if (isOwn && isAmong(Placement, property))
  {
    // The value that was set from outside stays; the other property returns to its start.
    SCOPED_UNDO_EXCLUDE();
    ReferencePlacement wanted = this->Start;
    const ReferencePlacement now = this->now();
    (std::strcmp(property, Placement[0]) == 0 ? wanted.rotation : wanted.translation) =
      std::strcmp(property, Placement[0]) == 0 ? now.rotation : now.translation;
    this->put(wanted);
    this->end(State::Idle, tr("%1 was changed, so Align ended.").arg(label));
  }
  else
  {
    this->cancel(
      tr("%1 was changed, so Align ended. The reference is back at its previous position.")
        .arg(label));
  }
}
}
