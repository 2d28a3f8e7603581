// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From an affine that places voxels in RAS mm to a grid along the nearest RAS axes.
///
/// World is RAS: x to the patient's right, y to the front, z to the head, in mm. All volumes take
/// this road, whatever their file.
#ifndef BrainShift_RasGrid_h
#define BrainShift_RasGrid_h

#include "Common/Grid.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <string>
#include <vector>

namespace brainshift
{
/**
 * A cosine between two axes above this is reported as shear. Axes of a rotation are perpendicular:
 * headers in float32 stay below 1e-6. A cosine of 1e-4 moves no voxel of a head by more than
 * 0.03 mm.
 */
constexpr double LargestUnreportedShear = 1e-4;

/** Throws a part of a sentence if an affine cannot place voxels: not finite, singular. */
VTKBRAINSHIFTFORMATS_EXPORT void requireAffine(const glm::dmat4& worldFromVoxel);

/**
 * Warns of a file whose directions of axes, each of which should have the length 1, scale its
 * spacing by more than a thousandth.
 *
 * @param lengths    of the directions of the three axes
 * @param warnings   parts of sentences; gets one more
 */
VTKBRAINSHIFTFORMATS_EXPORT void warnOfScaledAxes(
  const glm::dvec3& lengths, std::vector<std::string>& warnings);

/** Voxels that are permuted and flipped so that each grid axis runs along the nearest RAS axis. */
struct RasGrid
{
  Grid grid; ///< mm, RAS; its direction is the rotation that is left, often the identity
  std::array<int, 3> voxelAxis{ 0, 1, 2 }; ///< the file's axis that runs along each grid axis
  std::array<bool, 3> reversed{};          ///< whether that axis runs the other way
  double shear = 0.0;                      ///< largest cosine between two of the file's axes
  double largestErrorMm = 0.0;             ///< farthest distance of a corner from its true place
};

/**
 * The grid of an affine. Nothing is lost unless the affine is sheared. Then the grid keeps spacing
 * and centre and takes the nearest rotation.
 *
 * @param worldFromVoxel   an affine that passes requireAffine
 * @param dimensions       voxels along each axis, in the file's order
 */
VTKBRAINSHIFTFORMATS_EXPORT RasGrid nearestRasGrid(
  const glm::dmat4& worldFromVoxel, const glm::ivec3& dimensions);
}

#endif
