// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/SliceMouse.h"

#include "Common/ScreenScale.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"

#include <pqDataRepresentation.h>
#include <pqRenderView.h>
#include <pqRepresentation.h>
#include <pqUndoStack.h>

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkPVDataInformation.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewLayoutProxy.h>

#include <QScopedValueRollback>

#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

class vtkSMProxy;

namespace brainshift
{
// Slices of one volume in several views, bent in some and as loaded in others.

/// Lets the slices of the same volume in other views go through the same tissue as those of a
/// display, bent there or not. It renders nothing.
void followInOtherViews(vtkSMProxy* display);

namespace
{
// The volume that a source passes on without new voxels: that of the file, for a filter that
// deforms it, compares it, or has its moments or its resection.
vtkSMProxy* volumeOf(vtkSMProxy* source)
{
  const auto passesOn = [](vtkSMProxy* filter) {
    const std::string_view name = filter->GetXMLName();
    return name == "FreeFormDeformation" || name == "CompareVolumes" || name == "Moments" ||
      name == "Resection";
  };
  while (source && passesOn(source))
  {
    source = vtkSMPropertyHelper(source, "Input").GetAsProxy();
  }
  return source;
}

vtkSMProxy* volumeShownBy(vtkSMProxy* display)
{
  return volumeOf(vtkSMPropertyHelper(display, "Input").GetAsProxy());
}

// The rest position (mm) of tissue at a drawn position of a display, or the reverse.
std::vector<double> sameTissue(
  vtkSMProxy* display, const std::vector<double>& position, bool toRest)
{
  const vtkSmartPointer<vtkSMProxy> report = makeReport(display, "DeformedVolumeReport");
  pointAt(report, "Representation", display);
  vtkSMPropertyHelper(report, "Place").Set(position.data(), 3);
  vtkSMPropertyHelper(report, "ToRest").Set(toRest);
  return answerOf(report, "SameTissue");
}

}

void followInOtherViews(vtkSMProxy* display)
{
  const std::vector<double> drawn = vtkSMPropertyHelper(display, "SlicePosition").GetDoubleArray();
  vtkSMProxy* volume = volumeShownBy(display);
  pqServerManagerModel* model = serverManagerModel();
  std::vector<double> rest;
  for (pqDataRepresentation* other : model->findItems<pqDataRepresentation*>())
  {
    vtkSMProxy* follower = other->getProxy();
    if (!other->isVisible() || !showsSlices(other) || volumeShownBy(follower) != volume ||
      vtkSMPropertyHelper(follower, "Input").GetAsProxy() ==
        vtkSMPropertyHelper(display, "Input").GetAsProxy())
    {
      continue; // views of one source are linked if they were laid out together
    }
    rest = rest.empty() ? sameTissue(display, drawn, true) : rest;
    const std::vector<double> found = sameTissue(follower, rest, false);
    vtkSMPropertyHelper(follower, "SlicePosition").Set(found.data(), 3);
    follower->UpdateVTKObjects();
  }
}

namespace
{
constexpr float BeforeCamera = 0.1f; // before ParaView's camera, after tools that take the mouse
constexpr double Faces = 0.99; // least cosine between the viewing direction and a plane's normal
constexpr int Planes = 3;
constexpr const char* ShowNames[Planes] = { "ShowSagittal", "ShowCoronal", "ShowAxial" };
constexpr int Flat = 1;            // InteractionMode of a 2D view
constexpr int Wipe = 5;            // SliceComparison
constexpr double GripPixels = 6.0; // to either side of the wipe's line

bool showsSlices(pqRepresentation* representation)
{
  vtkSMProxy* proxy = representation->getProxy();
  return representation->isVisible() && proxy->GetProperty("Representation") &&
    std::strcmp(vtkSMPropertyHelper(proxy, "Representation").GetAsString(), "Deformed Slices") == 0;
}

// How the planes lie is known where they are drawn.
void askHowPlanesLie(vtkSMProxy* display, double normals[9], double voxelSteps[3])
{
  const vtkSmartPointer<vtkSMProxy> report = makeReport(display, "DeformedVolumeReport");
  pointAt(report, "Representation", display);
  std::fill_n(normals, 3 * Planes, 0.0);
  std::fill_n(voxelSteps, Planes, 0.0);
  const std::vector<double> lie = answerOf(report, "SliceNormals");
  const std::vector<double> steps = answerOf(report, "VoxelSteps");
  std::copy_n(lie.begin(), std::min<std::size_t>(lie.size(), 3 * Planes), normals);
  std::copy_n(steps.begin(), std::min<std::size_t>(steps.size(), Planes), voxelSteps);
}

void clampToInput(vtkSMProxy* display, double position[3])
{
  vtkSMPropertyHelper input(display, "Input");
  if (auto source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()))
  {
    double bounds[6];
    source->GetDataInformation(input.GetOutputPort())->GetBounds(bounds);
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = std::clamp(position[axis], bounds[2 * axis], bounds[2 * axis + 1]);
    }
  }
}

