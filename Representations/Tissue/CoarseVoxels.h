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
/// The mean of numbers.
class MeanNumber
{
public:
  void clear() { *this = MeanNumber(); }

  void add(double number)
  {
    this->Sum += number;
    this->Count += 1;
  }

  /// NaN if there are none.
  double number() const { return this->Sum / this->Count; }

private:
  double Sum = 0.0;
  double Count = 0.0;
};

/// The number that comes most often; of equals, the least.
class MostFrequentNumber
{
public:
  void clear() { this->Numbers.clear(); }
  void add(double number) { this->Numbers.push_back(number); }

  /// NaN if there are none.
  double number()
  {
    std::sort(this->Numbers.begin(), this->Numbers.end());
    double found = std::numeric_limits<double>::quiet_NaN();
    std::ptrdiff_t most = 0;
    for (auto run = this->Numbers.begin(); run != this->Numbers.end();)
    {
      const auto end = std::upper_bound(run, this->Numbers.end(), *run);
      found = end - run > most ? *run : found;
      most = std::max(most, end - run);
      run = end;
    }
    return found;
  }

private:
  std::vector<double> Numbers;
};

/// Adds the finite numbers of one texel's voxels.
template <typename Joined, typename Voxel>
void joinBlock(
  const ValueLayout& layout, const glm::ivec3& texel, const Voxel& voxel, Joined& joined)
{
  const glm::ivec3 low = texel * layout.perTexel;
  const glm::ivec3 high = glm::min(low + layout.perTexel, layout.voxels);
  for (vtkIdType z = low.z; z < high.z; ++z)
  {
    for (vtkIdType y = low.y; y < high.y; ++y)
    {
      const vtkIdType row = (z * layout.voxels.y + y) * layout.voxels.x;
      for (vtkIdType i = row + low.x; i < row + high.x; ++i)
      {
        const double number = voxel(i);
        if (std::isfinite(number))
        {
          joined.add(number);
        }
      }
    }
  }
}

/// Calls write(texel, number) for each texel, x fastest, on many threads: one number for those of
/// its voxels that are finite. `Joined`: MeanNumber or MostFrequentNumber. `voxel`: returns the
/// number of a voxel, x fastest.
template <typename Joined, typename Voxel, typename Write>
void joinVoxels(const ValueLayout& layout, const Voxel& voxel, const Write& write)
{
  const glm::ivec3& side = layout.dimensions;
  parallelFor(0, side.z, 1, [&](vtkIdType first, vtkIdType last) {
    Joined joined;
    glm::ivec3 texel;
    vtkIdType at = first * side.x * side.y;
    for (texel.z = static_cast<int>(first); texel.z < last; ++texel.z)
    {
      for (texel.y = 0; texel.y < side.y; ++texel.y)
      {
        for (texel.x = 0; texel.x < side.x; ++texel.x, ++at)
        {
          joined.clear();
          joinBlock(layout, texel, voxel, joined);
          write(at, joined.number());
        }
      }
    }
  });
}
}

#endif
