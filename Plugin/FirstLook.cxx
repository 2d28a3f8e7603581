// SPDX-License-Identifier: BSD-3-Clause
#include "Plugin/FirstLook.h"

#include "Interaction/Views/VolumeLook.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqView.h>

#include <vtkDataObject.h>
#include <vtkSMArrayListDomain.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSMSessionProxyManager.h>

#include <QList>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <vector>

namespace brainshift
{
namespace
{
// Whether a source is another one, or made of it.
bool isMadeOf(pqPipelineSource* source, pqPipelineSource* other)
{
  auto filter = qobject_cast<pqPipelineFilter*>(source);
  const QList<pqOutputPort*> inputs = filter ? filter->getAllInputs() : QList<pqOutputPort*>();
  return source == other || std::any_of(inputs.begin(), inputs.end(), [&](pqOutputPort* input) {
    return isMadeOf(input->getSource(), other);
  });
}

// The display's own input comes later than the display.
pqPipelineSource* sourceOf(pqDataRepresentation* display)
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
    vtkSMPropertyHelper(display->getProxy(), "Input").GetAsProxy());
}

enum class Users // of a colour map
{
  None,
  Related,
  Strangers
};

Users usersOf(vtkSMProxy* colors, pqDataRepresentation* asking)
{
  Users users = Users::None;
  auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (auto display : model->findItems<pqDataRepresentation*>())
  {
    if (display == asking || display->getLookupTableProxy() != colors)
    {
      continue;
    }
    if (isMadeOf(sourceOf(display), sourceOf(asking)) ||
      isMadeOf(sourceOf(asking), sourceOf(display)))
    {
      return Users::Related;
    }
    users = Users::Strangers;
  }
  return users;
}

// ParaView looks along -z, with y up, until somebody turns the camera.
bool isUnturned(vtkSMProxy* view)
{
  const std::vector<double> from = vtkSMPropertyHelper(view, "CameraPosition").GetDoubleArray();
  const std::vector<double> to = vtkSMPropertyHelper(view, "CameraFocalPoint").GetDoubleArray();
  const std::vector<double> up = vtkSMPropertyHelper(view, "CameraViewUp").GetDoubleArray();
  const double distance = std::abs(from[2] - to[2]);
  return from[2] >= to[2] && std::abs(from[0] - to[0]) <= 1e-6 * distance &&
    std::abs(from[1] - to[1]) <= 1e-6 * distance && up[1] == 1.0;
}

bool isAlone(pqDataRepresentation* display)
{
  const QList<pqRepresentation*> all = display->getView()->getRepresentations();
  return std::none_of(all.begin(), all.end(), [&](pqRepresentation* other) {
    return other != display && other->isVisible() && qobject_cast<pqDataRepresentation*>(other);
  });
}

// Turns the camera to the tissue, and takes the scale of colours away, which natural colours do not
// need. Both later: then the display has a view, and ParaView has placed the camera.
void finishLater(pqDataRepresentation* display, const std::vector<double>& bounds)
{
  QTimer::singleShot(0, display, [display, bounds] {
    auto view = vtkSMRenderViewProxy::SafeDownCast(
      display->getView() ? display->getView()->getProxy() : nullptr);
    if (!view)
    {
      return;
    }
    vtkSMPVRepresentationProxy::SafeDownCast(display->getProxy())
      ->SetScalarBarVisibility(view, false);
    if (display->isVisible() && isAlone(display) && isUnturned(view))
    {
      aimAt(view, bounds);
    }
    display->getView()->render();
  });
}

void outline(pqDataRepresentation* display)
{
  vtkSMPropertyHelper(display->getProxy(), "Representation").Set("Outline");
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
  if (look.kind == "Labels" && isOfReader(display))
  {
    outline(display);
  }
  if (!look.name.isEmpty())
  {
    applyLook(display, look);
    finishLater(display, look.bounds);
  }
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
  const unsigned int before = countColorMaps(display->getProxy());
  colorByFirstArray(display);
  vtkSMProxy* colors = display->getLookupTableProxy();
  const bool isNew = countColorMaps(display->getProxy()) > before;
  const Users users = colors && !isNew ? usersOf(colors, display) : Users::None;
  if (users == Users::Strangers)
  {
    // Later: ParaView still sets the colours of the array's name when it registers a display.
    QTimer::singleShot(0, display, [display] { takeOwnColors(display); });
  }
  else if (colors && users == Users::None && (isNew || isLook(colors)))
  {
    giveLook(display);
  }
}
}
