// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads an array of voxels through a backward map: how the CPU makes a bent volume.
#ifndef BrainShift_Resample_h
#define BrainShift_Resample_h

#include "Filters/Deformation/FieldChange.h"
#include "Filters/Deformation/PointMap.h"

#include <functional>

class vtkDataArray;

namespace brainshift
{
/** Which voxels to read and to write, and their positions in the lattice. */
struct ResampleGeometry
{
  glm::ivec3 dimensions{ 0 }; ///< values of the whole volume along each axis
  IndexBox held;              ///< the source array, in indices of the whole
  IndexBox target;            ///< the target array
  IndexBox written;           ///< the region to write; both arrays have it

  /** Lattice cells for each step of the index: lattice = index * this + latticeOfFirst. */
  glm::dvec3 latticeFromIndex{ 1.0 };

  glm::dvec3 latticeOfFirst{ 0.0 }; ///< lattice coordinates of the whole's first value
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

/** What a region lacked. */
struct Lacking
{
  IndexBox voxels;      ///< what to hold so that none is missing; empty: none was
  bool outside = false; ///< whether tissue came from outside the volume
  bool stopped = false; ///< whether `proceed` said stop

  void add(const Lacking& other);
};

/**
 * The lowest finite value of each component of an array; infinity where there is none. Together
 * those of parts are those of the whole.
 */
std::vector<double> lowestOf(vtkDataArray* array);

/**
 * Fills a region of an array with the source as it is seen at each voxel, which is the source at
 * restFromDeformed of that voxel. The numbers of a part are those of the whole, bit for bit.
 *
 * @param target    allocated, with the type and the components of `source`
 * @param outside   for each component, what holds outside the volume: lowestOf the whole array
 */
Lacking resample(vtkDataArray* source, vtkDataArray* target, const std::vector<double>& outside,
  const Resampling& how);
}

#endif
