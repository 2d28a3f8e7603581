// SPDX-License-Identifier: BSD-3-Clause
// Proves that with a mask only what is inside moves: nothing outside it does, by any amount;
// nothing of it is seen inside; and the rim does not fold.
#include "Filters/Deformation/MaskWeights.h"
#include "Filters/Deformation/ControlPoints.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Deformation/Replay.h"
#include "Testing/Cxx/Deformation/TestHead.h"

#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;
using namespace brainshift::testing;
using namespace brainshift::testing::head;

namespace
{
// The voxels of a grid that are brain.
Mask brainOn(const Grid& grid)
{
  Mask mask{ grid, std::vector<char>(grid.count()) };
  for (std::size_t offset = 0; offset < grid.count(); ++offset)
  {
    const glm::dvec3 voxel(indexOf(grid, offset));
    mask.inside[offset] = labelAt(grid.worldFromGrid(voxel)) == Brain;
  }
  return mask;
}

// Whether a point lies in a voxel that is inside.
bool isInside(const Mask& mask, const glm::dvec3& world)
{
  const glm::ivec3 voxel(glm::floor(mask.grid.gridFromWorld(world) + 0.5));
  return mask.inside[mask.grid.offset(voxel.x, voxel.y, voxel.z)] != 0;
}

Lattice maskedLattice(const Mask& mask, double feather, int kernel = KernelCatmullRom)
{
  Lattice lattice = makeLattice(withDimensions(VolumeGrid, glm::ivec3(12)), kernel);
  lattice.mask = maskWeights(lattice.grid, Samples, mask, feather);
  return lattice;
}

class MaskOnGrid : public ::testing::TestWithParam<bool>
{
protected:
  Mask Inside = brainOn(GetParam() ? obliqueMaskGrid() : VolumeGrid);
};
}

TEST_P(MaskOnGrid, NothingOutsideMoves)
{
  Lattice lattice = maskedLattice(this->Inside, 4.0);
  std::fill(lattice.displacements.begin(), lattice.displacements.end(), glm::vec3(30, -20, 25));
  const NodeField field = refine(lattice, Samples);
  const PointMap map(lattice);
  Random random(31);
  int outside = 0;
  double largest = 0.0;
  for (int i = 0; i < 200000; ++i)
  {
    const glm::dvec3 rest = random.point(VolumeGrid, 0.0);
    const glm::vec3 moved = field.displacement(glm::vec3(lattice.grid.gridFromWorld(rest)));
    if (!isInside(this->Inside, rest))
    {
      ++outside;
      EXPECT_EQ(moved, glm::vec3(0.0f));
      EXPECT_EQ(map.deformedFromRest(rest), rest);
    }
    largest = std::max(largest, glm::distance(map.deformedFromRest(rest), rest));
  }
  EXPECT_GT(outside, 20000);
  EXPECT_NEAR(largest, glm::length(glm::vec3(30, -20, 25)), 1e-3) << "deep inside all of it moves";
  EXPECT_EQ(map.deformedFromRest({ -50.0, 36.0, 32.0 }), glm::dvec3(-50.0, 36.0, 32.0));
}

