// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/PlacedReference.h"

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkTextureObject.h"

namespace brainshift
{
glm::dmat4 VolumePlace::otherFromTexture(const Grid& grid, const ValueLayout& layout) const
{
  return glm::inverse(brainshift::worldFromTexture(grid, layout, this->actor)) *
    this->worldFromTexture;
}

void setReferencePlace(Program& program, const PlacedReference& reference)
{
  program.set("reference", reference.scalars);
  program.set("referenceFromTexture", glm::mat4(reference.referenceFromTexture));
  program.set("referenceLow", glm::vec3(reference.low));
  program.set("referenceHigh", glm::vec3(reference.high));
}

void setComparisonColors(Program& program, const ColorPair& colors)
{
  program.set("ownColor", colors.own);
  program.set("referenceColor", colors.reference);
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
