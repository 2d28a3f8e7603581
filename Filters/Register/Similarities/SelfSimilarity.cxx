// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Similarities/SelfSimilarity.h"

#include "Filters/Register/Similarities/LocalFitSimilarity.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace brainshift
{
namespace
{
// The local noise is not taken smaller or larger than so many times its mean.
constexpr float LeastNoise = 0.01f;
constexpr float LargestNoise = 1000.0f;

// The six neighbours, two along each axis.
glm::ivec3 neighbour(int number)
{
  glm::ivec3 offset(0);
  offset[number / 2] = number % 2 ? -SelfSimilarityDistance : SelfSimilarityDistance;
  return offset;
}

// The squared difference of two neighbours, added up over a box around each point.
void compare(const Volume& volume, const glm::ivec3& a, const glm::ivec3& b, Volume& sums)
{
  const Grid& grid = volume.grid;
  const glm::ivec3 last = grid.dimensions - 1;
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j <= last.y; ++j)
      {
        const auto row = [&](const glm::ivec3& offset) {
          return &volume.values[grid.offset(
            0, std::clamp(j + offset.y, 0, last.y), std::clamp(k + offset.z, 0, last.z))];
        };
        const float* fromA = row(a);
        const float* fromB = row(b);
        float* to = &sums.values[grid.offset(0, j, k)];
        const auto atBorder = [&](int i) {
          const float difference =
            fromA[std::clamp(i + a.x, 0, last.x)] - fromB[std::clamp(i + b.x, 0, last.x)];
          to[i] = difference * difference;
        };
        const int first = std::min(-std::min({ 0, a.x, b.x }), last.x + 1);
        const int end = std::max(last.x + 1 - std::max({ 0, a.x, b.x }), first);
        for (int i = 0; i < first; ++i)
        {
          atBorder(i);
        }
        for (int i = first; i < end; ++i) // without limits, so that vectors of numbers are taken
        {
          const float difference = fromA[i + a.x] - fromB[i + b.x];
          to[i] = difference * difference;
        }
        for (int i = end; i <= last.x; ++i)
        {
          atBorder(i);
        }
      }
    }
  });
  boxSum(sums, glm::ivec3(SelfSimilarityRadius));
}

// e to a power of at most 0, to 2e-7 of it: the rounding of single precision. Below -80 it is that
// of -80, which is 2e-35; of NaN it is NaN. Without a branch or a call, so that vectors of numbers
// are taken.
float expOf(float power)
{
  constexpr float LeastPower = -80.0f;
  constexpr float Log2OfE = 1.44269504f;
  constexpr float ToWhole = 12582912.0f; // 1.5 * 2^23: after a sum with it a number is whole
  constexpr std::int32_t OneBits = 0x3f800000;
  constexpr int ExponentBit = 23;
  const float limited = std::max(power, LeastPower);          // NaN stays
  const float twos = Log2OfE * std::max(LeastPower, limited); // of NaN that of the least
  const float shifted = twos + ToWhole;
  const float whole = shifted - ToWhole;
  const float part = twos - whole; // -0.5 to 0.5
  // The series of 2^part = e^(part * log 2).
  const float series = 1.0f +
    part *
      (0.693147181f +
        part *
          (0.240226507f +
            part *
              (0.0555041087f +
                part * (0.00961812911f + part * (0.00133335581f + part * 0.000154035304f)))));
  const std::int32_t bits = OneBits + static_cast<std::int32_t>(whole) * (1 << ExponentBit);
  float scale;
  std::memcpy(&scale, &bits, sizeof(scale));
  return series * scale + (limited - limited); // 0, or NaN
}

// Turns sums of squares into numbers from 0 to 1, where 1 is the most alike pair.
void normalise(float* numbers, float meanNoise)
{
  float sum = 0.0f;
  float least = numbers[0];
  for (int pair = 0; pair < SelfSimilarityNumbers; ++pair)
  {
    sum += numbers[pair];
    least = std::min(least, numbers[pair]);
  }
  const float noise =
    std::clamp(sum / SelfSimilarityNumbers, LeastNoise * meanNoise, LargestNoise * meanNoise);
  const float perNoise = noise >= std::numeric_limits<float>::min() ? 1.0f / noise : 0.0f;
  for (int pair = 0; pair < SelfSimilarityNumbers; ++pair)
  {
    numbers[pair] = expOf((least - numbers[pair]) * perNoise);
  }
}