TEST_P(MaskOnGrid, TheRimDoesNotFoldAndKeepsWhatIsInside)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    Replay replay;
    const Lattice& bent = replay.run(
      maskedLattice(this->Inside, 5.0, kernel), strongStrokes(33, 16), { true, Samples });
    EXPECT_GT(maximumDisplacement(bent), 2.0);
    EXPECT_GT(minimumJacobian(bent), 0.1 - DeterminantTolerance);
    const PointMap map(bent);
    Random random(32);
    for (int i = 0; i < 50000; ++i)
    {
      const glm::dvec3 rest = random.point(VolumeGrid, 0.0);
      const glm::dvec3 goes = map.deformedFromRest(rest);
      EXPECT_EQ(isInside(this->Inside, goes), isInside(this->Inside, rest));
      EXPECT_EQ(isInside(this->Inside, map.restFromDeformed(rest)), isInside(this->Inside, rest));
      EXPECT_LT(glm::distance(map.restFromDeformed(goes), rest), 2e-3);
      EXPECT_GT(glm::determinant(map.jacobian(rest)), 0.1 - 5e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, MaskOnGrid, ::testing::Values(false, true));

TEST(MaskWeights, RiseOverTheFeather)
{
  // Inside: x from 1.5 to 8.5 cells of 10 mm. Nodes every 2 mm: the first that may move lies at 18,
  // the last that may not at 16.
  Mask mask{ plainGrid({ 10, 3, 3 }, { 10.0, 50.0, 50.0 }), std::vector<char>(90, 1) };
  mask.grid.origin = { 0.0, -5.0, -5.0 };
  for (std::size_t voxel = 0; voxel < 90; ++voxel)
  {
    mask.inside[voxel] = voxel % 10 > 1 && voxel % 10 < 9;
  }
  const Grid lattice = plainGrid(glm::ivec3(10), glm::dvec3(10.0));
  const auto weights = maskWeights(lattice, 4, mask, 20.0);
  const int side = 46;
  ASSERT_EQ(weights->values.size(), std::size_t(side * side * side));
  const auto at = [&](int x) { return weights->values[(22 * side + 22) * side + x]; };
  EXPECT_EQ(at(8), 0.0f);
  EXPECT_NEAR(at(9), 0.1 * 0.1 * 2.8, 1e-6);
  EXPECT_NEAR(at(13), 0.5, 1e-6);
  EXPECT_EQ(at(18), 1.0f);
  EXPECT_EQ(at(30), 1.0f);
  EXPECT_EQ(at(42), 0.0f) << "84 mm, and 85 is the edge";
  EXPECT_GT(at(41), 0.0f);
  EXPECT_EQ(weights->values[(22 * side + 0) * side + 22], 0.0f) << "the volume's border";
  const auto hard = maskWeights(lattice, 4, mask, 0.0);
  EXPECT_EQ(hard->values[(22 * side + 22) * side + 8], 0.0f);
  EXPECT_EQ(hard->values[(22 * side + 22) * side + 9], 1.0f);
}

TEST(MaskWeights, RiseEquallyFarAlongEachAxis)
{
  // Nodes every 2, 1 and 4 mm. Inside is what lies above 40 mm along one axis.
  const Grid lattice = plainGrid(glm::ivec3(12), { 10.0, 5.0, 20.0 });
  const glm::dvec3 spacing = lattice.spacing / 5.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    Mask mask{ plainGrid(glm::ivec3(3), glm::dvec3(400.0)), std::vector<char>(27, 1) };
    mask.grid.origin = glm::dvec3(-400.0);
    mask.grid.origin[axis] = -160.0; // the first voxel ends at 40 mm
    for (std::size_t voxel = 0; voxel < 27; ++voxel)
    {
      mask.inside[voxel] = indexOf(mask.grid, voxel)[axis] > 0;
    }
    const auto weights = maskWeights(lattice, 4, mask, 8.0);
    const Grid nodes = withDimensions(lattice, glm::ivec3(56));
    for (int steps = 0; steps < 3; ++steps)
    {
      glm::ivec3 node(28);
      const int last = static_cast<int>(40.0 / spacing[axis]); // that may not move
      node[axis] = last + steps;
      const double t = std::min(steps * spacing[axis] / 8.0, 1.0);
      EXPECT_NEAR(
        weights->values[nodes.offset(node.x, node.y, node.z)], t * t * (3.0 - 2.0 * t), 1e-6)
        << axis << " " << steps;
    }
  }
}

