// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The two maps of a lattice for single points.
///
/// They evaluate the cubic itself and not the field that pictures are drawn with. With a mask they
/// read the masked nodes, as pictures do.
#ifndef BrainShift_PointMap_h
#define BrainShift_PointMap_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/OffsetField.h"

namespace brainshift
{
/** deformedFromRest, its inverse and its derivatives. Positions are mm along world axes. */
class BRAINSHIFT_DEFORMATION_EXPORT PointMap
{
public:
  /** `inverse`: how restFromDeformed finds tissue. */
  explicit PointMap(const Lattice& lattice, Inverse inverse = Inverse::Exact);

  /** The control points. */
  const Grid& grid() const { return this->LatticeGrid; }

  /** How restFromDeformed finds tissue. */
  Inverse inverse() const { return this->Backward; }

  /** Whether displacements are trilinear between masked nodes. Else they are cubic. */
  bool isTrilinear() const { return !this->Masked.values.empty(); }

  /** Where tissue at a rest point goes. */
  glm::dvec3 deformedFromRest(const glm::dvec3& rest) const;

  /**
   * The rest point of the tissue that is seen at a deformed point. With the exact inverse,
   * deformedFromRest of the answer is the point, to 0.0001 lattice cells or better, wherever the
   * map does not fold.
   */
  glm::dvec3 restFromDeformed(const glm::dvec3& deformed) const;

  /**
   * restFromDeformed minus identity, lattice cells. It needs fewer steps from a guess nearby.
   *
   * @param deformed   lattice coordinates: cells from the first control point
   * @param guess      where the search begins, lattice cells; the negated inverse needs none
   */
  glm::vec3 offsetInCells(const glm::dvec3& deformed, const glm::vec3& guess) const;

  /**
   * offsetInCells with a single step if the guess is near. Where the map does not fold, the two
   * differ by less than 0.0005 lattice cells.
   */
  glm::vec3 offsetNear(const glm::dvec3& deformed, const glm::vec3& guess) const;

  /** Derivatives of deformedFromRest at a rest point: column a is d(deformed) / d(rest_a). */
  glm::dmat3 jacobian(const glm::dvec3& rest) const;

private:
  glm::vec3 displacement(const glm::dvec3& position) const;

  Grid LatticeGrid;
  int Kernel;
  Inverse Backward;
  std::vector<glm::vec4> InCells; // displacements of the control points, lattice cells; w: 0
  NodeField Masked;               // with a mask: what holds instead; else without nodes
};
}

#endif
