// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/TextureMemory.h"

#include "Representations/Gpu/OpenGL.h"

#include "vtkTextureObject.h"

namespace brainshift
{
std::int64_t textureBytes(vtkTextureObject* texture)
{
  if (!texture || texture->GetHandle() == 0)
  {
    return 0;
  }
  texture->Activate();
  const auto ask = [texture](GLenum name) {
    GLint value = 0;
    glGetTexLevelParameteriv(texture->GetTarget(), 0, name, &value);
    return static_cast<std::int64_t>(value);
  };
  std::int64_t bits = 0;
  for (const GLenum channel : { GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
         GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE })
  {
    bits += ask(channel);
  }
  const std::int64_t texels =
    ask(GL_TEXTURE_WIDTH) * ask(GL_TEXTURE_HEIGHT) * ask(GL_TEXTURE_DEPTH);
  texture->Deactivate();
  return texels * bits / 8;
}

std::int64_t textureBytes(std::initializer_list<std::vector<vtkTextureObject*>> groups)
{
  std::int64_t bytes = 0;
  for (const std::vector<vtkTextureObject*>& group : groups)
  {
    for (vtkTextureObject* texture : group)
    {
      bytes += textureBytes(texture);
    }
  }
  return bytes;
}
}