TEST(MaskWeights, AreZeroOnTheWholeBorder)
{
  // A mask far beyond the lattice: still no tissue may leave it.
  Mask mask{ plainGrid(glm::ivec3(2), glm::dvec3(1000.0)), std::vector<char>(8, 1) };
  mask.grid.origin = glm::dvec3(-400.0);
  const Grid lattice = plainGrid({ 5, 6, 7 }, glm::dvec3(10.0));
  const auto weights = maskWeights(lattice, 1, mask, 0.0);
  const Grid nodes = withDimensions(lattice, { 9, 11, 13 });
  for (std::size_t number = 0; number < nodes.count(); ++number)
  {
    const glm::ivec3 node = indexOf(nodes, number);
    const bool atBorder =
      glm::any(glm::equal(node, glm::ivec3(0))) || glm::any(glm::equal(node, nodes.dimensions - 1));
    EXPECT_EQ(weights->values[number], atBorder ? 0.0f : 1.0f)
      << node.x << " " << node.y << " " << node.z;
  }
}

// Adds to five voxels by chance, and compares with the distances to all of them.
void expectGrown(const Grid& grid, double by)
{
  Random random(35);
  Mask mask{ grid, std::vector<char>(grid.count(), 0) };
  std::vector<glm::dvec3> inside;
  for (int i = 0; i < 5; ++i)
  {
    const glm::ivec3 voxel(grid.gridFromWorld(random.point(grid, 0.0)));
    mask.inside[grid.offset(voxel.x, voxel.y, voxel.z)] = 1;
    inside.push_back(grid.worldFromGrid(glm::dvec3(voxel)));
  }
  growMask(mask, by);
  for (std::size_t offset = 0; offset < grid.count(); ++offset)
  {
    const glm::dvec3 at = grid.worldFromGrid(glm::dvec3(indexOf(grid, offset)));
    double nearest = 1e9;
    for (const glm::dvec3& voxel : inside)
    {
      nearest = std::min(nearest, glm::distance(at, voxel));
    }
    EXPECT_EQ(mask.inside[offset] != 0, nearest <= by) << by << " mm, " << nearest;
  }
}

TEST(GrowMask, AddsTheVoxelsWithinADistance)
{
  for (const double by : { 0.0, 1.4, 4.0, 100.0 })
  {
    expectGrown(plainGrid({ 20, 17, 9 }, { 1.0, 1.5, 3.0 }), by);
    expectGrown(plainGrid({ 20, 17, 9 }, { 0.4, 0.55, 1.2 }), by); // some below 1 mm
  }
}

TEST(StrokesInFeather, NamesThoseThatTheMaskHoldsBack)
{
  // The mask is what lies below x = 50 mm, with a feather of 15 mm.
  const Grid lattice = plainGrid(glm::ivec3(13), glm::dvec3(10.0));
  Mask mask{ plainGrid(glm::ivec3(25), glm::dvec3(5.0)), std::vector<char>(25 * 25 * 25) };
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel)
  {
    mask.inside[voxel] = voxel % 25 < 10;
  }
  std::vector<Stroke> strokes(4, strokeAt(Tool::Soft, { 25, 60, 60 }, { 0, 3, 0 }));
  strokes[1].anchor.x = 44.0;
  strokes[2].anchor.x = 90.0; // outside
  strokes[3].anchor.x = 44.0;
  strokes[3].enabled = false;
  for (Stroke& stroke : strokes)
  {
    stroke.major = 20.0;
  }
  Lattice base = makeLattice(lattice, KernelCatmullRom);
  Replay replay;
  replay.run(base, strokes);
  EXPECT_EQ(replay.strokesInFeather(), "") << "without a mask";
  base.mask = maskWeights(lattice, Samples, mask, 15.0);
  replay.run(base, strokes);
  const std::string words = replay.strokesInFeather();
  EXPECT_NE(words.find("the anchor of stroke 2, 3:"), std::string::npos) << words;
  EXPECT_NE(words.find("Raise Mask Growth"), std::string::npos) << words;
  strokes.erase(strokes.begin() + 2, strokes.end());
  growMask(mask, 25.0);
  base.mask = maskWeights(lattice, Samples, mask, 15.0);
  replay.run(base, strokes);
  EXPECT_EQ(replay.strokesInFeather(), "") << "the feather lies beyond the anchors now";
}
