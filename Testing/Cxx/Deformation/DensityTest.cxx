// SPDX-License-Identifier: BSD-3-Clause
// Proves that a denser lattice replays strokes to the same deformation, and that the strokes are
// named that a lattice is too coarse for.
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Deformation/Replay.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <tuple>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// The reference case: 256 x 256 x 150 mm.
Lattice latticeOfSide(int side, int kernel)
{
  const Grid volume = plainGrid({ 257, 257, 151 }, glm::dvec3(1.0));
  return makeLattice(withDimensions(volume, glm::ivec3(side)), kernel);
}

struct Change
{
  double largest = 0.0;     // displacement, mm
  double meanOfMoved = 0.0; // mean change where tissue moves by a hundredth of that or more, mm
  double largestChange = 0.0;
};

// How two lattices over the same box differ.
Change changeBetween(const Lattice& before, const Lattice& after)
{
  const PointMap from(before);
  const PointMap to(after);
  std::vector<std::pair<double, double>> points; // displacement and change
  Change change;
  for (int k = 0; k <= 50; ++k)
  {
    for (int j = 0; j <= 64; ++j)
    {
      for (int i = 0; i <= 64; ++i)
      {
        const glm::dvec3 rest(4.0 * i, 4.0 * j, 3.0 * k);
        const glm::dvec3 was = from.deformedFromRest(rest);
        const double moved = glm::distance(was, rest);
        points.emplace_back(moved, glm::distance(was, to.deformedFromRest(rest)));
        change.largest = std::max(change.largest, moved);
      }
    }
  }
  int count = 0;
  for (const auto& [moved, difference] : points)
  {
    change.largestChange = std::max(change.largestChange, difference);
    if (moved >= 0.01 * change.largest)
    {
      change.meanOfMoved += difference;
      ++count;
    }
  }
  change.meanOfMoved /= count;
  return change;
}

using Case = std::tuple<Tool, int>; // and kernel

class Doubled : public ::testing::TestWithParam<Case>
{
};
}

TEST_P(Doubled, KeepsTheDeformation)
{
  const auto [tool, kernel] = GetParam();
  Lattice coarse = latticeOfSide(19, kernel);
  Lattice dense = latticeOfSide(37, kernel);
  for (const glm::dvec3& anchor : { glm::dvec3(128, 128, 75), glm::dvec3(61, 77, 90),
         glm::dvec3(256, 170, 40), glm::dvec3(180, 200, 0) })
  {
    Stroke stroke = strokeAt(tool, anchor, { 3.0, -4.0, 5.0 });
    if (tool == Tool::Move)
    {
      stroke.axis = coarse.grid.spacing;
    }
    applyStroke(coarse, stroke);
    applyStroke(dense, stroke);
  }
  const Change change = changeBetween(coarse, dense);
  std::printf("largest %.3f mm, mean change of what moves %.2f %%, largest change %.2f %%\n",
    change.largest, 100.0 * change.meanOfMoved / change.largest,
    100.0 * change.largestChange / change.largest);
  EXPECT_GT(change.largest, 1.0);
  EXPECT_LT(change.meanOfMoved, 0.05 * change.largest);
  if (tool == Tool::Move)
  {
    EXPECT_LT(change.largestChange, 0.06 * change.largest) << "at the border; elsewhere none";
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, Doubled,
  ::testing::Combine(::testing::Values(Tool::Move, Tool::Soft, Tool::Stamp),
    ::testing::Values(KernelCatmullRom, KernelBSpline)));

TEST(StrokesTooFine, NamesNumberRadiusAndSpacing)
{
  const Grid lattice = latticeOfSide(19, KernelCatmullRom).grid; // 14.2 mm along x
  std::vector<Stroke> strokes(4, strokeAt(Tool::Soft, glm::dvec3(0.0), glm::dvec3(1.0)));
  strokes[0].tool = Tool::Move;
  strokes[0].major = lattice.spacing.x;
  EXPECT_EQ(strokesTooFine(strokes, lattice), "") << "none is";
  strokes[2].tool = Tool::Stamp;
  strokes[2].major = 50.0;
  strokes[2].minor = 8.5;
  EXPECT_EQ(strokesTooFine(strokes, lattice),
    "The lattice is too coarse for the radius of stroke 3 (8.5 mm): its spacing is 14.2 mm. "
    "Make Lattice Dimensions larger");
  strokes[2].enabled = false;
  EXPECT_EQ(strokesTooFine(strokes, lattice), "") << "it does nothing";
  strokes = std::vector<Stroke>(6, strokeAt(Tool::Soft, glm::dvec3(0.0), glm::dvec3(1.0)));
  const Grid coarse = latticeOfSide(5, KernelCatmullRom).grid;
  EXPECT_NE(
    strokesTooFine(strokes, coarse).find("stroke 1 (40 mm), 2 (40 mm), 3 (40 mm) and 3 more"),
    std::string::npos);
}
