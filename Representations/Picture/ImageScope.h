// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The OpenGL state for drawing into images of our own.
#ifndef BrainShift_ImageScope_h
#define BrainShift_ImageScope_h

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Scene/ImageArea.h"

#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

namespace brainshift
{
/// No blending and no tests, only a part of the picture. The end of the scope restores the state.
class ImageScope
{
public:
  /// `part`: pixels of the picture. `area`: what the images hold of it.
  ImageScope(vtkOpenGLState* state, const PixelBox& part, const ImageArea& area)
    : Viewport(state)
    , ScissorBox(state)
    , ColorMask(state)
    , Blending(state)
    , Scissor(state, GL_SCISSOR_TEST)
    , Blend(state, GL_BLEND)
    , DepthTest(state, GL_DEPTH_TEST)
    , Cull(state, GL_CULL_FACE)
    , Framebuffer(state)
  {
    for (const unsigned int capability : { GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE })
    {
      state->vtkglDisable(capability);
    }
    state->vtkglEnable(GL_SCISSOR_TEST);
    const glm::ivec2 first = part.low - area.low;
    state->vtkglScissor(first.x, first.y, part.size().x, part.size().y);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state->vtkglViewport(-area.low.x, -area.low.y, area.picture.x, area.picture.y);
  }

  /// Draws into an image as colour attachment `index`; attach them in ascending order.
  void attach(unsigned int index, vtkTextureObject* image)
  {
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + index, GL_TEXTURE_2D, image->GetHandle(), 0);
    this->Framebuffer.drawColors(index + 1);
  }

private:
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglScissor ScissorBox;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglBlendFuncSeparate Blending;
  vtkOpenGLState::ScopedglEnableDisable Scissor;
  vtkOpenGLState::ScopedglEnableDisable Blend;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglEnableDisable Cull;
  FramebufferScope Framebuffer;
};
}

#endif
