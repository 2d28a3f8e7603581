// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The volume that a drawn one is compared with, as the data carries it
/// (Filters/Attached/ReferenceVolume.h).
#ifndef BrainShift_SceneReference_h
#define BrainShift_SceneReference_h

#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Tissue/TissueTextures.h"

class vtkDataObject;

namespace brainshift
{
/// A reference, and how it is drawn.
struct SceneReference
{
  TissueRequest tissue;  ///< Without scalars there is no reference.
  glm::ivec3 first{ 0 }; ///< Of the whole reference's points, that the tissue begins with.
  PlacedVoxels cavity;   ///< What the colours ignore.
  ReferenceShow show = ReferenceShow::Both;
  double agreementMm = 1.0; ///< Surfaces half as far apart count as one.
  ColorPair colors;         ///< Of the volume and of the reference.

  bool exists() const { return this->tissue.values.scalars != nullptr; }
  bool isAlone() const { return this->exists() && this->show == ReferenceShow::Reference; }
};

/// The reference that a volume carries, drawn as `own`, the volume itself, is. `range`: the scalars
/// of the reference at the ends of the volume's colour map; usualMapping decides if x >= y.
SceneReference referenceOf(
  vtkDataObject* volume, const TissueRequest& own, const glm::dvec2& range);

/// The value of the volume that a scalar of its reference stands for, in 3D and in slices: colours
/// and opacities are those of the volume. `range`: see referenceOf.
StoredScalar valueFromReference(
  const ReferenceVolume& reference, const TissueRequest& own, const glm::dvec2& range);

/// The mapping from the least and the greatest scalar of both, if no range is given. Scalars keep
/// their numbers if the ranges have at least half in common; else one range maps to the other.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT StoredScalar usualMapping(
  const glm::dvec2& reference, const glm::dvec2& volume);

/// Widens bounds (mm) by the box of the reference that a volume carries, if any.
void widenByReference(vtkDataObject* volume, double bounds[6]);

/// Bytes of the reference's voxels, gradients and cavity on the GPU of the current context.
std::int64_t referenceBytes(const SceneReference& reference);
}

#endif
