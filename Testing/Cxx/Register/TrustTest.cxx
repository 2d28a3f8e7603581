// SPDX-License-Identifier: BSD-3-Clause
// Proves that checks tell right results from wrong ones without the truth, that they say when too
// little was compared, and that a reference in a wrong orientation is found and named.
#include "Filters/Register/Trust.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const RefinementPlan& plan()
{
  return similarities().front().plan;
}

// 0 in the air, 1 within an ellipsoid.
double inside(const glm::dvec3& at)
{
  const glm::dvec3 away = (at - middle(smallGrid())) / glm::dvec3(32.0, 36.0, 34.0);
  return glm::clamp(8.0 * (1.0 - glm::length(away)), 0.0, 1.0);
}

double head(const glm::dvec3& at)
{
  return tissue(at) * inside(at);
}

// A reference of another contrast that shows the tissue of `at(x)` at x.
RegisteredPair pairOf(const std::function<glm::dvec3(const glm::dvec3&)>& at)
{
  RegisteredPair pair;
  pair.rest = filled(smallGrid(), head);
  pair.reference = filled(smallGrid(), [&](const glm::dvec3& x) { return 300.0 - head(at(x)); });
  return pair;
}

glm::dvec3 same(const glm::dvec3& at)
{
  return at;
}

Lattice still()
{
  return makeLattice(withDimensions(smallGrid(), { 9, 9, 9 }), KernelCatmullRom);
}

Verdict verdict(const RegisteredPair& pair, const Lattice& start, const Lattice& result)
{
  Verification checks(pair, start, result, plan());
  double last = 0.0;
  int calls = 0;
  while (checks.step() && ++calls < 2000)
  {
    EXPECT_GE(checks.done(), last);
    last = checks.done();
  }
  EXPECT_TRUE(checks.isFinished());
  EXPECT_EQ(checks.done(), 1.0);
  return checks.verdict();
}

Verdict verdict(const RegisteredPair& pair, const Lattice& result)
{
  return verdict(pair, result, result);
}

bool says(const Verdict& verdict, const std::string& words)
{
  return std::any_of(verdict.reasons.begin(), verdict.reasons.end(),
    [&](const std::string& reason) { return reason.find(words) != std::string::npos; });
}
}

TEST(Trust, ARightResultIsGood)
{
  const Verdict found = verdict(pairOf(same), still());
  EXPECT_EQ(found.trust, Trust::Good);
  EXPECT_TRUE(found.reasons.empty()) << found.reasons.front();
}

TEST(Trust, ARightBendIsGood)
{
  const Lattice truth = bulge(smallGrid(), 6.0);
  RegisteredPair pair;
  pair.rest = filled(smallGrid(), head);
  pair.reference =
    filled(smallGrid(), [&](const glm::dvec3& x) { return 300.0 - head(tissueAt(truth, x)); });
  EXPECT_EQ(verdict(pair, truth).trust, Trust::Good);
}

TEST(Trust, OtherTissueIsNotTrusted)
{
  RegisteredPair pair = pairOf(same);
  pair.reference = filled(smallGrid(), [](const glm::dvec3& x) {
    return tissue(glm::dvec3(1.3 * x.z, 1.5 * x.x, 1.4 * x.y) + glm::dvec3(70.0, -20.0, 30.0)) *
      inside(x);
  });
  const Verdict found = verdict(pair, still());
  EXPECT_GE(found.trust, Trust::Doubtful);
  EXPECT_FALSE(found.reasons.empty());
}

namespace
{
RegisteredPair mirroredPair()
{
  return pairOf([](const glm::dvec3& x) {
    const glm::dvec3 normal = smallGrid().direction[0];
    return x - 2.0 * glm::dot(x - middle(smallGrid()), normal) * normal;
  });
}
}

TEST(Trust, AMirroredReferenceIsNamed)
{
  const Verdict found = verdict(mirroredPair(), still());
  EXPECT_EQ(found.trust, Trust::Failed);
  EXPECT_TRUE(says(found, "if it is mirrored from left to right"));
}

