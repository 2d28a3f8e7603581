// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Similarities/LocalFitSimilarity.h"

#include <numeric>
#include <utility>

namespace brainshift
{
namespace
{
inline void add(const float* from, std::size_t count, float* to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] += from[i];
  }
}

// Sums of a line's points for its window `number`. A point has `inner` numbers.
inline void gatherOne(
  const float* points, int count, std::size_t inner, const glm::ivec2& numberAndRadius, float* to)
{
  std::fill(to, to + inner, 0.0f);
  const int middle = numberAndRadius.x * WindowStride;
  const int last = std::min(count - 1, middle + numberAndRadius.y);
  for (int i = std::max(0, middle - numberAndRadius.y); i <= last; ++i)
  {
    add(points + i * inner, inner, to);
  }
}

// Sums of the windows that hold point `number` of a line of `count` points.
inline void spreadOne(
  const float* windows, int count, std::size_t inner, const glm::ivec2& numberAndRadius, float* to)
{
  std::fill(to, to + inner, 0.0f);
  const auto [number, radius] = std::pair(numberAndRadius.x, numberAndRadius.y);
  const int first = std::max(0, windowsAlong(number - radius));
  const int last = std::min(windowsAlong(count) - 1, (number + radius) / WindowStride);
  for (int window = first; window <= last; ++window)
  {
    add(windows + window * inner, inner, to);
  }
}

using One = void (*)(const float*, int, std::size_t, const glm::ivec2&, float*);

// Along one axis of a block, `one` for each of its results.
struct Pass
{
  int axis = 1;    // y or z
  int points = 0;  // number of points of a line, where the block has another number
  int results = 0; // of a line
  int radius = 0;  // of the windows
  One one = nullptr;
};

void along(const Block& from, const Pass& pass, Block& to)
{
  glm::ivec3 sides = from.dimensions;
  sides[pass.axis] = pass.results;
  to.reshape(sides, from.numbers);
  std::size_t inner = static_cast<std::size_t>(from.numbers) * sides.x;
  inner *= pass.axis == 2 ? sides.y : 1;
  const std::int64_t outer = pass.axis == 2 ? 1 : sides.z;
  const std::size_t line = inner * from.dimensions[pass.axis];
  parallelFor(0, outer * pass.results, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n)
    {
      pass.one(from.values.data() + n / pass.results * line, pass.points, inner,
        { n % pass.results, pass.radius }, to.values.data() + n * inner);
    }
  });
}
}

namespace
{
// `numbers` as a constant where it is one of some, so that the compiler makes vector instructions.
template <typename Work>
void withNumbers(int numbers, const Work& work)
{
  switch (numbers)
  {
    case 6:
      work(std::integral_constant<int, 6>());
      break;
    case 10:
      work(std::integral_constant<int, 10>());
      break;
    default:
      work(numbers);
  }
}
}

void Windows::gatherRow(const float* points, int count, int numbers, float* windows) const
{
  withNumbers(numbers, [&](const auto each) {
    for (int number = 0; number < windowsAlong(count); ++number)
    {
      gatherOne(points, count, each, { number, this->Radius }, windows + number * each);
    }
  });
}

void Windows::spreadRow(const float* windows, int count, int numbers, float* points) const
{
  withNumbers(numbers, [&](const auto each) {
    for (int number = 0; number < count; ++number)
    {
      spreadOne(windows, count, each, { number, this->Radius }, points + number * each);
    }
  });
}

void Windows::gather(const Block& rows, Block& windows)
{
  const glm::ivec3 points = rows.dimensions;
  along(rows, { 1, points.y, windowsAlong(points.y), this->Radius, gatherOne }, this->Between);
  along(this->Between, { 2, points.z, windowsAlong(points.z), this->Radius, gatherOne }, windows);
}

void Windows::spread(const Block& windows, const glm::ivec3& points, Block& rows)
{
  along(windows, { 2, points.z, points.z, this->Radius, spreadOne }, this->Between);
  along(this->Between, { 1, points.y, points.y, this->Radius, spreadOne }, rows);
}

