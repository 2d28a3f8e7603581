// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads an array of voxels through a backward map: how the CPU makes a bent volume.
#ifndef BrainShift_Resample_h
#define BrainShift_Resample_h

#include "Filters/Deformation/PointMap.h"

#include <functional>

class vtkDataArray;

namespace brainshift
{
/** Which voxels to write, and their positions in the lattice. */
struct ResampleGeometry
{
  glm::ivec3 dimensions{ 0 }; ///< of the whole source array: values along each axis
  glm::ivec3 first{ 0 };      ///< region to write, in indices of the source
  glm::ivec3 last{ 0 };       ///< inclusive

  /** Lattice cells for each step of the index: lattice = index * this + latticeOfFirst. */
  glm::dvec3 latticeFromIndex{ 1.0 };

  glm::dvec3 latticeOfFirst{ 0.0 }; ///< lattice coordinates of the source's first value
};

/** The backward map of a lattice for many points: exact, and quick where nothing moves. */
struct BackwardMap
{
  /** `samples`: of the lattice's mask; without a mask any number. */
  BackwardMap(const Lattice& lattice, int samples, Inverse inverse);

  PointMap map;

  /** The offset field. In a cell whose eight nodes are zero, nothing moves. */
  NodeField firstGuess;
};

/** How voxels are read; the numbers of vtkBakeDeformation::InterpolationType. */
enum class Reading
{
  Nearest = 0,
  Linear = 1, ///< trilinear
  Cubic = 2,  ///< Catmull-Rom over 64 voxels
};

/** How arrays are resampled. */
struct Resampling
{
  ResampleGeometry geometry;
  const BackwardMap& backward;
  Reading reading;

  /** Called with the fraction that is done, 0 to 1. If it returns false, the rest is not done. */
  std::function<bool(double)> proceed;
};

/**
 * Fills an array with the source as it is seen at each voxel of the region, which is the source at
 * restFromDeformed of that voxel. Outside the source its lowest value holds.
 *
 * @param target   allocated: the region's tuples, x fastest, with the type and the components of
 *                 `source`
 */
void resample(vtkDataArray* source, vtkDataArray* target, const Resampling& how);
}

#endif