// A refinement may bend the volume until it resembles the mirror image.
TEST(Trust, AMirroredReferenceIsNamedHoweverTheVolumeWasBent)
{
  Lattice bent = still();
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0.0f, 9.0f); // mm
  for (glm::vec3& displacement : bent.displacements)
  {
    displacement = { normal(random), normal(random), normal(random) };
  }
  const std::string words = "if it is mirrored from left to right";
  EXPECT_TRUE(says(verdict(mirroredPair(), still(), bent), words));
  EXPECT_FALSE(says(verdict(mirroredPair(), bent, bent), words)) << "the test cannot tell";
}

TEST(Trust, NoiseFailsByWhatIsInside)
{
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  RegisteredPair pair = pairOf(same);
  for (float& value : pair.reference.values)
  {
    value = normal(random);
  }
  EXPECT_EQ(verdict(pair, still()).trust, Trust::Failed);
}

TEST(Trust, AHalfTurnIsNamed)
{
  const Verdict found = verdict(pairOf([](const glm::dvec3& x) {
    const glm::dvec3 from = x - middle(smallGrid());
    return middle(smallGrid()) + glm::dvec3(-from.x, -from.y, from.z);
  }),
    still());
  EXPECT_EQ(found.trust, Trust::Failed);
  EXPECT_TRUE(says(found, "if it is rotated by 180 degrees about the direction (0, 0, "));
}

TEST(Trust, TooLittleIsNotChecked)
{
  RegisteredPair pair = pairOf(same);
  pair.inside = ball(smallGrid(), middle(smallGrid()), 6.0);
  const Verdict found = verdict(pair, still());
  EXPECT_EQ(found.trust, Trust::Unchecked);
  EXPECT_TRUE(says(found, "too little was compared"));
}

// Nothing moves a flat reference, so all searches end where they begin.
TEST(Trust, AFlatReferenceIsNotChecked)
{
  RegisteredPair pair = pairOf(same);
  pair.inside = ball(smallGrid(), middle(smallGrid()), 24.0);
  const Mask flat = ball(smallGrid(), middle(smallGrid()), 44.0);
  for (std::size_t i = 0; i < flat.inside.size(); ++i)
  {
    pair.reference.values[i] = flat.inside[i] ? 120.0f : pair.reference.values[i];
  }
  const Verdict found = verdict(pair, still());
  EXPECT_EQ(found.trust, Trust::Unchecked);
  EXPECT_TRUE(says(found, "too little was compared"));
}

TEST(Trust, AValueThatOverflowsIsNotChecked)
{
  RegisteredPair pair = pairOf(same);
  pair.reference.values[pair.reference.values.size() / 2] = 1e37f;
  EXPECT_EQ(verdict(pair, still()).trust, Trust::Unchecked);
}

namespace
{
std::size_t LargestGrid = 0; // points

// A metric that notes the grids which it is made for.
template <int Number>
const Metric* noting(const Metric* metric)
{
  static const Metric* original = metric;
  static const Metric notes{ metric->support, metric->bytesPerPoint,
    [](LevelVolumes level, const Lattice& lattice) {
      LargestGrid = std::max(LargestGrid, level.rest.grid.count());
      return original->make(std::move(level), lattice);
    } };
  return &notes;
}
}

// Few samples make the checks finer: near what counts, not everywhere.
TEST(Trust, ASmallMaskTakesLittleMemory)
{
  Grid grid = smallGrid(80);
  grid.spacing = glm::dvec3(1.0);
  const auto folds = [&](const glm::dvec3& at) { return tissue(1.5 * at); };
  RegisteredPair pair;
  pair.rest = filled(grid, folds);
  pair.reference = filled(grid, [&](const glm::dvec3& at) { return 300.0 - folds(at); });
  pair.inside = ball(grid, middle(grid), 12.0); // 7 ml
  RefinementPlan noted = plan();
  noted.check.halves.metric = noting<0>(noted.check.halves.metric);
  noted.check.other.metric = noting<1>(noted.check.other.metric);
  const Lattice lattice = makeLattice(withDimensions(grid, { 9, 9, 9 }), KernelCatmullRom);
  Verification checks(pair, lattice, lattice, noted);
  while (checks.step())
  {
  }
  EXPECT_TRUE(checks.figures().halvesMm);
  EXPECT_TRUE(checks.figures().otherMm);
  EXPECT_LT(LargestGrid, 130000u) << "all of it has " << grid.count();
}

