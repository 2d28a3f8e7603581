// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Traces/TraceImage.h"

#include "Representations/Gpu/OpenGL.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <vector>

namespace brainshift
{
TraceImage::TraceImage() = default;
TraceImage::~TraceImage() = default;

void TraceImage::provide(vtkOpenGLRenderWindow* window, const glm::ivec2& size)
{
  if (this->Colors)
  {
    this->Colors->Resize(size.x, size.y);
    this->Depths->Resize(size.x, size.y);
    return;
  }
  this->Colors = vtkSmartPointer<vtkTextureObject>::New();
  this->Depths = vtkSmartPointer<vtkTextureObject>::New();
  for (vtkTextureObject* image : { this->Colors.Get(), this->Depths.Get() })
  {
    image->SetContext(window);
    image->SetMinificationFilter(vtkTextureObject::Nearest);
    image->SetMagnificationFilter(vtkTextureObject::Nearest);
  }
  constexpr int components = 4;
  this->Colors->Allocate2D(size.x, size.y, components, VTK_UNSIGNED_CHAR);
  this->Depths->AllocateDepth(size.x, size.y, vtkTextureObject::Fixed32);
}

void TraceImage::draw(
  vtkOpenGLRenderWindow* window, const glm::ivec2& size, const std::function<void()>& drawBalls)
{
  this->provide(window, size);
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  FramebufferScope framebuffer(state);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->Colors->GetHandle(), 0);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->Depths->GetHandle(), 0);
  framebuffer.drawColors(1);
  state->vtkglViewport(0, 0, size.x, size.y);
  state->vtkglScissor(0, 0, size.x, size.y);
  state->vtkglDisable(GL_BLEND);
  // The clear of VTK's state would change the clear colour of the window.
  const float nothing[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  drawBalls();
}

bool TraceImage::layOver(vtkOpenGLRenderWindow* window, Counters& counters)
{
  if (!this->OverProgram.use(window, tracesOverSource(), counters))
  {
    return false;
  }
  this->OverProgram.set("balls", this->Colors.Get());
  this->OverProgram.set("depths", this->Depths.Get());
  drawTriangles(1);
  this->Colors->Deactivate();
  this->Depths->Deactivate();
  return true;
}

void TraceImage::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image : { &this->Colors, &this->Depths })
  {
    if (*image)
    {
      (*image)->ReleaseGraphicsResources(window);
    }
    *image = nullptr;
  }
  this->OverProgram.forget();
}
}
