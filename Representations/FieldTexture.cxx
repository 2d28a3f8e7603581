// SPDX-License-Identifier: BSD-3-Clause
#include "FieldTexture.h"

#include "VolumePass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <cstdint>

namespace brainshift
{
namespace
{
// A float texture of the wanted size, kept if it has that size already. Null if the GPU refuses.
bool allocate(vtkOpenGLRenderWindow* window, vtkSmartPointer<vtkTextureObject>& texture,
  const glm::ivec3& count, int filter)
{
  if (texture && texture->GetWidth() == static_cast<unsigned int>(count.x) &&
    texture->GetHeight() == static_cast<unsigned int>(count.y) &&
    texture->GetDepth() == static_cast<unsigned int>(count.z))
  {
    return true;
  }
  texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  // Four components: three-component floats are the slowest format to sample.
  return texture->Allocate3D(count.x, count.y, count.z, 4, VTK_FLOAT);
}

std::int64_t texels(const glm::ivec3& count)
{
  return static_cast<std::int64_t>(count.x) * count.y * count.z;
}
}

FieldTexture::FieldTexture() = default;
FieldTexture::~FieldTexture() = default;

bool FieldTexture::update(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  this->ControlPoints = vtkSmartPointer<vtkTextureObject>::New();
  this->ControlPoints->SetContext(window);
  const glm::ivec3& points = request.dimensions;
  if (!this->ControlPoints->Create3DFromRaw(points.x, points.y, points.z, 3, VTK_FLOAT,
        const_cast<glm::vec3*>(request.inCells.data())))
  {
    return false;
  }
  counters.latticeUploads += 1;
  counters.bytesUploaded += static_cast<std::int64_t>(request.inCells.size() * sizeof(glm::vec3));
  return this->refine(window, request, counters) && this->invert(window, request, counters);
}

bool FieldTexture::refine(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  const int perCell = request.samples + 1;
  glm::ivec3 count = request.dimensions;
  vtkTextureObject* coarse = this->ControlPoints;
  for (int axis = 0; axis < 3; ++axis)
  {
    count[axis] = (request.dimensions[axis] - 1) * perCell + 1;
    if (!allocate(window, this->Refined[axis], count, vtkTextureObject::Nearest) ||
      !this->RefineProgram.use(window, refineSource(), counters))
    {
      return false;
    }
    this->RefineProgram.set("coarse", coarse);
    this->RefineProgram.set("axis", axis);
    this->RefineProgram.set("points", request.dimensions[axis]);
    this->RefineProgram.set("perCell", perCell);
    this->RefineProgram.set("kernel", request.kernel);
    runVolumePass(window, this->RefineProgram.get()->GetHandle(), this->Refined[axis],
      glm::ivec3(0), count);
    coarse->Deactivate();
    coarse = this->Refined[axis];
  }
  return true;
}

bool FieldTexture::invert(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  if (!allocate(window, this->Offsets, request.nodes.count, vtkTextureObject::Linear) ||
    !this->InvertProgram.use(window, invertSource(), counters))
  {
    return false;
  }
  const int perCell = request.nodes.perCell;
  this->InvertProgram.set("refined", this->Refined[2]);
  this->InvertProgram.set("refinedCount", (request.dimensions - 1) * perCell + 1);
  this->InvertProgram.set("perCell", perCell);
  this->InvertProgram.set("firstCell", request.nodes.first);
  this->InvertProgram.set("offsetScale", request.offsetScale);
  this->InvertProgram.set("negated", request.inverse == Inverse::Negated ? 1 : 0);
  runVolumePass(window, this->InvertProgram.get()->GetHandle(), this->Offsets, glm::ivec3(0),
    request.nodes.count);
  this->Refined[2]->Deactivate();
  counters.texelsRefined += texels(request.nodes.count);
  return true;
}

void FieldTexture::releaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* texture : { this->ControlPoints.Get(), this->Refined[0].Get(),
         this->Refined[1].Get(), this->Refined[2].Get(), this->Offsets.Get() })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  this->ControlPoints = nullptr;
  this->Offsets = nullptr;
  for (auto& texture : this->Refined)
  {
    texture = nullptr;
  }
  this->RefineProgram.forget();
  this->InvertProgram.forget();
}
}
