// SPDX-License-Identifier: BSD-3-Clause
// Proves that replaying strokes does again only what changed, and gives the same bits as doing all.
#include "Filters/Deformation/Replay.h"
#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

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
    EXPECT_EQ(this->Running.shares(), fresh.shares());
  }
  this->Running.run(base(), this->Strokes, { false, 7 });
  EXPECT_EQ(this->Running.applied(), 1) << "without a guard samples do not matter";
}
