// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Skipping/RestPresence.h"

#include <array>
#include <limits>
#include <numeric>

namespace brainshift
{
namespace
{
constexpr int Overlap = 1; // voxels before and after a brick's own, for the margin
constexpr int BrickReach = RestBrickSide + 2 * Overlap + 1; // voxels a side that a brick knows

template <typename T>
constexpr T NoLeast = std::numeric_limits<T>::has_infinity ? std::numeric_limits<T>::infinity()
                                                           : std::numeric_limits<T>::max();
template <typename T>
constexpr T NoGreatest = std::numeric_limits<T>::has_infinity ? -std::numeric_limits<T>::infinity()
                                                              : std::numeric_limits<T>::lowest();

// Least and greatest values, element by element.
template <typename T>
struct Extremes
{
  std::vector<T> least;
  std::vector<T> greatest;

  explicit Extremes(std::size_t length)
    : least(length)
    , greatest(length)
  {
  }
};

template <typename T>
using Rows = std::array<const T*, BrickReach>;

// The value that interpolation finds BrickMargin beyond the voxel `at`, towards `next`, if it is
// less (or more) than `at`; else `at`. Whole numbers are rounded away from `at`.
float lessBeyond(float at, float next)
{
  const float difference = next - at;
  return difference < 0.0f ? at + BrickMargin * difference : at;
}

float moreBeyond(float at, float next)
{
  const float difference = next - at;
  return difference > 0.0f ? at + BrickMargin * difference : at;
}

constexpr int Parts = static_cast<int>(1.0f / BrickMargin);

std::uint16_t lessBeyond(std::uint16_t at, std::uint16_t next)
{
  return static_cast<std::uint16_t>(at - (std::max(at - next, 0) + Parts - 1) / Parts);
}

std::uint16_t moreBeyond(std::uint16_t at, std::uint16_t next)
{
  return static_cast<std::uint16_t>(at + (std::max(next - at, 0) + Parts - 1) / Parts);
}

// Extremes of the rows, element by element; the outer rows count only as far as the margin. Before
// anything is combined, `least` and `greatest` point to equal rows. A comparison with NaN is false,
// so NaN is left out.
template <typename T>
void combine(const Rows<T>& least, const Rows<T>& greatest, std::size_t length,
  T* __restrict leastOut, T* __restrict greatestOut)
{
  static_assert(BrickReach == 5, "the rows are written out, or compilers do not vectorise them");
  const auto [a, b, c, d, e] = least;
  const auto [p, q, r, s, t] = greatest;
  for (std::size_t i = 0; i < length; ++i)
  {
    const T lowBefore = lessBeyond(b[i], a[i]);
    const T lowAfter = lessBeyond(d[i], e[i]);
    T low = NoLeast<T>;
    low = lowBefore < low ? lowBefore : low;
    low = b[i] < low ? b[i] : low;
    low = c[i] < low ? c[i] : low;
    low = d[i] < low ? d[i] : low;
    low = lowAfter < low ? lowAfter : low;
    leastOut[i] = low;
    const T highBefore = moreBeyond(q[i], p[i]);
    const T highAfter = moreBeyond(s[i], t[i]);
    T high = NoGreatest<T>;
    high = highBefore > high ? highBefore : high;
    high = q[i] > high ? q[i] : high;
    high = r[i] > high ? r[i] : high;
    high = s[i] > high ? s[i] : high;
    high = highAfter > high ? highAfter : high;
    greatestOut[i] = high;
  }
}

// The rows that a brick knows, of `count` rows `stride` apart. At the border the last row repeats.
template <typename T>
Rows<T> rowsOf(const T* values, int brick, int count, std::size_t stride)
{
  Rows<T> rows;
  for (int i = 0; i < BrickReach; ++i)
  {
    rows[i] = values + std::clamp(brick * RestBrickSide - Overlap + i, 0, count - 1) * stride;
  }
  return rows;
}

// The work of one thread: it reduces a layer of bricks along z, then each row of it along y, then
// x.
template <typename T>
class LayerRanges
{
public:
  LayerRanges(const T* values, const glm::ivec3& dimensions, float scale)
    : Values(values)
    , Dimensions(dimensions)
    , Scale(scale)
    , Layer(static_cast<std::size_t>(dimensions.x) * dimensions.y)
    , Row(dimensions.x + BrickReach - 1)
    , Windows(dimensions.x)
  {
  }

  void find(int brickZ, const glm::ivec3& bricks, glm::vec2* out)
  {
    const std::size_t width = this->Dimensions.x;
    const std::size_t area = width * this->Dimensions.y;
    const Rows<T> slices = rowsOf(this->Values, brickZ, this->Dimensions.z, area);
    combine(slices, slices, area, this->Layer.least.data(), this->Layer.greatest.data());
    for (int brickY = 0; brickY < bricks.y; ++brickY, out += bricks.x)
    {
      combine(rowsOf(this->Layer.least.data(), brickY, this->Dimensions.y, width),
        rowsOf(this->Layer.greatest.data(), brickY, this->Dimensions.y, width), width,
        &this->Row.least[Overlap], &this->Row.greatest[Overlap]);
      this->findRow(bricks.x, out);
    }
  }

private:
  void findRow(int bricks, glm::vec2* out)
  {
    const std::size_t width = this->Dimensions.x;
    Rows<T> least;
    Rows<T> greatest;
    for (std::vector<T>* row : { &this->Row.least, &this->Row.greatest })
    {
      std::fill_n(row->begin(), Overlap, (*row)[Overlap]);
      std::fill(row->begin() + Overlap + width, row->end(), (*row)[Overlap + width - 1]);
    }
    for (int i = 0; i < BrickReach; ++i)
    {
      least[i] = &this->Row.least[i];
      greatest[i] = &this->Row.greatest[i];
    }
    // All windows, although only every second one belongs to a brick: that is faster than to gather
    // only those.
    combine(least, greatest, width, this->Windows.least.data(), this->Windows.greatest.data());
    for (int brick = 0; brick < bricks; ++brick)
    {
      out[brick] = this->Scale *
        glm::vec2(this->Windows.least[brick * RestBrickSide],
          this->Windows.greatest[brick * RestBrickSide]);
    }
  }

