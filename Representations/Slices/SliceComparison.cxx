// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SliceComparison.h"

#include "Representations/Gpu/Program.h"
#include "Representations/Slices/SliceGeometry.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkTextureObject.h"

namespace brainshift
{
namespace
{
constexpr int FirstComponent = 0;

glm::dvec3 mmFromTexture(const Grid& grid, const ValueLayout& layout)
{
  return grid.spacing / layout.textureFromGrid;
}

// Share of the range of greys from what a texture stores: scale, shift.
glm::dvec2 shareFromStored(const glm::dvec2& greys, const StoredScalar& value)
{
  const double length = greys.y > greys.x ? greys.y - greys.x : 1.0;
  return { value.scale / length, (value.shift - greys.x) / length };
}
}

std::array<WipePlane, 3> wipePlanes(
  const Grid& grid, const ValueLayout& layout, const glm::dvec3& positionMm)
{
  const glm::ivec3 axes = axesAcrossPlanes(grid.direction);
  const glm::dvec3 mm = mmFromTexture(grid, layout);
  const glm::dvec3 position =
    grid.gridFromWorld(positionMm) * layout.textureFromGrid + layout.textureOfGridZero;
  // Across the axis nearest to a world axis.
  const auto across = [&](int world) {
    const int axis = axes[world];
    WipePlane plane;
    plane.normal[axis] = grid.direction[axis][world] < 0.0 ? mm[axis] : -mm[axis];
    plane.shift = -plane.normal[axis] * position[axis];
    return plane;
  };
  enum World
  {
    X,
    Y,
    Z
  };
  std::array<WipePlane, 3> planes;
  planes[axes[X]] = across(Y);
  planes[axes[Y]] = planes[axes[Z]] = across(X);
  return planes;
}

bool ReferenceTextures::update(GpuTask& gpu, const ReferenceVolume& reference,
  const ComparisonChoice& choice, const ComparedVolume& volume, ReferenceScene& scene)
{
  const ValueLayout layout = layoutOf(reference.grid.dimensions, false);
  if (!this->Voxels.update(gpu, reference.voxels, layout.dimensions, FirstComponent))
  {
    return false;
  }
  const int filter = volume.nearest ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  this->Voxels.texture()->SetMinificationFilter(filter);
  this->Voxels.texture()->SetMagnificationFilter(filter);
  vtkNew<vtkMatrix4x4> unmoved; // all of them are, alike
  const VolumePlace place{ worldFromTexture(volume.grid, volume.layout, unmoved), unmoved };
  scene.place = { this->Voxels.texture(), place.otherFromTexture(reference.grid, layout),
    layout.low, layout.high };
  scene.voxels = layout.dimensions;
  scene.shareFromReference = shareFromStored(volume.greyRange,
    mappedFurther({ this->Voxels.scale(), this->Voxels.shift() }, volume.valueFromReference));
  scene.shareFromScalar = shareFromStored(volume.greyRange, volume.valueFromStored);
  const double scale = volume.transferFromStored.x / scene.shareFromScalar.x;
  scene.transferFromShare = { scale,
    volume.transferFromStored.y - scene.shareFromScalar.y * scale };
  scene.comparison = reference.show == ReferenceShow::Reference ? 0 : choice.comparison;
  scene.colors = choice.colors;
  scene.checkersFromTexture = mmFromTexture(volume.grid, volume.layout) / choice.checkerSizeMm;
  scene.fullFromGradient =
    scene.shareFromReference.x / mmFromTexture(reference.grid, layout) / choice.fullGradient;
  scene.windowRadius = 0.5 * choice.windowMm / mmFromTexture(volume.grid, volume.layout);
  scene.wipes = wipePlanes(volume.grid, volume.layout, choice.wipePosition);
  return this->Cavity.update(gpu, reference.cavity, place, scene.cavity);
}

std::vector<vtkTextureObject*> ReferenceTextures::textures() const
{
  return { this->Voxels.texture(), this->Cavity.texture() };
}

void ReferenceTextures::releaseGraphicsResources(vtkWindow* window)
{
  this->Voxels.releaseGraphicsResources(window);
  this->Cavity.releaseGraphicsResources(window);
}

void setReferenceUniforms(Program& program, const ReferenceScene& scene)
{
  setReferencePlace(program, scene.place);
  setCavityUniforms(program, scene.cavity);
  program.set("referenceVoxels", glm::vec3(scene.voxels));
  program.set("shareFromReference", glm::vec2(scene.shareFromReference));
  program.set("shareFromScalar", glm::vec2(scene.shareFromScalar));
  program.set("transferFromShare", glm::vec2(scene.transferFromShare));
  setComparisonColors(program, scene.colors);
  program.set("comparison", scene.comparison);
  program.set("checkersFromTexture", glm::vec3(scene.checkersFromTexture));
  program.set("fullFromGradient", glm::vec3(scene.fullFromGradient));
  program.set("windowRadius", glm::vec3(scene.windowRadius));
}

void setWipeUniforms(Program& program, const ReferenceScene& scene, int axis)
{
  program.set("wipeNormal", glm::vec3(scene.wipes[axis].normal));
  program.set("wipeShift", static_cast<float>(scene.wipes[axis].shift));
}
}
