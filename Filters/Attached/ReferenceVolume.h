// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The contract between Compare Volumes and what draws comparisons: a volume carries another
/// volume, the reference, as field data. The reference has its own grid and is not bent.
///
///    ReferenceVoxels  any type x 1, nx*ny*nz tuples, x fastest: the reference's point scalars
///    ReferenceGrid    see attachGrid in CarriedArray.h
///    ReferenceShow    int: 0 both volumes are shown, 1 only the deformed one, 2 only the reference
///    ReferenceIsLabels  int, 1: only if the reference's values are labels, which are never blended
///    CavityVoxels     unsigned char x 1, only with a cavity: 1 where the reference lacks tissue
///                     that was removed, else 0. Beyond the boxes around all voxels there is no
///                     cavity. Numbers take the nearest voxel. Pictures draw the edge where the
///                     interpolated value is one half.
///    CavityGrid       see attachGrid in CarriedArray.h; in the world, moved with the
///                     reference
///    ReferenceWhole   8 doubles, only if one of several MPI ranks has a part of the reference:
///                     points of the whole along x, y and z, which of them the first point of the
///                     part is, and the whole's least and greatest finite value
///
/// Colours and numbers that compare the volumes ignore the cavity.
#ifndef BrainShift_ReferenceVolume_h
#define BrainShift_ReferenceVolume_h

#include "Filters/Deformation/MaskWeights.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <optional>

class vtkDataObject;
class vtkFieldData;

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

/** Attaches voxels, which have the name that they are found by, and their grid under a name. */
void attachPlaced(vtkFieldData* fields, const PlacedVoxels& placed, const char* gridName);

/** Reads what attachPlaced wrote. Voxels that are missing or do not fit their grid are null. */
PlacedVoxels readPlaced(vtkFieldData* fields, const char* name, const char* gridName);

/** The reference of which voxels are a part. */
struct WholeReference
{
  glm::ivec3 points{ 0 };       ///< along each axis
  glm::ivec3 first{ 0 };        ///< of them, that the part begins with
  glm::dvec2 range{ 0.0, 0.0 }; ///< least and greatest finite value
};

/** What the arrays hold. */
struct ReferenceVolume : PlacedVoxels
{
  PlacedVoxels cavity; ///< 1 or 0; no voxels without a cavity
  ReferenceShow show = ReferenceShow::Both;
  bool isLabels = false;               ///< values are never blended
  std::optional<WholeReference> whole; ///< only if the voxels are a part
};

/** Name of the reference's voxels as attachReference needs them. */
constexpr const char* ReferenceVoxelsName = "ReferenceVoxels";

/** The voxels of a mask as an array, under the name that attachReference needs. */
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> asCavityVoxels(const Mask& mask);

/**
 * Attaches a reference whose voxels have the name ReferenceVoxelsName, with a cavity that
 * asCavityVoxels made.
 */
VTKBRAINSHIFTFILTERS_EXPORT void attachReference(
  vtkDataObject* volume, const ReferenceVolume& reference);

/**
 * Reads what attachReference wrote. Voxels that are missing or do not fit their grid are null.
 * Without a reference there is no cavity.
 */
VTKBRAINSHIFTFILTERS_EXPORT ReferenceVolume readReference(vtkDataObject* volume);

/** What a reference with voxels is a part of: itself, unless it says otherwise. */
VTKBRAINSHIFTFILTERS_EXPORT WholeReference wholeOf(const ReferenceVolume& reference);

/** Removes what attachReference wrote. */
void removeReference(vtkDataObject* volume);

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
