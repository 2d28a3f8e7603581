// SPDX-License-Identifier: BSD-3-Clause
// Proves that the refined fields, which pictures are drawn and volumes baked with, agree with the
// maps of single points.
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/PointMap.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int BothKernels[] = { KernelCatmullRom, KernelBSpline };
constexpr double VoxelMm = 1.0;

template <typename Function>
void forEachNode(const FieldNodes& nodes, const Function& function)
{
  std::size_t index = 0;
  for (int k = 0; k < nodes.count.z; ++k)
  {
    for (int j = 0; j < nodes.count.y; ++j)
    {
      for (int i = 0; i < nodes.count.x; ++i, ++index)
      {
        function(nodes.latticeFromNode(glm::vec3(i, j, k)), index);
      }
    }
  }
}

// How far from `deformed` the tissue arrives that the field says is seen there, mm.
double missAt(
  const Lattice& lattice, const PointMap& map, const NodeField& offsets, const glm::vec3& deformed)
{
  const glm::vec3 rest = deformed + offsets.displacement(deformed);
  const glm::dvec3 arrives = map.deformedFromRest(lattice.grid.worldFromGrid(glm::dvec3(rest)));
  return glm::distance(arrives, lattice.grid.worldFromGrid(glm::dvec3(deformed)));
}

double largestMissAtNodes(const Lattice& lattice, const NodeField& offsets)
{
  const PointMap map(lattice);
  double largest = 0.0;
  forEachNode(offsets.nodes, [&](const glm::vec3& deformed, std::size_t) {
    largest = std::max(largest, missAt(lattice, map, offsets, deformed));
  });
  return largest;
}

// Misses at random places that move, smallest first, mm.
std::vector<double> missesBetweenNodes(
  const Lattice& lattice, const NodeField& offsets, unsigned int seed, int points)
{
  const PointMap map(lattice);
  Random random(seed);
  std::vector<double> misses;
  for (int i = 0; i < points; ++i)
  {
    const glm::vec3 node = random.between(glm::dvec3(0.0), glm::dvec3(offsets.nodes.count - 1));
    const glm::vec3 deformed = offsets.nodes.latticeFromNode(node);
    const glm::dvec3 world = lattice.grid.worldFromGrid(glm::dvec3(deformed));
    if (map.deformedFromRest(world) != world)
    {
      misses.push_back(missAt(lattice, map, offsets, deformed));
    }
  }
  std::sort(misses.begin(), misses.end());
  return misses;
}

// The design's reference: 256 x 256 x 150 voxels of 1 mm, 19^3 control points, one stamp.
Lattice referenceCase()
{
  Grid volume = plainGrid({ 256, 256, 150 }, glm::dvec3(VoxelMm));
  Lattice lattice = makeLattice(withDimensions(volume, glm::ivec3(19)), KernelCatmullRom);
  Stroke stamp = strokeAt(Tool::Stamp, { 128.0, 128.0, 110.0 }, { 0.0, 0.0, 20.0 });
  stamp.major = 60.0;
  stamp.minor = 40.0;
  applyStroke(lattice, stamp);
  return lattice;
}
}

TEST(Refine, GivesTheCubicDisplacementAtItsNodes)
{
  for (const int kernel : BothKernels)
  {
    for (const int samples : { 0, 1, 4, 16 })
    {
      const Lattice lattice = randomLattice(obliqueGrid({ 4, 5, 6 }), kernel, 31, 1.0);
      const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
      const NodeField field = refine(lattice.grid, kernel, inCells, samples);
      EXPECT_EQ(field.nodes.count, (lattice.grid.dimensions - 1) * (samples + 1) + 1);
      forEachNode(field.nodes, [&](const glm::vec3& position, std::size_t index) {
        const glm::vec3 known =
          cubicDisplacement(lattice.grid.dimensions, kernel, inCells.data(), glm::dvec3(position));
        EXPECT_LT(glm::distance(field.values[index], known), 1e-5f);
      });
    }
  }
}

glm::mat3 jacobianOf(const NodeField& field, const glm::vec3& lattice)
{
  glm::vec3 displacement;
  glm::mat3 jacobian;
  field.map(lattice, displacement, jacobian);
  EXPECT_LT(glm::distance(displacement, field.displacement(lattice)), 1e-5f);
  return jacobian;
}

