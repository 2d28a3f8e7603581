// SPDX-License-Identifier: BSD-3-Clause
#include "SliceComparison.h"

#include "Program.h"
#include "SliceGeometry.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkTextureObject.h"

#include <glm/matrix.hpp>

namespace brainshift
{
namespace
{
constexpr int FirstComponent = 0;

// Texture coordinates of one grid from those of another.
glm::dmat4 textureFromTexture(
  const Grid& to, const ValueLayout& toLayout, const Grid& from, const ValueLayout& fromLayout)
{
  vtkNew<vtkMatrix4x4> unmoved;
  return glm::inverse(worldFromTexture(to, toLayout, unmoved)) *
    worldFromTexture(from, fromLayout, unmoved);
}

void setNearest(vtkTextureObject* texture, bool nearest)
{
  const int filter = nearest ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
}

glm::dvec3 mmFromTexture(const Grid& grid, const ValueLayout& layout)
{
  return grid.spacing / layout.textureFromGrid;
}

// Share of what is shown (its ends) from what a texture stores: scale, shift.
glm::dvec2 shareFromStored(const glm::dvec2& shown, const StoredScalar& value)
{
  const double length = shown.y > shown.x ? shown.y - shown.x : 1.0;
  return { value.scale / length, (value.shift - shown.x) / length };
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

bool ReferenceTextures::update(vtkOpenGLRenderWindow* window, const ReferenceVolume& reference,
  const ComparisonChoice& choice, const ComparedVolume& volume, ReferenceScene& scene,
  Counters& counters, std::string& problem)
{
  const ValueLayout layout = layoutOf(reference.grid.dimensions, false);
  if (!this->Voxels.update(
        window, reference.voxels, layout.dimensions, FirstComponent, counters, problem))
  {
    return false;
  }
  setNearest(this->Voxels.texture(), volume.nearest);
  scene.scalars = this->Voxels.texture();
  scene.referenceFromTexture =
    textureFromTexture(reference.grid, layout, volume.grid, volume.layout);
  scene.voxels = layout.dimensions;
  scene.low = layout.low;
  scene.high = layout.high;
  scene.shareFromReference = shareFromStored(volume.shownRange,
    mappedFurther({ this->Voxels.scale(), this->Voxels.shift() }, volume.valueFromReference));
  scene.shareFromScalar = shareFromStored(volume.shownRange, volume.valueFromStored);
  const double scale = volume.transferFromStored.x / scene.shareFromScalar.x;
  scene.transferFromShare = { scale,
    volume.transferFromStored.y - scene.shareFromScalar.y * scale };
  scene.comparison = reference.show == ReferenceShow::Reference ? 0 : choice.comparison;
  scene.checkersFromTexture = mmFromTexture(volume.grid, volume.layout) / choice.checkerSizeMm;
  scene.greenFromGradient =
    scene.shareFromReference.x / mmFromTexture(reference.grid, layout) / choice.fullGradient;
  scene.wipes = wipePlanes(volume.grid, volume.layout, choice.wipePosition);
  const PlacedVoxels& cavity = reference.cavity;
  if (cavity.voxels)
  {
    const ValueLayout cavityLayout = layoutOf(cavity.grid.dimensions, false);
    if (!this->Cavity.update(
          window, cavity.voxels, cavityLayout.dimensions, FirstComponent, counters, problem))
    {
      return false;
    }
    setNearest(this->Cavity.texture(), true);
    scene.cavity = this->Cavity.texture();
    scene.cavityFromTexture =
      textureFromTexture(cavity.grid, cavityLayout, volume.grid, volume.layout);
    constexpr double half = 0.5; // between what is none and what is one
    scene.leastCavity = (half - this->Cavity.shift()) / this->Cavity.scale();
  }
  return true;
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
  program.set("reference", scene.scalars);
  program.set("referenceFromTexture", glm::mat4(scene.referenceFromTexture));
  program.set("referenceVoxels", glm::vec3(scene.voxels));
  program.set("referenceLow", glm::vec3(scene.low));
  program.set("referenceHigh", glm::vec3(scene.high));
  program.set("shareFromReference", glm::vec2(scene.shareFromReference));
  program.set("shareFromScalar", glm::vec2(scene.shareFromScalar));
  program.set("transferFromShare", glm::vec2(scene.transferFromShare));
  program.set("comparison", scene.comparison);
  program.set("checkersFromTexture", glm::vec3(scene.checkersFromTexture));
  program.set("greenFromGradient", glm::vec3(scene.greenFromGradient));
  if (scene.cavity)
  {
    program.set("cavity", scene.cavity);
    program.set("cavityFromTexture", glm::mat4(scene.cavityFromTexture));
    program.set("leastCavity", static_cast<float>(scene.leastCavity));
  }
}

void setWipeUniforms(Program& program, const ReferenceScene& scene, int axis)
{
  program.set("wipeNormal", glm::vec3(scene.wipes[axis].normal));
  program.set("wipeShift", static_cast<float>(scene.wipes[axis].shift));
}
}
