// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Chooses points of the cortex that hold it where the skull is closed.
///
/// Without them the cortex elsewhere follows what was measured under the opening.
#ifndef BrainShift_Anchors_h
#define BrainShift_Anchors_h

#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/** Where the skull was opened: a ball. Without a radius it is closed. */
struct OpeningBall
{
  glm::dvec3 centre{ 0.0 }; ///< mm, rest frame
  double radiusMm = -1.0;   ///< below 0: there is no opening
};

/** Distance (mm) from the opening beyond which the cortex is assumed to stay. */
constexpr double AnchorMarginMm = 15.0;

/** About how many anchors hold the cortex. */
constexpr std::size_t AnchorsWanted = 250;

/** The ball around the mean of positions that holds all of them; closed if there are none. */
BRAINSHIFT_DEFORMATION_EXPORT OpeningBall ballAround(const std::vector<glm::dvec3>& positions);

/** The ball around the tissue at rest that was traced and pulled, as the base knows it. */
BRAINSHIFT_DEFORMATION_EXPORT OpeningBall openingOf(const Measurements& measured);

/** One point for each cell of a grid with this edge (mm): the one nearest to the cell's middle. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<SurfacePoint> thinnedPoints(
  const std::vector<SurfacePoint>& surface, double cellMm);

/**
 * Chooses anchors that are spread evenly: of the points in each cell of a grid the one nearest to
 * its middle. Beside the opening, where displacements fall to 0, they are at most about 8 mm apart:
 * cells as large as elsewhere would leave a gap there, and the cortex in it would follow.
 *
 * @param surface    points of the cortex with normals
 * @param isOpen     whether a position (mm, rest frame) is too near to the opening
 * @param wanted     about how many to choose, above 0
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<SurfacePoint> chooseAnchors(
  const std::vector<SurfacePoint>& surface, const std::function<bool(const glm::dvec3&)>& isOpen,
  std::size_t wanted = AnchorsWanted);
}

#endif
