// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/LabelMaps.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QSet>

namespace brainshift
{
namespace
{
constexpr const char* Segmentation = "Segmentation";

// Sources.
QSet<vtkTypeUInt32>& noted()
{
  return keptBySession<struct LabelMaps, QSet<vtkTypeUInt32>>();
}
}

void noteLabelMap(pqPipelineSource* source)
{
  if (source)
  {
    noted().insert(source->getProxy()->GetGlobalID());
  }
}

QList<pqPipelineSource*> labelMapsFor(pqDataRepresentation* display)
{
  QList<pqPipelineSource*> found;
  pqPipelineSource* bent = display->getInput();
  if (!bent || !bent->getProxy()->GetProperty(Segmentation) ||
    vtkSMPropertyHelper(bent->getProxy(), Segmentation).GetAsProxy())
  {
    return found;
  }
  auto model = serverManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>(bent->getServer()))
  {
    if (noted().contains(source->getProxy()->GetGlobalID()))
    {
      found.append(source);
    }
  }
  return found;
}

void segmentBy(pqDataRepresentation* display, pqPipelineSource* labels)
{
  if (!labels)
  {
    return;
  }
  pqPipelineSource* bent = display->getInput();
  vtkSMPropertyHelper(bent->getProxy(), Segmentation).Set(labels->getProxy());
  bent->getProxy()->UpdateVTKObjects();
  bent->updatePipeline();
  for (pqDataRepresentation* shown : labels->getRepresentations(display->getView()))
  {
    vtkSMPropertyHelper(shown->getProxy(), "Visibility").Set(0);
    shown->getProxy()->UpdateVTKObjects();
  }
}
}
