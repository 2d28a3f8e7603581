// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/LocalFitSimilarity.h"

#include "Filters/Deformation/Parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace brainshift
{
namespace
{
constexpr float LeastWindow = 0.3f;         // share of its samples that a window must have
constexpr float LeastVarianceShare = 0.02f; // of the mean variance of a volume's windows
constexpr float Ridge = 1e-4f;              // variance (range 0 to 1) of a volume that is flat

// Sums over a window, and what each window then leaves for its samples.
enum Sum
{
  Count,
  P,
  PP,
  V,
  VV,
  VP,
  G,
  GG,
  PG,
  VG,
  Sums
};
constexpr int SumsWithoutSlope = G;

// A sample's force is (Scale V - ScaleA P - ScaleB G - ScaleC - Loss V + LossMean) times the
// reference's slope: the derivative of the disagreements of all windows that hold it.
enum Left
{
  Scale,
  ScaleA,
  ScaleB,
  ScaleC,
  Loss,
  LossMean,
  Lefts
};

// `weights`: which values say what the range is; 1 or 0.
void toShares(std::vector<float>& values, const std::vector<float>& weights)
{
  std::vector<float> counting;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (weights[i] > 0.0f)
    {
      counting.push_back(values[i]);
    }
  }
  const Range range = rangeOf(counting);
  for (float& value : values)
  {
    value = range.share(value);
  }
}

std::vector<float> gradientLength(const Volume& volume)
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
          result[grid.offset(i, j, k)] = glm::length(slope);
        }
      }
    }
  });
  return result;
}

// The variance of what counts in the window around each point.
std::vector<float> windowVariances(
  const std::vector<float>& values, const Volume& weights, int radius)
{
  Volume means = weights;
  Volume squares = weights;
  Volume counts = weights;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    means.values[i] *= values[i];
    squares.values[i] *= values[i] * values[i];
  }
  boxSum(means, glm::ivec3(radius));
  boxSum(squares, glm::ivec3(radius));
  boxSum(counts, glm::ivec3(radius));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const float count = std::max(1.0f, counts.values[i]);
    const float mean = means.values[i] / count;
    squares.values[i] = std::max(0.0f, squares.values[i] / count - mean * mean);
  }
  return squares.values;
}

// A variance below which a window is taken for flat.
float leastVariance(const std::vector<float>& variances)
{
  const double sum = std::accumulate(variances.begin(), variances.end(), 0.0);
  return std::max(Ridge, static_cast<float>(LeastVarianceShare * sum / variances.size()));
}
}

struct LocalFitSimilarity::Work
{
  explicit Work(const Grid& grid, int sums)
    : value(grid.count())
    , weight(grid.count(), 0.0f)
    , slope(grid.count())
    , sums(sums, Volume{ grid, std::vector<float>(grid.count(), 0.0f) })
  {
  }

  std::vector<float> value;     // of the reference at the samples
  std::vector<float> weight;    // of the samples; 0: not compared
  std::vector<glm::vec3> slope; // of the reference for each mm that the controls move
  std::vector<Volume> sums;
  std::vector<double> slabSums; // of the windows' disagreement
  std::vector<double> slabCounts;
};

LocalFitSimilarity::LocalFitSimilarity(
  const LevelVolumes& level, const Lattice& lattice, bool withSlope)
  : WithSlope(withSlope)
  , Samples(level, lattice)
  , Rest(level.rest.values)
  , Reference(level.reference)
{
  toShares(this->Rest, level.restWeights.values);
  toShares(this->Reference.values, level.referenceWeights.values);
  this->LeastVariance =
    leastVariance(windowVariances(this->Reference.values, level.referenceWeights, WindowRadius));
  const std::vector<float> variances = windowVariances(this->Rest, level.restWeights, WindowRadius);
  const float least = leastVariance(variances);
  for (const float variance : variances)
  {
    this->Says.push_back(variance > least ? 1 : 0);
  }
  if (withSlope)
  {
    this->Slope = gradientLength({ level.rest.grid, this->Rest });
    toShares(this->Slope, level.restWeights.values);
    this->Slope = this->Samples.read(this->Slope, 1);
  }
  this->Rest = this->Samples.read(this->Rest, 1);
}

void LocalFitSimilarity::takeSamples(const std::vector<glm::vec3>& displacements, Work& work) const
{
  const LevelSamples& samples = this->Samples;
  const int rowsInSlab = samples.rows.samples().dimensions.y;
  samples.rows.visitRows(displacements, [&](const SampleRow& row) {
    samples.visitStretch(row,
      samples.stretches[static_cast<std::size_t>(row.k) * rowsInSlab + row.j],
      [&](const LevelSamples::Place& place) {
        const float w =
          place.weight * trilinear(samples.referenceWeights.values.data(), place.at).value;
        if (w <= 0.0f)
        {
          return;
        }
        const std::size_t n = place.number;
        const ValueAndSlope found = trilinear(this->Reference.values.data(), place.at);
        const float p = this->Rest[n];
        const float v = found.value;
        work.weight[n] = w;
        work.value[n] = v;
        work.slope[n] = found.slope * samples.stepsPerMm * place.freedom;
        const float numbers[SumsWithoutSlope] = { 1.0f, p, p * p, v, v * v, v * p };
        for (int s = 0; s < SumsWithoutSlope; ++s)
        {
          work.sums[s].values[n] = w * numbers[s];
        }
        if (this->WithSlope)
        {
          const float g = this->Slope[n];
          const float more[Sums - G] = { g, g * g, p * g, v * g };
          for (int s = G; s < Sums; ++s)
          {
            work.sums[s].values[n] = w * more[s - G];
          }
        }
      });
    return false;
  });
  for (Volume& sum : work.sums)
  {
    boxSum(sum, glm::ivec3(WindowRadius));
  }
}

