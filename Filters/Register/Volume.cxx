// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Volume.h"

#include "Common/Parallel.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
// Of a Gaussian, in points of the finer grid for each point of the coarser one. Below 0.6 points
// its weights would no longer be centred.
constexpr double DeviationPerFactor = 0.45;
constexpr double LeastDeviation = 0.6;
constexpr double RadiusInDeviations = 3.0;

constexpr float CutOffFraction = 0.001f;
constexpr std::size_t MostSorted = 200000; // values that stand for all when a range is found

// Runs `work` on every line of values along an axis: its first value and the step to the next.
template <typename Work>
void forEachLine(const glm::ivec3& sides, int axis, const Work& work)
{
  const std::size_t steps[3] = { 1, static_cast<std::size_t>(sides.x),
    static_cast<std::size_t>(sides.x) * sides.y };
  const int inner = axis == 0 ? 1 : 0;
  const int outer = axis == 2 ? 1 : 2;
  parallelFor(0, sides[outer], 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b)
    {
      work(b * steps[outer], steps[inner], sides[inner], steps[axis]);
    }
  });
}

std::vector<float> gaussian(double deviation)
{
  const int radius = static_cast<int>(std::ceil(RadiusInDeviations * deviation));
  std::vector<float> weights(2 * radius + 1);
  float sum = 0.0f;
  for (int i = -radius; i <= radius; ++i)
  {
    weights[i + radius] = static_cast<float>(std::exp(-0.5 * i * i / (deviation * deviation)));
    sum += weights[i + radius];
  }
  for (float& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

// Beside each other lie `lines` lines, so that one weight serves a whole row of values.
void smoothAlong(Volume& volume, int axis, const std::vector<float>& weights)
{
  const glm::ivec3 sides = volume.grid.dimensions;
  const int count = sides[axis];
  const int radius = static_cast<int>(weights.size() / 2);
  forEachLine(sides, axis, [&](std::size_t first, std::size_t beside, int lines, std::size_t step) {
    std::vector<float> before(static_cast<std::size_t>(count) * lines);
    float* values = volume.values.data() + first;
    for (int i = 0; i < count; ++i)
    {
      for (int line = 0; line < lines; ++line)
      {
        before[static_cast<std::size_t>(i) * lines + line] = values[i * step + line * beside];
      }
    }
    std::vector<float> sums(lines);
    for (int i = 0; i < count; ++i)
    {
      std::fill(sums.begin(), sums.end(), 0.0f);
      for (int k = -radius; k <= radius; ++k)
      {
        const int from = std::clamp(i + k, 0, count - 1);
        const float* row = &before[static_cast<std::size_t>(from) * lines];
        const float weight = weights[k + radius];
        for (int line = 0; line < lines; ++line)
        {
          sums[line] += weight * row[line];
        }
      }
      for (int line = 0; line < lines; ++line)
      {
        values[i * step + line * beside] = sums[line];
      }
    }
  });
}

void sumAlong(Volume& volume, int axis, int radius)
{
  const glm::ivec3 sides = volume.grid.dimensions;
  const int count = sides[axis];
  forEachLine(sides, axis, [&](std::size_t first, std::size_t beside, int lines, std::size_t step) {
    std::vector<float> before(static_cast<std::size_t>(count) * lines);
    float* values = volume.values.data() + first;
    for (int i = 0; i < count; ++i)
    {
      for (int line = 0; line < lines; ++line)
      {
        before[static_cast<std::size_t>(i) * lines + line] = values[i * step + line * beside];
      }
    }
    const auto row = [&](int i) { return &before[static_cast<std::size_t>(i) * lines]; };
    std::vector<float> sums(lines, 0.0f);
    const auto add = [&](int i, float sign) {
      for (int line = 0; i >= 0 && i < count && line < lines; ++line)
      {
        sums[line] += sign * row(i)[line];
      }
    };
    for (int i = 0; i < radius; ++i)
    {
      add(i, 1.0f);
    }
    for (int i = 0; i < count; ++i)
    {
      add(i + radius, 1.0f);
      add(i - radius - 1, -1.0f);
      for (int line = 0; line < lines; ++line)
      {
        values[i * step + line * beside] = sums[line];
      }
    }
  });
}

// Whether the voxel nearest to a position is inside.
bool holds(const Mask& mask, const glm::dvec3& world)
{
  const glm::ivec3 index = glm::ivec3(glm::floor(mask.grid.gridFromWorld(world) + 0.5));
  const glm::ivec3 sides = mask.grid.dimensions;
  return index.x >= 0 && index.y >= 0 && index.z >= 0 && index.x < sides.x && index.y < sides.y &&
    index.z < sides.z && mask.inside[mask.grid.offset(index.x, index.y, index.z)] != 0;
}

bool holds(const Grid& grid, const glm::dvec3& world)
{
  constexpr double Rounding = 1e-6; // points
  const glm::dvec3 at = grid.gridFromWorld(world) + Rounding;
  const glm::dvec3 last = glm::dvec3(grid.dimensions - 1) + 2.0 * Rounding;
  return at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x <= last.x && at.y <= last.y &&
    at.z <= last.z;
}

// Calls visit(number, world position) for each point of a grid.
template <typename Visit>
void forEachPoint(const Grid& grid, const Visit& visit)
{
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < grid.dimensions.y; ++j)
      {
        std::size_t number = grid.offset(0, j, k);
        for (int i = 0; i < grid.dimensions.x; ++i)
        {
          visit(number++, grid.worldFromGrid({ i, j, k }));
        }
      }
    }
  });
}
}