constexpr const char* ZoomName = "CameraParallelScale";

bool linkedViewsFollow = false; // while one view sends the others its zoom

bool isFlatWithSlices(pqRenderView* view)
{
  const QList<pqRepresentation*> displays = view->getRepresentations();
  return vtkSMPropertyHelper(view->getProxy(), "InteractionMode").GetAsInt() == Flat &&
    std::any_of(displays.begin(), displays.end(), showsSlices);
}

bool hasFlatSlices(vtkSMViewLayoutProxy* layout)
{
  pqServerManagerModel* model = serverManagerModel();
  const QList<pqRenderView*> views = model->findItems<pqRenderView*>();
  return std::any_of(views.begin(), views.end(), [layout](pqRenderView* view) {
    return layout->ContainsView(view->getViewProxy()) && isFlatWithSlices(view);
  });
}

// Draws every view of slices, for the position may be linked. Not the others: 3D takes its time.
void drawSlices()
{
  pqServerManagerModel* model = serverManagerModel();
  for (pqRenderView* view : model->findItems<pqRenderView*>())
  {
    const QList<pqRepresentation*> displays = view->getRepresentations();
    if (std::any_of(displays.begin(), displays.end(), showsSlices))
    {
      view->render();
    }
  }
}

// `name`: SlicePosition or WipePosition.
void setPosition(vtkSMProxy* display, const char* name, double position[3])
{
  SCOPED_UNDO_EXCLUDE(); // a camera is no edit
  clampToInput(display, position);
  vtkSMPropertyHelper(display, name).Set(position, 3);
  display->UpdateVTKObjects();
  if (std::strcmp(name, "SlicePosition") == 0)
  {
    followInOtherViews(display);
  }
  drawSlices();
}

// The direction that the wipe's line divides a plane across: see vtkDeformedSlicesMapper.
const double* acrossWipe(const double normals[9], int plane)
{
  constexpr int sagittal = 0;
  constexpr int coronal = 1;
  return normals + 3 * (plane == sagittal ? coronal : sagittal);
}

// Signed distance of a point from the line, mm.
double beyondWipe(vtkSMProxy* display, const double point[3], const double across[3])
{
  double position[3];
  vtkSMPropertyHelper(display, "WipePosition").Get(position, 3);
  vtkMath::Subtract(point, position, position);
  return vtkMath::Dot(position, across);
}
}

void bringSlicesTo(vtkSMProxy* display, const double position[3])
{
  double copy[3] = { position[0], position[1], position[2] };
  setPosition(display, "SlicePosition", copy);
}

void SliceMouse::watchViews(QObject* context)
{
  const auto watch = [](pqView* added) {
    auto view = qobject_cast<pqRenderView*>(added);
    if (view && view->getRenderViewProxy()->GetInteractor())
    {
      new SliceMouse(view); // Qt deletes it with the view
    }
  };
  pqServerManagerModel* model = serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, context, watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    watch(view);
  }
}

