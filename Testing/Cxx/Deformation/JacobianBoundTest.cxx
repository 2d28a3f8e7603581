// SPDX-License-Identifier: BSD-3-Clause
// Proves that bounds on the Jacobian determinant are below it everywhere in a cell, and near it.
#include "Filters/Deformation/JacobianBound.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/OffsetField.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// The middle cell of 4 x 4 x 4 control points displaced by up to `cells`.
struct Cell
{
  Lattice lattice;
  CellTaps taps;

  Cell(int kernel, unsigned int seed, double cells)
    : lattice(randomLattice(plainGrid(glm::ivec3(4), glm::dvec3(1.0)), kernel, seed, cells))
  {
    for (int tap = 0; tap < 64; ++tap)
    {
      for (int component = 0; component < 3; ++component)
      {
        this->taps.component[component][tap] = this->lattice.displacements[tap][component];
      }
    }
  }

  // On 13 x 13 x 13 points of the cell.
  double smallest() const
  {
    double result = 1e30;
    for (int i = 0; i < 13 * 13 * 13; ++i)
    {
      const glm::dvec3 at = 1.0 + glm::dvec3(i % 13, i / 13 % 13, i / 169) / 12.0;
      const glm::mat3 jacobian = glm::mat3(1.0f) +
        cubicGradient(glm::ivec3(4), this->lattice.kernel, this->lattice.displacements.data(), at);
      result = std::min(result, double(glm::determinant(jacobian)));
    }
    return result;
  }

  // Of what is trilinear between the cell's own corners.
  NodeField corners() const { return refine(this->lattice, 0); }
};

double smallestOf(const NodeField& field)
{
  double result = 1e30;
  for (int i = 0; i < 9 * 9 * 9; ++i)
  {
    glm::vec3 unused;
    glm::mat3 jacobian;
    field.map(
      1.0f + 1e-4f + glm::vec3(i % 9, i / 9 % 9, i / 81) * (0.9998f / 8.0f), unused, jacobian);
    result = std::min(result, double(glm::determinant(jacobian)));
  }
  return result;
}
}

TEST(JacobianBound, IsBelowEveryDeterminant)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    for (unsigned int seed = 0; seed < 300; ++seed)
    {
      const Cell cell(kernel, seed, 0.02 + 0.002 * seed);
      const ColumnBounds bounds = boundsOf(cell.taps, kernel);
      EXPECT_LE(leastDeterminant(bounds), cell.smallest() + 1e-5);
      EXPECT_LE(leastDeterminant(bounds), smallestOf(cell.corners()) + 1e-4);
    }
  }
}

TEST(JacobianBound, ProvesWhatIsSoAndNothingElse)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    for (unsigned int seed = 0; seed < 100; ++seed)
    {
      const Cell cell(kernel, seed, 0.05 + 0.005 * seed);
      const auto smallest = static_cast<float>(cell.smallest());
      EXPECT_FALSE(cubicHolds(cell.taps, kernel, smallest + 1e-4f)) << seed;
      EXPECT_TRUE(cubicHolds(cell.taps, kernel, smallest - 0.03f)) << seed;
      std::array<glm::vec3, 8> corners;
      for (int corner = 0; corner < 8; ++corner)
      {
        corners[corner] =
          cell.corners().values[21 + (corner & 1) + 4 * (corner >> 1 & 1) + 16 * (corner >> 2)];
      }
      const auto least = static_cast<float>(smallestOf(cell.corners()));
      EXPECT_FALSE(trilinearHolds(corners, 1, least + 1e-3f)) << seed;
      EXPECT_TRUE(trilinearHolds(corners, 1, least - 0.03f)) << seed;
    }
  }
}

TEST(JacobianBound, KnowsWhatAMaskDoes)
{
  // Weights rise along x from 0.2 to 0.7 across the cell.
  const WeightRange weights{ 0.2f, 0.7f, { 0.5f, 0.0f, 0.0f }, { 0.5f, 0.0f, 0.0f } };
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    for (unsigned int seed = 0; seed < 100; ++seed)
    {
      const Cell cell(kernel, seed, 0.3);
      NodeField masked = cell.corners();
      for (std::size_t node = 0; node < masked.values.size(); ++node)
      {
        masked.values[node] *= node % 4 == 1 ? 0.2f : 0.7f;
      }
      EXPECT_LE(
        leastDeterminant(maskedBoundsOf(cell.taps, kernel, weights)), smallestOf(masked) + 1e-4);
    }
  }
}

TEST(HoldFace, MakesTheDisplacementThatOfTheFace)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    Cell cell(kernel, 5, 0.5);
    const glm::vec3 face = cubicDisplacement(
      glm::ivec3(4), kernel, cell.lattice.displacements.data(), { 1.3, 2.0, 1.6 });
    holdFace(cell.taps, kernel, 1, 1);
    for (int tap = 0; tap < 64; ++tap)
    {
      for (int component = 0; component < 3; ++component)
      {
        cell.lattice.displacements[tap][component] = cell.taps.component[component][tap];
      }
    }
    for (const double y : { 1.0, 1.4, 2.0 })
    {
      const glm::vec3 held = cubicDisplacement(
        glm::ivec3(4), kernel, cell.lattice.displacements.data(), { 1.3, y, 1.6 });
      EXPECT_LT(glm::distance(held, face), 1e-5f);
    }
  }
}

TEST(LeastDeterminant, KnowsColumnsThatAllChange)
{
  // Columns that can be the unit vectors or their negatives: the determinant can be -1.
  ColumnBounds columns;
  for (int column = 0; column < 3; ++column)
  {
    columns.middle[column] = glm::vec3(0.0f);
    columns.slope[column] = glm::mat3(0.0f);
    columns.rest[column] = glm::vec3(0.0f);
    columns.rest[column][column] = 1.0f;
  }
  EXPECT_EQ(leastDeterminant(columns), -1.0f);
  // Of random bounds, at the ends of all rests.
  Random random(3);
  for (int i = 0; i < 200; ++i)
  {
    for (int column = 0; column < 3; ++column)
    {
      columns.middle[column] = glm::vec3(random.between(glm::dvec3(-0.3), glm::dvec3(0.3)));
      columns.rest[column] = glm::vec3(random.between(glm::dvec3(0.0), glm::dvec3(2.0)));
    }
    const float least = leastDeterminant(columns);
    for (int signs = 0; signs < 512; ++signs)
    {
      glm::mat3 matrix;
      for (int number = 0; number < 9; ++number)
      {
        const int column = number / 3;
        const float rest = columns.rest[column][number % 3];
        matrix[column][number % 3] =
          columns.middle[column][number % 3] + (signs >> number & 1 ? rest : -rest);
      }
      EXPECT_GE(glm::determinant(matrix), least - 1e-4f) << i;
    }
  }
}
