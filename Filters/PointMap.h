// SPDX-License-Identifier: BSD-3-Clause
// deformedFromRest and its inverse for single points, straight from the control points.
#ifndef BrainShift_PointMap_h
#define BrainShift_PointMap_h

#include "Lattice.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
// How a picture finds tissue.
enum class Inverse
{
  Exact = 0,   // solves the forward map: tissue arrives where the handle is put
  Negated = 1, // the paper's form: subtracts the displacement found at the deformed point
};

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
  Grid LatticeGrid;
  int Kernel;
  Inverse Backward;
  std::vector<glm::vec3> InCells; // displacements of the control points, lattice cells
};
}

#endif
