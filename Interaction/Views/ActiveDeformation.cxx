// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/ActiveDeformation.h"

#include "Interaction/Commands/Application.h"

#include <pqActiveObjects.h>
#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqView.h>

#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMPropertyIterator.h>
#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace brainshift
{
namespace
{
void collectViews(pqPipelineSource* source, QSet<pqPipelineSource*>& seen, QSet<pqView*>& views)
{
  if (seen.contains(source))
  {
    return;
  }
  seen.insert(source);
  for (pqView* view : source->getViews())
  {
    views.insert(view);
  }
  for (pqPipelineSource* consumer : source->getAllConsumers())
  {
    collectViews(consumer, seen, views);
  }
}
}

QSet<pqView*> viewsShowing(pqPipelineSource* source)
{
  QSet<pqPipelineSource*> seen;
  QSet<pqView*> views;
  collectViews(source, seen, views);
  return views;
}

namespace
{
QList<pqPipelineSource*> inputsOf(pqPipelineSource* source)
{
  QList<pqPipelineSource*> inputs;
  if (auto filter = qobject_cast<pqPipelineFilter*>(source))
  {
    for (pqOutputPort* input : filter->getAllInputs())
    {
      inputs.append(input->getSource());
    }
  }
  return inputs;
}

// The next sources along the pipeline: first what a source is made of, then what is made of it.
QList<pqPipelineSource*> neighboursOf(pqPipelineSource* source)
{
  return inputsOf(source) + source->getAllConsumers();
}

bool isMoments(pqPipelineSource* source)
{
  return std::strcmp(source->getProxy()->GetXMLName(), "Moments") == 0;
}

bool isShown(pqPipelineSource* source, pqView* view)
{
  pqDataRepresentation* display = view ? source->getRepresentation(view) : nullptr;
  return (display && display->isVisible()) || bentDisplay(source, view);
}

bool isShownAs(pqDataRepresentation* display, const char* type)
{
  const char* kind = vtkSMPropertyHelper(display->getProxy(), "Representation", true).GetAsString();
  return kind && std::strcmp(kind, type) == 0;
}

// Breadth first, so that the nearest one is found.
pqPipelineSource* nearestShown(pqPipelineSource* from, pqView* view)
{
  QList<pqPipelineSource*> visited{ from };
  for (int next = 0; next < visited.size(); ++next)
  {
    pqPipelineSource* source = visited[next];
    if (isDeformation(source) && isShown(source, view))
    {
      return source;
    }
    for (pqPipelineSource* neighbour : neighboursOf(source))
    {
      if (!visited.contains(neighbour))
      {
        visited.append(neighbour);
      }
    }
  }
  return nullptr;
}
}

bool isDeformation(pqPipelineSource* source)
{
  return source && std::strcmp(source->getProxy()->GetXMLName(), "FreeFormDeformation") == 0;
}

bool isLatticeSetting(vtkSMProxy* proxy, const char* property)
{
  vtkSMProperty* setting = proxy->GetProperty(property);
  vtkPVXMLElement* hints = setting ? setting->GetHints() : nullptr;
  return hints && hints->FindNestedElementByName("LatticeSetting");
}

void shareLattice(vtkSMProxy* deformation, vtkSMProxy* lattice)
{
  lattice->GetProperty("Input")->Copy(deformation->GetProperty("Input"));
  const auto each = vtk::TakeSmartPointer(lattice->NewPropertyIterator());
  for (each->Begin(); !each->IsAtEnd(); each->Next())
  {
    if (isLatticeSetting(lattice, each->GetKey()))
    {
      each->GetProperty()->Copy(deformation->GetProperty(each->GetKey()));
    }
  }
}

pqPipelineSource* activeDeformation()
{
  return activeDeformation(pqActiveObjects::instance().activeView());
}

pqPipelineSource* activeDeformation(pqView* view)
{
  pqPipelineSource* source = pqActiveObjects::instance().activeSource();
  if (isDeformation(source))
  {
    return source;
  }
  if (pqPipelineSource* nearest = source ? nearestShown(source, view) : nullptr)
  {
    return nearest;
  }
  pqPipelineSource* only = nullptr;
  const auto sources = serverManagerModel()->findItems<pqPipelineSource*>();
  for (pqPipelineSource* candidate : sources)
  {
    if (isDeformation(candidate))
    {
      if (only)
      {
        return nullptr;
      }
      only = candidate;
    }
  }
  return only;
}

pqPipelineSource* deformationUpstream(pqPipelineSource* source)
{
  QList<pqPipelineSource*> visited{ source };
  for (int next = 0; next < visited.size(); ++next)
  {
    if (isMoments(visited[next]))
    {
      continue; // it has several, and which one depends on the time
    }
    if (next > 0 && isDeformation(visited[next]))
    {
      return visited[next];
    }
    visited += inputsOf(visited[next]);
  }
  return nullptr;
}

bool isBentFrom(pqPipelineSource* source, vtkSMProxy* volume)
{
  QList<pqPipelineSource*> visited{ source };
  for (int next = 0; next < visited.size(); ++next)
  {
    if (isDeformation(visited[next]) && volume &&
      vtkSMPropertyHelper(visited[next]->getProxy(), "Input").GetAsProxy() == volume)
    {
      return true;
    }
    visited += inputsOf(visited[next]);
  }
  return false;
}

pqPipelineSource* shownInstead(pqPipelineSource* deformation, pqView* view)
{
  if (!deformation || bentDisplay(deformation, view))
  {
    return nullptr;
  }
  const auto sources = serverManagerModel()->findItems<pqPipelineSource*>();
  const auto shown = std::find_if(sources.begin(), sources.end(), [view](pqPipelineSource* source) {
    return isDeformation(source) && bentDisplay(source, view);
  });
  return shown == sources.end() ? nullptr : *shown;
}

bool isMoved(pqDataRepresentation* display)
{
  const auto differs = [display](const char* name, double usual) {
    const std::vector<double> numbers =
      vtkSMPropertyHelper(display->getProxy(), name).GetDoubleArray();
    return std::any_of(
      numbers.begin(), numbers.end(), [usual](double number) { return number != usual; });
  };
  return differs("Translation", 0.0) || differs("Orientation", 0.0) || differs("Scale", 1.0);
}

bool showsSlices(pqDataRepresentation* display)
{
  return isShownAs(display, "Deformed Slices");
}

bool showsVolume(pqDataRepresentation* display)
{
  return isShownAs(display, "Deformed Volume");
}

pqDataRepresentation* bentDisplay(pqPipelineSource* deformation, pqView* view)
{
  QList<pqPipelineSource*> visited;
  if (deformation && view)
  {
    visited.append(deformation);
  }
  for (int next = 0; next < visited.size(); ++next)
  {
    pqDataRepresentation* display = visited[next]->getRepresentation(view);
    if (display && display->isVisible() && (showsVolume(display) || showsSlices(display)))
    {
      return display;
    }
    for (pqPipelineSource* consumer : visited[next]->getAllConsumers())
    {
      // The output of another deformation is at other positions, and so is that of another moment.
      const bool isElsewhere = isDeformation(consumer) || isMoments(consumer);
      if (!isElsewhere && !visited.contains(consumer))
      {
        visited.append(consumer);
      }
    }
  }
  return nullptr;
}
}
