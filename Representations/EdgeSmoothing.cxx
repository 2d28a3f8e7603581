// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeSmoothing.h"

#include "GpuMemory.h"
#include "MovingQuality.h"

#include "vtkActor2D.h"
#include "vtkMath.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkVolume.h"

namespace brainshift
{
namespace
{
// Volumes, and what lies flat on the picture, are drawn after the smoothing.
bool isSmoothed(vtkProp* prop)
{
  if (!prop->GetVisibility() || vtkVolume::SafeDownCast(prop) || vtkActor2D::SafeDownCast(prop))
  {
    return false;
  }
  const double* box = prop->GetBounds(); // none: it does not tell, as the sky does not
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
  this->AfterInsets->SetClientData(this);
  this->AfterInsets->SetCallback(&EdgeSmoothing::afterInsets);
}

EdgeSmoothing::~EdgeSmoothing()
{
  this->watch(nullptr);
}

void EdgeSmoothing::watch(vtkRenderer* renderer)
{
  this->smoothInsets();
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
  if (smoothing->Enabled && isMoving(renderer->GetRenderWindow()->GetDesiredUpdateRate()) &&
    drawsInSoftware())
  {
    smoothing->leaveOutInsets();
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

void EdgeSmoothing::afterInsets(vtkObject*, unsigned long, void* self, void*)
{
  static_cast<EdgeSmoothing*>(self)->smoothInsets();
}

void EdgeSmoothing::leaveOutInsets()
{
  this->smoothInsets();
  this->Window = this->Renderer->GetRenderWindow();
  vtkRendererCollection* renderers = this->Window->GetRenderers();
  vtkCollectionSimpleIterator next;
  renderers->InitTraversal(next);
  while (vtkRenderer* inset = renderers->GetNextRenderer(next))
  {
    if (inset != this->Renderer && inset->GetUseFXAA())
    {
      inset->UseFXAAOff();
      this->Insets.emplace_back(inset);
    }
  }
  this->Window->AddObserver(vtkCommand::EndEvent, this->AfterInsets);
}

void EdgeSmoothing::smoothInsets()
{
  for (const vtkWeakPointer<vtkRenderer>& inset : this->Insets)
  {
    if (inset)
    {
      inset->UseFXAAOn();
    }
  }
  this->Insets.clear();
  if (this->Window)
  {
    this->Window->RemoveObserver(this->AfterInsets);
    this->Window = nullptr;
  }
}
}
