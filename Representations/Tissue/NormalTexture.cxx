// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/NormalTexture.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/VolumePass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace brainshift
{
NormalTexture::NormalTexture() = default;
NormalTexture::~NormalTexture() = default;

bool NormalTexture::update(GpuTask& gpu, vtkTextureObject* scalars, const glm::ivec3& dimensions,
  bool half, float difference)
{
  if (this->Texture && this->Source == scalars && this->Half == half)
  {
    return true;
  }
  const glm::ivec3 size = half ? (dimensions + 1) / 2 : dimensions;
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(gpu.window);
  this->Texture->SetInternalFormat(GL_RGB10_A2);
  this->Texture->SetMinificationFilter(vtkTextureObject::Linear);
  this->Texture->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
  Program& program = this->NormalsProgram;
  if (!program.use(gpu.window, normalsSource(), gpu.counters))
  {
    this->Texture = nullptr;
    return gpu.fail("The gradients' shader does not compile on this GPU");
  }
  if (!this->Texture->Allocate3D(size.x, size.y, size.z, 4, VTK_FLOAT))
  {
    this->Texture = nullptr;
    return gpu.refuse("The GPU refused a 3D texture for the gradients");
  }
  const glm::vec3 voxel = 1.0f / glm::vec3(dimensions);
  program.set("scalars", scalars);
  program.set("texel", 1.0f / glm::vec3(size));
  program.set("voxel", voxel);
  // Along the longest side, the usual difference over two voxels becomes a gradient of 1.
  const float longest =
    static_cast<float>(glm::max(dimensions.x, glm::max(dimensions.y, dimensions.z)));
  const float scale = 2.0f / (difference > 0.0f ? difference * longest : longest);
  program.set("gradientScale", scale);
  this->Scale = scale * 511.0 / 1023.0; // as normals.frag.glsl stores it
  runVolumePass(gpu.window, program.get()->GetHandle(), { this->Texture }, glm::ivec3(0), size);
  scalars->Deactivate();
  this->Source = scalars;
  this->Half = half;
  return true;
}

void NormalTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Source = nullptr;
  this->NormalsProgram.forget();
}
}
