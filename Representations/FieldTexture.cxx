// SPDX-License-Identifier: BSD-3-Clause
#include "FieldTexture.h"

#include "Kernels.h"
#include "VolumePass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>

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

// Whether the fields of two requests have the same nodes and the same unit, so that unchanged
// control points leave them as they are.
bool samePlaces(const FieldRequest& a, const FieldRequest& b)
{
  return a.dimensions == b.dimensions && a.kernel == b.kernel && a.samples == b.samples &&
    a.inverse == b.inverse && a.nodes == b.nodes && a.offsetScale == b.offsetScale &&
    sameMask(a.mask, b.mask);
}

// The kernel's weights at each of the perCell nodes of a cell.
std::vector<glm::vec4> weightsInCell(int kernel, int perCell)
{
  std::vector<glm::vec4> weights(perCell);
  for (int node = 0; node < perCell; ++node)
  {
    weights[node] = kernelWeights(kernel, static_cast<float>(node) / static_cast<float>(perCell));
  }
  return weights;
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
  IndexBox points{ glm::ivec3(0), request.dimensions - 1 };
  this->Changed = { glm::ivec3(0), request.nodes.count - 1 };
  if (this->HasCurrent && samePlaces(this->Current, request))
  {
    points = changedPoints(request.dimensions, this->Current.inCells, request.inCells);
    this->Changed = changedBackwardNodes(
      points, request.dimensions, this->Current.inCells, request.inCells, request.nodes);
  }
  const bool maskIsCurrent = this->HasCurrent && sameMask(this->Current.mask, request.mask);
  this->HasCurrent = false; // not before all of it succeeded
  if (!maskIsCurrent && !this->uploadMask(window, request, counters))
  {
    return false;
  }
  if (!points.empty() &&
    (!this->upload(window, request, counters) || !this->refine(window, request, points, counters) ||
      !this->invert(window, request, counters)))
  {
    return false;
  }
  this->Current = request;
  this->HasCurrent = true;
  return true;
}

bool FieldTexture::upload(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  this->ControlPoints = vtkSmartPointer<vtkTextureObject>::New();
  this->ControlPoints->SetContext(window);
  const glm::ivec3& points = request.dimensions;
  counters.latticeUploads += 1;
  counters.bytesUploaded += static_cast<std::int64_t>(request.inCells.size() * sizeof(glm::vec3));
  return this->ControlPoints->Create3DFromRaw(
    points.x, points.y, points.z, 3, VTK_FLOAT, const_cast<glm::vec3*>(request.inCells.data()));
}

bool FieldTexture::uploadMask(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  this->MaskWeights = nullptr;
  if (!request.mask)
  {
    return true;
  }
  const glm::ivec3 nodes = (request.dimensions - 1) * request.mask->perCell + 1;
  this->MaskWeights = vtkSmartPointer<vtkTextureObject>::New();
  this->MaskWeights->SetContext(window);
  counters.bytesUploaded += texels(nodes) * static_cast<std::int64_t>(sizeof(float));
  return this->MaskWeights->Create3DFromRaw(
    nodes.x, nodes.y, nodes.z, 1, VTK_FLOAT, const_cast<float*>(request.mask->values.data()));
}

bool FieldTexture::refine(vtkOpenGLRenderWindow* window, const FieldRequest& request,
  const IndexBox& points, Counters& counters)
{
  FieldNodes forward;
  forward.perCell = request.samples + 1;
  forward.count = (request.dimensions - 1) * forward.perCell + 1;
  const IndexBox nodes = changedForwardNodes(points, forward);
  const std::vector<glm::vec4> weights = weightsInCell(request.kernel, forward.perCell);
  glm::ivec3 count = request.dimensions;
  IndexBox box{ glm::ivec3(0),
    request.dimensions - 1 }; // of control points; of nodes, axis by axis
  vtkTextureObject* coarse = this->ControlPoints;
  for (int axis = 0; axis < 3; ++axis)
  {
    count[axis] = forward.count[axis];
    box.first[axis] = nodes.first[axis];
    box.last[axis] = nodes.last[axis];
    vtkTextureObject* mask = axis == 2 ? this->MaskWeights : nullptr;
    Program& program = this->RefinePrograms[mask != nullptr];
    if (!allocate(window, this->Refined[axis], count, vtkTextureObject::Nearest) ||
      !program.use(window, refineSource(mask != nullptr), counters))
    {
      return false;
    }
    glm::ivec3 unit(0);
    unit[axis] = 1;
    if (mask)
    {
      program.set("maskWeights", mask);
    }
    program.set("coarse", coarse);
    program.set("axis", unit);
    program.set("points", request.dimensions[axis]);
    program.set("perCell", forward.perCell);
    program.get()->SetUniform4fv("weights", forward.perCell, glm::value_ptr(weights[0]));
    runVolumePass(
      window, program.get()->GetHandle(), { this->Refined[axis] }, box.first, box.size());
    coarse->Deactivate();
    if (mask)
    {
      mask->Deactivate();
    }
    coarse = this->Refined[axis];
  }
  // The next stroke computes what it needs of these anew; their memory is worth more.
  for (const int axis : { 0, 1 })
  {
    this->Refined[axis]->ReleaseGraphicsResources(window);
    this->Refined[axis] = nullptr;
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
  this->InvertProgram.set("refined", this->Refined[2].Get());
  this->InvertProgram.set("refinedCount", (request.dimensions - 1) * perCell + 1);
  this->InvertProgram.set("perCell", perCell);
  this->InvertProgram.set("firstCell", request.nodes.first);
  this->InvertProgram.set("offsetScale", request.offsetScale);
  this->InvertProgram.set("negated", request.inverse == Inverse::Negated ? 1 : 0);
  runVolumePass(window, this->InvertProgram.get()->GetHandle(), { this->Offsets },
    this->Changed.first, this->Changed.size());
  this->Refined[2]->Deactivate();
  counters.texelsRefined += texels(this->Changed.size());
  return true;
}

void FieldTexture::releaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* texture :
    { this->ControlPoints.Get(), this->Refined[0].Get(), this->Refined[1].Get(),
      this->Refined[2].Get(), this->Offsets.Get(), this->MaskWeights.Get() })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  this->ControlPoints = nullptr;
  this->Offsets = nullptr;
  this->MaskWeights = nullptr;
  for (auto& texture : this->Refined)
  {
    texture = nullptr;
  }
  this->HasCurrent = false;
  this->RefinePrograms[0].forget();
  this->RefinePrograms[1].forget();
  this->InvertProgram.forget();
}
}
