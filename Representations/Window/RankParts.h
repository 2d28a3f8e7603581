// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which part of a bent volume each of several MPI ranks draws, and which voxels it needs for that.
///
/// The deformed frame is cut into boxes, one for each rank. Boxes have an order in depth from any
/// eye; bent blocks of the rest frame have none.
#ifndef BrainShift_RankParts_h
#define BrainShift_RankParts_h

#include "Common/Grid.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <array>
#include <map>
#include <string>
#include <vector>

namespace brainshift
{
struct Lattice;

/// Least and greatest x, y and z, mm, world axes.
using Box = std::array<double, 6>;

/// First and last point along x, y and z, as VTK counts them.
using Extent = std::array<int, 6>;

/// A volume of which ranks hold parts.
struct WholeVolume
{
  Grid grid; ///< Of all points; its origin is the first point of `extent`.
  Extent extent{ 0, -1, 0, -1, 0, -1 };
};

/// Least and greatest value of each component of the whole volume's arrays, and last of their
/// magnitude. By whether the array is of cells, and its name.
using WholeRanges = std::map<std::pair<bool, std::string>, std::vector<std::array<double, 2>>>;

/// What one rank draws of the deformed frame.
struct DrawnPart
{
  Box bounds{};   ///< mm
  Box cut{};      ///< mm: between these sides, see withoutOuterSides.
  Extent whole{}; ///< of the volume of which the rank has a part
  Box tissue{};   ///< mm: where the tissue of all ranks can be
  WholeRanges ranges;
};

/**
 * Cuts a box into one for each rank. Each cut goes across the longest side, and divides it as it
 * divides the ranks.
 */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<Box> rankParts(const Box& whole, int ranks);

/** A part without those of its sides that are sides of the whole: they are far outside. Rays go to
 * their ends there. */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Box withoutOuterSides(const Box& part, const Box& whole);

/** The smallest box that holds two. */
Box around(const Box& a, const Box& b);

/**
 * Where the tissue rests that can come into a part of the deformed frame: an extent within that of
 * the volume, of two points a side at least. It holds the neighbours that interpolation and
 * gradients read.
 *
 * @param lattice   the deformation; null: nothing moves
 * @param haloMm    is added to every side, mm
 */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Extent restExtent(
  const WholeVolume& volume, const Lattice* lattice, const Box& part, double haloMm);

/// Whether an extent holds all of another.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool holds(const Extent& extent, const Extent& other);
}

#endif