SliceMouse::SliceMouse(pqRenderView* view)
  : QObject(view)
  , View(view)
  , Interactor(view->getRenderViewProxy()->GetInteractor())
{
  const auto observe = [this](unsigned long event, auto method) {
    this->Observers.push_back(this->Interactor->AddObserver(event, this, method, BeforeCamera));
  };
  observe(vtkCommand::MouseWheelForwardEvent, &SliceMouse::onWheel);
  observe(vtkCommand::MouseWheelBackwardEvent, &SliceMouse::onWheel);
  observe(vtkCommand::LeftButtonPressEvent, &SliceMouse::onButton);
  observe(vtkCommand::LeftButtonReleaseEvent, &SliceMouse::onButton);
  observe(vtkCommand::RightButtonPressEvent, &SliceMouse::onRightButton);
  observe(vtkCommand::RightButtonReleaseEvent, &SliceMouse::onRightButton);
  observe(vtkCommand::LeftButtonDoubleClickEvent, &SliceMouse::onDoubleClick);
  observe(vtkCommand::MouseMoveEvent, &SliceMouse::onMove);
  this->Camera = view->getRenderViewProxy()->GetActiveCamera();
  this->CameraObserver =
    this->Camera->AddObserver(vtkCommand::ModifiedEvent, this, &SliceMouse::noticeZoom);
  this->AskedZoom = view->getProxy()->GetProperty(ZoomName);
  this->AskedObserver =
    this->AskedZoom->AddObserver(vtkCommand::ModifiedEvent, this, &SliceMouse::noticeAskedZoom);
  this->Sharing.setSingleShot(true);
  this->Sharing.setInterval(0);
  QObject::connect(&this->Sharing, &QTimer::timeout, this, &SliceMouse::sendZoom);
}

SliceMouse::~SliceMouse()
{
  for (const unsigned long observer : this->Observers)
  {
    if (this->Interactor)
    {
      this->Interactor->RemoveObserver(observer);
    }
  }
  if (this->Camera)
  {
    this->Camera->RemoveObserver(this->CameraObserver);
  }
  if (this->AskedZoom)
  {
    this->AskedZoom->RemoveObserver(this->AskedObserver);
  }
}

SliceMouse::Facing SliceMouse::facingSlice() const
{
  Facing facing;
  if (vtkSMPropertyHelper(this->View->getProxy(), "InteractionMode").GetAsInt() != Flat)
  {
    return facing;
  }
  const double* ahead =
    this->View->getRenderViewProxy()->GetRenderer()->GetActiveCamera()->GetDirectionOfProjection();
  for (pqRepresentation* representation : this->View->getRepresentations())
  {
    if (!showsSlices(representation))
    {
      continue;
    }
    vtkSMProxy* display = representation->getProxy();
    askHowPlanesLie(display, facing.normals, facing.voxelSteps);
    for (facing.plane = 0; facing.plane < Planes; ++facing.plane)
    {
      const double cosine = vtkMath::Dot(ahead, facing.normals + 3 * facing.plane);
      if (std::abs(cosine) > Faces &&
        vtkSMPropertyHelper(display, ShowNames[facing.plane]).GetAsInt())
      {
        facing.display = display;
        facing.isMoved = isMoved(qobject_cast<pqDataRepresentation*>(representation));
        return facing;
      }
    }
  }
  return facing;
}

SliceMouse* SliceMouse::of(pqRenderView* view)
{
  return view ? view->findChild<SliceMouse*>(QString(), Qt::FindDirectChildrenOnly) : nullptr;
}

bool SliceMouse::step(int voxels)
{
  const Facing slice = this->facingSlice();
  if (!slice.display)
  {
    return false;
  }
  double position[3];
  vtkSMPropertyHelper(slice.display, "SlicePosition").Get(position, 3);
  for (int i = 0; i < 3; ++i)
  {
    position[i] += voxels * slice.voxelSteps[slice.plane] * slice.normals[3 * slice.plane + i];
  }
  setPosition(slice.display, "SlicePosition", position);
  return true;
}

