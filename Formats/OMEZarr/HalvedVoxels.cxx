// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/HalvedVoxels.h"

#include "vtkSetGet.h" // for the macro that visits types

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace brainshift
{
namespace
{
// Up to eight numbers that become one.
template <typename T>
struct Few
{
  std::array<T, 8> numbers{};
  int count = 0;
};

template <typename T>
T meanOf(const Few<T>& few)
{
  double sum = 0.0; // exact for whole numbers of 4 bytes
  int counted = 0;
  for (int i = 0; i < few.count; ++i)
  {
    const double number = static_cast<double>(few.numbers[static_cast<std::size_t>(i)]);
    const bool counts = !std::is_floating_point_v<T> || !std::isnan(number);
    sum += counts ? number : 0.0;
    counted += counts ? 1 : 0;
  }
  const double mean = counted > 0 ? sum / counted : std::numeric_limits<double>::quiet_NaN();
  return static_cast<T>(std::is_floating_point_v<T> ? mean : std::round(mean));
}

template <typename T>
T mostFrequentOf(const Few<T>& few)
{
  T best = few.numbers[0];
  std::ptrdiff_t most = 0;
  for (int i = 0; i < few.count; ++i)
  {
    const T number = few.numbers[static_cast<std::size_t>(i)];
    const std::ptrdiff_t times =
      std::count(few.numbers.begin(), few.numbers.begin() + few.count, number);
    best = times > most ? number : best;
    most = std::max(most, times);
  }
  return best;
}

template <typename T>
Few<T> fewAt(const T* numbers, const VoxelBox& finer, const Size3& first, const glm::ivec3& step)
{
  const Size3 end = glm::min(first + Size3(step), finer.size);
  Few<T> few;
  for (std::int64_t z = first.z; z < end.z; ++z)
  {
    for (std::int64_t y = first.y; y < end.y; ++y)
    {
      for (std::int64_t x = first.x; x < end.x; ++x)
      {
        few.numbers[static_cast<std::size_t>(few.count++)] =
          numbers[x * finer.steps.x + y * finer.steps.y + z * finer.steps.z];
      }
    }
  }
  return few;
}

template <typename T>
void halveAs(const VoxelBox& finer, const HalvingWay& way, const HalvedPart& part)
{
  const auto* const numbers = reinterpret_cast<const T*>(finer.first);
  for (std::int64_t z = 0; z < part.size.z; ++z)
  {
    for (std::int64_t y = 0; y < part.size.y; ++y)
    {
      auto* to = reinterpret_cast<T*>(part.to) + (z * PyramidChunk + y) * PyramidChunk;
      for (std::int64_t x = 0; x < part.size.x; ++x)
      {
        const Size3 first = (part.begin + Size3(x, y, z)) * Size3(way.step);
        const Few<T> few = fewAt(numbers, finer, first, way.step);
        *to++ = way.halving == Halving::Mean ? meanOf(few) : mostFrequentOf(few);
      }
    }
  }
}

template <typename T>
std::array<double, 2> rangeAs(const VoxelBox& box)
{
  const auto* const numbers = reinterpret_cast<const T*>(box.first);
  bool hasAny = false;
  T least{};
  T most{};
  for (std::int64_t z = 0; z < box.size.z; ++z)
  {
    for (std::int64_t y = 0; y < box.size.y; ++y)
    {
      const T* number = numbers + y * box.steps.y + z * box.steps.z;
      for (std::int64_t x = 0; x < box.size.x; ++x, number += box.steps.x)
      {
        if (*number == *number) // not NaN
        {
          least = hasAny ? std::min(least, *number) : *number;
          most = hasAny ? std::max(most, *number) : *number;
          hasAny = true;
        }
      }
    }
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  return { hasAny ? static_cast<double>(least) : none, hasAny ? static_cast<double>(most) : none };
}
}

void halve(const VoxelBox& finer, const HalvingWay& way, const HalvedPart& part)
{
  switch (way.type)
  {
    vtkTemplateMacro(halveAs<VTK_TT>(finer, way, part));
  }
}

std::array<double, 2> rangeOf(int type, const VoxelBox& box)
{
  std::array<double, 2> range{};
  switch (type)
  {
    vtkTemplateMacro(range = rangeAs<VTK_TT>(box));
  }
  return range;
}
}