Grid coarseGrid(const Grid& source, double spacingMm)
{
  Grid result = source;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.spacing[axis] = std::max(source.spacing[axis], spacingMm);
    const double length = source.spacing[axis] * (source.dimensions[axis] - 1);
    // A last point that rounding would push out still counts.
    result.dimensions[axis] =
      std::max(2, static_cast<int>(std::floor(length / result.spacing[axis] + 1e-6)) + 1);
  }
  return result;
}

namespace
{
// The weights that smooth points of a spacing for one of `spacingMm`; 1 alone where none is needed.
std::vector<float> smoothingWeights(double pointMm, double spacingMm)
{
  const double factor = spacingMm / pointMm;
  return factor > 1.0 ? gaussian(std::max(LeastDeviation, DeviationPerFactor * factor))
                      : std::vector<float>{ 1.0f };
}
}

Volume smoothed(const Volume& source, double spacingMm)
{
  Volume result = source;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float> weights = smoothingWeights(source.grid.spacing[axis], spacingMm);
    if (weights.size() > 1)
    {
      smoothAlong(result, axis, weights);
    }
  }
  return result;
}

Volume resampled(const Volume& source, const Grid& to)
{
  Volume result{ to, std::vector<float>(to.count()) };
  const glm::dvec3 last(source.grid.dimensions - 1);
  forEachPoint(to, [&](std::size_t number, const glm::dvec3& world) {
    const glm::dvec3 at = glm::clamp(source.grid.gridFromWorld(world), glm::dvec3(0.0), last);
    result.values[number] =
      trilinear(source.values.data(), neighboursOf(source.grid.dimensions, glm::vec3(at))).value;
  });
  return result;
}