Command SliceMouse::commandOf(Mouse mouse) const
{
  return commandOfMouse(Scope::Slices, Tool::None, mouse, this->Interactor->GetShiftKey() != 0,
    this->Interactor->GetControlKey() != 0);
}

bool SliceMouse::onWheel(vtkObject*, unsigned long event, void*)
{
  const int voxels = event == vtkCommand::MouseWheelForwardEvent ? 1 : -1;
  return this->commandOf(Mouse::Wheel) == Command::StepSlices && this->step(voxels);
}

bool SliceMouse::onButton(vtkObject*, unsigned long event, void*)
{
  if (event == vtkCommand::LeftButtonReleaseEvent)
  {
    return std::exchange(this->Dragging, Drag::Nothing) != Drag::Nothing;
  }
  const Command command = this->commandOf(Mouse::Drag);
  const Facing slice = command == Command::None ? Facing() : this->facingSlice();
  this->Dragging = !slice.display || slice.isMoved          ? Drag::Nothing
    : command == Command::BringSlices                       ? Drag::Planes
    : command == Command::MoveWipe && this->isOnWipe(slice) ? Drag::Wipe
                                                            : Drag::Nothing;
  if (this->Dragging == Drag::Planes)
  {
    this->bringToCursor(slice);
  }
  return this->Dragging != Drag::Nothing;
}

bool SliceMouse::onRightButton(vtkObject*, unsigned long event, void*)
{
  if (event == vtkCommand::RightButtonReleaseEvent)
  {
    if (this->Dragging != Drag::GreyValues)
    {
      return false;
    }
    this->Dragging = Drag::Nothing;
    this->Greys.end();
    pqApplicationCore::instance()->render(); // the 3D view may use the same colour map
    return true;
  }
  const Command command = this->commandOf(Mouse::RightDrag);
  const Facing slice = command == Command::None ? Facing() : this->facingSlice();
  if (slice.display && command == Command::Zoom)
  {
    this->Interactor->SetControlKey(0); // without it ParaView's right button zooms
    return false;
  }
  if (!slice.display || !this->Greys.begin(slice.display, this->Interactor->GetEventPosition()))
  {
    return false;
  }
  this->Dragging = Drag::GreyValues;
  return true;
}

bool SliceMouse::onDoubleClick(vtkObject*, unsigned long, void*)
{
  const bool free = ToolSettings::instance()->tool() == Tool::None;
  const Command command = commandOfMouse(Scope::View, Tool::None, Mouse::DoubleClick, false, false);
  vtkSMViewLayoutProxy* layout = vtkSMViewLayoutProxy::FindLayout(this->View->getViewProxy());
  if (!free || command != Command::EnlargeView || !layout || !hasFlatSlices(layout))
  {
    return false;
  }
  SCOPED_UNDO_EXCLUDE();
  if (layout->GetMaximizedCell() < 0)
  {
    layout->MaximizeCell(layout->GetViewLocation(this->View->getViewProxy()));
  }
  else
  {
    layout->RestoreMaximizedState();
  }
  return true;
}

void SliceMouse::noticeZoom()
{
  const double zoom = this->Camera ? this->Camera->GetParallelScale() : this->Zoom;
  if (zoom != this->Zoom)
  {
    this->Zoom = zoom;
    this->Follows = linkedViewsFollow;
    this->Sharing.start(); // a camera changes in several steps
  }
}

void SliceMouse::noticeAskedZoom()
{
  vtkSMProxy* view = this->View->getProxy();
  if (this->Camera &&
    vtkSMPropertyHelper(view, ZoomName).GetAsDouble() != this->Camera->GetParallelScale())
  {
    SCOPED_UNDO_EXCLUDE();
    const QScopedValueRollback<bool> others(linkedViewsFollow, true);
    view->UpdateProperty(ZoomName, 1);
  }
}

