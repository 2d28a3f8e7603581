// SPDX-License-Identifier: BSD-3-Clause
// Proves that the stiffness is an energy, that rigid motions have none, that a Newton step
// solves its equations, and that it learns from the last step how the energy curves.
#include "Filters/Register/Stiffness.h"
#include "Filters/Register/LatticeRows.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
Grid controlGrid()
{
  Grid grid;
  grid.dimensions = { 7, 6, 8 };
  grid.spacing = { 9.0, 10.0, 12.0 };
  return grid;
}

std::vector<glm::vec3> scattered(std::size_t count, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<glm::vec3> result(count);
  for (glm::vec3& vector : result)
  {
    vector = { normal(random), normal(random), normal(random) };
  }
  return result;
}

std::vector<glm::vec3> affine(const Grid& grid, const glm::dmat3& by)
{
  std::vector<glm::vec3> result(grid.count());
  for (int k = 0; k < grid.dimensions.z; ++k)
  {
    for (int j = 0; j < grid.dimensions.y; ++j)
    {
      for (int i = 0; i < grid.dimensions.x; ++i)
      {
        result[grid.offset(i, j, k)] = glm::vec3(by * (grid.spacing * glm::dvec3(i, j, k)) + 1.0);
      }
    }
  }
  return result;
}
}

TEST(Stiffness, IsSymmetricAndNeverNegative)
{
  const Grid grid = controlGrid();
  const Stiffness stiffness(grid, 2.0);
  const auto a = scattered(grid.count(), 1);
  const auto b = scattered(grid.count(), 2);
  const double ab = dot(a, stiffness.times(b));
  EXPECT_NEAR(ab, dot(b, stiffness.times(a)), 1e-6 + 1e-5 * std::abs(ab));
  EXPECT_GT(dot(a, stiffness.times(a)), 0.0);
  EXPECT_NEAR(dot(a, Stiffness(grid, 4.0).times(a)), 2.0 * dot(a, stiffness.times(a)), 1e-6);
}

TEST(Stiffness, AStretchCostsItsElasticEnergy)
{
  const Grid grid = controlGrid();
  const Stiffness stiffness(grid, 1.0);
  const double cells = 6.0 * 5.0 * 7.0 / grid.count();
  const auto energy = [&](const glm::dmat3& by) {
    const auto d = affine(grid, by);
    return dot(d, stiffness.times(d));
  };
  EXPECT_NEAR(energy(glm::dmat3(0.0)), 0.0, 1e-9) << "a shift";
  EXPECT_NEAR(energy(glm::dmat3(0, 0.01, 0, -0.01, 0, 0, 0, 0, 0)), 0.0, 1e-9) << "a rotation";
  // Of a stretch by e along x: 2 * shear * e^2 + compression * e^2.
  EXPECT_NEAR(energy(glm::dmat3(0.01, 0, 0, 0, 0, 0, 0, 0, 0)), cells * 0.25e-4, 1e-8);
}

// Bending dominates: half the wavelength costs far more than the 4 times of elasticity.
TEST(Stiffness, AWideBendCostsLittle)
{
  Grid grid;
  grid.dimensions = { 49, 9, 9 };
  grid.spacing = glm::dvec3(10.0);
  const Stiffness stiffness(grid, 1.0);
  const auto energy = [&](double wavelengthMm) {
    std::vector<glm::vec3> wave(grid.count());
    for (std::size_t i = 0; i < wave.size(); ++i)
    {
      const double x = grid.spacing.x * static_cast<double>(i % 49);
      wave[i].z = static_cast<float>(std::sin(2.0 * glm::pi<double>() * x / wavelengthMm));
    }
    return dot(wave, stiffness.times(wave));
  };
  EXPECT_GT(energy(60.0), 8.0 * energy(120.0));
}

namespace
{
glm::mat3 hessianOf(const float* f)
{
  return { f[3], f[6], f[7], f[6], f[4], f[8], f[7], f[8], f[5] };
}

// Forces of a cost whose Hessian is `share` of the lumped one, with displacements d. A third of the
// control points has no sample.
std::vector<float> forcesAt(const std::vector<glm::vec3>& d, float share)
{
  const auto pushes = scattered(d.size(), 4);
  std::vector<float> forces;
  for (std::size_t i = 0; i < d.size(); ++i)
  {
    const float h = i % 3 ? 1e-4f : 0.0f;
    const float numbers[] = { 0, 0, 0, h, 2 * h, 3 * h, 0.5f * h, 0.1f * h, -0.2f * h };
    const glm::vec3 force = share * (hessianOf(numbers) * (pushes[i] - d[i]));
    forces.insert(forces.end(), { force.x, force.y, force.z });
    forces.insert(forces.end(), numbers + 3, numbers + 9);
  }
  return forces;
}

std::vector<glm::vec3> sum(std::vector<glm::vec3> a, float factor, const std::vector<glm::vec3>& b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    a[i] += factor * b[i];
  }
  return a;
}
}

TEST(Stiffness, AStepSolvesItsEquations)
{
  const Grid grid = controlGrid();
  const Stiffness stiffness(grid, 0.3);
  const auto bend = scattered(grid.count(), 3);
  const auto forces = forcesAt(bend, 1.0f);
  const auto pull = pullOf(stiffness, forces, bend);
  const auto step = newtonStep(stiffness, forces, pull);
  // Without a step before, a fixed share of the lumped Hessian counts.
  const auto stiff = stiffness.times(step);
  std::vector<glm::vec3> lumped;
  lumped.reserve(grid.count());
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    lumped.push_back(hessianOf(&forces[i * ForceNumbers]) * step[i]);
  }
  const auto rest = sum(pull, -1.0f, stiff);
  const double share = dot(rest, lumped) / dot(lumped, lumped);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.6);
  const auto left = sum(rest, static_cast<float>(-share), lumped);
  EXPECT_LT(std::sqrt(dot(left, left) / dot(pull, pull)), 0.01);
}

// The lumped Hessian is up to ten times too large. One step tells by how much, so that the next one
// nearly ends at the least energy.
TEST(Stiffness, AStepLearnsFromTheLastOne)
{
  const Grid grid = controlGrid();
  const Stiffness stiffness(grid, 0.3);
  for (const float share : { 0.1f, 0.25f, 0.9f })
  {
    auto bend = scattered(grid.count(), 3);
    auto pull = pullOf(stiffness, forcesAt(bend, share), bend);
    const double before = dot(pull, pull);
    StepTaken last;
    for (int number = 0; number < 2; ++number)
    {
      const auto forces = forcesAt(bend, share);
      const auto step = newtonStep(stiffness, forces, pull, number > 0 ? &last : nullptr);
      bend = sum(bend, 1.0f, step);
      const auto now = pullOf(stiffness, forcesAt(bend, share), bend);
      last = { step, sum(pull, -1.0f, now) };
      pull = now;
    }
    EXPECT_LT(std::sqrt(dot(pull, pull) / before), 0.02) << share;
  }
}