TEST(Trust, ALargeVolumeIsCheckedOnFewerPoints)
{
  Grid grid;
  grid.dimensions = { 512, 512, 512 };
  grid.spacing = glm::dvec3(10.0); // micrometres that were taken for millimetres
  const RefinementLevel& asked = plan().check.halves;
  const Grid taken = coarseGrid(grid, withinMemory(asked, grid).spacingMm);
  EXPECT_LE(taken.count(), 4000000u);
  EXPECT_GT(taken.count(), 3000000u);
  EXPECT_LT(Verification::bytes(grid, grid, {}, plan()), 3e9) << "2.1 GB of them are smoothed";
  EXPECT_EQ(withinMemory(asked, smallGrid()).spacingMm, asked.spacingMm);
}

TEST(Trust, OneFigureBeyondItsLimitIsDoubtfulAndTwoFail)
{
  CheckPlan limits;
  limits.halvesMm = 2.0;
  limits.otherMm = 1.0;
  const auto trust = [&](std::optional<double> halvesMm, std::optional<double> otherMm) {
    return verdictOf({ halvesMm, otherMm }, limits).trust;
  };
  EXPECT_EQ(trust(1.9, 0.9), Trust::Good);
  EXPECT_EQ(trust(2.1, 0.9), Trust::Doubtful);
  EXPECT_EQ(trust(1.9, 1.1), Trust::Doubtful);
  EXPECT_EQ(trust(2.1, 1.1), Trust::Failed);
  EXPECT_EQ(trust(6.0, 0.1), Trust::Failed) << "far beyond";
  EXPECT_EQ(trust(1.9, {}), Trust::Good);
  EXPECT_EQ(trust({}, {}), Trust::Unchecked);
}

TEST(Trust, APlaceNearbyThatMatchesAsWellMakesItDoubtful)
{
  CheckPlan limits;
  limits.rivalGain = 0.06;
  CheckFigures figures;
  figures.halvesMm = 1.0;
  EXPECT_EQ(verdictOf(figures, limits).trust, Trust::Good) << "the search found no other place";
  figures.rivalGain = 0.061;
  figures.rivalMm = 6.0;
  EXPECT_EQ(verdictOf(figures, limits).trust, Trust::Good);
  figures.rivalGain = 0.059;
  EXPECT_EQ(verdictOf(figures, limits).trust, Trust::Doubtful);
  figures.halvesMm = 1.1 * limits.halvesMm;
  EXPECT_EQ(verdictOf(figures, limits).trust, Trust::Failed) << "two checks found a fault";
  figures.halvesMm = 1.0;
  figures.rivalGain = 0.009;
  EXPECT_EQ(verdictOf(figures, limits).trust, Trust::Doubtful);
  EXPECT_TRUE(says(verdictOf(figures, limits), "6 mm away on average"));
  EXPECT_TRUE(says(verdictOf(figures, limits), "nearly as well: the cost is 0.9 percent more"));
  EXPECT_TRUE(says(verdictOf(figures, limits), "at least 6 percent more"));
  figures.rivalGain = -0.02;
  EXPECT_TRUE(says(verdictOf(figures, limits), "match better: the cost is 2 percent less"));
}