// The pairs of neighbours, but for those across the middle: they would compare it with itself where
// the volume is symmetric.
std::vector<glm::ivec2> neighbourPairs()
{
  std::vector<glm::ivec2> pairs;
  for (int a = 0; a < 6; ++a)
  {
    for (int b = a + 1; b < 6; ++b)
    {
      if (a / 2 != b / 2)
      {
        pairs.emplace_back(a, b);
      }
    }
  }
  return pairs;
}
}

UnsetVector<float> selfSimilarity(const Volume& volume)
{
  constexpr int Group = 4; // pairs that are stored at once: memory is passed through less often
  const std::int64_t count = static_cast<std::int64_t>(volume.values.size());
  UnsetVector<float> result(volume.values.size() * SelfSimilarityNumbers);
  std::array<Volume, Group> sums;
  sums.fill({ volume.grid, std::vector<float>(volume.values.size()) });
  const std::int64_t slab = static_cast<std::int64_t>(volume.grid.offset(0, 0, 1));
  std::vector<double> slabSums(volume.grid.dimensions.z, 0.0);
  const std::vector<glm::ivec2> pairs = neighbourPairs();
  for (int first = 0; first < SelfSimilarityNumbers; first += Group)
  {
    for (int n = 0; n < Group; ++n)
    {
      const glm::ivec2 pair = pairs[first + n];
      compare(volume, neighbour(pair.x), neighbour(pair.y), sums[n]);
    }
    parallelFor(0, volume.grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t k = begin; k < end; ++k)
      {
        for (std::int64_t i = k * slab; i < (k + 1) * slab; ++i)
        {
          float* to = &result[i * SelfSimilarityNumbers + first];
          for (int n = 0; n < Group; ++n)
          {
            to[n] = sums[n].values[i];
            slabSums[k] += to[n];
          }
        }
      }
    });
  }
  const double all = std::accumulate(slabSums.begin(), slabSums.end(), 0.0);
  const float meanNoise = static_cast<float>(all / result.size());
  parallelFor(0, count, 1000, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      normalise(&result[i * SelfSimilarityNumbers], meanNoise);
    }
  });
  return result;
}

