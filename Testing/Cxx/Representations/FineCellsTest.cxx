// SPDX-License-Identifier: BSD-3-Clause
// Proves that the field which pictures are drawn with misses the deformation by no more than the
// design allows: 0.05 mm, or 0.05 voxel.
#include "Representations/Field/FineCells.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/MaskWeights.h"
#include "Representations/Field/SceneDeformation.h"
#include "Testing/Cxx/Representations/TestFineCells.h"

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int BothKernels[] = { KernelCatmullRom, KernelBSpline };

// The largest misses among random places where tissue moves, and the sums of all, mm.
struct Misses
{
  double uncorrected = 0.0;
  double corrected = 0.0;
  double uncorrectedSum = 0.0;
  double correctedSum = 0.0;
};

Misses missesOf(const CorrectedField& drawn, int places)
{
  Random random(61);
  Misses misses;
  for (int i = 0; i < places; ++i)
  {
    const glm::vec3 node(
      random.between(glm::dvec3(drawn.moved.first), glm::dvec3(drawn.moved.last)));
    const glm::vec3 offset = drawn.field.displacement(drawn.field.nodes.latticeFromNode(node));
    if (offset != glm::vec3(0.0f))
    {
      const double uncorrected = drawn.missAt(node, offset);
      const double corrected = drawn.missAt(node, drawn.drawnAt(node));
      misses.uncorrected = std::max(misses.uncorrected, uncorrected);
      misses.corrected = std::max(misses.corrected, corrected);
      misses.uncorrectedSum += uncorrected;
      misses.correctedSum += corrected;
    }
  }
  return misses;
}

// Checks that the corrections are needed and are enough.
void expectExact(CorrectedField& drawn, const std::string& what)
{
  drawn.correct(drawn.moved);
  const Misses misses = missesOf(drawn, 150000);
  std::printf(
    "%s: %.3f mm, corrected %.4f mm\n", what.c_str(), misses.uncorrected, misses.corrected);
  EXPECT_GT(misses.uncorrected, AllowedMm) << what << " would need no corrections";
  EXPECT_LT(misses.corrected, AllowedMm) << what;
  EXPECT_FALSE(drawn.cells.leftOut()) << what;
}
}

TEST(FineCells, MakeEveryStrokeExact)
{
  for (const int kernel : BothKernels)
  {
    for (const auto& [name, stroke] : bendingStrokes())
    {
      CorrectedField drawn(latticeAfter(referenceLatticeGrid(), kernel, { stroke }));
      expectExact(drawn, name + (kernel == KernelBSpline ? ", B-spline" : ""));
    }
  }
}

TEST(FineCells, MakeTheNegatedFieldExact)
{
  for (const auto& [name, stroke] : bendingStrokes())
  {
    CorrectedField drawn(
      latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { stroke }), Inverse::Negated);
    expectExact(drawn, name + ", negated");
  }
}

// Under a mask the displacement is trilinear between nodes. Its inverse has kinks, which need
// denser nodes than there are if tissue almost folds. Then the search says so.
TEST(FineCells, MakeAMaskedFieldExactOrSaySo)
{
  Mask mask{ plainGrid({ 129, 129, 76 }, glm::dvec3(2.0)), {} };
  forEachIndex(glm::ivec3(0), mask.grid.dimensions - 1, [&](const glm::ivec3& voxel) {
    mask.inside.push_back(
      glm::distance(glm::dvec3(voxel) * 2.0, glm::dvec3(128.0, 128.0, 80.0)) < 65.0);
  });
  const auto weights = maskWeights(referenceLatticeGrid(), FineSamples, mask, 12.0);
  const auto strokes = bendingStrokes();
  for (const int stroke : { 0, 1, 3, 4 }) // the others bend too little in the mask
  {
    const auto& [name, bending] = strokes[stroke];
    CorrectedField drawn(
      latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { bending }, weights));
    drawn.correct(drawn.moved);
    const Misses misses = missesOf(drawn, 150000);
    std::printf("%s, masked: %.3f mm, corrected %.4f mm\n", name.c_str(), misses.uncorrected,
      misses.corrected);
    EXPECT_GT(misses.uncorrected, AllowedMm) << name << " would need no corrections";
    EXPECT_LT(misses.corrected, 2.0 * AllowedMm) << name;
    EXPECT_TRUE(misses.corrected < AllowedMm || drawn.cells.leftOut()) << name;
  }
}

// A stroke corrects only what it changed. The field is then the same as if all of it were new.
TEST(FineCells, FollowAStroke)
{
  const auto strokes = bendingStrokes();
  const Grid grid = referenceLatticeGrid();
  Stroke second = strokes[1].second;
  second.anchor += glm::dvec3(25.0, -10.0, 5.0);
  const Lattice before = latticeAfter(grid, KernelCatmullRom, { strokes[2].second });
  const Lattice after = latticeAfter(grid, KernelCatmullRom, { strokes[2].second, second });
  CorrectedField anew(after);
  anew.correct(anew.moved);
  CorrectedField followed(before);
  followed.correct(followed.moved);
  const FineCells old = followed.cells;
  const std::vector<glm::vec3> from = displacementsInCells(before);
  const std::vector<glm::vec3> to = displacementsInCells(after);
  CorrectedField next(after);
  ASSERT_TRUE(next.field.nodes == followed.field.nodes);
  next.cells = old;
  const IndexBox changed = changedBackwardNodes(
    changedPoints(grid.dimensions, from, to), grid.dimensions, from, to, next.field.nodes);
  ASSERT_FALSE(changed == next.moved) << "nothing is kept";
  next.correct(changed);
  int different = 0;
  int corrected = 0;
  forEachIndex(glm::ivec3(0), next.field.nodes.count - 2, [&](const glm::ivec3& cell) {
    const glm::vec3 node = glm::vec3(cell) + 0.3f;
    corrected += anew.cells.code(cell) > 0.0f ? 1 : 0;
    different += next.correctionAt(node) != anew.correctionAt(node) ? 1 : 0;
  });
  EXPECT_GT(corrected, 1000);
  EXPECT_EQ(different, 0);
}

