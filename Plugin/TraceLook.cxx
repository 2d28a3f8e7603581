// SPDX-License-Identifier: BSD-3-Clause
#include "TraceLook.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqPipelineSource.h>
#include <pqView.h>

#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTransferFunctionManager.h>
#include <vtkSMTransferFunctionProxy.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace
{
constexpr const char* Distance = "DistanceToCortex";

bool showsTraceDistance(pqDataRepresentation* shown)
{
  pqPipelineSource* source = shown->getInput();
  return source && std::strcmp(source->getProxy()->GetXMLName(), "TraceDistance") == 0;
}

// Whole mm; 0 if there are no distances.
double largestDistance(pqDataRepresentation* shown)
{
  auto source = vtkSMSourceProxy::SafeDownCast(shown->getInput()->getProxy());
  vtkPVArrayInformation* distances =
    source->GetDataInformation(0)->GetPointDataInformation()->GetArrayInformation(Distance);
  if (!distances)
  {
    return 0.0;
  }
  const double* range = distances->GetComponentRange(0);
  return range[0] <= range[1] ? std::ceil(std::max(std::abs(range[0]), std::abs(range[1]))) : 0.0;
}

void labelScale(vtkSMProxy* colors, vtkSMProxy* view)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* bar = manager->GetScalarBarRepresentation(colors, view);
  vtkSMPropertyHelper(bar, "Title").Set("Distance to the cortex (mm)");
  vtkSMPropertyHelper(bar, "ComponentTitle").Set("");
  vtkSMPropertyHelper(bar, "RangeLabelFormat").Set("%.0f");
  bar->UpdateVTKObjects();
}

// They would lie within ours.
void hideTracedPoints(pqDataRepresentation* shown)
{
  auto filter = qobject_cast<pqPipelineFilter*>(shown->getInput());
  pqOutputPort* points = filter ? filter->getInput("Input", 0) : nullptr;
  if (pqDataRepresentation* traced = points ? points->getRepresentation(shown->getView()) : nullptr)
  {
    traced->setVisible(false);
  }
}
}

void showByDistance(pqDataRepresentation* shown)
{
  if (!showsTraceDistance(shown))
  {
    return;
  }
  auto representation = vtkSMPVRepresentationProxy::SafeDownCast(shown->getProxy());
  const double largest = largestDistance(shown);
  if (!shown->getView() || largest <= 0.0 ||
    !representation->SetScalarColoring(Distance, vtkDataObject::POINT))
  {
    return;
  }
  vtkSMProxy* view = shown->getView()->getProxy();
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  vtkSMTransferFunctionProxy::ApplyPreset(colors, "Cool to Warm");
  vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, -largest, largest);
  labelScale(colors, view);
  representation->SetScalarBarVisibility(view, true);
  representation->UpdateVTKObjects();
  hideTracedPoints(shown);
  shown->getView()->render();
}
