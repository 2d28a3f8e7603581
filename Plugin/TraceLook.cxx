// SPDX-License-Identifier: BSD-3-Clause
#include "Plugin/TraceLook.h"

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
#include <array>
#include <cmath>
#include <cstring>

namespace brainshift
{
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
// and greys, and told apart by the colour-blind. Only what is very near the cortex is pale.
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
  vtkSMPropertyHelper(bar, "RangeLabelFormat").Set("%.0f");
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
