// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/StrokeEditor.h"

#include "Common/Problem.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkCommand.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>

#include <QScopedValueRollback>
#include <QSignalBlocker>

#include <cstddef>
#include <cstring>

namespace brainshift
{
namespace
{
StrokeEditor::Strokes joined(StrokeEditor::Strokes first, const StrokeEditor::Strokes& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}
}

StrokeEditor* StrokeEditor::of(pqPipelineSource* source)
{
  if (!isDeformation(source))
  {
    return nullptr;
  }
  auto editor = source->findChild<StrokeEditor*>(QString(), Qt::FindDirectChildrenOnly);
  return editor ? editor : new StrokeEditor(source);
}

StrokeEditor* StrokeEditor::of(vtkSMSourceProxy* proxy)
{
  pqServerManagerModel* model = serverManagerModel();
  return proxy ? StrokeEditor::of(model->findItem<pqPipelineSource*>(proxy)) : nullptr;
}

StrokeEditor::StrokeEditor(pqPipelineSource* source)
  : QObject(source)
  , Source(source)
{
  this->Redraw.setSingleShot(true);
  this->Redraw.setInterval(0);
  QObject::connect(&this->Redraw, &QTimer::timeout, this, &StrokeEditor::draw);
  QObject::connect(pqApplicationCore::instance(), &pqApplicationCore::aboutToWriteState, this,
    [this] { this->Unselected.putBack(); }); // a state file must not miss selections
  this->Connector->Connect(
    source->getProxy()->GetProperty("Strokes"), vtkCommand::ModifiedEvent, this, SLOT(notice()));
}

StrokeEditor::Strokes StrokeEditor::strokes() const
{
  Strokes strokes; // none if the numbers are bad
  problemOf([&] {
    strokes =
      strokesFromNumbers(vtkSMPropertyHelper(this->Source->getProxy(), "Strokes").GetDoubleArray());
  });
  return strokes;
}

void StrokeEditor::begin(const Strokes& underHand)
{
  this->cancel();
  Q_EMIT this->aboutToEdit();
  const Strokes before = this->strokes();
  this->startEditing(before, before, underHand);
}

void StrokeEditor::beginAtLast(const Stroke& stroke)
{
  this->cancel();
  Q_EMIT this->aboutToEdit();
  const Strokes before = this->strokes();
  Strokes kept = before;
  if (!kept.empty())
  {
    kept.pop_back();
  }
  this->startEditing(before, kept, { stroke });
}

void StrokeEditor::startEditing(
  const Strokes& before, const Strokes& kept, const Strokes& underHand)
{
  if (before.empty() &&
    vtkSMPropertyHelper(this->Source->getProxy(), "Strokes").GetNumberOfElements() > 0)
  {
    return; // numbers that are no strokes: the filter reports the error, and they are kept
  }
  this->Before = before;
  this->Kept = kept;
  this->Editing = true;
  this->Unselected.leaveOut(this->Source);
  Q_EMIT this->editing(true);
  this->change(underHand);
}

void StrokeEditor::stopEditing()
{
  this->Redraw.stop();
  this->Editing = false;
  this->Unselected.putBack();
  Q_EMIT this->editing(false);
}

void StrokeEditor::change(const Strokes& underHand)
{
  if (this->Editing)
  {
    this->write(joined(this->Kept, underHand));
    this->drawSoon();
  }
}

void StrokeEditor::commit(const QString& label)
{
  if (!this->Editing)
  {
    return;
  }
  const Strokes after = this->strokes();
  {
    // Undo returns to the last state that the session saw, so restore the start first.
    SCOPED_UNDO_EXCLUDE();
    const QSignalBlocker quiet(this);
    this->write(this->Before);
    this->Source->getProxy()->UpdateVTKObjects();
  }
  this->stopEditing();
  this->replaceAll(after, label);
  drawFully(this->Source);
}

void StrokeEditor::cancel()
{
  if (this->Editing)
  {
    SCOPED_UNDO_EXCLUDE();
    this->write(this->Before);
    this->Source->getProxy()->UpdateVTKObjects();
    this->stopEditing();
    drawFully(this->Source);
  }
}

void StrokeEditor::replaceAll(const Strokes& strokes, const QString& label)
{
  this->cancel();
  Q_EMIT this->aboutToEdit();
  const unsigned int numbers =
    vtkSMPropertyHelper(this->Source->getProxy(), "Strokes").GetNumberOfElements();
  if (strokes == this->strokes() && strokes.size() * NumbersPerStroke == numbers)
  {
    return; // and not for numbers that are no strokes, which read as none
  }
  vtkSMProxy* proxy = this->Source->getProxy();
  {
    SCOPED_UNDO_SET(label);
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
    this->write(strokes);
    proxy->UpdateVTKObjects();
  }
  drawFully(this->Source);
}

void StrokeEditor::walkThrough(const std::function<void()>& measure)
{
  this->cancel();
  vtkSMProxy* proxy = this->Source->getProxy();
  const Strokes all = this->strokes();
  if (all.empty())
  {
    return; // or they are numbers that are no strokes: they are not lost
  }
  Q_EMIT this->aboutToEdit(); // no registration goes on from strokes that come and go
  SCOPED_UNDO_EXCLUDE();
  const QSignalBlocker silent(this);
  const QScopedValueRollback<bool> walking(this->Walking, true);
  for (std::size_t count = 0; count <= all.size(); ++count)
  {
    this->write(Strokes(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)));
    proxy->UpdateVTKObjects();
    measure();
  }
}

