// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/GpuMemory.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/ShaderSource.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

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

namespace
{
constexpr double BytesPerMiB = 1024.0 * 1024.0;

// From the texts of the extensions, because not all loaders know them. Both in KiB.
constexpr GLenum NvxCurrentAvailable = 0x9049;
constexpr GLenum AtiTextureFree = 0x87FC;

bool hasExtension(const char* name)
{
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
  {
    const auto* found = reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, i));
    if (found && std::strcmp(found, name) == 0)
    {
      return true;
    }
  }
  return false;
}

std::int64_t volumeOf(const glm::ivec3& sides)
{
  return static_cast<std::int64_t>(sides.x) * sides.y * sides.z;
}

// One decimal below 100 MiB.
std::string asMiB(double miB)
{
  std::ostringstream text;
  text << (miB < 100.0 ? std::round(10.0 * miB) / 10.0 : std::round(miB));
  return text.str();
}

std::string bytesAsMiB(std::int64_t bytes)
{
  return asMiB(static_cast<double>(bytes) / BytesPerMiB);
}
}

MemoryNeed memoryNeed(const DrawnSizes& sizes)
{
  constexpr std::int64_t GradientBytes = 4; // three numbers of ten bits, two bits spare
  constexpr std::int64_t NodeBytes = 16;    // four floats
  constexpr std::int64_t WeightBytes = 4;   // of a mask at a node
  // Picture, hits, spans and depth. The first three again for a moving part, at half the size a
  // side. Both images of occlusion.
  constexpr std::int64_t PixelBytes = 4 + 4 + 4 + 4 + (4 + 4 + 4) / 4 + (4 + 1);
  const std::int64_t voxels = volumeOf(sizes.voxels);
  MemoryNeed need;
  need.scalars = sizes.scalarBytes * voxels;
  need.colors = sizes.colorBytes * voxels;
  if (sizes.gradients)
  {
    need.gradients =
      GradientBytes * (sizes.halfResolution ? volumeOf((sizes.voxels + 1) / 2) : voxels);
  }
  need.segment = sizes.segmentBytes * voxels;
  need.field = NodeBytes * (volumeOf(sizes.forwardNodes) + volumeOf(sizes.backwardNodes));
  need.field += sizes.masked ? WeightBytes * volumeOf(sizes.forwardNodes) : 0;
  if (sizes.corrected)
  {
    constexpr std::int64_t codeBytes = 4; // of a node
    need.corrections = codeBytes * volumeOf(sizes.backwardNodes) + CorrectionLayerBytes;
  }
  need.images = PixelBytes * sizes.pixels.x * sizes.pixels.y;
  return need;
}

double freeMemoryMiB(vtkOpenGLRenderWindow* window)
{
  window->MakeCurrent();
  GLint kiB[4] = { 0, 0, 0, 0 };
  if (drawsInSoftware())
  {
    // They have the extensions, but their answers mean nothing: 0, or whatever the stack held.
    return UnknownMemory;
  }
  if (hasExtension("GL_NVX_gpu_memory_info"))
  {
    glGetIntegerv(NvxCurrentAvailable, kiB);
  }
  else if (hasExtension("GL_ATI_meminfo"))
  {
    glGetIntegerv(AtiTextureFree, kiB); // the pool's total comes first
  }
  return kiB[0] > 0 ? kiB[0] / 1024.0 : UnknownMemory;
}

bool drawsInSoftware()
{
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer && (std::strstr(renderer, "llvmpipe") || std::strstr(renderer, "softpipe"));
}

// A driver answers for a proxy at once; a texture that does not fit takes seconds to be refused.
std::string textureProblem(vtkOpenGLRenderWindow* window, const glm::ivec3& texels)
{
  const int limit = vtkTextureObject::GetMaximumTextureSize3D(window);
  const int longest = std::max({ texels.x, texels.y, texels.z });
  if (longest > limit)
  {
    return "There are " + std::to_string(longest) +
      " voxels along one axis; the GPU takes at most " + std::to_string(limit);
  }
  glTexImage3D(
    GL_PROXY_TEXTURE_3D, 0, GL_R32F, texels.x, texels.y, texels.z, 0, GL_RED, GL_FLOAT, nullptr);
  GLint width = 0;
  glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
  return width == texels.x ? std::string() : refusedTexture(texels);
}

std::string refusedTexture(const glm::ivec3& texels)
{
  return "The GPU refused a 3D texture of " + std::to_string(texels.x) + " x " +
    std::to_string(texels.y) + " x " + std::to_string(texels.z) + " values";
}

bool takeOutOfMemory()
{
  constexpr int MostErrors = 16; // a lost context reports without end
  bool outOfMemory = false;
  GLenum error = GL_NO_ERROR;
  for (int i = 0; i < MostErrors && (error = glGetError()) != GL_NO_ERROR; ++i)
  {
    outOfMemory = outOfMemory || error == GL_OUT_OF_MEMORY;
  }
  return outOfMemory;
}

std::string describeNeed(const MemoryNeed& need)
{
  return bytesAsMiB(need.total()) + " MiB (scalars " + bytesAsMiB(need.scalars) + ", gradients " +
    bytesAsMiB(need.gradients) + ", colours " + bytesAsMiB(need.colors) + ", segment " +
    bytesAsMiB(need.segment) + ", offset field " + bytesAsMiB(need.field) + ", corrections of it " +
    bytesAsMiB(need.corrections) + ", images " + bytesAsMiB(need.images) +
    (need.reference > 0 ? ", reference " + bytesAsMiB(need.reference) : "") + ")";
}

std::string memoryProblem(
  const MemoryNeed& need, std::int64_t held, double limitMiB, double freeMiB)
{
  const double neededMiB = static_cast<double>(need.total()) / BytesPerMiB;
  const std::string needed = "The deformed volume needs " + describeNeed(need) + " of GPU memory; ";
  if (limitMiB > 0.0 && neededMiB > limitMiB)
  {
    return needed + "Memory Limit allows " + asMiB(limitMiB) + " MiB";
  }
  const double heldMiB = static_cast<double>(held) / BytesPerMiB;
  if (freeMiB != UnknownMemory && neededMiB - heldMiB > freeMiB)
  {
    return needed + "the GPU has " + asMiB(freeMiB + heldMiB) + " MiB left for it";
  }
  return "";
}

std::string GpuMemory::ask(vtkOpenGLRenderWindow* window, const MemoryNeed& need, double limitMiB)
{
  if (this->Refused > 0 && need.total() >= this->Refused)
  {
    return "The GPU is out of memory: the deformed volume needs " + describeNeed(need);
  }
  const bool more = need.total() > this->Granted;
  const std::string problem =
    memoryProblem(need, this->Granted, limitMiB, more ? freeMemoryMiB(window) : UnknownMemory);
  if (problem.empty())
  {
    this->Granted = std::max(this->Granted, need.total());
  }
  return problem;
}
}