namespace
{
// The points of a line, from `first` on, that a point of another line is read from.
struct LineTaps
{
  int first = 0;
  std::vector<float> weights;
};

// Smooths a line of `count` points, and reads it at a position in points, linear between them.
LineTaps tapsAt(double position, int count, const std::vector<float>& smoothing)
{
  const int radius = static_cast<int>(smoothing.size() / 2);
  const float at = static_cast<float>(glm::clamp(position, 0.0, count - 1.0));
  const int low = std::min(static_cast<int>(at), count - 2);
  const float upper = at - static_cast<float>(low);
  LineTaps taps;
  taps.first = std::max(0, low - radius);
  taps.weights.assign(std::min(count - 1, low + 1 + radius) - taps.first + 1, 0.0f);
  for (int k = -radius; k <= radius; ++k)
  {
    for (const int step : { 0, 1 })
    {
      const int from = std::clamp(low + step + k, 0, count - 1); // the end holds beyond it
      taps.weights[from - taps.first] += smoothing[k + radius] * (step ? upper : 1.0f - upper);
    }
  }
  return taps;
}

// For each point of `to` along an axis.
std::vector<LineTaps> tapsAlong(
  const Grid& from, const Grid& to, int axis, const std::vector<float>& smoothing)
{
  std::vector<LineTaps> taps;
  for (int i = 0; i < to.dimensions[axis]; ++i)
  {
    glm::dvec3 point(0.0);
    point[axis] = i;
    const double position = from.gridFromWorld(to.worldFromGrid(point))[axis];
    taps.push_back(tapsAt(position, from.dimensions[axis], smoothing));
  }
  return taps;
}

// Replaces a slowest axis: `inner` values lie beside each other for each point of the line.
std::vector<float> readAlong(
  const std::vector<float>& values, const std::vector<LineTaps>& taps, std::size_t inner, int count)
{
  const auto results = static_cast<std::int64_t>(taps.size());
  const std::size_t line = inner * count;
  const auto outer = static_cast<std::int64_t>(values.size() / line);
  std::vector<float> result(inner * results * outer, 0.0f);
  parallelFor(0, outer * results, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n)
    {
      const LineTaps& tap = taps[n % results];
      const float* from = values.data() + n / results * line + inner * tap.first;
      float* to = result.data() + n * inner;
      for (const float weight : tap.weights)
      {
        for (std::size_t i = 0; i < inner; ++i)
        {
          to[i] += weight * from[i];
        }
        from += inner;
      }
    }
  });
  return result;
}

// The same for the fastest axis.
std::vector<float> readRows(
  const std::vector<float>& values, const std::vector<LineTaps>& taps, int count)
{
  const auto rows = static_cast<std::int64_t>(values.size() / count);
  std::vector<float> result(taps.size() * rows);
  parallelFor(0, rows, 64, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row)
    {
      float* to = result.data() + row * static_cast<std::int64_t>(taps.size());
      for (const LineTaps& tap : taps)
      {
        const float* from = values.data() + row * count + tap.first;
        float sum = 0.0f;
        for (const float weight : tap.weights)
        {
          sum += weight * *from++;
        }
        *to++ = sum;
      }
    }
  });
  return result;
}

bool haveSameAxes(const Grid& a, const Grid& b)
{
  constexpr double Rounding = 1e-9;
  const glm::dmat3 apart = a.direction - b.direction;
  return std::max({ glm::length(apart[0]), glm::length(apart[1]), glm::length(apart[2]) }) <
    Rounding;
}
}

Volume sampled(const Volume& source, double spacingMm, const Grid& to)
{
  if (!haveSameAxes(source.grid, to))
  {
    return resampled(smoothed(source, spacingMm), to);
  }
  const glm::ivec3 sides = source.grid.dimensions;
  const auto taps = [&](int axis) {
    return tapsAlong(source.grid, to, axis, smoothingWeights(source.grid.spacing[axis], spacingMm));
  };
  std::vector<float> values =
    readAlong(source.values, taps(2), static_cast<std::size_t>(sides.x) * sides.y, sides.z);
  values = readAlong(values, taps(1), sides.x, sides.y);
  return { to, readRows(values, taps(0), sides.x) };
}

void boxSum(Volume& volume, const glm::ivec3& radii)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    sumAlong(volume, axis, radii[axis]);
  }
}

