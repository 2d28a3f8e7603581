// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the views show together of a bent volume and its reference.
#ifndef BrainShift_SharedCrosshair_h
#define BrainShift_SharedCrosshair_h

#include <glm/vec3.hpp>

class pqPipelineSource;

namespace brainshift
{
/// Brings the slices of all views to a position (mm) where a Free-Form Deformation is drawn: those
/// of it, those of its volume as loaded to the same tissue, those of others to the position.
void bringCrosshairTo(pqPipelineSource* deformation, const glm::dvec3& drawn);

/// Whether a view shows a reference: a comparison of the Free-Form Deformation, or another volume.
bool isReferenceShown(pqPipelineSource* deformation);
}

#endif