  const T* Values;
  glm::ivec3 Dimensions;
  float Scale;
  Extremes<T> Layer;
  Extremes<T> Row; // repeats its ends for the windows that stand out
  Extremes<T> Windows;
};

template <typename T>
BrickRanges rangesOf(const T* values, const glm::ivec3& dimensions, float scale)
{
  BrickRanges bricks;
  bricks.count = (dimensions + RestBrickSide - 1) / RestBrickSide;
  const std::size_t layer = static_cast<std::size_t>(bricks.count.x) * bricks.count.y;
  bricks.ranges.resize(layer * bricks.count.z);
  parallelFor(0, bricks.count.z, 1, [&](vtkIdType first, vtkIdType last) {
    LayerRanges<T> ranges(values, dimensions, scale);
    for (vtkIdType z = first; z < last; ++z)
    {
      ranges.find(static_cast<int>(z), bricks.count, &bricks.ranges[z * layer]);
    }
  });
  return bricks;
}
}

glm::vec2 BrickRanges::whole() const
{
  const glm::vec2 none(NoLeast<float>, NoGreatest<float>);
  std::vector<glm::vec2> ofLayer(this->count.z, none);
  const std::size_t layer = static_cast<std::size_t>(this->count.x) * this->count.y;
  const auto widen = [](glm::vec2& whole, const glm::vec2& range) {
    whole = glm::vec2(std::min(whole.x, range.x), std::max(whole.y, range.y));
  };
  parallelFor(0, this->count.z, 1, [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType z = first; z < last; ++z)
    {
      for (std::size_t brick = z * layer; brick < (z + 1) * layer; ++brick)
      {
        widen(ofLayer[z], this->ranges[brick]);
      }
    }
  });
  glm::vec2 whole = none;
  for (const glm::vec2& range : ofLayer)
  {
    widen(whole, range);
  }
  return whole;
}

glm::vec2 VisibleValues::ends() const
{
  constexpr float all = std::numeric_limits<float>::max(); // the end colours hold beyond the ends
  const auto begin = this->before.begin();
  const auto first = std::upper_bound(begin, this->before.end(), 0) - begin - 1;
  const auto beyond =
    std::lower_bound(begin, this->before.end(), this->before.back()) - begin; // past the last
  const auto valueOf = [&](double entry) {
    return static_cast<float>((entry - this->entryOfValueZero) / this->entryFromValue);
  };
  if (this->before.back() == 0)
  {
    return { all, -all };
  }
  return { first == 0 ? -all : valueOf(static_cast<double>(first) - 2.0),
    beyond == this->entries ? all : valueOf(static_cast<double>(beyond) + 1.0) };
}

float usualDifference(const BrickRanges& bricks)
{
  constexpr std::size_t enough = 100000; // so many bricks give nearly the result of all of them
  const std::size_t step = std::max<std::size_t>(bricks.ranges.size() / enough, 1);
  std::vector<float> differences;
  for (std::size_t i = 0; i < bricks.ranges.size(); i += step)
  {
    const float difference = bricks.ranges[i].y - bricks.ranges[i].x;
    if (difference > 0.0f && difference <= std::numeric_limits<float>::max())
    {
      differences.push_back(difference);
    }
  }
  if (differences.empty())
  {
    return 0.0f;
  }
  const auto usual =
    differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
  std::nth_element(differences.begin(), usual, differences.end());
  return *usual;
}

BrickRanges brickRanges(const float* values, const glm::ivec3& dimensions, float scale)
{
  return rangesOf(values, dimensions, scale);
}

BrickRanges brickRanges(const std::uint16_t* values, const glm::ivec3& dimensions, float scale)
{
  return rangesOf(values, dimensions, scale);
}

void sumUp(std::vector<float>& counts, const glm::ivec3& size)
{
  const auto add = [](float a, float b) { // both below the modulus, so it is exact
    const float sum = a + b;
    return sum >= SumModulus ? sum - SumModulus : sum;
  };
  const std::size_t width = size.x;
  const std::size_t layer = width * size.y;
  parallelFor(0, size.z, 1, [&](vtkIdType first, vtkIdType last) {
    for (float* row = &counts[first * layer]; row < counts.data() + last * layer; row += width)
    {
      std::partial_sum(row, row + width, row, add);
    }
    for (vtkIdType k = first; k < last; ++k)
    {
      float* above = &counts[k * layer] + width;
      for (float* end = above + layer - width; above < end; ++above)
      {
        *above = add(*above, *(above - width));
      }
    }
  });
  parallelFor(0, size.y, 1, [&](vtkIdType first, vtkIdType last) {
    for (int k = 1; k < size.z; ++k)
    {
      const float* below = &counts[(k - 1) * layer];
      float* here = &counts[k * layer];
      for (std::size_t i = first * width; i < last * width; ++i)
      {
        here[i] = add(here[i], below[i]);
      }
    }
  });
}
}