bool counts(const Region& region, const glm::dvec3& world)
{
  const auto isOutside = [&](const Mask* mask) { return mask && holds(*mask, world); };
  return (!region.grid || holds(*region.grid, world)) &&
    (!region.inside || holds(*region.inside, world)) &&
    std::none_of(region.outside.begin(), region.outside.end(), isOutside);
}

Volume weightsOf(const Grid& grid, const Region& region, const Support& support)
{
  Volume missing{ grid, std::vector<float>(grid.count()) };
  // Missing points are counted, so that the border of the grid itself shrinks nothing.
  forEachPoint(grid, [&](std::size_t number, const glm::dvec3& world) {
    missing.values[number] = counts(region, world) ? 0.0f : 1.0f;
  });
  Volume result{ grid, std::vector<float>(grid.count(), 1.0f) };
  const auto isMissing = [](float number) { return number > 0.0f; };
  if (std::none_of(missing.values.begin(), missing.values.end(), isMissing))
  {
    return result;
  }
  const int boxes = support.along == support.across ? 1 : 3; // 1: all three are the same
  for (int axis = 0; axis < boxes; ++axis)
  {
    glm::ivec3 radii(support.across);
    radii[axis] = support.along;
    Volume around = missing;
    boxSum(around, radii);
    for (std::size_t i = 0; i < result.values.size(); ++i)
    {
      result.values[i] = around.values[i] < 0.5f ? result.values[i] : 0.0f;
    }
  }
  return result;
}

Range rangeOf(const std::vector<float>& values)
{
  std::vector<float> some;
  const std::size_t step = 1 + values.size() / MostSorted;
  for (std::size_t i = 0; i < values.size(); i += step)
  {
    if (std::isfinite(values[i]))
    {
      some.push_back(values[i]);
    }
  }
  if (some.empty())
  {
    return {};
  }
  const auto cut = static_cast<std::ptrdiff_t>(CutOffFraction * some.size());
  const auto valueAt = [&](std::ptrdiff_t number) {
    std::nth_element(some.begin(), some.begin() + number, some.end());
    return some[number];
  };
  const auto last = static_cast<std::ptrdiff_t>(some.size()) - 1;
  const Range found{ valueAt(cut), valueAt(last - cut) };
  return found.high > found.low ? found : Range{ found.low, found.low + 1.0f };
}

namespace
{
// A number for each point, from the gradient there (for each mm along the grid's axes).
template <typename Number>
std::vector<float> fromGradients(const Volume& volume, const Number& number)
{
  const Grid& grid = volume.grid;
  std::vector<float> result(volume.values.size());
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < grid.dimensions.y; ++j)
      {
        for (int i = 0; i < grid.dimensions.x; ++i)
        {
          glm::vec3 slope;
          for (int axis = 0; axis < 3; ++axis)
          {
            glm::ivec3 low(i, j, k);
            glm::ivec3 high = low;
            low[axis] = std::max(low[axis] - 1, 0);
            high[axis] = std::min(high[axis] + 1, grid.dimensions[axis] - 1);
            slope[axis] = (volume.values[grid.offset(high.x, high.y, high.z)] -
                            volume.values[grid.offset(low.x, low.y, low.z)]) /
              static_cast<float>(grid.spacing[axis] * (high[axis] - low[axis]));
          }
          result[grid.offset(i, j, k)] = number(slope);
        }
      }
    }
  });
  return result;
}
}

std::vector<float> gradientLength(const Volume& volume)
{
  return fromGradients(volume, [](const glm::vec3& slope) { return glm::length(slope); });
}

std::vector<float> riseAlong(const Volume& volume, const glm::dvec3& direction)
{
  const glm::vec3 along(glm::transpose(volume.grid.direction) * direction);
  return fromGradients(
    volume, [&](const glm::vec3& slope) { return std::max(0.0f, glm::dot(slope, along)); });
}
}
