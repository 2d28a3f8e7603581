// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Pointer/TipDistance.h"

#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqUndoStack.h>

#include <vtkDataObject.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkSMParaViewPipelineController.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>

#include <QCoreApplication>

#include <cmath>
#include <cstring>

namespace brainshift
{
namespace
{
constexpr const char* Cortex[] = { "SurfaceArray", "SurfaceBy", "Threshold", "Label",
  "Segmentation", "Cavity", "CavityLabels" };
constexpr int ByThreshold = 0;

bool isA(vtkSMProxy* proxy, const char* name)
{
  return std::strcmp(proxy->GetXMLName(), name) == 0;
}

// Of the first point array, or the one of this name. Null if there is none.
vtkPVArrayInformation* arrayOf(vtkSMSourceProxy* image, const char* name)
{
  vtkPVDataSetAttributesInformation* arrays =
    image->GetDataInformation(0)->GetAttributeInformation(vtkDataObject::POINT);
  vtkPVArrayInformation* found = name && *name ? arrays->GetArrayInformation(name) : nullptr;
  if (!found)
  {
    found = arrays->GetAttributeInformation(0); // the scalars
  }
  return found || arrays->GetNumberOfArrays() == 0 ? found : arrays->GetArrayInformation(0);
}

vtkSmartPointer<vtkSMProxy> hidden(vtkSMProxy* beside, const char* group, const char* name,
  const std::function<void(vtkSMProxy*)>& connect = {})
{
  auto made = vtk::TakeSmartPointer(beside->GetSessionProxyManager()->NewProxy(group, name));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->PreInitializeProxy(made);
  if (connect)
  {
    connect(made);
  }
  controller->PostInitializeProxy(made);
  made->UpdateVTKObjects();
  made->PrototypeOn(); // a question is no step to undo
  return made;
}
}

vtkSMProxy* cortexOf(pqPipelineSource* deformation)
{
  for (pqPipelineSource* consumer : deformation->getAllConsumers())
  {
    vtkSMProxy* proxy = consumer->getProxy();
    if (isA(proxy, "TraceDistance") &&
      vtkSMPropertyHelper(proxy, "Deformation").GetAsProxy() == deformation->getProxy())
    {
      return proxy;
    }
  }
  return fitOf(deformation);
}

void setCortex(vtkSMProxy* filter, vtkSMProxy* from, double threshold)
{
  if (!from)
  {
    vtkSMPropertyHelper(filter, "SurfaceBy").Set(ByThreshold);
    vtkSMPropertyHelper(filter, "Threshold").Set(threshold);
    return;
  }
  for (const char* name : Cortex)
  {
    filter->GetProperty(name)->Copy(from->GetProperty(name));
  }
}

double halfwayThreshold(pqPipelineSource* deformation)
{
  auto source = vtkSMSourceProxy::SafeDownCast(deformation->getProxy());
  vtkPVArrayInformation* array =
    source && source->GetOutputPortsCreated() ? arrayOf(source, nullptr) : nullptr;
  const double* range = array ? array->GetComponentRange(0) : nullptr;
  return range && range[0] < range[1] ? 0.5 * (range[0] + range[1]) : 0.5;
}

void TipDistance::forget()
{
  SCOPED_UNDO_EXCLUDE();
  this->Filter = nullptr;
  this->Point = nullptr;
  this->Deformation = nullptr;
}

void TipDistance::make(pqPipelineSource* deformation)
{
  this->forget();
  vtkSMProxy* volume = deformation->getProxy();
  this->Point = hidden(volume, "sources", "PolyPointSource");
  this->Filter = vtkSMSourceProxy::SafeDownCast(
    hidden(volume, "filters", "TraceDistance", [&](vtkSMProxy* filter) {
      vtkSMPropertyHelper(filter, "Input").Set(this->Point, 0);
      vtkSMPropertyHelper(filter, "Deformation").Set(volume, 0);
    }));
  this->Deformation = deformation;
}

// The filter would call an error each time.
bool TipDistance::hasSurface(vtkSMProxy* from, double threshold)
{
  vtkSMProxy* segmentation =
    from ? vtkSMPropertyHelper(from, "Segmentation").GetAsProxy() : nullptr;
  auto image =
    vtkSMSourceProxy::SafeDownCast(segmentation ? segmentation : this->Deformation->getProxy());
  const char* name = from ? vtkSMPropertyHelper(from, "SurfaceArray").GetAsString() : nullptr;
  vtkPVArrayInformation* array = image->GetOutputPortsCreated() ? arrayOf(image, name) : nullptr;
  if (segmentation && !array) // it was never shown
  {
    image->UpdatePipeline();
    array = arrayOf(image, name);
  }
  const bool byLabel = from && vtkSMPropertyHelper(from, "SurfaceBy").GetAsInt() != ByThreshold;
  const double level = !from ? threshold
    : byLabel                ? vtkSMPropertyHelper(from, "Label").GetAsInt()
                             : vtkSMPropertyHelper(from, "Threshold").GetAsDouble();
  const double* range = array ? array->GetComponentRange(0) : nullptr;
  const bool holds = range &&
    (byLabel ? level >= range[0] && level <= range[1] : level > range[0] && level <= range[1]);
  this->Problem = holds ? QString()
    : range             ? QCoreApplication::translate(
                "BrainShift", "No cortex: its level is %1, but the values range from %2 to %3.")
                .arg(level)
                .arg(range[0])
                .arg(range[1])
            : QCoreApplication::translate("BrainShift", "No cortex: the volume has no values.");
  return holds;
}

std::optional<double> TipDistance::of(
  pqPipelineSource* deformation, const glm::dvec3& tip, double threshold)
{
  SCOPED_UNDO_EXCLUDE();
  if (this->Deformation != deformation || !this->Filter)
  {
    this->make(deformation);
  }
  vtkSMProxy* from = cortexOf(deformation);
  if (!this->hasSurface(from, threshold))
  {
    return std::nullopt;
  }
  vtkSMPropertyHelper(this->Point, "Points").Set(&tip.x, 3);
  this->Point->UpdateVTKObjects();
  setCortex(this->Filter, from, threshold);
  this->Filter->UpdateVTKObjects();
  pqProgressManager* progress = pqApplicationCore::instance()->getProgressManager();
  progress->lockProgress(deformation); // its bar would lay out the window anew
  this->Filter->UpdatePipeline();
  progress->unlockProgress(deformation);
  pull(this->Filter, this->Filter->GetProperty("Mean"));
  const double distance = vtkSMPropertyHelper(this->Filter, "Mean").GetAsDouble();
  return std::isfinite(distance) ? std::optional<double>(distance) : std::nullopt;
}
}
