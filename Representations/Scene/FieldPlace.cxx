// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/FieldPlace.h"

namespace brainshift
{
glm::dvec3 textureFromLattice(const DrawnValues& values, const Grid& lattice)
{
  return lattice.spacing / values.grid.spacing * values.layout.textureFromGrid;
}

void widenByNodes(const Grid& lattice, const FieldNodes& nodes, double bounds[6])
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::vec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world =
      lattice.worldFromGrid(glm::dvec3(nodes.latticeFromNode(side * glm::vec3(nodes.count - 1))));
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = glm::min(bounds[2 * axis], world[axis]);
      bounds[2 * axis + 1] = glm::max(bounds[2 * axis + 1], world[axis]);
    }
  }
}

SceneField restField(const ValueLayout& layout)
{
  SceneField field;
  field.spaceLow = layout.low;
  field.spaceHigh = layout.high;
  return field;
}

SceneField bentField(const DrawnValues& values, const Grid& lattice, const FieldNodes& nodes)
{
  const glm::dvec3 texturePerCell = textureFromLattice(values, lattice);
  const glm::dvec3 textureOfLatticeZero = textureFromWorld(values, lattice.origin);
  const glm::dvec3 count(nodes.count);
  const glm::dvec3 first(nodes.first);
  const double perCell = nodes.perCell;
  SceneField field;
  field.fieldFromTexture = perCell / texturePerCell / count;
  field.fieldOfTextureZero =
    (0.5 - first * perCell) / count - textureOfLatticeZero * field.fieldFromTexture;
  field.texel = 0.5 / count;
  field.spaceLow = textureOfLatticeZero + first * texturePerCell;
  field.spaceHigh = field.spaceLow + (count - 1.0) / perCell * texturePerCell;
  field.latticeFromTexture = 1.0 / texturePerCell;
  field.latticeOfTextureZero = -textureOfLatticeZero / texturePerCell;
  return field;
}
}
