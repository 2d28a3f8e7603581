// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Clipping planes and cropping regions of a mapper, in texture coordinates.
 *
 * Both cut what is seen: they stay where they are when tissue moves.
 */
#ifndef BrainShift_SceneCuts_h
#define BrainShift_SceneCuts_h

#include "Representations/Scene/RayCastScene.h"
#include "Representations/Scene/SceneGeometry.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

class vtkPlane;
class vtkVolumeMapper;

namespace brainshift
{
/// Coefficients of a plane (mm, world) in texture coordinates.
glm::dvec4 texturePlane(vtkPlane* plane, const glm::dmat4& worldFromTexture);

/// How many clipping planes a mapper has.
int clipPlaneCount(vtkVolumeMapper* mapper);

/// Fills the scene's cuts for the volume that `mapper` draws.
SceneCuts cutsOf(vtkVolumeMapper* mapper, const DrawnValues& values, const SceneFrame& frame,
  const SceneField& field);

/// Fills the scene's cuts for a reference that is drawn in place of the mapper's volume. The
/// volume's cropping becomes clipping planes. `exact`: false if cropping keeps other regions than
/// the middle one, which planes cannot express: then it cuts nothing.
SceneCuts cutsOfReference(vtkVolumeMapper* mapper, const RayCastScene& reference,
  const DrawnValues& volume, const glm::dmat4& worldFromVolumeTexture, bool& exact);
}

#endif