void LocalFitSimilarity::fitWindow(Work& work, std::size_t number, double& sum, double& count) const
{
  const auto at = [&](int s) -> float& { return work.sums[s].values[number]; };
  const float samples = at(Count);
  const float side = 2 * WindowRadius + 1;
  float left[Lefts] = {};
  if (this->Says[number] && work.weight[number] > 0.0f &&
    samples > LeastWindow * side * side * side)
  {
    const float p = at(P) / samples;
    const float v = at(V) / samples;
    const float pp = at(PP) / samples - p * p + Ridge;
    const float vp = at(VP) / samples - v * p;
    const float vv = std::max(0.0f, at(VV) / samples - v * v);
    float a = vp / pp;
    float b = 0.0f;
    float g = 0.0f;
    float explained = a * vp;
    if (this->WithSlope)
    {
      g = at(G) / samples;
      const float gg = at(GG) / samples - g * g + Ridge;
      const float pg = at(PG) / samples - p * g;
      const float vg = at(VG) / samples - v * g;
      const float determinant = pp * gg - pg * pg; // above 0 by the ridges
      a = (vp * gg - vg * pg) / determinant;
      b = (vg * pp - vp * pg) / determinant;
      explained = a * vp + b * vg;
    }
    // A window without variance says nothing: its disagreement is 1, whatever moves.
    const float all = vv + this->LeastVariance;
    const float unexplained = std::max(0.0f, all - explained);
    sum += unexplained / all;
    count += 1.0;
    left[Scale] = 1.0f / (all * samples);
    left[ScaleA] = left[Scale] * a;
    left[ScaleB] = left[Scale] * b;
    left[ScaleC] = left[Scale] * (v - a * p - b * g);
    left[Loss] = left[Scale] * unexplained / all;
    left[LossMean] = left[Loss] * v;
  }
  for (int l = 0; l < Lefts; ++l)
  {
    at(l) = left[l];
  }
}

void LocalFitSimilarity::fitWindows(Work& work) const
{
  const Grid& grid = this->Samples.rows.samples();
  work.slabSums.assign(grid.dimensions.z, 0.0);
  work.slabCounts.assign(grid.dimensions.z, 0.0);
  const std::size_t slab = grid.offset(0, 0, 1);
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k)
    {
      for (std::size_t n = slab * k; n < slab * (k + 1); ++n)
      {
        this->fitWindow(work, n, work.slabSums[k], work.slabCounts[k]);
      }
    }
  });
  for (int l = 0; l < Lefts; ++l)
  {
    if (l != ScaleB || this->WithSlope)
    {
      boxSum(work.sums[l], glm::ivec3(WindowRadius));
    }
  }
}

ControlForces LocalFitSimilarity::takeForces(
  const std::vector<glm::vec3>& displacements, const Work& work) const
{
  const LevelSamples& samples = this->Samples;
  const Grid& grid = samples.rows.samples();
  return samples.rows.visitRows(displacements, [&](const SampleRow& row) {
    const LevelSamples::Stretch stretch =
      samples.stretches[static_cast<std::size_t>(row.k) * grid.dimensions.y + row.j];
    for (int i = stretch.first; i < stretch.last; ++i)
    {
      const std::size_t n = grid.offset(i, row.j, row.k);
      const float weight = work.weight[n];
      if (weight <= 0.0f)
      {
        continue;
      }
      const auto left = [&](int l) { return work.sums[l].values[n]; };
      const float slopePart = this->WithSlope ? left(ScaleB) * this->Slope[n] : 0.0f;
      const float down = -weight *
        ((left(Scale) - left(Loss)) * work.value[n] - left(ScaleA) * this->Rest[n] - slopePart -
          left(ScaleC) + left(LossMean));
      const float curve = weight * left(Scale);
      const glm::vec3& s = work.slope[n];
      const float force[ForceNumbers] = { down * s.x, down * s.y, down * s.z, curve * s.x * s.x,
        curve * s.y * s.y, curve * s.z * s.z, curve * s.x * s.y, curve * s.x * s.z,
        curve * s.y * s.z };
      LatticeRows::add(
        row, samples.rows.tapsAt(0, samples.rows.position(i, row.j, row.k).x), force);
    }
    return stretch.first < stretch.last;
  });
}

Agreement LocalFitSimilarity::compare(const std::vector<glm::vec3>& displacements) const
{
  Work work(this->Samples.rows.samples(), this->WithSlope ? Sums : SumsWithoutSlope);
  this->takeSamples(displacements, work);
  this->fitWindows(work);
  return averaged(work.slabSums, work.slabCounts, this->takeForces(displacements, work));
}
}
