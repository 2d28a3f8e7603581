// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Measured points and masks as data sets hold them.
 */
#ifndef BrainShift_MeasuredPoints_h
#define BrainShift_MeasuredPoints_h

#include "Filters/Deformation/MaskWeights.h"
#include "Filters/Fit/Measurements.h"

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkSmartPointer.h"            // for what a function returns

#include <glm/ext/vector_int3.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkInformation;
class vtkPointSet;

namespace brainshift
{
/** Positions (mm, world) of all points; none without points. */
std::vector<glm::dvec3> positionsOf(vtkPointSet* points);

/** Pairs of landmarks, and what they are called. */
struct NamedPairs
{
  std::vector<PointPair> pairs;
  std::vector<std::string> names; ///< as many as pairs
  std::string unmatched;          ///< those without a partner, with commas between; at most ten
};

/**
 * The pairs of landmarks at rest and measured. They match by the point array Label, else by order;
 * the point array Weight of those at rest gives weights. Both may be null. A pair is called by its
 * label at rest, or by its number among those at rest, from 1 on.
 */
VTKBRAINSHIFTFILTERS_EXPORT NamedPairs landmarkPairs(vtkPointSet* rest, vtkPointSet* measured);

/**
 * Asks for the part of a point set that is this MPI rank's. Call it in RequestUpdateExtent. Most
 * sources of points know no parts: the first rank gets all, and keeps it for all who ask.
 *
 * @param points   pipeline information of an input; null does nothing
 */
void askForOwnPoints(vtkInformation* points);

/**
 * The points of all MPI ranks, in the order of the ranks, on each of them. If all ranks have the
 * same points, these are copies of each other and count once. All ranks must call it, or none.
 */
vtkSmartPointer<vtkPointSet> pointsOfAllRanks(vtkPointSet* own);

/** The space within a distance of a mask, beyond the mask's own image too. It takes no memory. */
class VTKBRAINSHIFTFILTERS_EXPORT NearMask
{
public:
  /** Keeps a reference to the mask. `byMm`: distance, 0 or more. */
  NearMask(const Mask& mask, double byMm);

  /** Whether the middle of a voxel that is inside lies within the distance of a position. */
  bool holds(const glm::dvec3& position) const;

private:
  const Mask& Voxels;
  double ByMm;
  glm::ivec3 First{ 0 };  // of the voxels that are inside
  glm::ivec3 Behind{ 0 }; // one more than the last of them; none are inside if both are equal
};
}

#endif