TEST(FineCells, AreLeftOutInABox)
{
  CorrectedField drawn(
    latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { bendingStrokes()[0].second }));
  EXPECT_FALSE(drawn.cells.any());
  drawn.correct(drawn.moved);
  EXPECT_TRUE(drawn.cells.any());
  const IndexBox half{ drawn.moved.first, (drawn.moved.first + drawn.moved.last) / 2 };
  drawn.cells.leaveOut(half);
  int within = 0;
  int outside = 0;
  forEachIndex(glm::ivec3(0), drawn.field.nodes.count - 2, [&](const glm::ivec3& cell) {
    const bool with = drawn.cells.code(cell) > 0.0f;
    (enclosing(half, { cell, cell }) == half ? within : outside) += with ? 1 : 0;
  });
  EXPECT_EQ(within, 0);
  EXPECT_GT(outside, 100);
  drawn.cells.leaveOut({ glm::ivec3(0), drawn.field.nodes.count - 2 });
  EXPECT_FALSE(drawn.cells.any());
}

// Empty-space skipping relies on it.
TEST(FineCells, StayWithinTheirReach)
{
  CorrectedField drawn(
    latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { bendingStrokes()[1].second }));
  drawn.correct(drawn.moved);
  const IndexBox all{ glm::ivec3(0), drawn.field.nodes.count - 1 };
  NodeField reaches{ drawn.field.nodes, {} };
  for (const float reach : drawn.cells.reaches(all))
  {
    reaches.values.emplace_back(reach);
  }
  Random random(62);
  float tightest = 0.0f;
  for (int i = 0; i < 100000; ++i)
  {
    const glm::vec3 node(
      random.between(glm::dvec3(drawn.moved.first), glm::dvec3(drawn.moved.last)));
    const glm::vec3 correction = glm::abs(drawn.correctionAt(node));
    const glm::ivec3 cell(glm::floor(node));
    const float most = std::max({ correction.x, correction.y, correction.z });
    const std::vector<float> corners = drawn.cells.reaches({ cell, cell + 1 });
    const float least = *std::min_element(corners.begin(), corners.end());
    ASSERT_LE(most, least);
    tightest = least > 0.0f ? std::max(tightest, most / least) : tightest;
  }
  EXPECT_GT(tightest, 0.8f) << "the reach is far too large";
}

// A field that bends everywhere gets what there is place for, and says how many cells lack more.
TEST(FineCells, KeepToTheirMemory)
{
  const Lattice lattice =
    randomLatticeWithoutFolds(plainGrid(glm::ivec3(12), glm::dvec3(40.0)), KernelCatmullRom, 63);
  CorrectedField drawn(lattice);
  drawn.correct({ glm::ivec3(0), drawn.field.nodes.count - 1 });
  EXPECT_LE(drawn.cells.layers(), MostLayers);
  EXPECT_GT(drawn.cells.layers(), MostLayers / 2);
  EXPECT_TRUE(drawn.cells.leftOut());
  const Misses misses = missesOf(drawn, 20000);
  EXPECT_LT(misses.correctedSum, 0.7 * misses.uncorrectedSum);
}

// However many cells are filled at once, each gets its own corrections.
TEST(FineCells, AreFilledInAnyNumber)
{
  const Lattice lattice =
    latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { bendingStrokes()[0].second });
  CorrectedField whole(lattice);
  whole.correct(whole.moved);
  CorrectedField rows(lattice);
  for (int z = whole.moved.first.z; z <= whole.moved.last.z; ++z)
  {
    rows.correct({ { whole.moved.first.x, whole.moved.first.y, z },
      { whole.moved.last.x, whole.moved.last.y, z } });
  }
  int corrected = 0;
  forEachIndex(whole.moved.first, whole.moved.last - 1, [&](const glm::ivec3& cell) {
    const glm::vec3 node = glm::vec3(cell) + 0.3f;
    corrected += whole.cells.code(cell) > 0.0f ? 1 : 0;
    ASSERT_EQ(whole.correctionAt(node), rows.correctionAt(node));
  });
  EXPECT_GT(corrected, 1000);
}

TEST(FineCells, AreAsExactAsTheVoxelsNeed)
{
  EXPECT_DOUBLE_EQ(allowedMissMm(glm::dvec3(0.5, 1.0, 1.0)), 0.05);
  EXPECT_DOUBLE_EQ(allowedMissMm(glm::dvec3(3.0, 2.0, 4.0)), 0.1);
}
