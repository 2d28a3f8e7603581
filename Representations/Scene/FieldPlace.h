// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Position of lattice and offset field in the volume's texture, and the space that tissue can
/// reach.
#ifndef BrainShift_FieldPlace_h
#define BrainShift_FieldPlace_h

#include "Representations/Scene/RayCastScene.h"
#include "Representations/Scene/SceneGeometry.h"

namespace brainshift
{
/// Texture units of one lattice cell: the unit that the offset field is wanted in.
glm::dvec3 textureFromLattice(const DrawnValues& values, const Grid& lattice);

/// Widens bounds (mm; x, y, z, least and greatest each) by the box of an offset field's nodes.
void widenByNodes(const Grid& lattice, const FieldNodes& nodes, double bounds[6]);

/// The field of a volume without a deformation: tissue stays in the volume's box.
SceneField restField(const ValueLayout& layout);

/// The field of a volume with a lattice: all but the texture of offsets and the hull of what moves.
SceneField bentField(const DrawnValues& values, const Grid& lattice, const FieldNodes& nodes);
}

#endif
