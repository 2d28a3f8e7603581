// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Landmarks/LandmarkPicker.h"

#include "Common/ScreenScale.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Landmarks/LandmarkList.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/SliceMouse.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>

#include <QApplication>
#include <QKeyEvent>
#include <QScopedValueRollback>

#include <cstring>

namespace brainshift
{
namespace
{
constexpr float Priority = 2.0f;    // before everything else in a view
constexpr double ClickPixels = 4.0; // a press that goes farther is a drag

glm::ivec2 pixelOf(vtkRenderWindowInteractor* interactor)
{
  const int* at = interactor->GetEventPosition();
  return { at[0], at[1] };
}

bool showsBent(pqPipelineSource* deformation, pqDataRepresentation* display)
{
  return display == bentDisplay(deformation, display->getView()) && !isMoved(display);
}
}

LandmarkPicker* LandmarkPicker::instance()
{
  pqApplicationCore* core = pqApplicationCore::instance();
  auto picker = core->findChild<LandmarkPicker*>(QString(), Qt::FindDirectChildrenOnly);
  return picker ? picker : new LandmarkPicker(core);
}

LandmarkPicker::LandmarkPicker(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = serverManagerModel();
  this->connect(model, &pqServerManagerModel::viewAdded, this, [this](pqView* view) {
    if (this->Deformation)
    {
      this->watch(qobject_cast<pqRenderView*>(view));
    }
  });
  this->connect(model, &pqServerManagerModel::preViewRemoved, this, [this](pqView* view) {
    const auto isOf = [view](const Watched& watched) { return watched.view == view; };
    for (const Watched& gone : this->Views)
    {
      for (const unsigned long observer : gone.observers)
      {
        isOf(gone) ? gone.interactor->RemoveObserver(observer) : void();
      }
    }
    this->Views.erase(
      std::remove_if(this->Views.begin(), this->Views.end(), isOf), this->Views.end());
    this->Probe.forget();
    this->PressedIn = nullptr;
  });
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this, [this](auto* source) {
    if (source == this->Deformation)
    {
      this->stop();
    }
  });
  this->connect(ToolSettings::instance(), &ToolSettings::changed, this, [this] {
    if (this->Deformation && ToolSettings::instance()->tool() != Tool::None)
    {
      this->stop(); // the hand took a tool
    }
  });
  this->connect(qApp, &QCoreApplication::aboutToQuit, this, &LandmarkPicker::stop);
}

pqPipelineSource* LandmarkPicker::deformation() const
{
  return this->Deformation;
}

void LandmarkPicker::start(pqPipelineSource* deformation)
{
  this->stop();
  ToolSettings::instance()->setTool(Tool::None);
  this->Deformation = deformation;
  pqServerManagerModel* model = serverManagerModel();
  for (pqRenderView* view : model->findItems<pqRenderView*>())
  {
    this->watch(view);
  }
  qApp->installEventFilter(this);
  this->connect(LandmarkList::of(deformation), &LandmarkList::changed, this, [this] {
    if (this->Deformation && !this->Picked)
    {
      this->request(); // the number of the next pair is another one
    }
  });
  this->request();
  Q_EMIT this->changed();
}

void LandmarkPicker::stop()
{
  if (!this->Deformation)
  {
    return;
  }
  LandmarkList::of(this->Deformation)->disconnect(this);
  qApp->removeEventFilter(this);
  this->forgetViews();
  this->Deformation = nullptr;
  this->Picked.reset();
  this->PressedIn = nullptr;
  this->Probe.forget();
  ToolSettings::instance()->setRequest({});
  Q_EMIT this->changed();
}

void LandmarkPicker::watch(pqRenderView* view)
{
  vtkRenderWindowInteractor* interactor =
    view ? view->getRenderViewProxy()->GetInteractor() : nullptr;
  if (!interactor)
  {
    return;
  }
  Watched watched{ view, interactor, {} };
  const auto observe = [&](unsigned long event, auto method) {
    watched.observers.push_back(interactor->AddObserver(event, this, method, Priority));
  };
  observe(vtkCommand::LeftButtonPressEvent, &LandmarkPicker::onPress);
  observe(vtkCommand::LeftButtonDoubleClickEvent, &LandmarkPicker::onPress);
  observe(vtkCommand::MouseMoveEvent, &LandmarkPicker::onMove);
  observe(vtkCommand::LeftButtonReleaseEvent, &LandmarkPicker::onRelease);
  this->Views.push_back(watched);
}

