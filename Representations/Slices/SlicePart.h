// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The part of the planes of Deformed Slices that one of several MPI ranks draws.
///
/// All ranks draw the same rectangles, in texture coordinates of the whole volume. So a pixel has
/// the same place and depth on each rank, to the bit, and exactly one rank draws it. Only voxels
/// are read in coordinates of the texture that a rank has.
#ifndef BrainShift_SlicePart_h
#define BrainShift_SlicePart_h

#include "Common/RankAgreement.h"
#include "Representations/Scene/ImageArea.h"
#include "Representations/Scene/SceneGeometry.h"

#include <vector>

namespace brainshift
{
class Program;
struct SliceQuad;

/// See above. Texture coordinates are those of the whole volume.
struct SlicePart
{
  std::vector<float> planes;     ///< As SceneCuts::partPlanes; empty: one process draws all of it.
  glm::dvec3 low{ 0.0 };         ///< A box around it, texture coordinates.
  glm::dvec3 high{ 1.0 };        ///< The opposite corner.
  glm::dvec3 wholeVoxels{ 1.0 }; ///< Of the whole volume, a side.
  glm::dvec3 heldFirst{ 0.0 };   ///< The first voxel that this rank has.
  glm::dvec3 heldVoxels{ 1.0 };  ///< Those that its texture stands for, a side.
};

/**
 * The part of the planes between the sides of a box.
 *
 * @param cut       mm, see DrawnPart
 * @param whole     the whole volume
 * @param held      what this rank has of it
 * @param overlaps  whether neighbours draw a little of it, too: where nothing is blended, that is
 *                  not seen, and no pixel is left out whatever drivers the ranks have
 */
VTKBRAINSHIFTREPRESENTATIONS_EXPORT SlicePart slicePartOf(
  const Box& cut, const DrawnValues& whole, const DrawnValues& held, bool overlaps);

/// The pixels in which the part of a rectangle can be. `viewport`: those of the picture.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelBox pixelsOf(const SliceQuad& quad, const SlicePart& part,
  const glm::dmat4& clipFromTexture, const PixelBox& viewport);

/// Sets the uniforms of Shaders/Slices/part.glsl. `nearest`: voxels are drawn as they are.
void setPartUniforms(Program& program, const SlicePart& part, bool nearest);
}

#endif
