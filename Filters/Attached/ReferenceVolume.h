// SPDX-License-Identifier: BSD-3-Clause
// The contract between Compare Volumes and what draws comparisons: a volume carries another one,
// the reference, as field data. The reference has a grid of its own and is not bent.
//
//   ReferenceVoxels  any type x 1, nx*ny*nz tuples, x fastest: the reference's point scalars
//   ReferenceGrid    see GridArray.h
//   ReferenceShow    int: 0 both volumes are shown, 1 the deformed one alone, 2 the reference alone
//   CavityVoxels     unsigned char x 1, only with a cavity: 1 where the reference lacks tissue that
//                    was removed, else 0; beyond the boxes around all voxels there is none.
//                    Numbers take the nearest voxel's, pictures draw the edge where interpolation
//                    passes a half
//   CavityGrid       see GridArray.h; in the world, moved as the reference is
//
// Colours and numbers that compare ignore what lies in the cavity.
#ifndef BrainShift_ReferenceVolume_h
#define BrainShift_ReferenceVolume_h

#include "Filters/Deformation/Grid.h"
#include "Filters/Deformation/MaskWeights.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

class vtkDataObject;

namespace brainshift
{
// Which of the two is shown.
enum class ReferenceShow
{
  Both,
  Deformed,
  Reference,
};

// Voxels of a grid of their own, in the world.
struct PlacedVoxels
{
  vtkDataArray* voxels = nullptr; // null: none
  Grid grid;
};

struct ReferenceVolume : PlacedVoxels
{
  PlacedVoxels cavity; // 1 or 0
  ReferenceShow show = ReferenceShow::Both;
};

// The numbers of an array under the name that attachReference wants; shared, not copied.
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> asReferenceVoxels(vtkDataArray* scalars);

// The voxels inside a mask under the name that attachReference wants.
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> asCavityVoxels(const Mask& mask);

// Attaches a reference, whose voxels asReferenceVoxels and asCavityVoxels made.
VTKBRAINSHIFTFILTERS_EXPORT void attachReference(
  vtkDataObject* volume, const ReferenceVolume& reference);

// Reads what attachReference wrote; no voxels, of the reference or of the cavity, if there are none
// or they do not fit their grid. A cavity goes with a reference only.
VTKBRAINSHIFTFILTERS_EXPORT ReferenceVolume readReference(vtkDataObject* volume);

// How a reference is moved: turned about `middle` (degrees about x, then y, then z), then moved.
struct RigidMotion
{
  glm::dvec3 middle{ 0.0 }; // mm, world
  glm::dvec3 rotation{ 0.0 };
  glm::dvec3 translation{ 0.0 }; // mm, world
};

VTKBRAINSHIFTFILTERS_EXPORT glm::dvec3 middleOf(const Grid& grid);
VTKBRAINSHIFTFILTERS_EXPORT Grid movedRigidly(const Grid& grid, const RigidMotion& motion);
}

#endif