void LandmarkPicker::forgetViews()
{
  for (const Watched& watched : this->Views)
  {
    for (const unsigned long observer : watched.observers)
    {
      watched.interactor->RemoveObserver(observer);
    }
  }
  this->Views.clear();
}

const LandmarkPicker::Watched* LandmarkPicker::watched(vtkObject* interactor) const
{
  const auto found = std::find_if(this->Views.begin(), this->Views.end(),
    [interactor](const Watched& watched) { return watched.interactor.GetPointer() == interactor; });
  return found == this->Views.end() ? nullptr : &*found;
}

bool LandmarkPicker::onPress(vtkObject* caller, unsigned long, void*)
{
  const Watched* in = this->watched(caller);
  if (this->Passing || !in || in->interactor->GetShiftKey() || in->interactor->GetControlKey())
  {
    return false;
  }
  this->PressedIn = caller;
  this->PressedAt = pixelOf(in->interactor);
  return true;
}

// A press that becomes a drag starts the camera at the position of the press.
bool LandmarkPicker::onMove(vtkObject* caller, unsigned long, void*)
{
  const Watched* in = this->watched(caller);
  if (!in || caller != this->PressedIn)
  {
    return false;
  }
  const glm::ivec2 now = pixelOf(in->interactor);
  const double farthest = ClickPixels * screenScale(in->interactor->GetRenderWindow());
  if (glm::distance(glm::dvec2(now), glm::dvec2(this->PressedAt)) <= farthest)
  {
    return true;
  }
  const vtkSmartPointer<vtkRenderWindowInteractor> interactor = in->interactor;
  const QScopedValueRollback<bool> passing(this->Passing, true);
  this->PressedIn = nullptr;
  interactor->SetEventPosition(this->PressedAt.x, this->PressedAt.y);
  interactor->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  interactor->SetEventPosition(now.x, now.y);
  return false;
}

bool LandmarkPicker::onRelease(vtkObject* caller, unsigned long, void*)
{
  const Watched* in = this->watched(caller);
  if (!in || caller != this->PressedIn)
  {
    return false;
  }
  this->PressedIn = nullptr;
  this->pick(in->view, this->PressedAt);
  return true;
}

void LandmarkPicker::pick(pqRenderView* view, const glm::ivec2& pixel)
{
  pqPipelineSource* deformation = this->Deformation;
  const auto bent = [deformation](
                      pqDataRepresentation* display) { return showsBent(deformation, display); };
  const auto other = [deformation](
                       pqDataRepresentation* display) { return showsOther(deformation, display); };
  if (view->getViewProxy()->GetNeedsUpdate())
  {
    view->forceRender(); // what is clicked is what is drawn
  }
  std::optional<CursorTissue> found = this->Probe.tissueAt(view, pixel.x, pixel.y, bent);
  if (!this->Picked)
  {
    if (found)
    {
      this->Picked = Half{ found->rest, found->deformed };
      bringCrosshairTo(deformation, found->deformed);
    }
    this->request(found
        ? QString()
        : tr("No tissue of %1 is at that position. ").arg(deformation->getSMName()));
    Q_EMIT this->changed();
    return;
  }
  // A reference that is shown beside the bent volume comes first.
  const std::optional<CursorTissue> reference = this->Probe.tissueAt(view, pixel.x, pixel.y, other);
  found = reference ? reference : found;
  if (!found)
  {
    const bool isVolume = this->Probe.tissueAt(view, pixel.x, pixel.y).has_value();
    this->request(isVolume
        ? tr("The volume at that position is no reference, or its display has a Translation, an "
             "Orientation or a Scale, or a Compare Volumes moves it: then click it there. ")
        : tr("No volume is at that position. "));
    return;
  }
  const glm::dvec3 rest = this->Picked->rest;
  this->Picked.reset();
  LandmarkList::of(deformation)->add(rest, found->deformed);
  this->request();
  Q_EMIT this->changed();
}

