// SPDX-License-Identifier: BSD-3-Clause
#include "SceneDepth.h"

#include "OpenGL.h"
#include "Program.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

namespace brainshift
{
SceneDepth::SceneDepth() = default;
SceneDepth::~SceneDepth() = default;

void SceneDepth::capture(
  vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size)
{
  if (!this->Depth)
  {
    this->Depth = vtkSmartPointer<vtkTextureObject>::New();
    this->Depth->SetContext(window);
    this->Depth->SetMinificationFilter(vtkTextureObject::Nearest);
    this->Depth->SetMagnificationFilter(vtkTextureObject::Nearest);
    // A blit wants the format of the window's own buffer.
    if (window->GetStencilCapable())
    {
      this->Depth->AllocateDepthStencil(size.x, size.y);
    }
    else
    {
      this->Depth->AllocateDepth(size.x, size.y, vtkTextureObject::Fixed32);
    }
  }
  this->Depth->Resize(size.x, size.y);

  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST); // it would cut the copy
  GLint source = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &source);
  FramebufferScope framebuffer(state);
  const GLenum attachment =
    window->GetStencilCapable() ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
  glFramebufferTexture2D(
    GL_DRAW_FRAMEBUFFER, attachment, GL_TEXTURE_2D, this->Depth->GetHandle(), 0);
  framebuffer.drawColors(0);
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned int>(source));
  glBlitFramebuffer(origin.x, origin.y, origin.x + size.x, origin.y + size.y, 0, 0, size.x, size.y,
    GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void SceneDepth::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Depth)
  {
    this->Depth->ReleaseGraphicsResources(window);
  }
  this->Depth = nullptr;
}
}
