// SPDX-License-Identifier: BSD-3-Clause
// Which blocks of the rest volume can be seen with the present colour map: the paper's presence map
// (section 2), as the rest-frame half of exact skipping. See ARCHITECTURE.md, "Skipping".
#ifndef BrainShift_RestPresence_h
#define BrainShift_RestPresence_h

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace brainshift
{
constexpr int RestBrickSide = 2; // voxels, in the rest volume
constexpr int BrickSide = 4;     // voxels, in the deformed frame; 8 occupies more, 2 has more faces

// Bricks of both frames look at so many voxels around them, so that a visible sample near a face makes
// the brick beyond that face occupied too: the rasteriser and brick numbers may round.
constexpr float BrickMargin = 1.0f / 8.0f;

// The least and the greatest value that interpolation can find within each brick.
struct BrickRanges
{
  glm::ivec3 count{ 0 };
  std::vector<glm::vec2> ranges; // x: least, y: greatest; least > greatest: no number in it
};

// `values`: dimensions.x * y * z numbers, x fastest. A range is that of all voxels a trilinear
// filter reads for positions within the brick and BrickMargin around it. NaN is left out: it is never visible.
BrickRanges brickRanges(const float* values, const glm::ivec3& dimensions);
BrickRanges brickRanges(const std::uint16_t* values, const glm::ivec3& dimensions);

// Number of visible bricks with lower indices on all axes: (count + 1)^3 numbers, x fastest, so that
// eight of them tell how many lie in any box. `visible` says it of a range. Exact up to 2^24 bricks.
std::vector<float> summedVisibility(
  const BrickRanges& bricks, const std::function<bool(const glm::vec2&)>& visible);
}

#endif