namespace
{
constexpr float LeastWindow = 0.3f;   // fraction of its samples that a window must have
constexpr float SamplesForOne = 2.0f; // for each one of a checkerboard

// Sums over a window; G is the second term. Its results for its samples (Left) replace them.
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
constexpr int SumsWithoutSecond = G;

// A sample's force is (Scale V - ScaleA P - ScaleB G - ScaleC - Loss V + LossMean) times the
// reference's slope: the derivative of the costs of all windows that hold it.
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

// The variance of the values that count in each window.
std::vector<float> windowVariances(
  Windows& around, const std::vector<float>& values, const Volume& weights)
{
  constexpr int Numbers = 3;
  const glm::ivec3 sides = weights.grid.dimensions;
  Block rows({ windowsAlong(sides.x), sides.y, sides.z }, Numbers);
  parallelFor(0, sides.z, 1, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> points(static_cast<std::size_t>(sides.x) * Numbers);
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < sides.y; ++j)
      {
        std::size_t n = weights.grid.offset(0, j, k);
        for (std::size_t i = 0; i < points.size(); i += Numbers, ++n)
        {
          points[i] = weights.values[n];
          points[i + 1] = points[i] * values[n];
          points[i + 2] = points[i + 1] * values[n];
        }
        around.gatherRow(points.data(), sides.x, Numbers, rows.row(j, k));
      }
    }
  });
  Block windows;
  around.gather(rows, windows);
  std::vector<float> variances;
  for (std::size_t n = 0; n < windows.values.size(); n += Numbers)
  {
    const float count = std::max(1.0f, windows.values[n]);
    const float mean = windows.values[n + 1] / count;
    variances.push_back(std::max(0.0f, windows.values[n + 2] / count - mean * mean));
  }
  return variances;
}

// A variance below which a window is taken for flat.
float leastVariance(const std::vector<float>& variances, float fraction, float ridge)
{
  const double sum = std::accumulate(variances.begin(), variances.end(), 0.0);
  return std::max(ridge, static_cast<float>(fraction * sum / variances.size()));
}
}

// The memory of a comparison, sample by sample and window by window.
struct LocalFitSimilarity::Work
{
  Work(const Grid& grid, int sums)
    : value(grid.count())
    , weight(grid.count(), 0.0f)
    , slope(grid.count())
    , rows({ windowsAlong(grid.dimensions.x), grid.dimensions.y, grid.dimensions.z }, sums)
  {
  }

  void clear() { std::fill(this->weight.begin(), this->weight.end(), 0.0f); }

  std::vector<float> value;     // of the reference at the samples
  std::vector<float> weight;    // of the samples; 0: not compared
  std::vector<glm::vec3> slope; // of the reference for each mm that the controls move
  Block rows;                   // Sum, gathered along x alone
  Block windows;                // Sum, then Left
  Block lefts;                  // Left, spread along z and y
  std::vector<double> slabSums; // of the windows' cost
  std::vector<double> slabCounts;
};

LocalFitSimilarity::~LocalFitSimilarity() = default;

LocalFitSimilarity::LocalFitSimilarity(
  LevelVolumes level, const Lattice& lattice, const LocalFit& fit)
  : Around(fit.windowRadius)
  , Samples(level, lattice)
  , Rest(std::move(level.rest.values))
  , Reference(std::move(level.reference))
  , Ridge(fit.ridge)
  , IsThin(fit.isThin)
{
  toFractions(this->Rest, level.restWeights.values);
  toFractions(this->Reference.values, level.referenceWeights.values);
  this->LeastVariance =
    leastVariance(windowVariances(this->Around, this->Reference.values, level.referenceWeights),
      fit.leastVariance, this->Ridge);
  const std::vector<float> variances = windowVariances(this->Around, this->Rest, level.restWeights);
  const float least = leastVariance(variances, fit.leastVariance, this->Ridge);
  for (const float variance : variances)
  {
    this->Varies.push_back(variance > least ? 1 : 0);
  }
  this->readSecond(level, fit.second);
  this->Rest = this->Samples.read(this->Rest, 1);
  this->leaveOutIdleSamples();
  if (this->IsThin)
  {
    this->thinOut();
  }
}

void LocalFitSimilarity::readSecond(const LevelVolumes& level, SecondTerm second)
{
  if (second == SecondTerm::GradientLength)
  {
    this->Second =
      level.secondTerm.empty() ? gradientLength({ level.rest.grid, this->Rest }) : level.secondTerm;
    toFractions(this->Second, level.restWeights.values);
  }
  else if (second == SecondTerm::Square)
  {
    this->Second = this->Rest;
    for (float& value : this->Second)
    {
      value *= value;
    }
  }
  if (second != SecondTerm::None)
  {
    this->Second = this->Samples.read(this->Second, 1);
  }
}

// Samples that no window needs do not count: the air around a head is most of many volumes.
void LocalFitSimilarity::leaveOutIdleSamples()
{
  const glm::ivec3 sides = this->Samples.rows.samples().dimensions;
  Block windows({ windowsAlong(sides.x), windowsAlong(sides.y), windowsAlong(sides.z) }, 1);
  std::copy(this->Varies.begin(), this->Varies.end(), windows.values.begin());
  Block rows;
  this->Around.spread(windows, sides, rows);
  std::vector<float> needed(sides.x);
  for (int k = 0; k < sides.z; ++k)
  {
    for (int j = 0; j < sides.y; ++j)
    {
      this->Around.spreadRow(rows.row(j, k), sides.x, 1, needed.data());
      float* weights = &this->Samples.weights[this->Samples.rows.samples().offset(0, j, k)];
      for (int i = 0; i < sides.x; ++i)
      {
        weights[i] = needed[i] > 0.0f ? weights[i] : 0.0f;
      }
    }
  }
  this->Samples.findStretches();
}

