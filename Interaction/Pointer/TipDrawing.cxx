// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Pointer/TipDrawing.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqUndoStack.h>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPVRenderView.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>

#include <array>
#include <cstddef>

namespace brainshift
{
namespace
{
constexpr double TipRadiusMm = 1.5;
constexpr double ShaftRadiusMm = 0.6;
constexpr double ShaftLengthMm = 60.0;
constexpr double UnseenMm = 0.02; // less than a pixel
constexpr float TracePixels = 5.0F;
constexpr std::array<double, 3> TipColor{ 1.0, 0.85, 0.2 };
constexpr std::array<double, 3> ShaftColor{ 0.9, 0.9, 0.9 };
constexpr std::array<double, 3> TraceColor{ 1.0, 0.45, 0.05 };

vtkRenderer* layerOf(pqRenderView* view)
{
  auto window = vtkPVRenderView::SafeDownCast(view->getRenderViewProxy()->GetClientSideObject());
  return window ? window->GetNonCompositedRenderer() : nullptr;
}

// Rays are cast anew for a still picture unless it is kept.
void keepPicture(pqDataRepresentation* display, bool keep)
{
  const vtkSMPropertyHelper now(display->getProxy(), "KeepPicture", /*quiet*/ true);
  if (now.GetNumberOfElements() == 1 && (now.GetAsInt() != 0) != keep)
  {
    SCOPED_UNDO_EXCLUDE();
    vtkSMPropertyHelper(display->getProxy(), "KeepPicture").Set(keep ? 1 : 0);
    display->getProxy()->UpdateVTKObjects();
  }
}
}

struct TipDrawing::Parts
{
  vtkNew<vtkSphereSource> Ball;
  vtkNew<vtkLineSource> Line;
  vtkNew<vtkTubeFilter> Tube;
  vtkNew<vtkPolyData> Trace;
  std::array<vtkNew<vtkActor>, 3> Actors; // tip, shaft, trace
  glm::dvec3 Tip{ 0.0 };
  glm::dvec3 End{ 0.0 }; // of the shaft
  bool TraceChanged = false;
  QList<QPointer<pqRenderView>> Views;
  QList<QPointer<pqDataRepresentation>> Kept;

  void remove(pqRenderView* view) const
  {
    if (vtkRenderer* layer = view ? layerOf(view) : nullptr)
    {
      for (const auto& actor : this->Actors)
      {
        layer->RemoveActor(actor);
      }
    }
  }
};

TipDrawing::TipDrawing()
  : Internal(std::make_unique<Parts>())
{
  Parts& parts = *this->Internal;
  parts.Ball->SetRadius(TipRadiusMm);
  parts.Ball->SetThetaResolution(20);
  parts.Ball->SetPhiResolution(20);
  parts.Tube->SetInputConnection(parts.Line->GetOutputPort());
  parts.Tube->SetRadius(ShaftRadiusMm);
  parts.Tube->SetNumberOfSides(12);
  std::array<vtkNew<vtkPolyDataMapper>, 3> mappers;
  mappers[0]->SetInputConnection(parts.Ball->GetOutputPort());
  mappers[1]->SetInputConnection(parts.Tube->GetOutputPort());
  mappers[2]->SetInputData(parts.Trace);
  const std::array<std::array<double, 3>, 3> colors{ TipColor, ShaftColor, TraceColor };
  for (std::size_t i = 0; i < mappers.size(); ++i)
  {
    parts.Actors[i]->SetMapper(mappers[i]);
    parts.Actors[i]->PickableOff();
    parts.Actors[i]->VisibilityOff();
    parts.Actors[i]->GetProperty()->SetColor(colors[i][0], colors[i][1], colors[i][2]);
    parts.Actors[i]->GetProperty()->SetAmbient(0.4);
    parts.Actors[i]->GetProperty()->SetDiffuse(0.6);
  }
  parts.Actors[2]->GetProperty()->LightingOff();
  parts.Actors[2]->GetProperty()->SetPointSize(TracePixels);
  parts.Actors[2]->GetProperty()->RenderPointsAsSpheresOn();
}

TipDrawing::~TipDrawing() = default;

void TipDrawing::show(const glm::dvec3& tip, const glm::dvec3& shaft)
{
  Parts& parts = *this->Internal;
  const glm::dvec3 end = tip + ShaftLengthMm * shaft;
  if (this->Shown && !parts.TraceChanged && glm::distance(tip, parts.Tip) < UnseenMm &&
    glm::distance(end, parts.End) < UnseenMm)
  {
    return; // a tip at rest needs no pictures
  }
  parts.Tip = tip;
  parts.End = end;
  parts.TraceChanged = false;
  parts.Ball->SetCenter(tip.x, tip.y, tip.z);
  parts.Line->SetPoint1(tip.x, tip.y, tip.z);
  parts.Line->SetPoint2(end.x, end.y, end.z);
  parts.Actors[0]->VisibilityOn();
  parts.Actors[1]->VisibilityOn();
  this->Shown = true;
  this->enterViews();
  this->draw();
}

void TipDrawing::hide()
{
  if (this->Shown)
  {
    this->Shown = false;
    this->Internal->Actors[0]->VisibilityOff();
    this->Internal->Actors[1]->VisibilityOff();
    this->draw();
  }
}

void TipDrawing::setTrace(const std::vector<double>& points)
{
  vtkNew<vtkPoints> traced;
  vtkNew<vtkCellArray> vertices;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
  {
    const vtkIdType added = traced->InsertNextPoint(points[i], points[i + 1], points[i + 2]);
    vertices->InsertNextCell(1, &added);
  }
  this->Internal->Trace->SetPoints(traced);
  this->Internal->Trace->SetVerts(vertices);
  this->Internal->Trace->Modified();
  this->Internal->TraceChanged = true;
  this->Internal->Actors[2]->SetVisibility(traced->GetNumberOfPoints() > 0);
}

void TipDrawing::enterViews()
{
  Parts& parts = *this->Internal;
  pqServerManagerModel* model = serverManagerModel();
  for (pqRenderView* view : model->findItems<pqRenderView*>())
  {
    vtkRenderer* layer = parts.Views.contains(view) ? nullptr : layerOf(view);
    if (layer)
    {
      for (const auto& actor : parts.Actors)
      {
        layer->AddActor(actor);
      }
      parts.Views.append(view);
    }
    pqPipelineSource* deformation = activeDeformation(view);
    pqDataRepresentation* display = deformation ? bentDisplay(deformation, view) : nullptr;
    if (display)
    {
      keepPicture(display, true);
      if (!parts.Kept.contains(display))
      {
        parts.Kept.append(display);
      }
    }
  }
}

void TipDrawing::draw()
{
  for (const QPointer<pqRenderView>& view : this->Internal->Views)
  {
    if (view && this->Bending)
    {
      drawRoughly(view);
    }
    else if (view)
    {
      view->render();
    }
  }
}

void TipDrawing::leave(pqRenderView* view)
{
  this->Internal->remove(view);
  this->Internal->Views.removeAll(view);
}

void TipDrawing::leaveAll()
{
  Parts& parts = *this->Internal;
  this->hide();
  this->setTrace({});
  for (const QPointer<pqDataRepresentation>& display : parts.Kept)
  {
    if (display)
    {
      keepPicture(display, false);
    }
  }
  parts.Kept.clear();
  for (const QPointer<pqRenderView>& view : parts.Views)
  {
    parts.remove(view);
  }
  this->draw();
  parts.Views.clear();
}
}
