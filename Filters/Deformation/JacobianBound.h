// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Proofs that the Jacobian determinant of position + displacement stays at or above a limit
 *        everywhere in a cell, and not only at samples of it.
 *
 * Over a box each column of the Jacobian is bounded by its middle, a slope along each axis, and a
 * rest. A bound on the determinant follows from these. If the bound does not prove a box, the box
 * is halved. A proof that succeeds is always right. A proof can fail for a cell whose smallest
 * determinant is above the limit by very little.
 *
 * All displacements are in lattice cells. `kernel`: KernelCatmullRom or KernelBSpline (Kernels.h).
 */
#ifndef BrainShift_JacobianBound_h
#define BrainShift_JacobianBound_h

#include "Filters/Deformation/Export.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace brainshift
{
/**
 * What the three columns of a matrix can be over a box: middle + slope * position + rest.
 * Positions go from -0.5 to 0.5 along each axis.
 */
struct ColumnBounds
{
  glm::vec3 middle[3]; ///< of each column, at the middle of the box
  glm::mat3 slope[3];  ///< of each column: change over the box along each axis
  glm::vec3 rest[3];   ///< largest absolute value of each number of the rest; 0 or more
};

/** A number that the determinant is nowhere below in the box. */
BRAINSHIFT_DEFORMATION_EXPORT float leastDeterminant(const ColumnBounds& columns);

/** Displacements of the 64 control points around a lattice cell, one list for each component. */
struct CellTaps
{
  /** Control point (i, j, k) of the 4 x 4 x 4 has the index i + 4 j + 16 k. */
  std::array<float, 64> component[3];
};

/**
 * Makes the displacement constant along an axis, with the values of the cell's lower (`side` 0) or
 * upper (`side` 1) face. This is what holds beyond that face if it is the lattice's border.
 */
BRAINSHIFT_DEFORMATION_EXPORT void holdFace(CellTaps& taps, int kernel, int axis, int side);

/**
 * Bounds on the cubic's columns over the whole cell, with slopes of zero. Because there are no
 * slopes, the bounds also hold for columns that come from three different places. They hold for the
 * refined displacement too, whose columns are means of the cubic's columns.
 */
BRAINSHIFT_DEFORMATION_EXPORT ColumnBounds boundsOf(const CellTaps& taps, int kernel);

/** The range of a mask's weights within a cell, and of their slopes. */
struct WeightRange
{
  float least = 1.0f;
  float greatest = 1.0f;
  glm::vec3 leastSlope{ 0.0f };    ///< along each axis, for each lattice cell
  glm::vec3 greatestSlope{ 0.0f }; ///< along each axis, for each lattice cell
};

/** Bounds on the columns of the refined displacement in the cell times the mask's weights. */
BRAINSHIFT_DEFORMATION_EXPORT ColumnBounds maskedBoundsOf(
  const CellTaps& taps, int kernel, const WeightRange& weights);

/** Whether the cubic's determinant is proved to be at or above `limit` everywhere in the cell. */
BRAINSHIFT_DEFORMATION_EXPORT bool cubicHolds(const CellTaps& taps, int kernel, float limit);

/**
 * Whether the determinant of a displacement that is trilinear between the 8 corners of a box is
 * proved to be at or above `limit` everywhere in the box.
 *
 * @param corners   displacements; corner i lies at (i & 1, i >> 1 & 1, i >> 2)
 * @param perCell   how many such boxes lie along one side of a lattice cell
 */
BRAINSHIFT_DEFORMATION_EXPORT bool trilinearHolds(
  const std::array<glm::vec3, 8>& corners, int perCell, float limit);
}

#endif
