// SPDX-License-Identifier: BSD-3-Clause
// The volume that a drawn one is compared with, as the data carries it (Filters/Attached/ReferenceVolume.h).
#ifndef BrainShift_SceneReference_h
#define BrainShift_SceneReference_h

#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Tissue/Tissue.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <cstdint>

class vtkDataArray;
class vtkDataObject;

namespace brainshift
{
struct SceneReference
{
  Grid grid;
  TissueRequest tissue; // without scalars: none
  PlacedVoxels cavity;  // what colours ignore
  ReferenceShow show = ReferenceShow::Both;

  bool exists() const { return this->tissue.scalars != nullptr; }
  bool isAlone() const { return this->exists() && this->show == ReferenceShow::Reference; }
};

// The reference that a volume carries, drawn as `own` is. `range`: the reference's scalars at the
// ends of the volume's colour map; where they are no range, usualMapping tells.
SceneReference referenceOf(
  vtkDataObject* volume, const TissueRequest& own, const glm::dvec2& range);

// Value of the volume that a scalar of its reference stands for, in 3D and in slices: colours and
// opacities are the volume's. `range`: as above.
StoredScalar valueFromReference(
  vtkDataArray* reference, const TissueRequest& own, const glm::dvec2& range);

// The same where no range is given: by the least and the greatest of both: the same
// where the ranges have at least half in common, else from one range to the other.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT StoredScalar usualMapping(
  const glm::dvec2& reference, const glm::dvec2& volume);

// Widens bounds (mm) by the box of the reference that a volume carries, if any.
void widenByReference(vtkDataObject* volume, double bounds[6]);

// Bytes of its voxels, gradients and cavity on the GPU of the current context.
std::int64_t referenceBytes(const SceneReference& reference);
}

#endif
