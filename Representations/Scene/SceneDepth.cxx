// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/SceneDepth.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/Program.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

namespace brainshift
{
namespace
{
// The depth texture of the window's own framebuffer, if that is what is drawn into; null otherwise.
vtkTextureObject* attachedDepth(vtkOpenGLRenderWindow* window)
{
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  vtkOpenGLFramebufferObject* own = window->GetRenderFramebuffer();
  if (!own || own->GetFBOIndex() != static_cast<unsigned int>(bound))
  {
    return nullptr;
  }
  vtkTextureObject* depth = own->GetDepthAttachmentAsTextureObject();
  return depth && depth->GetTarget() == GL_TEXTURE_2D ? depth : nullptr;
}
}

SceneDepth::SceneDepth() = default;
SceneDepth::~SceneDepth() = default;

void SceneDepth::copy(vtkOpenGLRenderWindow* window, const glm::ivec2& origin,
  const glm::ivec2& size, const PixelBox& part)
{
  if (!this->Copy)
  {
    this->Copy = vtkSmartPointer<vtkTextureObject>::New();
    this->Copy->SetContext(window);
    this->Copy->SetMinificationFilter(vtkTextureObject::Nearest);
    this->Copy->SetMagnificationFilter(vtkTextureObject::Nearest);
    // A blit wants the format of the window's own buffer.
    if (window->GetStencilCapable())
    {
      this->Copy->AllocateDepthStencil(size.x, size.y);
    }
    else
    {
      this->Copy->AllocateDepth(size.x, size.y, vtkTextureObject::Fixed32);
    }
  }
  this->Copy->Resize(size.x, size.y);

  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST); // it would cut the copy
  GLint source = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &source);
  FramebufferScope framebuffer(state);
  const GLenum attachment =
    window->GetStencilCapable() ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
  glFramebufferTexture2D(
    GL_DRAW_FRAMEBUFFER, attachment, GL_TEXTURE_2D, this->Copy->GetHandle(), 0);
  framebuffer.drawColors(0);
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned int>(source));
  // A margin around a tile may lie outside the window, where nothing is drawn.
  const glm::ivec2 end(window->GetSize()[0], window->GetSize()[1]);
  const glm::ivec2 low = glm::max(part.low, -origin);
  const glm::ivec2 high = glm::min(part.high, end - origin);
  if (low != part.low || high != part.high)
  {
    vtkOpenGLState::ScopedglDepthMask mask(state);
    state->vtkglDepthMask(GL_TRUE);
    const float farthest = 1.0f;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
  }
  const glm::ivec2 from = origin + low;
  const glm::ivec2 to = origin + high;
  glBlitFramebuffer(
    from.x, from.y, to.x, to.y, low.x, low.y, high.x, high.y, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

SceneBehind SceneDepth::captureBehind(vtkOpenGLRenderWindow* window, const glm::ivec2& origin,
  const glm::ivec2& size, const SceneImage& image)
{
  if (vtkTextureObject* own = attachedDepth(window))
  {
    this->Readable = own;
    const glm::vec2 whole(own->GetWidth(), own->GetHeight());
    return { own, glm::vec2(size) / whole, glm::vec2(origin) / whole };
  }
  const glm::dvec2 windowPixels = glm::dvec2(size) / glm::dvec2(image.size); // for one of the image
  const PixelBox& box = image.part.box;
  this->copy(window, origin, size,
    { glm::floor(glm::dvec2(box.low) * windowPixels),
      glm::ceil(glm::dvec2(box.high) * windowPixels) });
  this->Readable = this->Copy;
  return { this->Copy, glm::vec2(1.0f), glm::vec2(0.0f) };
}

void SceneDepth::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Copy)
  {
    this->Copy->ReleaseGraphicsResources(window);
  }
  this->Copy = nullptr;
  this->Readable = nullptr;
}
}