namespace
{
constexpr int Lanes = 4; // numbers that a processor takes in one step
static_assert(SelfSimilarityNumbers % Lanes == 0, "every step is full");

// Sums over all numbers of a point: squared difference, its products with the three slopes, and the
// products of the slopes.
constexpr int SumsOfPoint = 10;

// Adds the products of Lanes channels. The compiler turns each line into one instruction.
inline void addProducts(
  const float* difference, const float* x, const float* y, const float* z, float sums[][Lanes])
{
  for (int n = 0; n < Lanes; ++n)
  {
    sums[0][n] += difference[n] * difference[n];
    sums[1][n] += x[n] * difference[n];
    sums[2][n] += y[n] * difference[n];
    sums[3][n] += z[n] * difference[n];
    sums[4][n] += x[n] * x[n];
    sums[5][n] += y[n] * y[n];
    sums[6][n] += z[n] * z[n];
    sums[7][n] += x[n] * y[n];
    sums[8][n] += x[n] * z[n];
    sums[9][n] += y[n] * z[n];
  }
}

// `rest`: the numbers of a sample. `reference`: those of the first of eight neighbours.
template <int Channels>
void compareNumbers(
  const float* rest, const float* reference, const Neighbours& at, float sums[][Lanes])
{
  const std::size_t x = at.next[0] * Channels;
  const std::size_t y = at.next[1] * Channels;
  const std::size_t z = at.next[2] * Channels;
  const glm::vec3 t = at.within;
  for (int channel = 0; channel < Channels; channel += Lanes)
  {
    const float* v = reference + channel;
    float difference[Lanes];
    float slopeX[Lanes];
    float slopeY[Lanes];
    float slopeZ[Lanes];
    for (int n = 0; n < Lanes; ++n)
    {
      const float d00 = v[x + n] - v[n];
      const float d10 = v[x + y + n] - v[y + n];
      const float d01 = v[x + z + n] - v[z + n];
      const float d11 = v[x + y + z + n] - v[y + z + n];
      const float v00 = v[n] + t.x * d00;
      const float v10 = v[y + n] + t.x * d10;
      const float v01 = v[z + n] + t.x * d01;
      const float v11 = v[y + z + n] + t.x * d11;
      const float d0 = d00 + t.y * (d10 - d00);
      const float d1 = d01 + t.y * (d11 - d01);
      const float low = v00 + t.y * (v10 - v00);
      const float high = v01 + t.y * (v11 - v01);
      slopeX[n] = d0 + t.z * (d1 - d0);
      slopeY[n] = (v10 - v00) + t.z * ((v11 - v01) - (v10 - v00));
      slopeZ[n] = high - low;
      difference[n] = rest[channel + n] - (low + t.z * slopeZ[n]);
    }
    addProducts(difference, slopeX, slopeY, slopeZ, sums);
  }
}

// The force of a sample (LatticeRows.h) and, returned, its squared difference.
float forceOf(
  const float sums[][Lanes], const glm::vec3& stepsPerMm, float weight, float freedom, float* force)
{
  float total[SumsOfPoint];
  for (int s = 0; s < SumsOfPoint; ++s)
  {
    total[s] = sums[s][0] + sums[s][1] + sums[s][2] + sums[s][3];
  }
  const glm::vec3 slope = stepsPerMm * freedom;
  for (int a = 0; a < 3; ++a)
  {
    force[a] = weight * total[1 + a] * slope[a];
    force[3 + a] = weight * total[4 + a] * slope[a] * slope[a];
  }
  force[6] = weight * total[7] * slope.x * slope.y;
  force[7] = weight * total[8] * slope.x * slope.z;
  force[8] = weight * total[9] * slope.y * slope.z;
  return total[0];
}

// Where the two volumes have edges.
std::vector<float> edgesOf(const LevelVolumes& level, bool isReference)
{
  if (level.beam == glm::dvec3(0.0))
  {
    return gradientLength(isReference ? level.reference : level.rest);
  }
  return isReference ? level.echoRise() : level.edgeRise();
}

// The numbers of each point of a volume; with `Images` 2, also those of its edges.
template <int Images>
UnsetVector<float> numbersOf(const LevelVolumes& level, bool isReference)
{
  const Volume& volume = isReference ? level.reference : level.rest;
  UnsetVector<float> numbers = selfSimilarity(volume);
  if constexpr (Images == 2)
  {
    const UnsetVector<float> more = selfSimilarity({ volume.grid, edgesOf(level, isReference) });
    UnsetVector<float> both(2 * numbers.size());
    const std::size_t points = volume.values.size();
    for (std::size_t i = 0; i < points; ++i)
    {
      float* to = &both[2 * i * SelfSimilarityNumbers];
      to = std::copy_n(&numbers[i * SelfSimilarityNumbers], SelfSimilarityNumbers, to);
      std::copy_n(&more[i * SelfSimilarityNumbers], SelfSimilarityNumbers, to);
    }
    return both;
  }
  return numbers;
}

// A sample counts by g / (g + this times the median of g), where g is the volume's steepness.
// Where tissue is flat, its numbers come from the noise.
constexpr float SteepShare = 3.0f;

std::vector<float> importanceOf(const LevelVolumes& level)
{
  std::vector<float> steepness = gradientLength(level.rest);
  std::vector<float> counting;
  for (std::size_t i = 0; i < steepness.size(); ++i)
  {
    if (level.restWeights.values[i] > 0.0f)
    {
      counting.push_back(steepness[i]);
    }
  }
  if (counting.empty())
  {
    return steepness;
  }
  const auto middle = counting.begin() + static_cast<std::ptrdiff_t>(counting.size() / 2);
  std::nth_element(counting.begin(), middle, counting.end());
  const float least = SteepShare * *middle;
  for (float& value : steepness)
  {
    value = value + least > 0.0f ? value / (value + least) : 1.0f;
  }
  return steepness;
}

// Numbers of neighbouring samples are alike. So a comparison may take one in so many: in 4, those
// whose indices are all even or all odd; in 8, those whose indices are all even.
void thinOut(LevelSamples& samples, int oneIn)
{
  const glm::ivec3 sides = samples.rows.samples().dimensions;
  std::size_t number = 0;
  for (int k = 0; k < sides.z; ++k)
  {
    for (int j = 0; j < sides.y; ++j)
    {
      for (int i = 0; i < sides.x; ++i, ++number)
      {
        const bool isAlike = (i - k) % 2 == 0 && (j - k) % 2 == 0;
        samples.weights[number] *= isAlike && (oneIn == 4 || k % 2 == 0) ? 1.0f : 0.0f;
      }
    }
  }
  samples.findStretches();
}

// A quick comparison takes one in 8 only if so many are left: a few samples tell too little about
// what leaves a sweep.
constexpr double LeastOfEighth = 2000.0;

// Mean squared difference of the numbers of both volumes, added up over 12. With two images,
// samples count by their importance.
// It takes one sample in OneIn.
template <int Images, int OneIn>
class SelfSimilarity : public Comparison
{
public:
  static constexpr int Channels = Images * SelfSimilarityNumbers;