void SliceMouse::sendZoom()
{
  vtkSMRenderViewProxy* view = this->View->getRenderViewProxy();
  if (!view || !this->Camera)
  {
    return;
  }
  const bool isSent = vtkSMPropertyHelper(view, ZoomName).GetAsDouble() == this->Zoom;
  // Also one that shows a volume in place of slices: the others are linked to it.
  if (!this->Follows && this->Camera->GetParallelProjection() != 0)
  {
    SCOPED_UNDO_EXCLUDE();
    const QScopedValueRollback<bool> others(linkedViewsFollow, true);
    view->SynchronizeCameraProperties();
    view->UpdateVTKObjects();
  }
  if (this->Follows || isSent) // else ParaView draws what the mouse does
  {
    this->View->render();
  }
}

bool SliceMouse::onMove(vtkObject*, unsigned long, void*)
{
  if (this->Dragging == Drag::GreyValues)
  {
    this->Greys.dragTo(
      this->Interactor->GetEventPosition(), screenScale(this->Interactor->GetRenderWindow()));
    drawSlices();
    return true;
  }
  const Facing slice = this->Dragging != Drag::Nothing ? this->facingSlice() : Facing();
  if (!slice.display)
  {
    return false;
  }
  if (this->Dragging == Drag::Wipe)
  {
    this->bringWipeToCursor(slice);
  }
  else
  {
    this->bringToCursor(slice);
  }
  return true;
}

void SliceMouse::findCursor(const Facing& slice, double world[3]) const
{
  const int* pixel = this->Interactor->GetEventPosition();
  vtkRenderer* renderer = this->View->getRenderViewProxy()->GetRenderer();
  renderer->SetDisplayPoint(pixel[0], pixel[1], 0.0);
  renderer->DisplayToWorld();
  const double* point = renderer->GetWorldPoint(); // parallel: anywhere on the pixel's line will do
  double position[3];
  vtkSMPropertyHelper(slice.display, "SlicePosition").Get(position, 3);
  const double* normal = slice.normals + 3 * slice.plane;
  double across = 0.0; // from the slice to that point
  for (int i = 0; i < 3; ++i)
  {
    world[i] = point[i] / point[3];
    across += (world[i] - position[i]) * normal[i];
  }
  for (int i = 0; i < 3; ++i)
  {
    world[i] -= across * normal[i];
  }
}

// Moves the other two planes to the cursor, and keeps this one.
void SliceMouse::bringToCursor(const Facing& slice)
{
  double position[3];
  this->findCursor(slice, position);
  setPosition(slice.display, "SlicePosition", position);
}

bool SliceMouse::isOnWipe(const Facing& slice) const
{
  if (vtkSMPropertyHelper(slice.display, "SliceComparison").GetAsInt() != Wipe)
  {
    return false;
  }
  double cursor[3];
  this->findCursor(slice, cursor);
  vtkRenderer* renderer = this->View->getRenderViewProxy()->GetRenderer();
  const double pixelMm =
    2.0 * renderer->GetActiveCamera()->GetParallelScale() / renderer->GetSize()[1];
  return std::abs(beyondWipe(slice.display, cursor, acrossWipe(slice.normals, slice.plane))) <=
    GripPixels * screenScale(renderer->GetVTKWindow()) * pixelMm;
}

void SliceMouse::bringWipeToCursor(const Facing& slice)
{
  double cursor[3];
  this->findCursor(slice, cursor);
  const double* across = acrossWipe(slice.normals, slice.plane);
  const double beyond = beyondWipe(slice.display, cursor, across);
  double position[3];
  vtkSMPropertyHelper(slice.display, "WipePosition").Get(position, 3);
  for (int i = 0; i < 3; ++i)
  {
    position[i] += beyond * across[i];
  }
  setPosition(slice.display, "WipePosition", position);
}
}
