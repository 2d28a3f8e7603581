// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/MovingWindow.h"

#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Picture/MovingQuality.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkTextureObject.h"

namespace brainshift
{
MovingWindow::MovingWindow()
{
  this->Before->SetClientData(this);
  this->Before->SetCallback(&MovingWindow::beforePicture);
  this->After->SetClientData(this);
  this->After->SetCallback(&MovingWindow::afterPicture);
}

MovingWindow::~MovingWindow()
{
  this->watch(nullptr);
}

void MovingWindow::watch(vtkRenderer* renderer)
{
  this->putBack();
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->Before);
  }
  this->Renderer = renderer;
  if (renderer)
  {
    renderer->AddObserver(vtkCommand::StartEvent, this->Before);
  }
}

void MovingWindow::beforePicture(vtkObject*, unsigned long, void* self, void*)
{
  auto* moving = static_cast<MovingWindow*>(self);
  moving->putBack();
  vtkRenderWindow* window = moving->Renderer->GetRenderWindow();
  if (moving->Enabled && isMoving(window->GetDesiredUpdateRate()) && drawsInSoftware())
  {
    moving->leaveOut();
  }
}

void MovingWindow::afterPicture(vtkObject*, unsigned long, void* self, void*)
{
  static_cast<MovingWindow*>(self)->putBack();
}

void MovingWindow::leaveOut()
{
  this->Window = vtkOpenGLRenderWindow::SafeDownCast(this->Renderer->GetRenderWindow());
  if (this->Window)
  {
    this->leaveOutInsets();
    this->leaveOutDepths();
    this->Window->AddObserver(vtkCommand::EndEvent, this->After);
  }
}

void MovingWindow::leaveOutInsets()
{
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
}

// OpenGL copies no depths into a framebuffer without a depth attachment.
void MovingWindow::leaveOutDepths()
{
  if (this->Window->GetFrameBlitMode() == vtkOpenGLRenderWindow::NoBlit)
  {
    vtkOpenGLFramebufferObject* shown = this->Window->GetDisplayFramebuffer();
    this->ShownDepths = shown->GetDepthAttachmentAsTextureObject();
    if (this->ShownDepths)
    {
      shown->RemoveDepthAttachment();
    }
  }
}

void MovingWindow::putBack()
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
    this->Window->RemoveObserver(this->After);
    if (this->ShownDepths)
    {
      this->Window->MakeCurrent(); // other observers may draw elsewhere
      this->Window->GetDisplayFramebuffer()->AddDepthAttachment(this->ShownDepths);
    }
  }
  this->ShownDepths = nullptr;
  this->Window = nullptr;
}
}
