// SPDX-License-Identifier: BSD-3-Clause
// Reads an array of voxels through an offset field: the CPU's way of drawing a bent volume.
#ifndef BrainShift_Resample_h
#define BrainShift_Resample_h

#include "Filters/Deformation/Grid.h"
#include "Filters/Deformation/OffsetField.h"

#include <functional>

class vtkDataArray;

namespace brainshift
{
// Which voxels to write and how they lie to the lattice.
struct ResampleGeometry
{
  glm::ivec3 dimensions{ 0 }; // of the whole source array, values a side
  glm::ivec3 first{ 0 };      // region to write, in source indices, inclusive
  glm::ivec3 last{ 0 };
  glm::dvec3 latticeFromIndex{ 1.0 }; // lattice = index * latticeFromIndex + latticeOfFirst
  glm::dvec3 latticeOfFirst{ 0.0 };
};

// How voxels are read; values as vtkBakeDeformation's.
enum class Reading
{
  Nearest = 0,
  Linear = 1,
  Cubic = 2,
};

// Fills `target` (allocated: the region's tuples, x fastest, same type and components as `source`)
// with the source read at restFromDeformed of each voxel. Outside the source: its lowest value.
// `proceed` is told the share done, 0 to 1, and says whether to go on.
void resample(vtkDataArray* source, vtkDataArray* target, const ResampleGeometry& geometry,
  const NodeField& offsets, Reading reading, const std::function<bool(double)>& proceed);
}

#endif
