// SPDX-License-Identifier: BSD-3-Clause
#include "Plugin/FirstLook.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/LabelMaps.h"
#include "Interaction/Displays/VolumeLook.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Plugin/FirstSight.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqView.h>

#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkSMArrayListDomain.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTransferFunctionManager.h>
#include <vtkSMTransferFunctionProxy.h>

#include <QPointer>
#include <QTimer>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace brainshift
{
namespace
{
enum class Users // of a colour map
{
  None,
  Related,
  Strangers
};

Users usersOf(vtkSMProxy* colors, pqDataRepresentation* asking)
{
  Users users = Users::None;
  auto model = serverManagerModel();
  vtkSMProxy* atRest = isDeformation(sourceOf(asking))
    ? vtkSMPropertyHelper(sourceOf(asking)->getProxy(), "Input").GetAsProxy()
    : nullptr;
  for (auto display : model->findItems<pqDataRepresentation*>())
  {
    if (display == asking || display->getLookupTableProxy() != colors)
    {
      continue;
    }
    if (isMadeOf(sourceOf(display), sourceOf(asking)) ||
      isMadeOf(sourceOf(asking), sourceOf(display)) || isBentFrom(sourceOf(display), atRest))
    {
      return Users::Related;
    }
    users = Users::Strangers;
  }
  return users;
}

void hideScale(pqDataRepresentation* display)
{
  if (display->getView())
  {
    vtkSMPVRepresentationProxy::SafeDownCast(display->getProxy())
      ->SetScalarBarVisibility(display->getView()->getProxy(), false);
  }
}

// What follows Apply is one step to undo, not one for each property.
constexpr const char* StepName = "First look";

// Turns the camera to the tissue, and takes the scale of colours away, which natural colours do not
// need. Both later: then the display has a view, and ParaView has placed the camera.
void finishLater(pqDataRepresentation* display, const std::vector<double>& tissue)
{
  noteTissue(display, tissue);
  QTimer::singleShot(0, display, [display] {
    SCOPED_UNDO_SET(tr(StepName));
    if (!showsVolume(display) || !display->getView()) // slices by now
    {
      return;
    }
    hideScale(display);
    bringIntoSight(display);
    display->getView()->render();
  });
}

bool isScaleShown(vtkSMProxy* colors)
{
  auto model = serverManagerModel();
  const QList<pqView*> views = model->findItems<pqView*>();
  return std::any_of(views.begin(), views.end(), [&](pqView* view) {
    vtkSMProxy* scale =
      vtkSMTransferFunctionProxy::FindScalarBarRepresentation(colors, view->getProxy());
    return scale && vtkSMPropertyHelper(scale, "Visibility").GetAsInt() != 0;
  });
}

void outline(pqDataRepresentation* display)
{
  vtkSMPropertyHelper(display->getProxy(), "Representation").Set("Outline");
  display->getProxy()->UpdateVTKObjects();
}

// Labels are never blended.
void drawNearest(pqDataRepresentation* display)
{
  for (const char* name : { "InterpolationType", "SliceInterpolation" })
  {
    if (display->getProxy()->GetProperty(name))
    {
      vtkSMPropertyHelper(display->getProxy(), name).Set(0);
    }
  }
  display->getProxy()->UpdateVTKObjects();
}

bool isOfReader(pqDataRepresentation* display)
{
  return !qobject_cast<pqPipelineFilter*>(sourceOf(display));
}

unsigned int countColorMaps(vtkSMProxy* beside)
{
  return beside->GetSessionProxyManager()->GetNumberOfProxies("lookup_tables");
}

VolumeLook firstLookOf(pqDataRepresentation* display)
{
  VolumeLook look = makeVolumeLook(display);
  const QString chosen = chosenLook(look.kind);
  return chosen != look.name && look.names.contains(chosen) ? makeVolumeLook(display, chosen)
                                                            : look;
}
}

void colorByFirstArray(pqDataRepresentation* display)
{
  auto representation = vtkSMPVRepresentationProxy::SafeDownCast(display->getProxy());
  vtkSMProperty* property = representation->GetProperty("ColorArrayName");
  auto arrays = property ? property->FindDomain<vtkSMArrayListDomain>() : nullptr;
  if (!arrays || arrays->GetNumberOfStrings() == 0)
  {
    return;
  }
  unsigned int chosen = 0;
  for (unsigned int i = arrays->GetNumberOfStrings(); i-- > 0;)
  {
    chosen = arrays->GetFieldAssociation(i) == vtkDataObject::POINT ? i : chosen;
  }
  const unsigned int before = countColorMaps(representation);
  if (representation->SetScalarColoring(
        arrays->GetString(chosen), arrays->GetFieldAssociation(chosen)) &&
    countColorMaps(representation) > before) // others have their range
  {
    representation->RescaleTransferFunctionToDataRange(true);
  }
}

namespace
{
void giveLook(pqDataRepresentation* display)
{
  const VolumeLook look = firstLookOf(display);
  if (look.kind == "Labels")
  {
    drawNearest(display);
  }
  if (look.kind == "Labels" && isOfReader(display))
  {
    outline(display);
    noteLabelMap(sourceOf(display));
    // Later: ParaView shows the scale of an outline, too.
    QTimer::singleShot(0, display, [display] {
      SCOPED_UNDO_SET(tr(StepName));
      hideScale(display);
    });
  }
  if (!look.name.isEmpty())
  {
    applyLook(display, look);
    finishLater(display, look.tissue);
  }
  else if (display->getLookupTableProxy())
  {
    noteUnchosen(display->getLookupTableProxy());
  }
}

// A display of an input of a source with colours of its own, not those of the array's name nor the
// greys of slices.
pqDataRepresentation* ownColoredInput(pqDataRepresentation* display)
{
  auto model = serverManagerModel();
  for (auto other : model->findItems<pqDataRepresentation*>())
  {
    if (other != display && other->getLookupTableProxy() && !showsSlices(other) &&
      vtkSMPropertyHelper(other->getProxy(), "UseSeparateColorMap", true).GetAsInt() != 0 &&
      isMadeOf(sourceOf(display), sourceOf(other)))
    {
      return other;
    }
  }
  return nullptr;
}
void takeOwnColors(pqDataRepresentation* display)
{
  vtkSMPropertyHelper(display->getProxy(), "UseSeparateColorMap", true).Set(1);
  colorByFirstArray(display);
  giveLook(display);
}
}

void showFirstLook(pqDataRepresentation* display)
{
  if (isReplayed())
  {
    // Redo brings colours and scale back itself; other volumes may share the map of this one.
    QTimer::singleShot(0, display, [display] {
      if (showsVolume(display))
      {
        noteTissue(display, firstLookOf(display).tissue);
      }
    });
    return;
  }
  const unsigned int before = countColorMaps(display->getProxy());
  colorByFirstArray(display);
  vtkSMProxy* colors = display->getLookupTableProxy();
  const bool isNew = countColorMaps(display->getProxy()) > before;
  const Users users = colors && !isNew ? usersOf(colors, display) : Users::None;
  if (users == Users::Strangers && !ownColoredInput(display)) // else it joins that look
  {
    // Later: ParaView still sets the colours of the array's name when it registers a display, and
    // shows their scale.
    const bool wasShown = isScaleShown(colors);
    QTimer::singleShot(0, display, [display, wasShown] {
      SCOPED_UNDO_SET(tr(StepName));
      if (!wasShown)
      {
        hideScale(display);
      }
      if (showsVolume(display)) // slices have their own greys by now
      {
        takeOwnColors(display);
      }
    });
  }
  else if (colors && users == Users::None && (isNew || isLook(colors) || isUnchosen(colors)))
  {
    giveLook(display);
  }
}

void shareColors(pqDataRepresentation* display, pqDataRepresentation* from)
{
  vtkSMProxy* to = display->getProxy();
  for (const char* map : { "LookupTable", "ScalarOpacityFunction" })
  {
    vtkSMProxy* shared = vtkSMPropertyHelper(from->getProxy(), map).GetAsProxy();
    vtkSMPropertyHelper own(to, map);
    if (own.GetAsProxy() != shared)
    {
      vtkSMPropertyHelper(to, "UseSeparateColorMap").Set(1);
      own.Set(shared);
    }
  }
  to->UpdateVTKObjects();
}

void joinLook(pqDataRepresentation* display)
{
  pqDataRepresentation* input = ownColoredInput(display);
  vtkSMProxy* colors = (input ? input : display)->getLookupTableProxy();
  if (!colors || (!input && !isLook(colors)))
  {
    return;
  }
  const bool hides = isLook(colors) && !isScaleShown(colors);
  // Later: ParaView still sets the colours of the array's name when it registers a display.
  const QPointer<pqDataRepresentation> from = input;
  QTimer::singleShot(0, display, [display, from, hides] {
    SCOPED_UNDO_EXCLUDE(); // it belongs to Apply
    if (hides)
    {
      hideScale(display); // that of the array's name
    }
    if (!showsVolume(display)) // slices have their own greys by now
    {
      return;
    }
    if (from)
    {
      shareColors(display, from);
    }
    if (hides)
    {
      hideScale(display);
    }
    display->renderViewEventually();
  });
}

namespace
{
constexpr const char* Distance = "DistanceToCortex";

bool showsTraceDistance(pqDataRepresentation* display)
{
  pqPipelineSource* source = display->getInput();
  return source && std::strcmp(source->getProxy()->GetXMLName(), "TraceDistance") == 0;
}

// Whole mm; 0 if there are no distances.
double largestDistance(pqDataRepresentation* display)
{
  auto source = vtkSMSourceProxy::SafeDownCast(display->getInput()->getProxy());
  vtkPVArrayInformation* distances =
    source->GetDataInformation(0)->GetPointDataInformation()->GetArrayInformation(Distance);
  if (!distances)
  {
    return 0.0;
  }
  const double* range = distances->GetComponentRange(0);
  return range[0] <= range[1] ? std::ceil(std::max(std::abs(range[0]), std::abs(range[1]))) : 0.0;
}

// Saturated purple inside, white at the cortex, saturated green outside: unlike skin, bone, brain
// and greys, and distinct for the colour-blind. Only points very near the cortex are pale.
void colorInsideAndOutside(vtkSMProxy* colors, double largest)
{
  const std::array<double, 20> points{ -1.0, 0.48, 0.0, 0.75, -0.25, 0.75, 0.35, 1.0, //
    0.0, 1.0, 1.0, 1.0,                                                               //
    0.25, 0.2, 0.85, 0.3, 1.0, 0.0, 0.5, 0.1 };
  vtkSMPropertyHelper(colors, "RGBPoints").Set(points.data(), points.size());
  vtkSMPropertyHelper(colors, "ColorSpace").Set("RGB");
  colors->UpdateVTKObjects();
  vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, -largest, largest);
}

void labelScale(vtkSMProxy* colors, vtkSMProxy* view)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* bar = manager->GetScalarBarRepresentation(colors, view);
  vtkSMPropertyHelper(bar, "Title").Set("Distance to the cortex (mm)");
  vtkSMPropertyHelper(bar, "ComponentTitle").Set("");
  vtkSMPropertyHelper format(bar, "RangeLabelFormat"); // of printf, from 6.1 on of std::format
  format.Set(std::strchr(format.GetAsString(), '{') ? "{:.0f}" : "%.0f");
  bar->UpdateVTKObjects();
}

// They would lie within ours.
void hideTracedPoints(pqDataRepresentation* display)
{
  auto filter = qobject_cast<pqPipelineFilter*>(display->getInput());
  pqOutputPort* points = filter ? filter->getInput("Input", 0) : nullptr;
  if (pqDataRepresentation* traced =
        points ? points->getRepresentation(display->getView()) : nullptr)
  {
    traced->setVisible(false);
  }
}
}

void showByDistance(pqDataRepresentation* display)
{
  if (!showsTraceDistance(display))
  {
    return;
  }
  auto representation = vtkSMPVRepresentationProxy::SafeDownCast(display->getProxy());
  const double largest = largestDistance(display);
  if (!display->getView() || largest <= 0.0 ||
    !representation->SetScalarColoring(Distance, vtkDataObject::POINT))
  {
    return;
  }
  vtkSMProxy* view = display->getView()->getProxy();
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  colorInsideAndOutside(colors, largest);
  labelScale(colors, view);
  representation->SetScalarBarVisibility(view, true);
  representation->UpdateVTKObjects();
  hideTracedPoints(display);
  display->getView()->render();
}
}
