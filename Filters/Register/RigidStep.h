// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The rigid motion that the forces on all control points ask for together.
 *
 * Six numbers instead of three for each control point: what speckle asks for in one place and in
 * another does not agree, so that it averages out.
 */
#ifndef BrainShift_RigidStep_h
#define BrainShift_RigidStep_h

#include "Filters/Deformation/Export.h"
#include "Filters/Deformation/Grid.h"
#include "Filters/Register/LatticeRows.h"

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
/** A step of all control points. */
struct RigidStep
{
  std::vector<glm::vec3> steps; ///< mm along the grid's axes
  double lengthMm = 0.0;        ///< the longest of those on which forces act
};

/**
 * The step of Gauss and Newton of a shift and a small rotation of the bent lattice.
 *
 * @param displacements   of the control points, mm along the grid's axes
 * @param forces          ForceNumbers for each control point (LatticeRows.h)
 */
BRAINSHIFT_DEFORMATION_EXPORT RigidStep rigidStep(
  const Grid& lattice, const std::vector<glm::vec3>& displacements, const ControlForces& forces);
}

#endif