void LandmarkPicker::request(const QString& before)
{
  const std::size_t number = LandmarkList::of(this->Deformation)->rows().size() + 1;
  const QString name = this->Deformation->getSMName();
  const QString words = !this->Picked
    ? tr("Landmark %1: click it in the bent volume %2. Press Escape to stop.").arg(number).arg(name)
    : isReferenceShown(this->Deformation)
    ? tr("Landmark %1: click the same position in the reference. Press Escape to stop.").arg(number)
    : tr("Landmark %1: no reference is shown. Click the measured position of this landmark. Press "
         "Escape to stop.")
        .arg(number);
  ToolSettings::instance()->setRequest(before + words);
}

bool LandmarkPicker::eventFilter(QObject* watched, QEvent* event)
{
  const QEvent::Type type = event->type();
  const bool isKey = type == QEvent::KeyPress || type == QEvent::ShortcutOverride;
  if (!isKey || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape)
  {
    return QObject::eventFilter(watched, event);
  }
  event->accept(); // or a shortcut of the window comes first
  if (type == QEvent::KeyPress)
  {
    this->stop();
  }
  return true;
}

namespace
{
bool isComparison(const pqPipelineSource* source)
{
  return std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") == 0;
}

bool isZero(vtkSMProxy* comparison, const char* property)
{
  glm::dvec3 numbers(0.0);
  vtkSMPropertyHelper(comparison, property).Get(&numbers[0], 3);
  return numbers == glm::dvec3(0.0);
}

// Whether a display shows a reference where its file has it, while a comparison with a volume moves
// it, as Align does: a landmark that is measured there lacks that motion.
bool showsBeforeAlign(vtkSMProxy* atRest, pqDataRepresentation* display)
{
  vtkSMProxy* shown = vtkSMPropertyHelper(display->getProxy(), "Input").GetAsProxy();
  const QList<pqPipelineSource*> sources = serverManagerModel()->findItems<pqPipelineSource*>();
  return std::any_of(sources.begin(), sources.end(), [&](pqPipelineSource* source) {
    vtkSMProxy* proxy = source->getProxy();
    return isComparison(source) && vtkSMPropertyHelper(proxy, "Reference").GetAsProxy() == shown &&
      isBentFrom(source, atRest) &&
      !(isZero(proxy, "ReferenceRotation") && isZero(proxy, "ReferenceTranslation"));
  });
}

QList<pqDataRepresentation*> shownVolumes()
{
  QList<pqDataRepresentation*> shown;
  pqServerManagerModel* model = serverManagerModel();
  for (pqDataRepresentation* display : model->findItems<pqDataRepresentation*>())
  {
    if (display->isVisible() && display->getView() && display->getOutputPortFromInput() &&
      (showsSlices(display) || showsVolume(display)))
    {
      shown.append(display);
    }
  }
  return shown;
}

// Whether a display shows the undeformed volume of a Free-Form Deformation.
bool showsAsLoaded(pqPipelineSource* deformation, pqDataRepresentation* display)
{
  return display->getOutputPortFromInput()->getSource()->getProxy() ==
    vtkSMPropertyHelper(deformation->getProxy(), "Input").GetAsProxy();
}
}

void bringCrosshairTo(pqPipelineSource* deformation, const glm::dvec3& drawn)
{
  for (pqDataRepresentation* display : shownVolumes())
  {
    glm::dvec3 now(0.0);
    if (!showsSlices(display) || showsAsLoaded(deformation, display))
    {
      continue; // the latter follows the bent one
    }
    vtkSMPropertyHelper(display->getProxy(), "SlicePosition").Get(&now[0], 3);
    if (now != drawn) // views that are linked have followed already
    {
      bringSlicesTo(display->getProxy(), &drawn[0]);
    }
  }
}

bool showsOther(pqPipelineSource* deformation, pqDataRepresentation* display)
{
  vtkSMProxy* atRest = vtkSMPropertyHelper(deformation->getProxy(), "Input").GetAsProxy();
  return display->isVisible() && (showsSlices(display) || showsVolume(display)) &&
    !isMoved(display) && vtkSMPropertyHelper(display->getProxy(), "Input").GetAsProxy() != atRest &&
    !isBentFrom(display->getInput(), atRest) && !showsBeforeAlign(atRest, display);
}

bool isReferenceShown(pqPipelineSource* deformation)
{
  const QList<pqDataRepresentation*> shown = shownVolumes();
  return std::any_of(shown.begin(), shown.end(), [deformation](pqDataRepresentation* display) {
    const bool bent = display == bentDisplay(deformation, display->getView());
    return bent ? isComparison(display->getInput()) : showsOther(deformation, display);
  });
}
}