TEST(NodeField, IsTrilinearBetweenItsNodes)
{
  NodeField field;
  field.nodes.count = { 3, 2, 2 };
  field.nodes.first = { -1, 2, 0 };
  field.nodes.perCell = 2;
  for (int i = 0; i < 12; ++i)
  {
    const int layer = i / 6;
    field.values.emplace_back(float(i % 3), float(10 * (i / 3 % 2)), float(100 * layer));
  }
  EXPECT_EQ(field.displacement({ -1.0f, 2.0f, 0.0f }), glm::vec3(0, 0, 0));
  EXPECT_EQ(field.displacement({ -0.5f, 2.5f, 0.5f }), glm::vec3(1, 10, 100));
  EXPECT_EQ(field.displacement({ -0.25f, 2.125f, 0.25f }), glm::vec3(1.5, 2.5, 50));
  EXPECT_EQ(field.displacement({ 9.0f, -9.0f, 0.25f }), glm::vec3(2, 0, 50)) << "nearest outside";
  EXPECT_EQ(jacobianOf(field, { -0.25f, 2.125f, 0.25f }), glm::mat3(3, 0, 0, 0, 21, 0, 0, 0, 201));
  EXPECT_EQ(jacobianOf(field, { 9.0f, 2.125f, 0.25f }), glm::mat3(1, 0, 0, 0, 21, 0, 0, 0, 201));
}

TEST(NodeField, KnowsItsDerivatives)
{
  constexpr float H = 1.0f / 256.0f;
  const Lattice lattice = randomLattice(plainGrid({ 4, 5, 6 }, glm::dvec3(1.0)), 0, 32, 1.0);
  const NodeField field = refine(lattice.grid, 0, lattice.displacements, 3);
  Random random(33);
  for (int i = 0; i < 300; ++i)
  {
    // Within one cell of nodes: H is 1/64 of one.
    const glm::dvec3 node =
      glm::floor(random.between(glm::dvec3(0.0), glm::dvec3(field.nodes.count) - 1.0));
    const glm::vec3 position =
      field.nodes.latticeFromNode(node + random.between(glm::dvec3(0.1), glm::dvec3(0.9)));
    const glm::mat3 jacobian = jacobianOf(field, position);
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::vec3 step(0.0f);
      step[axis] = H;
      const glm::vec3 difference =
        step + 0.5f * (field.displacement(position + step) - field.displacement(position - step));
      EXPECT_LT(glm::distance(jacobian[axis], difference / H), 2e-4f);
    }
  }
}

TEST(OffsetField, OfNoDisplacementIsZeroOverTheLattice)
{
  const Lattice lattice = makeLattice(obliqueGrid({ 5, 4, 6 }), KernelCatmullRom);
  const NodeField offsets = offsetField(lattice, 4, Inverse::Exact);
  EXPECT_TRUE(offsets.nodes == forwardNodes(lattice.grid, 4));
  const std::vector<glm::vec3> zero(offsets.values.size(), glm::vec3(0.0f));
  EXPECT_EQ(offsets.values, zero);
}

TEST(OffsetField, UndoesTheRefinedFieldAtItsNodes)
{
  // What is drawn is trilinear between refined nodes both ways; at the nodes of the backward field
  // only the solver's tolerance, 2e-5 cells, and rounding are left.
  for (const int kernel : BothKernels)
  {
    for (unsigned int seed = 200; seed < 206; ++seed)
    {
      const Lattice lattice = randomLatticeWithoutFolds(obliqueGrid({ 6, 5, 7 }), kernel, seed);
      const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
      const NodeField forward = refine(lattice.grid, kernel, inCells, 4);
      const NodeField offsets =
        invert(forward, backwardNodes(lattice.grid, inCells, 4), Inverse::Exact);
      forEachNode(offsets.nodes, [&](const glm::vec3& deformed, std::size_t index) {
        const glm::vec3 rest = deformed + offsets.values[index];
        EXPECT_LT(glm::distance(rest + forward.displacement(rest), deformed), 3e-5f)
          << "kernel " << kernel << " seed " << seed;
      });
    }
  }
}

TEST(OffsetField, NegatedIsMinusTheDisplacement)
{
  const Lattice lattice = randomLatticeWithoutFolds(obliqueGrid({ 6, 5, 7 }), 0, 34);
  const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
  const NodeField forward = refine(lattice.grid, 0, inCells, 4);
  const NodeField offsets = offsetField(lattice, 4, Inverse::Negated);
  forEachNode(offsets.nodes, [&](const glm::vec3& deformed, std::size_t index) {
    EXPECT_EQ(offsets.values[index], -forward.displacement(deformed));
  });
  EXPECT_NE(offsets.values, offsetField(lattice, 4, Inverse::Exact).values);
}

TEST(OffsetField, PutsTissueWhereTheStampSaysAtItsNodes)
{
  const Lattice lattice = referenceCase();
  ASSERT_GT(minimumJacobian(lattice), 0.1);
  const NodeField offsets = offsetField(lattice, 4, Inverse::Exact);
  const double atNodes = largestMissAtNodes(lattice, offsets);
  const std::vector<double> between = missesBetweenNodes(lattice, offsets, 35, 400000);
  const auto above =
    between.end() - std::upper_bound(between.begin(), between.end(), largestErrorMm(VoxelMm));
  const double share = static_cast<double>(above) / static_cast<double>(between.size());
  std::printf(
    "reference case: largest miss %.4f mm at nodes, %.4f mm between, %.2f %% of what moves "
    "above the limit\n",
    atNodes, between.back(), 100.0 * share);
  this->RecordProperty("largestMissAtNodesMm", std::to_string(atNodes));
  this->RecordProperty("largestMissBetweenNodesMm", std::to_string(between.back()));
  EXPECT_LT(atNodes, largestErrorMm(VoxelMm));
  // Between nodes 2.8 mm apart a straight line replaces the curve. So this field misses by more
  // than the limit where the stamp squeezes tissue to 0.4 of its volume. Pictures correct it there
  // (FineCellsTest, FineDrawingTest), and a bake begins from it. The miss must not grow: more of it
  // makes both slower.
  EXPECT_LT(share, 0.03);
  EXPECT_LT(between.back(), 0.3);
}

