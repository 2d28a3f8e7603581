// SPDX-License-Identifier: BSD-3-Clause
// Proves that replaying strokes does again only what changed, and gives the same bits as doing all.
#include "Filters/Deformation/Replay.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/PointMap.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const glm::dvec3 Middle(50.0);

Lattice base()
{
  return makeLattice(plainGrid(glm::ivec3(11), glm::dvec3(10.0)), KernelCatmullRom);
}

// Strokes whose result depends on their order: each is measured where the others moved it.
std::vector<Stroke> threeStrokes()
{
  return { strokeAt(Tool::Stamp, Middle, { 0, 0, 12 }),
    strokeAt(Tool::Move, Middle + 9.0, { 5, 0, 0 }),
    strokeAt(Tool::Soft, Middle + 14.0, { 0, -7, 3 }) };
}

std::vector<glm::vec3> fullReplay(const Lattice& start, const std::vector<Stroke>& strokes)
{
  Replay replay;
  return replay.run(start, strokes).displacements;
}

class ReplayTest : public ::testing::Test
{
protected:
  ReplayTest() { this->Running.run(base(), this->Strokes); }

  // Runs the strokes again and compares with doing all of them from the start.
  void expectAfterwards(int applied, const Lattice& start = base())
  {
    const std::vector<glm::vec3> result = this->Running.run(start, this->Strokes).displacements;
    EXPECT_EQ(this->Running.applied(), applied);
    EXPECT_EQ(result, fullReplay(start, this->Strokes));
  }

  std::vector<Stroke> Strokes = threeStrokes();
  Replay Running;
};
}

TEST_F(ReplayTest, AppliesInOrder)
{
  EXPECT_EQ(this->Running.applied(), 3);
  Lattice lattice = base();
  for (const Stroke& stroke : this->Strokes)
  {
    applyStroke(lattice, stroke);
  }
  EXPECT_EQ(fullReplay(base(), this->Strokes), lattice.displacements);
  EXPECT_NE(
    fullReplay(base(), { this->Strokes.rbegin(), this->Strokes.rend() }), lattice.displacements);
}

// PointMap is another road to where tissue goes. It prepares the whole lattice.
TEST_F(ReplayTest, SaysHowFarEachStrokeReached)
{
  ASSERT_EQ(this->Running.achieved().size(), this->Strokes.size());
  Lattice lattice = base();
  for (std::size_t i = 0; i < this->Strokes.size(); ++i)
  {
    const Stroke& stroke = this->Strokes[i];
    const PointMap before(lattice);
    applyStroke(lattice, stroke);
    const glm::dvec3 rest = stroke.tool == Tool::Move
      ? base().grid.worldFromGrid(glm::round(base().grid.gridFromWorld(stroke.anchor)))
      : before.restFromDeformed(stroke.anchor);
    const glm::dvec3 moved =
      PointMap(lattice).deformedFromRest(rest) - before.deformedFromRest(rest);
    const double expected = glm::dot(moved, glm::normalize(stroke.vector));
    EXPECT_NEAR(this->Running.achieved()[i], expected, 1e-3) << "stroke " << i;
    EXPECT_GT(expected, 0.1 * glm::length(stroke.vector));
  }
  this->Strokes.back().enabled = false;
  this->Running.run(base(), this->Strokes);
  EXPECT_EQ(this->Running.achieved().back(), 0.0);
}

TEST_F(ReplayTest, AppliesAChangedLastStrokeOnly)
{
  for (int click = 0; click < 5; ++click)
  {
    this->Strokes.back().vector *= 1.3;
    this->expectAfterwards(1);
  }
}

TEST_F(ReplayTest, AppliesAnAddedStrokeOnly)
{
  this->Strokes.push_back(strokeAt(Tool::Soft, Middle - 10.0, { 3, 3, 3 }));
  this->expectAfterwards(1);
  this->Strokes.push_back(strokeAt(Tool::Stamp, Middle - 20.0, { 2, 0, 0 }));
  this->expectAfterwards(1);
  this->Strokes.back().vector.y = 4.0;
  this->expectAfterwards(1);
}

