// SPDX-License-Identifier: BSD-3-Clause
// Proves that blocks of a volume that belong elsewhere are found, with where and how far, that a
// right result and hidden tissue have none, and that a refinement goes on from their motion.
#include "Filters/Register/BlockCheck.h"
#include "Filters/Register/Refinement.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// Grains of all sizes that no place has twice.
double grain(const glm::dvec3& at)
{
  double sum = 0.0;
  for (int i = 0; i < 12; ++i)
  {
    const glm::dvec3 wave(std::sin(7.1 * i + 1.0), std::cos(3.7 * i), std::sin(5.3 * i + 2.0));
    sum += std::sin((0.3 + 0.03 * i) * glm::dot(wave, at) + i);
  }
  return 100.0 + 20.0 * sum;
}

Lattice sunk()
{
  return bulge(smallGrid(), 10.0);
}

// A reference of another contrast in which a part moved.
RegisteredPair pairOf(const Lattice& truth)
{
  RegisteredPair pair;
  pair.rest = filled(smallGrid(), grain);
  pair.reference =
    filled(smallGrid(), [&](const glm::dvec3& x) { return 300.0 - grain(tissueAt(truth, x)); });
  return pair;
}

Lattice still()
{
  return makeLattice(sunk().grid, 0);
}

BlockCheck checked(const RegisteredPair& pair, const Lattice& result)
{
  BlockCheck check(pair, result, similarities().front().plan.check.blocks);
  double last = 0.0;
  while (check.step())
  {
    EXPECT_GE(check.done(), last);
    last = check.done();
  }
  EXPECT_EQ(check.done(), 1.0);
  const double ml = check.elsewhere().ml;
  EXPECT_FALSE(check.step());
  EXPECT_EQ(check.elsewhere().ml, ml) << "it counts once";
  return check;
}
}

TEST(BlockCheck, FindsWhatMoved)
{
  const Lattice truth = sunk();
  const RegisteredPair pair = pairOf(truth);
  const Lattice start = still();
  const BlockCheck check = checked(pair, start);
  const Elsewhere& found = check.elsewhere();
  EXPECT_GT(found.ml, 5.0);
  EXPECT_LT(glm::distance(found.middle, middle(smallGrid())), 8.0);
  EXPECT_GT(found.mm, 4.0);
  EXPECT_LT(found.mm, 9.0);
  // World axes: the lattice is rotated.
  const Controls motion = check.motion();
  const std::size_t inMiddle = truth.grid.offset(4, 4, 3);
  const glm::dvec3 moved = truth.grid.direction * glm::dvec3(motion[inMiddle]);
  const glm::dvec3 right(truth.displacements[inMiddle]);
  EXPECT_LT(glm::distance(moved, right), 0.5 * glm::length(right));
  EXPECT_LT(glm::length(motion.front()), 1.0f);
}

TEST(BlockCheck, ARightResultHasNone)
{
  const Lattice truth = sunk();
  const RegisteredPair pair = pairOf(truth);
  EXPECT_EQ(checked(pair, truth).elsewhere().ml, 0.0);
}

TEST(BlockCheck, DoesNotCountWhatIsHidden)
{
  RegisteredPair pair = pairOf(sunk());
  const Lattice start = still();
  pair.cavity = ball(smallGrid(), middle(smallGrid()), 45.0);
  EXPECT_EQ(checked(pair, start).elsewhere().ml, 0.0);
  pair.cavity = {};
  pair.inside = ball(smallGrid(), smallGrid().origin, 20.0);
  EXPECT_EQ(checked(pair, start).elsewhere().ml, 0.0) << "only what moves is compared";
}

TEST(BlockCheck, NothingIsTooSmall)
{
  for (const glm::ivec3& sides :
    { glm::ivec3(4, 5, 3), glm::ivec3(40, 42, 4), glm::ivec3(5, 40, 40), glm::ivec3(40, 2, 40) })
  {
    RegisteredPair pair;
    Grid grid = smallGrid();
    grid.dimensions = sides;
    pair.rest = filled(grid, grain);
    pair.reference = pair.rest;
    const Lattice still = makeLattice(withDimensions(grid, { 4, 4, 4 }), 0);
    const BlockCheck check = checked(pair, still);
    EXPECT_EQ(check.elsewhere().ml, 0.0);
    EXPECT_EQ(check.motion(), Controls(64, glm::vec3(0.0f)));
  }
}

TEST(BlockCheck, ARefinementGoesOnFromThere)
{
  const Lattice truth = sunk();
  const RegisteredPair pair = pairOf(truth);
  const Lattice start = still();
  const BlockCheck check = checked(pair, start);
  Refinement again(pair, start, {});
  again.beginAt(start, check.motion());
  const std::size_t inMiddle = truth.grid.offset(4, 4, 3);
  const glm::vec3 right = truth.displacements[inMiddle];
  EXPECT_LT(
    glm::distance(again.lattice().displacements[inMiddle], right), 0.5f * glm::length(right));
  while (!again.step().isFinished)
  {
  }
  double sum = 0.0;
  for (int i = 0; i < 5; ++i)
  {
    const glm::dvec3 at = middle(smallGrid()) + glm::dvec3(6.0 * i - 12.0, 3.0, -2.0);
    sum +=
      glm::distance(displacementOfTissue(truth, at), displacementOfTissue(again.lattice(), at));
  }
  EXPECT_LT(sum / 5.0, 0.5);
}
