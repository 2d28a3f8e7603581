// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the pixels of a picture at which tissue can be seen.
#ifndef BrainShift_SeenPixels_h
#define BrainShift_SeenPixels_h

#include "Representations/Scene/RayCastScene.h"

namespace brainshift
{
/// Fills in the box of pixels at which the occupied bricks of the scene and of its reference can be
/// seen: all pixels if a brick lies partly behind the eye. Rays stop skipping where pixels are so
/// large that the rasteriser's rounding would come near BrickMargin: then the picture is tiny.
void placeSeenPixels(RayCastScene& scene);

/// A box in texture coordinates.
struct TextureBox
{
  glm::dvec3 low{ 0.0 };
  glm::dvec3 high{ 0.0 };
};

/// The pixels at which all is seen that lies between positions (lattice coordinates) within
/// `space`: all pixels if a position lies behind the eye.
PixelPart pixelsBetween(
  const std::vector<glm::vec3>& positions, const TextureBox& space, const RayCastScene& scene);
}

#endif
