// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/EdgeSmoothing.h"

#include "vtkActor2D.h"
#include "vtkMath.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

namespace brainshift
{
namespace
{
// Volumes and 2D annotations are drawn after the smoothing.
bool isSmoothed(vtkProp* prop)
{
  if (!prop->GetVisibility() || vtkVolume::SafeDownCast(prop) || vtkActor2D::SafeDownCast(prop))
  {
    return false;
  }
  const double* box = prop->GetBounds(); // null: unknown, as of a sky
  return !box || vtkMath::AreBoundsInitialized(box);
}

bool showsVolumesAlone(vtkRenderer* renderer)
{
  if (renderer->GetTexturedBackground())
  {
    return false;
  }
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  while (vtkProp* prop = props->GetNextProp(next))
  {
    if (isSmoothed(prop))
    {
      return false;
    }
  }
  return true;
}
}

EdgeSmoothing::EdgeSmoothing()
{
  this->Before->SetClientData(this);
  this->Before->SetCallback(&EdgeSmoothing::beforePicture);
  this->After->SetClientData(this);
  this->After->SetCallback(&EdgeSmoothing::afterPicture);
}

EdgeSmoothing::~EdgeSmoothing()
{
  this->watch(nullptr);
}

void EdgeSmoothing::watch(vtkRenderer* renderer)
{
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->Before);
    this->Renderer->RemoveObserver(this->After);
  }
  this->Renderer = renderer;
  if (renderer)
  {
    renderer->AddObserver(vtkCommand::StartEvent, this->Before);
    renderer->AddObserver(vtkCommand::EndEvent, this->After);
  }
}

void EdgeSmoothing::beforePicture(vtkObject*, unsigned long, void* self, void*)
{
  auto* smoothing = static_cast<EdgeSmoothing*>(self);
  vtkRenderer* renderer = smoothing->Renderer;
  smoothing->LeftOut = smoothing->Enabled && renderer->GetUseFXAA() && showsVolumesAlone(renderer);
  if (smoothing->LeftOut)
  {
    renderer->UseFXAAOff();
  }
}

void EdgeSmoothing::afterPicture(vtkObject*, unsigned long, void* self, void*)
{
  auto* smoothing = static_cast<EdgeSmoothing*>(self);
  if (smoothing->LeftOut)
  {
    smoothing->Renderer->UseFXAAOn();
    smoothing->LeftOut = false;
  }
}
}
