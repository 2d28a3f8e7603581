// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief How a volume is bent before anything is measured: what a fit begins with.
 */
#ifndef BrainShift_FitBase_h
#define BrainShift_FitBase_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/PointMap.h"

#include <glm/vec3.hpp>

#include <utility>

namespace brainshift
{
/** A bend that a refinement found, or a field of another program. Positions are world mm. */
struct FitBase
{
  Lattice lattice;
  PointMap map; ///< of the lattice

  explicit FitBase(Lattice bent)
    : lattice(std::move(bent))
    , map(lattice)
  {
  }

  /** Whether it is the base of such a lattice, with the same mask. */
  bool isOf(const Lattice& other) const
  {
    return this->lattice.grid == other.grid && this->lattice.kernel == other.kernel &&
      this->lattice.mask == other.mask && this->lattice.displacements == other.displacements;
  }

  /** How far (mm) it moves tissue at rest. */
  glm::dvec3 displacement(const glm::dvec3& rest) const
  {
    return this->map.deformedFromRest(rest) - rest;
  }
};
}

#endif