// The middles of windows have even indices and stay.
void LocalFitSimilarity::thinOut()
{
  const glm::ivec3 sides = this->Samples.rows.samples().dimensions;
  std::size_t number = 0;
  for (int k = 0; k < sides.z; ++k)
  {
    for (int j = 0; j < sides.y; ++j)
    {
      for (int i = 0; i < sides.x; ++i, ++number)
      {
        this->Samples.weights[number] *= (i + j + k) % 2 == 0 ? 1.0f : 0.0f;
      }
    }
  }
  this->Samples.findStretches();
}

void LocalFitSimilarity::takeSample(
  const LevelSamples::Compared& sample, float* sums, Work& work) const
{
  const float w =
    sample.weight * trilinear(this->Samples.referenceWeights.values.data(), sample.at).value;
  if (w <= 0.0f)
  {
    return;
  }
  const std::size_t n = sample.number;
  const ValueAndSlope found = trilinear(this->Reference.values.data(), sample.at);
  const float p = this->Rest[n];
  const float v = found.value;
  work.weight[n] = w;
  work.value[n] = v;
  work.slope[n] = found.slope * this->Samples.stepsPerMm * sample.freedom;
  const float numbers[SumsWithoutSecond] = { w, w * p, w * p * p, w * v, w * v * v, w * v * p };
  std::copy(numbers, numbers + SumsWithoutSecond, sums);
  if (this->hasSecond())
  {
    const float g = this->Second[n];
    const float more[Sums - G] = { w * g, w * g * g, w * p * g, w * v * g };
    std::copy(more, more + (Sums - G), sums + G);
  }
}

void LocalFitSimilarity::takeSamples(const std::vector<glm::vec3>& displacements, Work& work)
{
  const LevelSamples& samples = this->Samples;
  const glm::ivec3 sides = samples.rows.samples().dimensions;
  const int numbers = work.rows.numbers;
  samples.visitRows(displacements, [&](const SampleRow& row) {
    const std::size_t first = samples.rows.samples().offset(0, row.j, row.k);
    std::vector<float> sums(static_cast<std::size_t>(sides.x) * numbers, 0.0f);
    const LevelSamples::Stretch& stretch = samples.stretchOf(row.j, row.k);
    samples.visitStretch(row, stretch, [&](const LevelSamples::Compared& sample) {
      this->takeSample(sample, &sums[(sample.number - first) * numbers], work);
    });
    this->Around.gatherRow(sums.data(), sides.x, numbers, work.rows.row(row.j, row.k));
    return false;
  });
  this->Around.gather(work.rows, work.windows);
}

void LocalFitSimilarity::fitWindow(float* numbers, bool counts, double& sum, double& windows) const
{
  const float samples = numbers[Count];
  const float side = static_cast<float>(this->Around.side());
  const float all = side * side * side / (this->IsThin ? SamplesForOne : 1.0f);
  float left[Lefts] = {};
  if (counts && samples > LeastWindow * all)
  {
    const float p = numbers[P] / samples;
    const float v = numbers[V] / samples;
    const float pp = numbers[PP] / samples - p * p + this->Ridge;
    const float vp = numbers[VP] / samples - v * p;
    const float vv = std::max(0.0f, numbers[VV] / samples - v * v);
    float a = vp / pp;
    float b = 0.0f;
    float g = 0.0f;
    float explained = a * vp;
    if (this->hasSecond())
    {
      g = numbers[G] / samples;
      const float gg = numbers[GG] / samples - g * g + this->Ridge;
      const float pg = numbers[PG] / samples - p * g;
      const float vg = numbers[VG] / samples - v * g;
      const float determinant = pp * gg - pg * pg; // above 0 by the ridges
      a = (vp * gg - vg * pg) / determinant;
      b = (vg * pp - vp * pg) / determinant;
      explained = a * vp + b * vg;
    }
    // A window without variance has no information: its cost is 1, whatever moves.
    const float variance = vv + this->LeastVariance;
    const float unexplained = std::max(0.0f, variance - explained);
    sum += unexplained / variance;
    windows += 1.0;
    left[Scale] = 1.0f / (variance * samples);
    left[ScaleA] = left[Scale] * a;
    left[ScaleB] = left[Scale] * b;
    left[ScaleC] = left[Scale] * (v - a * p - b * g);
    left[Loss] = left[Scale] * unexplained / variance;
    left[LossMean] = left[Loss] * v;
  }
  std::copy(left, left + Lefts, numbers);
}