TEST_F(ReplayTest, AppliesAChangedLastAndAnAddedStroke)
{
  this->Strokes.back().vector *= 0.5;
  this->Strokes.push_back(strokeAt(Tool::Soft, Middle, { 1, 1, 1 }));
  this->expectAfterwards(2);
}

TEST_F(ReplayTest, RepeatsAllAfterAChangeFurtherBack)
{
  this->Strokes.front().vector *= 0.5;
  this->expectAfterwards(3);
  this->Strokes[1].enabled = false;
  this->expectAfterwards(3);
}

TEST_F(ReplayTest, DropsALastStrokeThatIsDisabled)
{
  this->Strokes.back().enabled = false;
  this->expectAfterwards(1);
  EXPECT_EQ(this->Running.run(base(), this->Strokes).displacements,
    fullReplay(base(), { this->Strokes.begin(), this->Strokes.end() - 1 }));
}

TEST_F(ReplayTest, TakesStrokesBack)
{
  this->Strokes.pop_back();
  this->expectAfterwards(2);
  this->Strokes.clear();
  this->expectAfterwards(0);
  this->Strokes = threeStrokes();
  this->expectAfterwards(3);
}

TEST_F(ReplayTest, RepeatsAllOnAnotherBase)
{
  Lattice moved = base();
  moved.displacements[17] = { 1, 2, 3 };
  this->expectAfterwards(3, moved);
  Lattice smooth = moved;
  smooth.kernel = KernelBSpline;
  this->expectAfterwards(3, smooth);
  Lattice shifted = smooth;
  shifted.grid.origin.x += 1.0;
  this->expectAfterwards(3, shifted);
  this->expectAfterwards(3, makeLattice(plainGrid(glm::ivec3(14), glm::dvec3(8.0)), 0));
}

TEST_F(ReplayTest, RepeatsAllForAnotherGuard)
{
  // The guard proves the field that is drawn, too, which has as many samples.
  for (const Guarding& guarding :
    { Guarding{ true, 4 }, Guarding{ true, 0 }, Guarding{ false, 0 } })
  {
    const std::vector<glm::vec3> result =
      this->Running.run(base(), this->Strokes, guarding).displacements;
    EXPECT_EQ(this->Running.applied(), 3) << guarding.samples;
    Replay fresh;
    EXPECT_EQ(result, fresh.run(base(), this->Strokes, guarding).displacements);
    EXPECT_EQ(this->Running.fractions(), fresh.fractions());
  }
  this->Running.run(base(), this->Strokes, { false, 7 });
  EXPECT_EQ(this->Running.applied(), 0) << "without a guard samples do not matter";
}

namespace
{
// Many strokes of all tools, most of which the guard shortens.
std::vector<Stroke> manyStrokes(int count)
{
  Random random(8);
  std::vector<Stroke> strokes;
  for (int i = 0; i < count; ++i)
  {
    Stroke stroke = strokeAt(static_cast<Tool>(i % 3), random.point(base().grid, -1.0),
      random.between(glm::dvec3(-14.0), glm::dvec3(14.0)));
    stroke.major = i % 3 == 0 ? 0.0 : random.between(15.0, 30.0);
    stroke.minor = random.between(15.0, 30.0);
    strokes.push_back(stroke);
  }
  return strokes;
}
}

