// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The contract between Compare Volumes and what draws comparisons: a volume carries another
/// volume, the reference, as field data. The reference has its own grid and is not bent.
///
///    ReferenceVoxels  any type x 1, nx*ny*nz tuples, x fastest: the reference's point scalars
///    ReferenceGrid    see attachGrid in CarriedArray.h
///    ReferenceShow    int: 0 both volumes are shown, 1 only the deformed one, 2 only the reference
///    CavityVoxels     unsigned char x 1, only with a cavity: 1 where the reference lacks tissue
///                     that was removed, else 0. Beyond the boxes around all voxels there is no
///                     cavity. Numbers take the nearest voxel. Pictures draw the edge where the
///                     interpolated value is one half.
///    CavityGrid       see attachGrid in CarriedArray.h; in the world, moved with the
///                     reference
///
/// Colours and numbers that compare the volumes ignore the cavity.
#ifndef BrainShift_ReferenceVolume_h
#define BrainShift_ReferenceVolume_h

#include "Filters/Deformation/MaskWeights.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

class vtkDataObject;

namespace brainshift
{
/** Which of the two volumes is shown. */
enum class ReferenceShow
{
  Both,
  Deformed,
  Reference,
};

/** Voxels and where they lie in the world. */
struct PlacedVoxels
{
  vtkDataArray* voxels = nullptr; ///< null: none; not owned
  Grid grid;
};

/** What the arrays hold. */
struct ReferenceVolume : PlacedVoxels
{
  PlacedVoxels cavity; ///< 1 or 0; no voxels without a cavity
  ReferenceShow show = ReferenceShow::Both;
};

/** An array over the same numbers, under the name that attachReference needs. */
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> asReferenceVoxels(vtkDataArray* scalars);

/** The voxels of a mask as an array, under the name that attachReference needs. */
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> asCavityVoxels(const Mask& mask);

/** Attaches a reference whose voxels asReferenceVoxels and asCavityVoxels made. */
VTKBRAINSHIFTFILTERS_EXPORT void attachReference(
  vtkDataObject* volume, const ReferenceVolume& reference);

/**
 * Reads what attachReference wrote. Voxels that are missing or do not fit their grid are null.
 * Without a reference there is no cavity.
 */
VTKBRAINSHIFTFILTERS_EXPORT ReferenceVolume readReference(vtkDataObject* volume);

/** How a reference is moved: first turned about `middle`, then shifted. */
struct RigidMotion
{
  glm::dvec3 middle{ 0.0 };      ///< mm, world
  glm::dvec3 rotation{ 0.0 };    ///< degrees about x, then y, then z
  glm::dvec3 translation{ 0.0 }; ///< mm, world axes
};

/** The middle of a grid's box (mm, world). */
VTKBRAINSHIFTFILTERS_EXPORT glm::dvec3 middleOf(const Grid& grid);

/** The grid after the motion. */
VTKBRAINSHIFTFILTERS_EXPORT Grid movedRigidly(const Grid& grid, const RigidMotion& motion);

/**
 * The motion about the same middle that does what `motion` does and then turns by `turn` about the
 * world's origin and shifts by `shift` (mm).
 */
VTKBRAINSHIFTFILTERS_EXPORT RigidMotion followedBy(
  const RigidMotion& motion, const glm::dmat3& turn, const glm::dvec3& shift);
}

#endif