TEST(OffsetField, ComesCloserWithMoreSamples)
{
  const Lattice lattice = referenceCase();
  double previous = 10.0;                      // mm
  for (const int samples : { 0, 1, 3, 7, 15 }) // each halves the distance between nodes
  {
    const NodeField offsets = offsetField(lattice, samples, Inverse::Exact);
    const double miss = missesBetweenNodes(lattice, offsets, 36, 100000).back();
    EXPECT_LT(miss, 0.5 * previous) << samples << " samples";
    previous = miss;
  }
}

TEST(BackwardNodes, ReachWhereverTissueGoes)
{
  for (const int kernel : BothKernels)
  {
    for (unsigned int seed = 300; seed < 330; ++seed)
    {
      const glm::ivec3 dimensions(4 + seed % 3, 5, 4 + seed % 4);
      const Lattice lattice = randomLattice(obliqueGrid(dimensions), kernel, seed, 2.0);
      const FieldNodes nodes = backwardNodes(lattice.grid, displacementsInCells(lattice), 4);
      const glm::dvec3 low(nodes.first);
      const glm::dvec3 high(
        nodes.latticeFromNode(glm::vec3(nodes.count - 1)) + 1e-4f); // rounding of the position
      const PointMap map(lattice);
      Random random(seed);
      for (int i = 0; i < 4000; ++i)
      {
        glm::dvec3 rest = random.between(glm::dvec3(0.0), glm::dvec3(dimensions - 1));
        const int axis = i % 3;
        if (i % 4 < 2) // on a face
        {
          rest[axis] = i % 4 ? dimensions[axis] - 1 : 0;
        }
        else if (i % 4 == 2) // in a corner
        {
          rest = glm::round(rest / glm::dvec3(dimensions - 1)) * glm::dvec3(dimensions - 1);
        }
        const glm::dvec3 goes =
          lattice.grid.gridFromWorld(map.deformedFromRest(lattice.grid.worldFromGrid(rest)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(goes, low - 1e-4)) &&
          glm::all(glm::lessThanEqual(goes, high)))
          << "kernel " << kernel << " seed " << seed;
      }
    }
  }
}

TEST(BackwardNodes, AreNoMoreThanNeeded)
{
  Lattice lattice = makeLattice(plainGrid({ 6, 7, 8 }, glm::dvec3(10.0)), KernelCatmullRom);
  lattice.displacements[lattice.grid.offset(3, 3, 7)] = { 0.0f, 0.0f, 12.0f };
  const FieldNodes nodes = backwardNodes(lattice.grid, displacementsInCells(lattice), 4);
  EXPECT_EQ(nodes.first, glm::ivec3(0));
  EXPECT_EQ(nodes.count, glm::ivec3(26, 31, 36 + 2 * 5)) << "1.2 cells beyond the top";
}

TEST(BackwardNodes, AreNeverMoreThanAnIntegerCounts)
{
  const Grid grid = plainGrid(glm::ivec3(5), glm::dvec3(10.0));
  std::vector<glm::vec3> inCells(125, glm::vec3(0.0f));
  inCells[62] = { 1e12f, -1e12f, 0.0f };
  const FieldNodes nodes = backwardNodes(grid, inCells, 4);
  EXPECT_EQ(nodes.count.x, (4 + 2 * 20000) * 5 + 1) << "the cubic overshoots to the other side";
  EXPECT_EQ(nodes.first.y, -20000);
  EXPECT_EQ(nodes.count.z, 21);
}

TEST(NodeField, APositionThatIsNoNumberIsWithinTheField)
{
  Grid grid;
  grid.dimensions = glm::ivec3(4);
  const NodeField field = refine(makeLattice(grid, KernelCatmullRom), 2);
  const float none = std::numeric_limits<float>::quiet_NaN();
  glm::vec3 displacement(1.0f);
  glm::mat3 jacobian(0.0f);
  field.map(glm::vec3(none, 1.0f, none), displacement, jacobian);
  EXPECT_EQ(displacement, glm::vec3(0.0f));
  EXPECT_EQ(jacobian, glm::mat3(1.0f));
  EXPECT_EQ(field.displacement(glm::vec3(none)), glm::vec3(0.0f));
}
