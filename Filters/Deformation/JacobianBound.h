// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Proofs that the Jacobian determinant of position + displacement stays at or above a limit
/// everywhere in a cell, and not only at samples of it.
///
/// Over a box each column of the Jacobian is bounded by its middle, a slope along each axis, and a
/// rest. A bound on the determinant follows from these. If the bound does not prove a box, the box
/// is halved. A proof that succeeds is always right. A proof can fail for a cell whose smallest
/// determinant is above the limit by very little.
///
/// The bounds of a column come from its Bernstein coefficients, whose convex hull holds it:
/// Farouki, "The Bernstein polynomial basis: a centennial retrospective", Computer Aided Geometric
/// Design 29 (2012).
///
/// All displacements are in lattice cells. `kernel`: KernelCatmullRom or KernelBSpline (Kernels.h).
#ifndef BrainShift_JacobianBound_h
#define BrainShift_JacobianBound_h

#include "Common/Export.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>

namespace brainshift
{
/**
 * What the three columns of a matrix can be over a box: middle + slope * position + rest.
 * Positions go from -0.5 to 0.5 along each axis.
 */
template <typename T>
struct ColumnBoundsOf
{
  glm::vec<3, T> middle[3];   ///< of each column, at the middle of the box
  glm::mat<3, 3, T> slope[3]; ///< of each column: change over the box along each axis
  glm::vec<3, T> rest[3];     ///< largest absolute value of each number of the rest; 0 or more
};
using ColumnBounds = ColumnBoundsOf<float>;

/** A number that the determinant is nowhere below in the box. */
BRAINSHIFT_DEFORMATION_EXPORT float leastDeterminant(const ColumnBounds& columns);

/** Displacements of the 64 control points around a lattice cell, one list for each component. */
template <typename T>
struct CellTapsOf
{
  /** Control point (i, j, k) of the 4 x 4 x 4 has the index i + 4 j + 16 k. */
  std::array<T, 64> component[3];
};
using CellTaps = CellTapsOf<float>;

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

/** A part of a cell, in double precision, and what is known of the determinants in it. */
class BRAINSHIFT_DEFORMATION_EXPORT DeterminantPart
{
public:
  virtual ~DeterminantPart() = default;

  double least = 0.0; ///< no determinant in the part is below this
  double found = 0.0; ///< the smaller one of those at two corners

  /** Halves the part where that helps the bound most. Returns the half that is no longer in it. */
  virtual std::unique_ptr<DeterminantPart> halve() = 0;
};

/** A whole cell of the cubic. */
BRAINSHIFT_DEFORMATION_EXPORT std::unique_ptr<DeterminantPart> cubicPart(
  const CellTapsOf<double>& taps, int kernel);

/** A whole box of a displacement that is trilinear. The arguments are those of trilinearHolds. */
BRAINSHIFT_DEFORMATION_EXPORT std::unique_ptr<DeterminantPart> trilinearPart(
  const std::array<glm::dvec3, 8>& corners, int perCell);
}

#endif
