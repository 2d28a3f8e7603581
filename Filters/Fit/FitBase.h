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

#include <algorithm>
#include <memory>
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

  /** How far (mm) it moves tissue at rest. */
  glm::dvec3 displacement(const glm::dvec3& rest) const
  {
    return this->map.deformedFromRest(rest) - rest;
  }
};

/** The base of a lattice; null if none of its control points is moved. */
inline std::shared_ptr<const FitBase> baseOf(const Lattice& lattice)
{
  const bool moves = std::any_of(lattice.displacements.begin(), lattice.displacements.end(),
    [](const glm::vec3& d) { return d != glm::vec3(0.0f); });
  return moves ? std::make_shared<const FitBase>(lattice) : nullptr;
}
}

#endif
