// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Similarity.h"

#include <numeric>
#include <utility>

namespace brainshift
{
namespace
{
// The weight of a lattice's mask at a position (lattice coordinates), trilinear between its nodes.
float freedomAt(const Lattice& lattice, const glm::vec3& at)
{
  const int perCell = lattice.mask->perCell;
  const glm::ivec3 nodes = (lattice.grid.dimensions - 1) * perCell + 1;
  const glm::vec3 node =
    glm::clamp(at * static_cast<float>(perCell), glm::vec3(0.0f), glm::vec3(nodes - 1));
  return trilinear(lattice.mask->values.data(), neighboursOf(nodes, node)).value;
}
}

void toFractions(std::vector<float>& values, const std::vector<float>& weights)
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
    value = range.fraction(value);
  }
}

std::vector<float> LevelVolumes::brightEdgeRise() const
{
  std::vector<float> values = this->rest.values;
  toFractions(values, this->restWeights.values);
  std::vector<float> edges = gradientLength(this->rest);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    edges[i] *= values[i];
  }
  return riseAlong({ this->rest.grid, std::move(edges) }, this->beam);
}

LevelSamples::LevelSamples(const LevelVolumes& level, const Lattice& lattice)
  : rows(lattice, level.rest.grid)
  , referenceWeights(level.referenceWeights)
  , weights(level.restWeights.values)
  , stepsPerMm(1.0 / level.rest.grid.spacing)
{
  const Grid& grid = level.rest.grid;
  if (lattice.mask)
  {
    this->freedom.resize(grid.count());
  }
  parallelFor(
    0, lattice.mask ? grid.dimensions.z : 0, 1, [&](std::int64_t begin, std::int64_t end) {
      for (int k = static_cast<int>(begin); k < end; ++k)
      {
        for (int j = 0; j < grid.dimensions.y; ++j)
        {
          for (int i = 0; i < grid.dimensions.x; ++i)
          {
            const std::size_t number = grid.offset(i, j, k);
            this->freedom[number] =
              freedomAt(lattice, this->rows.latticePosition(this->rows.position(i, j, k)));
            this->weights[number] *= this->freedom[number] > 0.0f ? 1.0f : 0.0f;
          }
        }
      }
    });
  this->findStretches();
}

void LevelSamples::findStretches()
{
  const int count = this->rows.samples().dimensions.x;
  this->stretches.clear();
  for (std::size_t row = 0; row < this->weights.size(); row += count)
  {
    Stretch stretch{ count, 0 };
    for (int i = 0; i < count; ++i)
    {
      if (this->weights[row + i] > 0.0f)
      {
        stretch = { std::min(stretch.first, i), i + 1 };
      }
    }
    this->stretches.push_back(stretch);
  }
  this->possible = std::accumulate(this->weights.begin(), this->weights.end(), 0.0);
}

void LevelSamples::restrictTo(const HalfSpace& half)
{
  if (this->Unrestricted.empty())
  {
    this->Unrestricted = this->weights;
  }
  const Grid& grid = this->rows.samples();
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < grid.dimensions.y; ++j)
      {
        for (int i = 0; i < grid.dimensions.x; ++i)
        {
          const std::size_t number = grid.offset(i, j, k);
          this->weights[number] =
            half.holds(grid.worldFromGrid({ i, j, k })) ? this->Unrestricted[number] : 0.0f;
        }
      }
    }
  });
  this->findStretches();
}

namespace
{
// The numbers at a position; `Numbers` is an integer, or a constant for vector instructions.
template <typename Numbers>
void readNumbers(const float* values, const Neighbours& at, Numbers numbers, float* to)
{
  std::fill_n(to, static_cast<int>(numbers), 0.0f);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::bvec3 upper(corner & 1, corner & 2, corner & 4);
    const glm::vec3 fractions = glm::mix(1.0f - at.within, at.within, upper);
    const float weight = fractions.x * fractions.y * fractions.z;
    const float* from = values +
      numbers *
        (at.first + (upper.x ? at.next[0] : 0) + (upper.y ? at.next[1] : 0) +
          (upper.z ? at.next[2] : 0));
    for (int n = 0; n < numbers; ++n)
    {
      to[n] += weight * from[n];
    }
  }
}
}

void LevelSamples::readInto(const float* values, int numbers, float* result) const
{
  constexpr std::integral_constant<int, 12> OfSelfSimilarity;
  constexpr std::integral_constant<int, 24> OfItWithEdges;
  const Grid& grid = this->rows.samples();
  const glm::vec3 last(grid.dimensions - 1);
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < grid.dimensions.y; ++j)
      {
        const Stretch& counting = this->stretchOf(j, k);
        for (int i = counting.first; i < counting.last; ++i)
        {
          const std::size_t number = grid.offset(i, j, k);
          if (this->weights[number] <= 0.0f)
          {
            continue;
          }
          const Neighbours at = neighboursOf(
            grid.dimensions, glm::clamp(this->rows.position(i, j, k), glm::vec3(0.0f), last));
          float* to = &result[number * numbers];
          numbers == OfItWithEdges        ? readNumbers(values, at, OfItWithEdges, to)
            : numbers == OfSelfSimilarity ? readNumbers(values, at, OfSelfSimilarity, to)
                                          : readNumbers(values, at, numbers, to);
        }
      }
    }
  });
}

CostAndForces averaged(
  const std::vector<double>& rowSums, const std::vector<double>& rowWeights, ControlForces forces)
{
  CostAndForces result;
  result.samples = std::accumulate(rowWeights.begin(), rowWeights.end(), 0.0);
  result.cost = 1.0; // without a partner, volumes do not agree
  if (result.samples > 0.0)
  {
    result.cost = std::accumulate(rowSums.begin(), rowSums.end(), 0.0) / result.samples;
    const float perSample = static_cast<float>(1.0 / result.samples);
    for (float& force : forces)
    {
      force *= perSample;
    }
  }
  result.forces = std::move(forces);
  return result;
}

}
