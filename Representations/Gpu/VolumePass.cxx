// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/VolumePass.h"

#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/Program.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <algorithm>

namespace brainshift
{
void runVolumePass(vtkOpenGLRenderWindow* window, int programHandle,
  std::initializer_list<vtkTextureObject*> targets, const glm::ivec3& first,
  const glm::ivec3& count)
{
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
  FramebufferScope framebuffer(state);
  unsigned int attached = 0;
  for (vtkTextureObject* target : targets)
  {
    glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + attached, target->GetHandle(), 0);
    attached += 1;
  }
  framebuffer.drawColors(attached);

  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglViewport(first.x, first.y, count.x, count.y);
  state->vtkglScissor(first.x, first.y, count.x, count.y);
  glUniform1i(glGetUniformLocation(programHandle, "firstLayer"), first.z);
  drawTriangles(count.z);
}

int leadToSecondThread(int first, int count)
{
  constexpr int square = 64;
  return drawsInSoftware() ? std::max(square - (first + count / 2), 0) : 0;
}

std::vector<glm::vec4> readVolume(vtkOpenGLRenderWindow* window, vtkTextureObject* texture,
  const glm::ivec3& first, const glm::ivec3& count)
{
  const std::size_t layer = static_cast<std::size_t>(count.x) * count.y;
  std::vector<glm::vec4> texels(layer * count.z);
  const FramebufferScope framebuffer(window->GetState());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (int z = 0; z < count.z; ++z)
  {
    glFramebufferTextureLayer(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture->GetHandle(), 0, first.z + z);
    glReadPixels(first.x, first.y, count.x, count.y, GL_RGBA, GL_FLOAT, &texels[layer * z]);
  }
  return texels;
}

vtkSmartPointer<vtkTextureObject> makeTexture(
  vtkOpenGLRenderWindow* window, unsigned int format, int filter)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetInternalFormat(format);
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  return texture;
}

void replaceTexels(vtkTextureObject* texture, const Texels& texels)
{
  const glm::ivec3& first = texels.box.first;
  const glm::ivec3 size = texels.box.size();
  texture->Activate();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_3D, 0, first.x, first.y, first.z, size.x, size.y, size.z,
    texels.format, texels.type, texels.values);
  texture->Deactivate();
}

void clearVolume(vtkOpenGLRenderWindow* window, vtkTextureObject* target)
{
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  FramebufferScope framebuffer(state);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, target->GetHandle(), 0);
  framebuffer.drawColors(1);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float zero[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  glClearBufferfv(GL_COLOR, 0, zero);
}
}
