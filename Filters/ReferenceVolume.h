// SPDX-License-Identifier: BSD-3-Clause
// The contract between Compare Volumes and what draws comparisons: a volume carries another one,
// the reference, as field data. The reference has a grid of its own and is not bent.
//
//   ReferenceVoxels  any type x 1, nx*ny*nz tuples, x fastest: the reference's point scalars
//   ReferenceGrid    see GridArray.h
#ifndef BrainShift_ReferenceVolume_h
#define BrainShift_ReferenceVolume_h

#include "Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

class vtkDataObject;

namespace brainshift
{
struct ReferenceVolume
{
  vtkDataArray* voxels = nullptr; // null: none
  Grid grid;
};

// The numbers of an array under the name that attachReference wants; shared, not copied.
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> asReferenceVoxels(vtkDataArray* scalars);

// Attaches a reference, whose voxels asReferenceVoxels made.
VTKBRAINSHIFTFILTERS_EXPORT void attachReference(
  vtkDataObject* volume, const ReferenceVolume& reference);

// Reads what attachReference wrote; no voxels if there are none or they do not fit the grid.
VTKBRAINSHIFTFILTERS_EXPORT ReferenceVolume readReference(vtkDataObject* volume);

// A grid turned about the middle of its box (degrees about x, then y, then z), then moved (mm).
VTKBRAINSHIFTFILTERS_EXPORT Grid movedRigidly(
  const Grid& grid, const glm::dvec3& rotation, const glm::dvec3& translation);
}

#endif
