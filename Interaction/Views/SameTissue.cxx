// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/SameTissue.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqServerManagerModel.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <cstring>
#include <vector>

namespace brainshift
{
namespace
{
// The volume that a source passes on without new voxels: that of the file, for what bends it or
// compares it.
vtkSMProxy* volumeOf(vtkSMProxy* source)
{
  while (source &&
    (std::strcmp(source->GetXMLName(), "FreeFormDeformation") == 0 ||
      std::strcmp(source->GetXMLName(), "CompareVolumes") == 0))
  {
    source = vtkSMPropertyHelper(source, "Input").GetAsProxy();
  }
  return source;
}

vtkSMProxy* volumeShownBy(vtkSMProxy* display)
{
  return volumeOf(vtkSMPropertyHelper(display, "Input").GetAsProxy());
}

// Where tissue at a place (mm) that a display shows lies at rest, or the other way round.
std::vector<double> sameTissue(vtkSMProxy* display, const std::vector<double>& place, bool toRest)
{
  const vtkSmartPointer<vtkSMProxy> report = makeReport(display, "DeformedVolumeReport");
  pointAt(report, "Representation", display);
  vtkSMPropertyHelper(report, "Place").Set(place.data(), 3);
  vtkSMPropertyHelper(report, "ToRest").Set(toRest);
  return answerOf(report, "SameTissue");
}

}

void followInOtherViews(vtkSMProxy* display)
{
  const std::vector<double> place = vtkSMPropertyHelper(display, "SlicePosition").GetDoubleArray();
  vtkSMProxy* volume = volumeShownBy(display);
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
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
    rest = rest.empty() ? sameTissue(display, place, true) : rest;
    const std::vector<double> found = sameTissue(follower, rest, false);
    vtkSMPropertyHelper(follower, "SlicePosition").Set(found.data(), 3);
    follower->UpdateVTKObjects();
  }
}
}
