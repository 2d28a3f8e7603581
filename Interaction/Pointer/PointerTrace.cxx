// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Pointer/PointerTrace.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Pointer/TipDistance.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMParaViewPipelineControllerWithRendering.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewProxy.h>

#include <array>
#include <cstring>

namespace brainshift
{
namespace
{
constexpr double SpacingMm = 0.5;
constexpr std::size_t MostPoints = 100'000;
constexpr double PointPixels = 6.0;
constexpr std::array<double, 3> Orange{ 1.0, 0.45, 0.05 };

void setPoints(vtkSMProxy* source, const std::vector<double>& points)
{
  vtkSMPropertyHelper(source, "Points")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  source->UpdateVTKObjects();
}

// Not by the controller, which would make it the active source.
vtkSmartPointer<vtkSMProxy> newSource(vtkSMProxy* beside, const std::vector<double>& points)
{
  vtkSMSessionProxyManager* manager = beside->GetSessionProxyManager();
  auto made = vtk::TakeSmartPointer(manager->NewProxy("sources", "PolyPointSource"));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->InitializeProxy(made);
  setPoints(made, points);
  const std::string name = manager->GetUniqueProxyName("sources", "Traced Points", false);
  manager->RegisterProxy("sources", name.c_str(), made);
  made->SetLogName(name.c_str());
  return made;
}

// While a trace is recorded, the pointer draws it.
void showIn(pqView* view, vtkSMProxy* source)
{
  if (!view)
  {
    return;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSMProxy* display =
    controller->Show(vtkSMSourceProxy::SafeDownCast(source), 0, view->getViewProxy());
  if (display)
  {
    vtkSMPropertyHelper(display, "PointSize", /*quiet*/ true).Set(PointPixels);
    vtkSMPropertyHelper(display, "RenderPointsAsSpheres", true).Set(1);
    vtkSMPropertyHelper(display, "AmbientColor", true).Set(Orange.data(), 3);
    vtkSMPropertyHelper(display, "DiffuseColor", true).Set(Orange.data(), 3);
    display->UpdateVTKObjects();
  }
}
}

vtkSmartPointer<vtkSMProxy> PointerTrace::traces() const
{
  vtkSMProxy* fit = this->Deformation ? fitOf(this->Deformation) : nullptr;
  return fit ? vtkSMPropertyHelper(fit, "Traces").GetAsProxy() : nullptr;
}

int PointerTrace::added() const
{
  return static_cast<int>((this->Points.size() - this->Before.size()) / 3);
}

QString PointerTrace::begin(pqPipelineSource* deformation, double threshold)
{
  FitEditor* editor = FitEditor::of(deformation);
  if (!editor)
  {
    return tr("There is no Free-Form Deformation to edit.");
  }
  editor->claim(); // a run may have put another Lattice there for a while
  this->Deformation = deformation;
  this->Threshold = threshold;
  const vtkSmartPointer<vtkSMProxy> source = this->traces();
  if (source && std::strcmp(source->GetXMLName(), "PolyPointSource") != 0)
  {
    return tr("The fit takes its Traces from %1. Set Traces to None first.")
      .arg(source->GetXMLLabel());
  }
  this->HadFit = editor->fit();
  this->HadTraces = source;
  this->Before =
    source ? vtkSMPropertyHelper(source, "Points").GetDoubleArray() : std::vector<double>();
  this->Points = this->Before;
  this->Bent = this->Points.size();
  this->Recording = true;
  return {};
}

void PointerTrace::add(const glm::dvec3& tip)
{
  const std::size_t size = this->Points.size();
  if (!this->Recording || size >= 3 * MostPoints)
  {
    return;
  }
  const bool isFirst = size == this->Before.size();
  if (isFirst ||
    glm::distance(
      tip, glm::dvec3(this->Points[size - 3], this->Points[size - 2], this->Points[size - 1])) >=
      SpacingMm)
  {
    this->Points.insert(this->Points.end(), { tip.x, tip.y, tip.z });
  }
}

// Makes what is missing, and sets the points. `forNow`: the fit that the trace made for a while; a
// hand may have pulled and pinned on it.
void PointerTrace::write(const QString& label, vtkSMProxy* forNow)
{
  const vtkSmartPointer<vtkSMProxy> source = this->traces();
  FitEditor::of(this->Deformation)->edit(label, [&](vtkSMProxy* fit) {
    if (source)
    {
      setPoints(source, this->Points);
      return;
    }
    if (forNow)
    {
      fit->Copy(forNow);
    }
    else if (!this->HadFit)
    {
      vtkSMProxy* from = cortexOf(this->Deformation);
      setCortex(fit, from == fit ? nullptr : from, this->Threshold);
    }
    const vtkSmartPointer<vtkSMProxy> made = newSource(fit, this->Points);
    vtkSMPropertyHelper(fit, "Traces").Set(made, 0);
    if (!this->Recording)
    {
      showIn(pqActiveObjects::instance().activeView(), made);
    }
  });
}

void PointerTrace::fit()
{
  if (!this->Recording || this->Points.size() == this->Bent || !this->Deformation)
  {
    return;
  }
  this->Bent = this->Points.size();
  SCOPED_UNDO_EXCLUDE();
  if (const vtkSmartPointer<vtkSMProxy> source = this->traces())
  {
    setPoints(source, this->Points);
    FitEditor::setLive(fitOf(this->Deformation), true);
    drawMoving(this->Deformation, fitOf(this->Deformation));
  }
  else
  {
    this->write({});
  }
}

// What undo comes back to is what the session saw last, so it sees the beginning once more.
void PointerTrace::restore()
{
  SCOPED_UNDO_EXCLUDE();
  const vtkSmartPointer<vtkSMProxy> source = this->traces();
  const vtkSmartPointer<vtkSMProxy> fit = fitOf(this->Deformation);
  if (!source)
  {
    return;
  }
  if (this->HadTraces)
  {
    setPoints(source, this->Before);
    return;
  }
  vtkSMPropertyHelper(fit, "Traces").RemoveAllValues();
  fit->UpdateVTKObjects();
  if (!this->HadFit)
  {
    FitEditor::of(this->Deformation)->remove();
  }
  source->GetSessionProxyManager()->UnRegisterProxy(source);
}

pqPipelineSource* PointerTrace::deformation() const
{
  return this->Deformation;
}

void PointerTrace::abandon()
{
  this->Recording = false;
  FitEditor::setLive(this->Deformation ? fitOf(this->Deformation) : nullptr, false);
}

void PointerTrace::end()
{
  if (!this->Recording)
  {
    return;
  }
  this->Recording = false;
  FitEditor::setLive(this->Deformation ? fitOf(this->Deformation) : nullptr, false);
  if (this->Deformation && this->Points.size() > this->Before.size())
  {
    const vtkSmartPointer<vtkSMProxy> forNow = this->HadFit ? nullptr : fitOf(this->Deformation);
    this->restore();
    this->write(tr("Record Trace"), forNow);
  }
}
}
