// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which part of a bent volume each of several MPI ranks draws, and which voxels it needs for that.
///
/// The deformed frame is cut into boxes, one for each rank. Boxes have an order in depth from any
/// eye; bent blocks of the rest frame have none.
#ifndef BrainShift_RankParts_h
#define BrainShift_RankParts_h

#include "Common/ImageParts.h"
#include "Common/RankAgreement.h"
#include "Common/SharedVolume.h"
#include "Filters/Attached/RestExtent.h"
#include "Representations/Scene/SceneGeometry.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <optional>
#include <vector>

namespace brainshift
{
/// What one rank draws of the deformed frame.
struct DrawnPart
{
  Box bounds{};      ///< mm
  Box cut{};         ///< mm: between these sides, see withoutOuterSides.
  WholeVolume whole; ///< of which the rank has a part
  Box tissue{};      ///< mm: where the tissue of all ranks can be
  WholeRanges ranges;

  bool operator==(const DrawnPart& o) const
  {
    return this->bounds == o.bounds && this->cut == o.cut && this->whole.grid == o.whole.grid &&
      this->whole.extent == o.whole.extent && this->tissue == o.tissue && this->ranges == o.ranges;
  }
};

/// The range of a volume's drawn values: of the whole volume, also if `image` is a part of it.
/// `component`: -1 for the magnitude.
glm::dvec2 rangeOf(const std::optional<DrawnPart>& part, vtkImageData* image,
  const DrawnValues& values, int component);

/// The whole volume whose `values` are of a part: its grid and layout, without voxels.
DrawnValues wholeValues(const DrawnPart& part, const DrawnValues& values);

/// How many visible voxels are in each cell of a box, which has CellsASide of them a side.
struct VTKBRAINSHIFTREPRESENTATIONS_EXPORT TissueCounts
{
  static constexpr int CellsASide = 16;

  Box box{}; ///< mm
  std::vector<long long> cells = std::vector<long long>(CellsASide * CellsASide * CellsASide, 0);

  /// Counts voxels at a place (mm), or beside the nearest cell if it is outside.
  void add(const glm::dvec3& place, long long voxels);

  /// The work in a part of the box: half its fraction of the visible voxels, half its fraction of
  /// the space. So no part is larger than two of equal parts, whatever is visible.
  double workIn(const Box& part) const;
};

/**
 * Cuts a box into one for each rank. Each cut goes across the longest side, and divides it as it
 * divides the ranks; with counts, it divides the work so. Of sides alike in length the last one is
 * cut, as ParaView cuts a volume for its pipeline.
 */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<Box> rankParts(
  const Box& whole, int ranks, const TissueCounts* counts = nullptr);

/**
 * The former parts, or, if the work in one of them is more than half above the mean, new ones:
 * equal parts if the work in them is near enough to the mean, else balanced ones.
 *
 * @param parts    the former parts, may be empty; sides that were sides of the whole follow it
 * @param former   the whole that these are parts of
 * @param keeps    the former parts are kept, whatever their work, as far as they fit
 */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<Box> balancedParts(const std::vector<Box>& parts,
  const Box& former, int ranks, const TissueCounts& counts, bool keeps = false);

/**
 * The same parts, in an order that gives each rank much of what it holds: then it lacks few voxels.
 * Parts in such an order stay where they are.
 *
 * @param parts  one for each rank
 * @param held   mm, the voxels that each rank has from its pipeline
 */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<Box> nearestParts(
  const std::vector<Box>& parts, const std::vector<Box>& held);

/** A part without those of its sides that are sides of the whole: they are far outside. Rays go to
 * their ends there. */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Box withoutOuterSides(const Box& part, const Box& whole);

/** The smallest box that holds two. */
Box around(const Box& a, const Box& b);

/** The box (mm, world axes) of a grid's points. */
Box boxAround(const Grid& grid);

/** What two boxes have in common; if they have nothing, the side of `a` that is nearer. */
Box commonBox(const Box& a, const Box& b);

/** A box with so much more (mm) at each side. */
Box widened(const Box& box, double mm);

/** restExtent of a box (mm, world axes). */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Extent restExtent(
  const WholeVolume& volume, const Lattice* lattice, const Box& part, double haloMm);

/** Makes an extent that of a box and the halo around it, unless it still has what the box needs.
 * What a large stroke asked for is given back after it was undone. */
void followBox(Extent& wanted, const WholeVolume& volume, const Lattice* lattice, const Box& part,
  double haloMm);
}

#endif