void LocalFitSimilarity::fitWindows(Work& work)
{
  const Grid& grid = this->Samples.rows.samples();
  const glm::ivec3 sides = work.windows.dimensions;
  work.slabSums.assign(sides.z, 0.0);
  work.slabCounts.assign(sides.z, 0.0);
  parallelFor(0, sides.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < sides.y; ++j)
      {
        float* numbers = work.windows.row(j, k);
        const std::size_t middle = grid.offset(0, WindowStride * j, WindowStride * k);
        const char* varies = &this->Varies[(static_cast<std::size_t>(k) * sides.y + j) * sides.x];
        for (int i = 0; i < sides.x; ++i, numbers += work.windows.numbers)
        {
          this->fitWindow(numbers, varies[i] && work.weight[middle + WindowStride * i] > 0.0f,
            work.slabSums[k], work.slabCounts[k]);
        }
      }
    }
  });
  this->Around.spread(work.windows, grid.dimensions, work.lefts);
}

ControlForces LocalFitSimilarity::takeForces(
  const std::vector<glm::vec3>& displacements, const Work& work) const
{
  const LevelSamples& samples = this->Samples;
  const Grid& grid = samples.rows.samples();
  const int numbers = work.lefts.numbers;
  return samples.visitRows(displacements, [&](const SampleRow& row) {
    const LevelSamples::Stretch stretch = samples.stretchOf(row.j, row.k);
    std::vector<float> lefts(static_cast<std::size_t>(grid.dimensions.x) * numbers);
    this->Around.spreadRow(work.lefts.row(row.j, row.k), grid.dimensions.x, numbers, lefts.data());
    for (int i = stretch.first; i < stretch.last; ++i)
    {
      const std::size_t n = grid.offset(i, row.j, row.k);
      const float weight = work.weight[n];
      if (weight <= 0.0f)
      {
        continue;
      }
      const float* left = &lefts[static_cast<std::size_t>(i) * numbers];
      const float secondPart = this->hasSecond() ? left[ScaleB] * this->Second[n] : 0.0f;
      const float down = -weight *
        ((left[Scale] - left[Loss]) * work.value[n] - left[ScaleA] * this->Rest[n] - secondPart -
          left[ScaleC] + left[LossMean]);
      const float curve = weight * left[Scale];
      const glm::vec3& s = work.slope[n];
      const float force[ForceNumbers] = { down * s.x, down * s.y, down * s.z, curve * s.x * s.x,
        curve * s.y * s.y, curve * s.z * s.z, curve * s.x * s.y, curve * s.x * s.z,
        curve * s.y * s.z };
      LatticeRows::add(
        row, samples.rows.tapsAt(0, samples.rows.position(i, row.j, row.k).x), force);
    }
    return true;
  });
}

void LocalFitSimilarity::restrictTo(const HalfSpace& half)
{
  this->Samples.restrictTo(half);
  this->Known = nullptr; // rows that hold no sample any more are zero
}

CostAndForces LocalFitSimilarity::compare(const std::vector<glm::vec3>& displacements)
{
  if (!this->Known)
  {
    const int sums = this->hasSecond() ? Sums : SumsWithoutSecond;
    this->Known = std::make_unique<Work>(this->Samples.rows.samples(), sums);
  }
  Work& work = *this->Known;
  work.clear();
  this->takeSamples(displacements, work);
  this->fitWindows(work);
  CostAndForces result =
    averaged(work.slabSums, work.slabCounts, this->takeForces(displacements, work));
  const double points = this->IsThin ? SamplesForOne : 1.0;
  result.samples = points * std::accumulate(work.weight.begin(), work.weight.end(), 0.0);
  result.possible = points * this->Samples.possible;
  return result;
}

namespace
{
constexpr LocalFit ByVolume{ SecondTerm::None, 3, 1e-4f, true };
constexpr LocalFit ByGradients{ SecondTerm::GradientLength, 2, 1e-4f, true };
constexpr LocalFit BySquare{ SecondTerm::Square, 2, 3e-5f, true, 0.005f };

template <const LocalFit& Fit>
Metric metricOf()
{
  // A position between points is read from all of them.
  const Support support{ 1, 1 };
  return { support, LocalFitSimilarity::BytesPerPoint,
    [](LevelVolumes level, const Lattice& lattice) -> std::unique_ptr<Comparison> {
      return std::make_unique<LocalFitSimilarity>(std::move(level), lattice, Fit);
    } };
}
}

Metric localCorrelationMetric()
{
  return metricOf<ByVolume>();
}

Metric linearFitWithGradients()
{
  return metricOf<ByGradients>();
}

Metric quadraticFitMetric()
{
  return metricOf<BySquare>();
}
}
