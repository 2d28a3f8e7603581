// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Sets the uniforms of the ray caster's programs (Shaders/Rays), all of them.
 */
#ifndef BrainShift_RayCastUniforms_h
#define BrainShift_RayCastUniforms_h

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/RayCastScene.h"

class vtkTextureObject;

namespace brainshift
{
/// Sets every uniform of the scene's variant. `area`: what the images hold of the picture. `spans`:
/// the share of each ray before and behind the occupied bricks.
void setRayCastUniforms(
  Program& program, const RayCastScene& scene, const ImageArea& area, vtkTextureObject* spans);

/// Lets go of the texture units that setRayCastUniforms took.
void deactivateTextures(const RayCastScene& scene);
}

#endif
