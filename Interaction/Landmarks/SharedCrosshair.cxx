// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Landmarks/SharedCrosshair.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/SliceMouse.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqView.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QList>

#include <algorithm>
#include <cstring>

namespace brainshift
{
namespace
{
bool isComparison(pqDataRepresentation* display)
{
  const pqOutputPort* input = display->getOutputPortFromInput();
  return input && std::strcmp(input->getSource()->getProxy()->GetXMLName(), "CompareVolumes") == 0;
}

QList<pqDataRepresentation*> shownVolumes()
{
  QList<pqDataRepresentation*> shown;
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
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

// Whether a display shows the volume that a Free-Form Deformation bends, as loaded.
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

bool isReferenceShown(pqPipelineSource* deformation)
{
  const QList<pqDataRepresentation*> shown = shownVolumes();
  return std::any_of(shown.begin(), shown.end(), [deformation](pqDataRepresentation* display) {
    const bool bent = display == bentDisplay(deformation, display->getView());
    return bent ? isComparison(display) : !showsAsLoaded(deformation, display);
  });
}
}
