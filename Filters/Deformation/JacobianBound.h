// SPDX-License-Identifier: BSD-3-Clause
// Proofs that the Jacobian determinant of position + displacement stays at or above a limit
// everywhere in a cell, not at samples of it.
//
// Over a box each column of the Jacobian is its middle, a slope along each axis, and a rest; from
// bounds on these follows one on the determinant. A box that this does not prove is halved. "Holds"
// is always true to its word; a cell whose least determinant is above the limit by very little may
// be refused.
#ifndef BrainShift_JacobianBound_h
#define BrainShift_JacobianBound_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace brainshift
{
// What the columns of a matrix can be over a box: middle + slope * position + rest, where positions
// go from -0.5 to 0.5 along each axis and each number of the rest is at most as large as here.
struct ColumnBounds
{
  glm::vec3 middle[3];
  glm::mat3 slope[3];
  glm::vec3 rest[3];
};

// The determinant is nowhere in the box below this.
VTKBRAINSHIFTFILTERS_EXPORT float leastDeterminant(const ColumnBounds& columns);

// Displacements (lattice cells) of the 64 control points around a lattice cell, each component by
// itself: control point (i, j, k) of the 4 x 4 x 4 has index i + 4 j + 16 k.
struct CellTaps
{
  std::array<float, 64> component[3];
};

// Makes the displacement constant along an axis, as it is on the cell's lower (side 0) or upper
// (side 1) face: what holds beyond that face if it is the lattice's border.
VTKBRAINSHIFTFILTERS_EXPORT void holdFace(CellTaps& taps, int kernel, int axis, int side);

// Bounds on the cubic's columns over the whole cell, without slopes: so they hold for columns from
// three different places too, and with them for what is trilinear between nodes of the cell, whose
// columns are means of the cubic's.
VTKBRAINSHIFTFILTERS_EXPORT ColumnBounds boundsOf(const CellTaps& taps, int kernel);

// What a mask does to a cell: range of its weights, and of their slope along each axis, a lattice
// cell.
struct WeightRange
{
  float least = 1.0f;
  float greatest = 1.0f;
  glm::vec3 leastSlope{ 0.0f };
  glm::vec3 greatestSlope{ 0.0f };
};

// Bounds on the columns of what is trilinear between nodes of the cell, each times its weight.
VTKBRAINSHIFTFILTERS_EXPORT ColumnBounds maskedBoundsOf(
  const CellTaps& taps, int kernel, const WeightRange& weights);

// The determinant of the cubic is at or above the limit everywhere in the cell.
VTKBRAINSHIFTFILTERS_EXPORT bool cubicHolds(const CellTaps& taps, int kernel, float limit);

// The same for a displacement (lattice cells) that is trilinear between the 8 corners of a box with
// `perCell` such boxes a lattice cell; corner i lies at (i & 1, i >> 1 & 1, i >> 2).
VTKBRAINSHIFTFILTERS_EXPORT bool trilinearHolds(
  const std::array<glm::vec3, 8>& corners, int perCell, float limit);
}

#endif