  /** For each point of a level: four times its numbers while it is prepared, and weights. */
  static constexpr double BytesPerPoint = 16.0 + 4.0 * sizeof(float) * (Channels + Images - 1);

  SelfSimilarity(LevelVolumes level, const Lattice& lattice)
    : Level(std::move(level))
    , Over(lattice)
  {
  }

  bool prepare() override
  {
    if (this->Reference.empty())
    {
      this->Reference = numbersOf<Images>(this->Level, true);
    }
    else if (this->Rest.empty())
    {
      this->Rest = numbersOf<Images>(this->Level, false);
    }
    else if (!this->Samples)
    {
      this->Samples = std::make_unique<LevelSamples>(this->Level, this->Over);
      if constexpr (OneIn > 1)
      {
        thinOut(*this->Samples, OneIn);
      }
      this->Rest = this->Samples->read(this->Rest, Channels);
      if constexpr (Images == 2)
      {
        this->Importance = this->Samples->read(importanceOf(this->Level), 1);
        if (this->Samples->possible >= 2.0 * LeastOfEighth)
        {
          this->Quick = std::make_unique<LevelSamples>(*this->Samples);
          thinOut(*this->Quick, 2 * OneIn);
        }
      }
      this->Level = {};
      this->Over = {};
    }
    return this->Samples != nullptr;
  }

