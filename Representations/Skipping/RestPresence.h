// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which bricks of the rest volume can be seen with the present colour map.
///
/// This is the presence map of the paper (section 2), as the rest-frame half of exact skipping.
#ifndef BrainShift_RestPresence_h
#define BrainShift_RestPresence_h

#include "Common/Parallel.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include "vtkType.h" // for vtkIdType

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace brainshift
{
constexpr int RestBrickSide = 2; ///< Voxels, in the rest volume.
constexpr int BrickSide = 4; ///< Voxels, in the deformed frame. 8 occupies more, 2 has more faces.

/// Bricks of both frames include a margin of so many voxels around them. A visible sample near a
/// face so makes the brick beyond that face occupied, too: the rasteriser and brick numbers may
/// round.
constexpr float BrickMargin = 1.0f / 8.0f;

/// The least and the greatest value that interpolation can find within each brick.
struct BrickRanges
{
  glm::ivec3 count{ 0 };         ///< Bricks a side.
  std::vector<glm::vec2> ranges; ///< x: least, y: greatest; least > greatest: no number.

  /// Least and greatest value of all bricks; least > greatest: no number in any.
  VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::vec2 whole() const;
};

///@{
/// The range of each brick: of all that interpolation finds within it and BrickMargin around it.
/// NaN is left out: it is never visible. `values`: dimensions.x * y * z numbers, x fastest, which
/// are multiplied by `scale`, above 0.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT BrickRanges brickRanges(
  const float* values, const glm::ivec3& dimensions, float scale = 1.0f);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT BrickRanges brickRanges(
  const std::uint16_t* values, const glm::ivec3& dimensions, float scale = 1.0f);
///@}

/// How much values usually differ within a brick: of all bricks in which they differ, 99 in a
/// hundred stay below. 0 if no values differ. So a few outliers, like metal in a CT, do not count.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT float usualDifference(const BrickRanges& bricks);

/// Which values a colour map makes visible.
struct VisibleValues
{
  int entries = 0;             ///< Colours of the map.
  std::vector<int> before;     ///< Visible entries with lower indices: entries + 1 numbers.
  double entryFromValue = 1.0; ///< entry = value * entryFromValue + entryOfValueZero
  double entryOfValueZero = 0.0;

  /// Least and greatest value that can be visible, with two more entries on either side for
  /// rounding. Least above greatest if no value can be visible.
  VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::vec2 ends() const;

  /// Whether a value in the range can be visible: whether any entry is that the texture may answer
  /// with, or one more entry on either side, for rounding.
  bool operator()(const glm::vec2& range) const
  {
    const double last = this->entries - 1.0;
    const double low = range.x * this->entryFromValue + this->entryOfValueZero;
    const double high = range.y * this->entryFromValue + this->entryOfValueZero;
    // Clamped, then cut to whole numbers: floor and ceil are calls on processors before SSE 4.1.
    const int from = static_cast<int>(std::min(std::max(low - 1.0, 0.0), last));
    const int to =
      this->entries - 1 - static_cast<int>(std::min(std::max(last - 1.0 - high, 0.0), last));
    return this->before[to + 1] > this->before[from];
  }
};

/// Sums of bricks count up to this and then from 0 again. Single precision is exact for eight of
/// them. The difference that eight sums give is the number of bricks in a box, but for a multiple.
/// A box of so many bricks counts as visible. presence.frag.glsl holds the number, too.
constexpr float SumModulus = 2097152.0f; // 2^21

/// Replaces 1 for each visible brick, in the order of summedVisibility, by sums below SumModulus.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT void sumUp(std::vector<float>& counts, const glm::ivec3& size);

/// Number of visible bricks with lower indices on all axes, less multiples of SumModulus: (count +
/// 1)^3 numbers, x fastest. Eight of them tell whether any brick in a box is visible (summed-area
/// tables: Crow, SIGGRAPH 1984; here in three dimensions). `visible`, called on many threads,
/// returns whether a range is visible.
template <typename Visible>
std::vector<float> summedVisibility(const BrickRanges& bricks, const Visible& visible)
{
  const glm::ivec3 size = bricks.count + 1;
  std::vector<float> counts(static_cast<std::size_t>(size.x) * size.y * size.z, 0.0f);
  const vtkIdType rows = static_cast<vtkIdType>(bricks.count.y) * bricks.count.z;
  parallelFor(0, rows, 64, [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType row = first; row < last; ++row)
    {
      const vtkIdType j = row % bricks.count.y + 1;
      const vtkIdType k = row / bricks.count.y + 1;
      const glm::vec2* range = &bricks.ranges[row * bricks.count.x];
      float* out = &counts[(k * size.y + j) * size.x + 1];
      for (int i = 0; i < bricks.count.x; ++i)
      {
        out[i] = range[i].x <= range[i].y && visible(range[i]) ? 1.0f : 0.0f;
      }
    }
  });
  sumUp(counts, size);
  return counts;
}
}

#endif