bool StrokeEditor::bringsBack(const char* property) const
{
  return (this->Walking && std::strcmp(property, "Strokes") == 0) ||
    (this->ShowsBefore && std::strcmp(property, "Strength") == 0);
}

void StrokeEditor::showBefore(bool on)
{
  if (on == this->ShowsBefore)
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper strength(this->Source->getProxy(), "Strength");
  this->StrengthAfter = on ? strength.GetAsDouble() : this->StrengthAfter;
  this->ShowsBefore = true; // also while Strength comes back: that is no change of it
  this->TimesBefore += on ? 1 : 0;
  strength.Set(on ? 0.0 : this->StrengthAfter);
  this->Source->getProxy()->UpdateVTKObjects();
  this->ShowsBefore = on;
  drawFully(this->Source);
}

void StrokeEditor::changeStrength(double strength)
{
  vtkSMPropertyHelper property(this->Source->getProxy(), "Strength");
  if (!this->ChangesStrength)
  {
    this->showBefore(false);
    Q_EMIT this->aboutToEdit();
    this->ChangesStrength = true;
    this->StrengthBefore = property.GetAsDouble();
  }
  property.Set(strength);
  this->drawSoon();
}

void StrokeEditor::commitStrength()
{
  if (!this->ChangesStrength)
  {
    return;
  }
  this->ChangesStrength = false;
  this->Redraw.stop();
  vtkSMProxy* proxy = this->Source->getProxy();
  vtkSMPropertyHelper property(proxy, "Strength");
  const double after = property.GetAsDouble();
  {
    SCOPED_UNDO_EXCLUDE(); // undo returns to the last state that the session saw
    property.Set(this->StrengthBefore);
    proxy->UpdateVTKObjects();
  }
  {
    SCOPED_UNDO_SET("Change Strength");
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
    property.Set(after);
    proxy->UpdateVTKObjects();
  }
  drawFully(this->Source);
}

void StrokeEditor::write(const Strokes& strokes)
{
  const std::vector<double> numbers = numbersFromStrokes(strokes);
  this->Writing = true;
  vtkSMPropertyHelper property(this->Source->getProxy(), "Strokes");
  if (numbers.empty())
  {
    property.SetNumberOfElements(0);
  }
  else
  {
    property.Set(numbers.data(), static_cast<unsigned int>(numbers.size()));
  }
  this->Writing = false;
}

void StrokeEditor::notice()
{
  if (this->Editing && !this->Writing)
  {
    this->stopEditing(); // undo, a script or the panel changed it: their value stays
  }
  Q_EMIT this->changed();
}

void StrokeEditor::drawSoon()
{
  if (!this->Redraw.isActive())
  {
    this->Redraw.start();
  }
}

void StrokeEditor::draw()
{
  drawMoving(this->Source);
  Q_EMIT this->drawn();
}

namespace
{
constexpr const char* Name = "PointOfInterest";
}

void setPointOfInterest(vtkSMProxy* filter, const glm::dvec3& position)
{
  glm::dvec3 before(0.0);
  vtkSMPropertyHelper property(filter, Name);
  property.Get(&before[0], 3);
  if (position == before)
  {
    return;
  }
  SCOPED_UNDO_SET("Point of interest");
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
  property.Set(&position[0], 3);
  filter->UpdateVTKObjects();
}

void centrePointOfInterest(vtkSMProxy* filter)
{
  // The property's domain has the centre. An unchecked value is not sent to observers.
  vtkSMProperty* property = filter->GetProperty(Name);
  property->ResetToDomainDefaults(/*use_unchecked_values*/ true);
  vtkSMPropertyHelper unchecked(property);
  unchecked.SetUseUnchecked(true);
  glm::dvec3 centre(0.0);
  unchecked.Get(&centre[0], 3);
  property->ClearUncheckedElements();
  setPointOfInterest(filter, centre);
}
}