TEST(LongReplay, GoesOnFromACheckpoint)
{
  const Guarding guarding{ true, 0 };
  constexpr int Gap = StrokesPerCheckpoint;
  constexpr int Count = 2 * Gap + 6;
  std::vector<Stroke> strokes = manyStrokes(Count);
  Replay running;
  running.run(base(), strokes, guarding);
  EXPECT_LT(*std::min_element(running.fractions().begin(), running.fractions().end()), 0.9);
  const auto expectAsAnew = [&](int most, const char* when) {
    const std::vector<glm::vec3> result = running.run(base(), strokes, guarding).displacements;
    EXPECT_LE(running.applied(), most) << when;
    Replay fresh;
    EXPECT_EQ(result, fresh.run(base(), strokes, guarding).displacements) << when;
    EXPECT_EQ(running.fractions(), fresh.fractions()) << when;
  };
  expectAsAnew(0, "nothing changed");
  const std::vector<Stroke> all = strokes;
  strokes.pop_back();
  expectAsAnew(Gap, "the last one is taken back");
  strokes.back().vector *= 0.5;
  expectAsAnew(Gap, "then another last one is changed");
  strokes.resize(Gap + 1);
  expectAsAnew(Gap, "many are taken back, to just after a checkpoint");
  strokes.resize(Gap);
  expectAsAnew(Gap, "to the checkpoint");
  strokes = all;
  expectAsAnew(Count - Gap, "all are back");
  strokes[Count - 5].enabled = false;
  expectAsAnew(5 + Gap, "one of the last ones is disabled");
  strokes.erase(strokes.begin() + Count - 8);
  expectAsAnew(7 + Gap, "one of them is deleted");
  strokes[0].vector *= 0.9;
  expectAsAnew(Count - 1, "the first one is changed");
  strokes.clear();
  expectAsAnew(0, "none is left");
}

TEST(LongReplay, CanBeStoppedAndGoesOn)
{
  const Guarding guarding{ true, 0 };
  const std::vector<Stroke> strokes = manyStrokes(40);
  const Lattice whole = Replay().run(base(), strokes, guarding);
  Replay running;
  double last = 0.0;
  const auto stopAt = [&](int strokeCount) {
    int heard = 0;
    last = 0.0;
    running.run(base(), strokes, guarding, [&](double share) {
      EXPECT_GT(share, last);
      EXPECT_LT(share, 1.0);
      last = share;
      return ++heard < strokeCount;
    });
  };
  std::size_t count = 0;
  for (const int more : { 1, 19, 7 })
  {
    stopAt(more);
    count += static_cast<std::size_t>(more);
    EXPECT_FALSE(running.isWhole());
    EXPECT_EQ(running.count(), count);
    EXPECT_EQ(running.fractions().size(), count);
  }
  stopAt(100);
  EXPECT_TRUE(running.isWhole());
  EXPECT_EQ(running.applied(), 13) << "those until the stop are not repeated";
  EXPECT_EQ(running.run(base(), strokes, guarding).displacements, whole.displacements);
}

TEST(LongReplay, ANewEditAfterAStopIsAsAnew)
{
  const Guarding guarding{ true, 0 };
  std::vector<Stroke> strokes = manyStrokes(40);
  Replay running;
  running.run(base(), strokes, guarding);
  strokes[30].vector *= 0.5;
  int heard = 0;
  running.run(base(), strokes, guarding, [&](double) { return ++heard < 3; });
  EXPECT_FALSE(running.isWhole());
  strokes[running.count() - 1].vector *= 0.5;
  const Lattice whole = Replay().run(base(), strokes, guarding);
  EXPECT_EQ(running.run(base(), strokes, guarding).displacements, whole.displacements);
  EXPECT_TRUE(running.isWhole());
}

TEST(LongReplay, KeepsNoMoreCheckpointsThanFit)
{
  // 113^3 points take 17 MB: 3 checkpoints fit.
  const Lattice large = makeLattice(plainGrid(glm::ivec3(113), glm::dvec3(1.0)), KernelCatmullRom);
  Stroke still = strokeAt(Tool::Move, Middle, glm::dvec3(0.1));
  std::vector<Stroke> strokes(StrokesPerCheckpoint * 8, still);
  Replay running;
  running.run(large, strokes);
  strokes.pop_back();
  running.run(large, strokes);
  EXPECT_LE(running.applied(), static_cast<int>(4 * StrokesPerCheckpoint));
  EXPECT_GT(running.applied(), static_cast<int>(StrokesPerCheckpoint));
}
