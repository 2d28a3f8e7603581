// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/DescriptorSimilarity.h"

#include "Filters/Register/SelfSimilarity.h"

#include <cstddef>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int Lanes = 4; // numbers that a processor takes in one step
constexpr int Channels = SelfSimilarityNumbers;
static_assert(Channels % Lanes == 0, "every step is full");

// Sums over the 12 numbers: squared difference, its products with the three slopes, and the
// products of the slopes.
constexpr int Sums = 10;

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

// `rest`: 12 numbers of a sample. `reference`: those of the first of eight neighbours.
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
  float total[Sums];
  for (int s = 0; s < Sums; ++s)
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
}

DescriptorSimilarity::DescriptorSimilarity(const LevelVolumes& level, const Lattice& lattice)
  : Samples(level, lattice)
  , Rest(Samples.read(
      level.restNumbers.empty() ? selfSimilarity(level.rest) : level.restNumbers, Channels))
  , Reference(
      level.referenceNumbers.empty() ? selfSimilarity(level.reference) : level.referenceNumbers)
{
}

Agreement DescriptorSimilarity::compare(const std::vector<glm::vec3>& displacements) const
{
  const LevelSamples& samples = this->Samples;
  const Grid& grid = samples.rows.samples();
  std::vector<double> rowSums(samples.stretches.size(), 0.0);
  std::vector<double> rowWeights(samples.stretches.size(), 0.0);
  ControlForces forces = samples.rows.visitRows(displacements, [&](const SampleRow& row) {
    const std::size_t rowNumber = static_cast<std::size_t>(row.k) * grid.dimensions.y + row.j;
    const LevelSamples::Stretch stretch = samples.stretches[rowNumber];
    samples.visitStretch(row, stretch, [&](const LevelSamples::Place& place) {
      const float weight =
        place.weight * trilinear(samples.referenceWeights.values.data(), place.at).value;
      if (weight > 0.0f)
      {
        float sums[Sums][Lanes] = {};
        compareNumbers(&this->Rest[place.number * Channels],
          &this->Reference[place.at.first * Channels], place.at, sums);
        float force[ForceNumbers];
        rowSums[rowNumber] +=
          weight * forceOf(sums, samples.stepsPerMm, weight, place.freedom, force);
        rowWeights[rowNumber] += weight;
        LatticeRows::add(row, place.taps, force);
      }
    });
    return stretch.first < stretch.last;
  });
  Agreement result = averaged(rowSums, rowWeights, std::move(forces));
  result.possible = samples.possible;
  return result;
}
}
