// SPDX-License-Identifier: BSD-3-Clause
// deformedFromRest and its inverse for single points, straight from the control points; with a
// mask, from the masked nodes that pictures are drawn from.
#ifndef BrainShift_PointMap_h
#define BrainShift_PointMap_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/OffsetField.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
class VTKBRAINSHIFTFILTERS_EXPORT PointMap
{
public:
  explicit PointMap(const Lattice& lattice, Inverse inverse = Inverse::Exact);

  // Where tissue at a rest point goes. mm, world, both ways.
  glm::dvec3 deformedFromRest(const glm::dvec3& rest) const;

  // Which tissue is seen at a deformed point: deformedFromRest of the answer is the point, to
  // 0.0001 lattice cells or better, wherever the map does not fold.
  glm::dvec3 restFromDeformed(const glm::dvec3& deformed) const;

  // Derivatives of deformedFromRest at a rest point, world axes: column a is d(deformed)/d(rest_a).
  glm::dmat3 jacobian(const glm::dvec3& rest) const;

private:
  glm::vec3 displacement(const glm::dvec3& position) const;

  Grid LatticeGrid;
  int Kernel;
  Inverse Backward;
  std::vector<glm::vec3> InCells; // displacements of the control points, lattice cells
  NodeField Masked;               // with a mask: what holds instead; else without nodes
};
}

#endif