  CostAndForces compare(const std::vector<glm::vec3>& displacements) override;
  void restrictTo(const HalfSpace& half) override
  {
    this->Samples->restrictTo(half);
    if (this->Quick)
    {
      this->Quick->restrictTo(half);
    }
  }
  void take(Part part) override { this->IsQuickest = part == Part::Quickest; }

private:
  LevelVolumes Level; // while it is prepared
  Lattice Over;       // the same
  std::unique_ptr<LevelSamples> Samples;
  std::unique_ptr<LevelSamples> Quick; // half of them; null: there are too few
  bool IsQuickest = false;
  UnsetVector<float> Rest;       // at the samples that count; while it is prepared, at the points
  UnsetVector<float> Reference;  // at the points
  std::vector<float> Importance; // of the samples; empty: 1 everywhere
};

template <int Images, int OneIn>
CostAndForces SelfSimilarity<Images, OneIn>::compare(const std::vector<glm::vec3>& displacements)
{
  const bool isHalf = this->IsQuickest && this->Quick;
  const LevelSamples& samples = isHalf ? *this->Quick : *this->Samples;
  const Grid& grid = samples.rows.samples();
  std::vector<double> rowSums(samples.stretches.size(), 0.0);
  std::vector<double> rowWeights(samples.stretches.size(), 0.0);
  std::vector<double> rowCounts(samples.stretches.size(), 0.0);
  ControlForces forces = samples.visitRows(displacements, [&](const SampleRow& row) {
    const std::size_t rowNumber = static_cast<std::size_t>(row.k) * grid.dimensions.y + row.j;
    samples.visitStretch(
      row, samples.stretchOf(row.j, row.k), [&](const LevelSamples::Compared& sample) {
        const float counted =
          sample.weight * trilinear(samples.referenceWeights.values.data(), sample.at).value;
        const float weight = Images == 2 ? counted * this->Importance[sample.number] : counted;
        if (weight > 0.0f)
        {
          float sums[SumsOfPoint][Lanes] = {};
          compareNumbers<Channels>(&this->Rest[sample.number * Channels],
            &this->Reference[sample.at.first * Channels], sample.at, sums);
          float force[ForceNumbers];
          rowSums[rowNumber] += weight / Images *
            forceOf(sums, samples.stepsPerMm, weight / Images, sample.freedom, force);
          rowWeights[rowNumber] += weight;
          rowCounts[rowNumber] += counted;
          LatticeRows::add(row, sample.taps, force);
        }
      });
    return true;
  });
  CostAndForces result = averaged(rowSums, rowWeights, std::move(forces));
  const double factor = isHalf ? 2.0 * OneIn : OneIn; // points for each sample
  result.samples = factor * std::accumulate(rowCounts.begin(), rowCounts.end(), 0.0);
  result.possible = factor * samples.possible;
  return result;
}

template <int Images, int OneIn>
std::unique_ptr<Comparison> made(LevelVolumes level, const Lattice& lattice)
{
  return std::make_unique<SelfSimilarity<Images, OneIn>>(std::move(level), lattice);
}

const Metric SelfSimilarityMetric = selfSimilarityMetric();
const Metric ThinSelfSimilarity = thinSelfSimilarity();

// Where contrasts differ or slices are thick, self-similarity is least 0.4 to 0.6 mm beside the
// right position. The local fit has no such bias, but finds positions from nearby only.
const Metric QuadraticFit = quadraticFitMetric();

constexpr double Converged = 2e-3; // a smaller gain comes from the noise

// Coarse levels find what is wide. The last one begins nearly right, and may follow bends that are
// narrow: it is a factor on the other.
constexpr double CoarseStiffness = 1.5;
constexpr double LastStiffness = 0.75;
constexpr double LastMm = 1.45;
}

namespace
{
// A position between points is read from all of them; a gradient, from both sides of its point. An
// edge is the gradient of a gradient.
constexpr Support PlainSupport{ SelfSimilaritySupport.along + 1, SelfSimilaritySupport.across + 1 };
constexpr Support EdgeSupport{ PlainSupport.along + 2, PlainSupport.across + 2 };
}

Descriptor selfSimilarityDescriptor()
{
  return { SelfSimilaritySupport, SelfSimilarityNumbers, &selfSimilarity };
}

Metric selfSimilarityMetric()
{
  return { PlainSupport, SelfSimilarity<1, 1>::BytesPerPoint, &made<1, 1> };
}

Metric thinSelfSimilarity()
{
  return { PlainSupport, SelfSimilarity<1, 4>::BytesPerPoint, &made<1, 4> };
}

Metric thinSelfSimilarityWithEdges()
{
  return { EdgeSupport, SelfSimilarity<2, 4>::BytesPerPoint, &made<2, 4> };
}

Similarity describeSelfSimilarity()
{
  Similarity result;
  result.name = "auto";
  result.label = "Auto (any contrast)";
  result.tooltip =
    "For volumes of any contrast. Compares self-similarity (SSC), and at the end how well a "
    "parabola of the volume's values explains the reference in small windows.";
  result.plan.levels = { { &SelfSimilarityMetric, 4.0 }, { &ThinSelfSimilarity, 2.0 },
    { &QuadraticFit, LastMm, 1.0, false, true, 1, LastStiffness } };
  result.plan.stiffness = CoarseStiffness;
  result.plan.converged = Converged;
  result.plan.check.halves = { &SelfSimilarityMetric, 4.0, 1.0, true };
  result.plan.check.other = { &QuadraticFit, 4.0, 1.0, true };
  result.plan.check.blocks = selfSimilarityDescriptor();
  result.plan.check.halvesMm = 3.5; // 3.05 mm in a right pair of T1 and T2 in slices of 2.7 mm
  return result;
}
}
