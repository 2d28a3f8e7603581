// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/FitEditor.h"

#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkCommand.h>
#include <vtkSMParaViewPipelineController.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>

#include <QScopedValueRollback>

#include <glm/gtc/type_ptr.hpp>

#include <cstddef>
#include <cstring>
#include <string>

namespace brainshift
{
namespace
{
// The annotation of sources that BrainShift made; fitting.py has the same one.
constexpr const char* MadeByUs = "BrainShiftFit";

vtkSMProxy* latticeOf(vtkSMProxy* deformation)
{
  return vtkSMPropertyHelper(deformation, "Lattice", /*quiet*/ true).GetAsProxy();
}

// The rigid part of a fit: measured from rest, mm.
glm::dmat4 rigidOf(vtkSMProxy* fit)
{
  pull(fit, fit->GetProperty("Rigid"));
  const std::vector<double> rows = vtkSMPropertyHelper(fit, "Rigid").GetDoubleArray();
  return rows.size() == 16 ? glm::transpose(glm::make_mat4(rows.data())) : glm::dmat4(1.0);
}

// Positions (mm) of tissue at rest after a fit, without its rigid part. As many as `rest`, or none.
std::vector<glm::dvec3> positionsBy(vtkSMProxy* fit, const std::vector<glm::dvec3>& rest)
{
  if (rest.empty())
  {
    return {};
  }
  const vtkSmartPointer<vtkSMProxy> report = makeReport(fit, "FitReport");
  pointAt(report, "Filter", fit);
  vtkSMPropertyHelper(report, "Points")
    .Set(&rest.front().x, static_cast<unsigned int>(3 * rest.size()));
  const std::vector<double> numbers = answerOf(report, "Measured");
  const glm::dmat4 rigid = rigidOf(fit);
  const glm::dmat3 inverseRotation = glm::transpose(glm::dmat3(rigid));
  std::vector<glm::dvec3> positions;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
  {
    const glm::dvec3 measured(numbers[i], numbers[i + 1], numbers[i + 2]);
    positions.push_back(inverseRotation * (measured - glm::dvec3(rigid[3])));
  }
  return positions;
}
}

vtkSmartPointer<vtkSMProxy> makeLatticeFilter(
  vtkSMProxy* deformation, const char* kind, vtkSMProxy* base)
{
  auto made =
    vtk::TakeSmartPointer(deformation->GetSessionProxyManager()->NewProxy("filters", kind));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->PreInitializeProxy(made);
  shareLattice(deformation, made);
  if (base)
  {
    vtkSMPropertyHelper(made, "Base").Set(base);
  }
  controller->PostInitializeProxy(made);
  made->SetAnnotation(MadeByUs, "1");
  made->UpdateVTKObjects();
  return made;
}

void registerQuietly(vtkSMProxy* made, const char* what)
{
  vtkSMSessionProxyManager* manager = made->GetSessionProxyManager();
  const char* volume =
    manager->GetProxyName("sources", vtkSMPropertyHelper(made, "Input").GetAsProxy());
  const std::string name = (volume ? volume + std::string(" ") : std::string()) + what;
  std::string free = name;
  for (int number = 2; manager->GetProxy("sources", free.c_str()); ++number)
  {
    free = name + " " + std::to_string(number);
  }
  manager->RegisterProxy("sources", free.c_str(), made);
  made->SetLogName(free.c_str());
}

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

vtkSMSourceProxy* fitOf(pqPipelineSource* deformation)
{
  vtkSMProxy* lattice = isDeformation(deformation) ? latticeOf(deformation->getProxy()) : nullptr;
  const bool isFit = lattice && std::strcmp(lattice->GetXMLName(), "FitDeformation") == 0;
  return isFit ? vtkSMSourceProxy::SafeDownCast(lattice) : nullptr;
}

FitEditor* FitEditor::of(pqPipelineSource* source)
{
  if (!isDeformation(source))
  {
    return nullptr;
  }
  auto editor = source->findChild<FitEditor*>(QString(), Qt::FindDirectChildrenOnly);
  return editor ? editor : new FitEditor(source);
}

FitEditor::FitEditor(pqPipelineSource* source)
  : QObject(source)
  , Source(source)
{
  this->Redraw.setSingleShot(true);
  this->Redraw.setInterval(0);
  QObject::connect(&this->Redraw, &QTimer::timeout, this, &FitEditor::draw);
  vtkSMProxy* proxy = source->getProxy();
  this->OfSource->Connect(
    proxy->GetProperty("Lattice"), vtkCommand::ModifiedEvent, this, SLOT(noticeLattice()));
  this->OfSource->Connect(proxy, vtkCommand::UpdateEvent, this, SLOT(shareSettings()));
  QObject::connect(pqApplicationCore::instance(), &pqApplicationCore::aboutToWriteState, this,
    [this] { FitEditor::setLive(this->fit(), false); });
  QObject::connect(source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    [this] { this->BasePositions.reset(); });
  this->noticeLattice();
}

FitEditor::Numbers FitEditor::numbers(const char* list) const
{
  vtkSMProxy* proxy = this->fit();
  return proxy ? vtkSMPropertyHelper(proxy, list).GetDoubleArray() : Numbers();
}

std::vector<glm::dvec3> FitEditor::fittedPositions(const std::vector<glm::dvec3>& rest) const
{
  vtkSMProxy* proxy = this->fit();
  return proxy ? positionsBy(proxy, rest) : this->requestBase(rest);
}

std::vector<glm::dvec3> FitEditor::basePositions(const std::vector<glm::dvec3>& rest) const
{
  const std::vector<glm::dvec3> positions = this->requestBase(rest);
  return positions.size() == rest.size() ? positions : rest;
}

std::vector<glm::dvec3> FitEditor::requestBase(const std::vector<glm::dvec3>& rest) const
{
  if (rest.empty() || !this->base())
  {
    return {};
  }
  if (!this->BasePositions || this->BaseRest != rest)
  {
    SCOPED_UNDO_EXCLUDE();
    // Without measurements a fit is its base.
    const vtkSmartPointer<vtkSMProxy> alone = this->prepare();
    vtkSMSourceProxy::SafeDownCast(alone)->UpdatePipeline();
    this->BaseRest = rest;
    this->BasePositions = positionsBy(alone, rest);
  }
  return *this->BasePositions;
}

vtkSmartPointer<vtkSMProxy> FitEditor::base() const
{
  vtkSMProxy* made = this->fit();
  return made ? vtkSMPropertyHelper(made, "Base").GetAsProxy()
              : latticeOf(this->Source->getProxy());
}

void FitEditor::setLive(vtkSMProxy* fit, bool on)
{
  if (fit && vtkSMPropertyHelper(fit, "Live").GetAsInt() != int(on))
  {
    SCOPED_UNDO_EXCLUDE();
    vtkSMPropertyHelper(fit, "Live").Set(int(on));
    fit->UpdateVTKObjects();
  }
}

vtkSmartPointer<vtkSMProxy> FitEditor::prepare() const
{
  return makeLatticeFilter(this->Source->getProxy(), "FitDeformation", this->base());
}

void FitEditor::setLattice(vtkSMProxy* lattice)
{
  const QScopedValueRollback<bool> writing(this->Writing, true);
  vtkSMPropertyHelper property(this->Source->getProxy(), "Lattice");
  if (lattice)
  {
    property.Set(lattice);
  }
  else
  {
    property.RemoveAllValues();
  }
  this->Source->getProxy()->UpdateVTKObjects();
}

void FitEditor::make()
{
  const vtkSmartPointer<vtkSMProxy> made = this->prepare();
  {
    SM_SCOPED_TRACE(RegisterPipelineProxy).arg("proxy", made);
    registerQuietly(made, "fit");
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->Source->getProxy());
  this->setLattice(made);
}

void FitEditor::remove()
{
  const vtkSmartPointer<vtkSMProxy> made = this->fit();
  if (!made)
  {
    return;
  }
  this->setLattice(vtkSMPropertyHelper(made, "Base").GetAsProxy());
  made->GetSessionProxyManager()->UnRegisterProxy(made);
}

bool FitEditor::claim()
{
  this->cancel();
  vtkSMProxy* proxy = this->Source->getProxy();
  const vtkSMProxy* before = latticeOf(proxy);
  Q_EMIT this->aboutToEdit();
  return latticeOf(proxy) != before;
}

void FitEditor::edit(const QString& label, const std::function<void(vtkSMProxy*)>& change)
{
  this->claim();
  FitEditor::setLive(this->fit(), false); // Live must not become a part of an undo step
  {
    SCOPED_UNDO_SET(label);
    if (!this->fit())
    {
      this->make();
    }
    vtkSMProxy* proxy = this->fit();
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
    change(proxy);
    proxy->UpdateVTKObjects();
  }
  drawFully(this->Source);
}

void FitEditor::replace(const char* list, const Numbers& numbers, const QString& label)
{
  this->claim();
  if (numbers != this->numbers(list))
  {
    this->edit(label, [&](vtkSMProxy* fit) { setNumbers(fit, list, numbers); });
  }
}

void FitEditor::begin(const char* list, const Numbers& underHand)
{
  this->claim();
  this->List = list;
  this->Before = this->numbers(list);
  this->Made = !this->fit();
  if (this->Made)
  {
    SCOPED_UNDO_EXCLUDE(); // the temporary fit is neither undone nor traced
    const vtkSmartPointer<vtkSMProxy> made = this->prepare();
    registerQuietly(made, "fit");
    this->setLattice(made);
  }
  this->Editing = true;
  this->UnderHand = this->fit();
  FitEditor::setLive(this->UnderHand, true);
  this->change(underHand);
}

void FitEditor::change(const Numbers& underHand)
{
  if (this->Editing)
  {
    this->write(underHand);
    if (!this->Redraw.isActive())
    {
      this->Redraw.start();
    }
  }
}

void FitEditor::commit(const QString& label)
{
  if (!this->Editing)
  {
    return;
  }
  const Numbers after = this->numbers(this->List.c_str());
  // Undo returns to the last state that the session saw, so restore the start first.
  this->restore();
  this->stopEditing();
  this->replace(this->List.c_str(), after, label);
  drawFully(this->Source);
}

void FitEditor::cancel()
{
  if (this->Editing)
  {
    this->restore();
    this->stopEditing();
    drawFully(this->Source);
  }
}

void FitEditor::restore()
{
  SCOPED_UNDO_EXCLUDE();
  if (this->Made)
  {
    this->remove();
    return;
  }
  this->write(this->Before);
  this->fit()->UpdateVTKObjects();
}

void FitEditor::stopEditing()
{
  this->Redraw.stop();
  this->Editing = false;
  FitEditor::setLive(this->UnderHand, false);
  this->UnderHand = nullptr;
  Q_EMIT this->changed();
}

void FitEditor::write(const Numbers& numbers)
{
  const QScopedValueRollback<bool> writing(this->Writing, true);
  setNumbers(this->fit(), this->List.c_str(), numbers);
}

void FitEditor::noticeLattice()
{
  this->BasePositions.reset();
  this->OfFit->Disconnect();
  if (vtkSMProxy* proxy = this->fit())
  {
    this->OfFit->Connect(proxy, vtkCommand::PropertyModifiedEvent, this,
      SLOT(noticeFit(vtkObject*, unsigned long, void*, void*)));
  }
  if (this->Editing && !this->Writing)
  {
    this->stopEditing(); // undo, a script or the panel changed it: their value stays
  }
  Q_EMIT this->changed();
}

void FitEditor::noticeFit(vtkObject* fit, unsigned long, void*, void* name)
{
  const char* property = static_cast<const char*>(name);
  if (vtkSMProxy::SafeDownCast(fit)->GetProperty(property)->GetInformationOnly())
  {
    return;
  }
  if (this->Editing && !this->Writing && this->List == property)
  {
    this->stopEditing();
  }
  if (std::strcmp(property, "Base") == 0)
  {
    this->BasePositions.reset();
  }
  Q_EMIT this->changed();
}

// A fit that the user made and set up is left alone.
void FitEditor::shareSettings()
{
  vtkSMProxy* proxy = this->fit();
  if (proxy && proxy->HasAnnotation(MadeByUs))
  {
    shareLattice(this->Source->getProxy(), proxy);
    proxy->UpdateVTKObjects();
  }
}

void FitEditor::draw()
{
  drawMoving(this->Source, this->fit());
  Q_EMIT this->drawn();
}
}