TEST(Trust, ScatterIsThatOfHalvesAndOfSearchesAround)
{
  CheckPlan limits;
  limits.rivalGain = 0.03;
  limits.scatterMm = 1.5;
  const auto verdict = [&](double halvesMm, std::optional<double> spreadMm) {
    CheckFigures figures;
    figures.halvesMm = halvesMm;
    figures.spreadMm = spreadMm;
    return verdictOf(figures, limits);
  };
  EXPECT_EQ(verdict(4.0, 0.4).trust, Trust::Good) << "1.26 mm";
  EXPECT_EQ(verdict(1.0, 1.8).trust, Trust::Good) << "1.34 mm";
  EXPECT_EQ(verdict(2.5, 0.8).trust, Trust::Doubtful) << "1.41 mm";
  EXPECT_EQ(verdict(2.9, 0.8).trust, Trust::Failed) << "1.52 mm";
  EXPECT_TRUE(says(verdict(3.2, 0.8), "scatter by 1.6 mm; a result is doubtful above "));
  EXPECT_EQ(verdict(2.9, {}).trust, Trust::Good) << "halves alone, up to 3 mm";
  EXPECT_EQ(verdict(3.1, {}).trust, Trust::Doubtful);
}

TEST(Trust, AMatchInsideThatIsWorseThanBesideIsNotCalledLess)
{
  EXPECT_TRUE(insideReason({}, 8.0).empty());
  EXPECT_TRUE(insideReason(0.3, 8.0).empty());
  EXPECT_NE(insideReason(0.1, 8.0).find("the cost is 10 percent less"), std::string::npos);
  EXPECT_NE(insideReason(-0.04, 8.0).find("the cost is 4 percent more"), std::string::npos);
}

TEST(Trust, AnOrientationOfNoiseIsNotBetter)
{
  const auto reason = [](double now, double best) {
    Orientation asItIs;
    asItIs.information = now;
    Orientation other;
    other.matrix[0][0] = -1.0;
    other.information = best;
    return orientationReason(asItIs, other, glm::dmat3(1.0));
  };
  EXPECT_TRUE(reason(0.04, 0.05).empty()) << "noise";
  EXPECT_TRUE(reason(0.5, 0.54).empty());
  EXPECT_NE(reason(0.4, 0.5).find("mirrored from left to right"), std::string::npos);
}

TEST(Trust, AVerdictKeepsTheWorst)
{
  Verdict verdict;
  verdict.lower(Trust::Failed, "one.");
  verdict.lower(Trust::Doubtful, "two.");
  EXPECT_EQ(verdict.trust, Trust::Failed);
  EXPECT_EQ(verdict.reasons.size(), 2u);
  EXPECT_STREQ(nameOf(verdict.trust), "failed");
}

TEST(Orientations, AreAllDifferentAndTheFirstChangesNothing)
{
  const std::vector<glm::dmat3>& all = allOrientations();
  EXPECT_EQ(all.size(), 48u);
  EXPECT_EQ(all.front(), glm::dmat3(1.0));
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    EXPECT_EQ(std::abs(glm::determinant(all[i])), 1.0);
    EXPECT_EQ(std::count(all.begin(), all.end(), all[i]), 1);
  }
}

TEST(Orientations, HaveNames)
{
  glm::dmat3 matrix(1.0);
  EXPECT_EQ(orientationText(matrix, matrix), "moved, in its present orientation");
  matrix[2][2] = -1.0;
  EXPECT_EQ(orientationText(matrix, glm::dmat3(1.0)), "mirrored from bottom to top");
  matrix[1][1] = -1.0;
  EXPECT_EQ(orientationText(matrix, glm::dmat3(1.0)),
    "rotated by 180 degrees about the direction (1, 0, 0)");
  const glm::dmat3 quarter(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  EXPECT_EQ(orientationText(quarter, glm::dmat3(1.0)),
    "rotated by 90 degrees about the direction (0, 0, 1)");
  const glm::dmat3 leftHanded(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
  EXPECT_EQ(
    orientationText(quarter, leftHanded), "rotated by 90 degrees about the direction (0, 0, -1)");
  const glm::dmat3 turned(glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1));
  EXPECT_NE(orientationText(turned, glm::dmat3(1.0)).find("mirrored from"), std::string::npos);
}
