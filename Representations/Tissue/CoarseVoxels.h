// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One number for several voxels, where a texture has no room for each of them.
#ifndef BrainShift_CoarseVoxels_h
#define BrainShift_CoarseVoxels_h

#include "Common/Parallel.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkType.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace brainshift
{
/// Calls write(texel, number) for each texel, x fastest, on many threads. The number is that of
/// `ofBlock`, which receives the numbers of the texel's voxels that are finite; NaN if there are
/// none. `voxel`: returns the number of a voxel, x fastest.
template <typename Voxel, typename OfBlock, typename Write>
void forTexels(
  const ValueLayout& layout, const Voxel& voxel, const OfBlock& ofBlock, const Write& write)
{
  const glm::ivec3& side = layout.dimensions;
  parallelFor(0, side.z, 1, [&](vtkIdType first, vtkIdType last) {
    std::vector<double> block;
    for (vtkIdType z = first; z < last; ++z)
    {
      for (int y = 0; y < side.y; ++y)
      {
        for (int x = 0; x < side.x; ++x)
        {
          const glm::ivec3 low = glm::ivec3(x, y, z) * layout.perTexel;
          const glm::ivec3 high = glm::min(low + layout.perTexel, layout.voxels);
          block.clear();
          for (vtkIdType k = low.z; k < high.z; ++k)
          {
            for (vtkIdType j = low.y; j < high.y; ++j)
            {
              const vtkIdType row = (k * layout.voxels.y + j) * layout.voxels.x;
              for (vtkIdType i = row + low.x; i < row + high.x; ++i)
              {
                const double number = voxel(i);
                if (std::isfinite(number))
                {
                  block.push_back(number);
                }
              }
            }
          }
          write((z * side.y + y) * side.x + x,
            block.empty() ? std::numeric_limits<double>::quiet_NaN() : ofBlock(block));
        }
      }
    }
  });
}

/// The mean of each texel's voxels.
template <typename Voxel, typename Write>
void averageVoxels(const ValueLayout& layout, const Voxel& voxel, const Write& write)
{
  const auto mean = [](const std::vector<double>& block) {
    double sum = 0.0;
    for (const double number : block)
    {
      sum += number;
    }
    return sum / static_cast<double>(block.size());
  };
  forTexels(layout, voxel, mean, write);
}

/// The number that most voxels of each texel have; of equals, the least.
template <typename Voxel, typename Write>
void mostFrequentVoxels(const ValueLayout& layout, const Voxel& voxel, const Write& write)
{
  const auto mostFrequent = [](std::vector<double>& block) {
    std::sort(block.begin(), block.end());
    double found = block.front();
    std::ptrdiff_t most = 0;
    for (auto run = block.begin(); run != block.end();)
    {
      const auto end = std::upper_bound(run, block.end(), *run);
      if (end - run > most)
      {
        most = end - run;
        found = *run;
      }
      run = end;
    }
    return found;
  };
  forTexels(layout, voxel, mostFrequent, write);
}
}

#endif
