// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/PlacedReference.h"

#include "Representations/Gpu/Program.h"

#include "vtkTextureObject.h"

#include <glm/matrix.hpp>

namespace brainshift
{
glm::dmat4 VolumePlace::otherFromTexture(const Grid& grid, const ValueLayout& layout) const
{
  return glm::inverse(brainshift::worldFromTexture(grid, layout, this->actor)) *
    this->worldFromTexture;
}

bool CavityTexture::update(vtkOpenGLRenderWindow* window, const PlacedVoxels& cavity,
  const VolumePlace& volume, PlacedCavity& placed, Counters& counters, std::string& problem)
{
  if (!cavity.voxels)
  {
    return true;
  }
  const ValueLayout layout = layoutOf(cavity.grid.dimensions, false);
  constexpr int firstComponent = 0;
  if (!this->Voxels.update(
        window, cavity.voxels, layout.dimensions, firstComponent, counters, problem))
  {
    return false;
  }
  placed.voxels = this->Voxels.texture();
  // The nearest voxel's would show steps.
  placed.voxels->SetMinificationFilter(vtkTextureObject::Linear);
  placed.voxels->SetMagnificationFilter(vtkTextureObject::Linear);
  placed.cavityFromTexture = volume.otherFromTexture(cavity.grid, layout);
  constexpr double half = 0.5; // between what is none and what is one
  placed.least = (half - this->Voxels.shift()) / this->Voxels.scale();
  return true;
}

void CavityTexture::releaseGraphicsResources(vtkWindow* window)
{
  this->Voxels.releaseGraphicsResources(window);
}

void setReferencePlace(Program& program, const PlacedReference& reference)
{
  program.set("reference", reference.scalars);
  program.set("referenceFromTexture", glm::mat4(reference.referenceFromTexture));
  program.set("referenceLow", glm::vec3(reference.low));
  program.set("referenceHigh", glm::vec3(reference.high));
}

void setCavityUniforms(Program& program, const PlacedCavity& cavity)
{
  if (cavity.voxels)
  {
    program.set("cavity", cavity.voxels);
    program.set("cavityFromTexture", glm::mat4(cavity.cavityFromTexture));
    program.set("leastCavity", static_cast<float>(cavity.least));
  }
}
}
