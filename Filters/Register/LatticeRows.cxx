// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/LatticeRows.h"

namespace brainshift
{
namespace
{
// Weights for the force and, lumped, for its Hessian; one for each of its numbers, so that the
// compiler makes vector instructions of the sums.
struct TapWeights
{
  float each[ForceNumbers];
};

inline TapWeights tapWeights(const Taps& taps, int tap)
{
  const glm::vec4 sizes = glm::abs(taps.weights);
  const float own = taps.weights[tap];
  const float lumped = sizes[tap] * (sizes.x + sizes.y + sizes.z + sizes.w);
  return { { own, own, own, lumped, lumped, lumped, lumped, lumped, lumped } };
}

inline void addForce(float* to, const float* force, const TapWeights& weights)
{
  for (int n = 0; n < ForceNumbers; ++n)
  {
    to[n] += weights.each[n] * force[n];
  }
}

// The control point of a tap; beyond the lattice the last one holds.
int controlOf(const Taps& taps, int tap, int count)
{
  return std::clamp(taps.first + tap - 1, 0, count - 1);
}
}

LatticeRows::LatticeRows(const Lattice& lattice, const Grid& samples)
  : Samples(samples)
  , Controls(lattice.grid.dimensions)
  , ControlsPerStep(samples.spacing / lattice.grid.spacing)
  , AtFirst(lattice.grid.gridFromWorld(samples.origin))
  , Kernel(lattice.kernel)
{
}

void LatticeRows::add(const SampleRow& row, const Taps& taps, const float* force)
{
  for (int tap = 0; tap < 4; ++tap)
  {
    addForce(row.sums + static_cast<std::size_t>(taps.first + tap) * ForceNumbers, force,
      tapWeights(taps, tap));
  }
}

void LatticeRows::blendSlab(
  const std::vector<glm::vec3>& displacements, int k, std::vector<glm::vec3>& slab) const
{
  const Taps taps = this->tapsAt(2, this->position(0, 0, k).z);
  const std::size_t size = static_cast<std::size_t>(this->Controls.x) * this->Controls.y;
  slab.assign(size, glm::vec3(0.0f));
  for (int tap = 0; tap < 4; ++tap)
  {
    const glm::vec3* from = &displacements[size * controlOf(taps, tap, this->Controls.z)];
    for (std::size_t i = 0; i < size; ++i)
    {
      slab[i] += taps.weights[tap] * from[i];
    }
  }
}

void LatticeRows::blendRow(
  const std::vector<glm::vec3>& slab, int j, int k, std::vector<glm::vec3>& controls) const
{
  const Taps taps = this->tapsAt(1, this->position(0, j, k).y);
  const int count = this->Controls.x;
  controls.assign(count + 2, glm::vec3(0.0f));
  for (int tap = 0; tap < 4; ++tap)
  {
    const glm::vec3* from =
      &slab[static_cast<std::size_t>(count) * controlOf(taps, tap, this->Controls.y)];
    for (int i = 0; i < count; ++i)
    {
      controls[i + 1] += taps.weights[tap] * from[i];
    }
  }
  controls.front() = controls[1];
  controls.back() = controls[count];
}

void LatticeRows::addRow(std::vector<float>& sums, int j, int k, float* slabSums) const
{
  const int count = this->Controls.x;
  for (int n = 0; n < ForceNumbers; ++n)
  {
    sums[ForceNumbers + n] += sums[n];
    sums[count * ForceNumbers + n] += sums[(count + 1) * ForceNumbers + n];
  }
  const Taps taps = this->tapsAt(1, this->position(0, j, k).y);
  for (int tap = 0; tap < 4; ++tap)
  {
    const TapWeights weights = tapWeights(taps, tap);
    float* to = slabSums +
      static_cast<std::size_t>(count) * controlOf(taps, tap, this->Controls.y) * ForceNumbers;
    for (int i = 0; i < count; ++i)
    {
      addForce(to + i * ForceNumbers, &sums[(i + 1) * ForceNumbers], weights);
    }
  }
}

ControlForces LatticeRows::addSlabs(const std::vector<float>& slabs) const
{
  const std::size_t size = this->slabNumbers();
  ControlForces result(size * this->Controls.z, 0.0f);
  // Each piece owns control points, so that no two add to the same one.
  const std::int64_t points = static_cast<std::int64_t>(size / ForceNumbers);
  parallelFor(0, points, 32, [&](std::int64_t begin, std::int64_t end) {
    for (int k = 0; k < this->Samples.dimensions.z; ++k)
    {
      const Taps taps = this->tapsAt(2, this->position(0, 0, k).z);
      for (int tap = 0; tap < 4; ++tap)
      {
        const TapWeights weights = tapWeights(taps, tap);
        float* to = &result[size * controlOf(taps, tap, this->Controls.z)];
        for (std::int64_t i = begin; i < end; ++i)
        {
          addForce(to + i * ForceNumbers, &slabs[size * k + i * ForceNumbers], weights);
        }
      }
    }
  });
  return result;
}

double LatticeRows::bytes(const glm::ivec3& controls, const glm::ivec3& samples)
{
  return sizeof(float) * static_cast<double>(ForceNumbers) * controls.x * controls.y *
    (static_cast<double>(samples.z) + controls.z);
}
}
