// SPDX-License-Identifier: BSD-3-Clause
// Proves that the sheet predicts contacts that are left out, keeps its pitch, leaves the cortex
// beyond the opening, and says which contacts are not on the cortex. The brain sags by 5 to 15 mm,
// contacts have noise of 0.4 mm. The table compares with the nearest point of the cortex and with a
// fit to the contacts as traces.
#include "Filters/Electrodes/SheetFit.h"
#include "Testing/Cxx/Electrodes/SyntheticGrids.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double NoiseMm = 0.4;
constexpr int Cases = 4;

std::optional<SurfacePoint> onCortex(const glm::dvec3& rest, std::size_t)
{
  return WavyCortex::nearest(rest);
}

const std::vector<SurfacePoint>& cortexPoints()
{
  static const std::vector<SurfacePoint> points = WavyCortex::points(3000);
  return points;
}

struct Figure
{
  double sum = 0.0;
  double largest = 0.0;
  int count = 0;

  void add(double value)
  {
    this->sum += value;
    this->largest = std::max(this->largest, value);
    ++this->count;
  }
  double mean() const { return this->count ? this->sum / this->count : 0.0; }
};

// A patient: what is known and what is true.
struct Patient
{
  Sag sag;
  LaidGrid grid;

  Patient() = default;
  Patient(const GridShape& shape, int number)
  {
    const std::vector<glm::dvec3> sides{ { 0.9, -0.3, 0.5 }, { -1.0, 0.1, 0.4 }, { -0.6, 0.6, 0.7 },
      { 0.5, 0.4, 0.9 } };
    const std::vector<double> depths{ 5.0, 8.0, 11.0, 15.0 };
    this->sag = sagAt(sides[number], depths[number], 5.0 + 3.0 * number, 100 + number);
    this->grid = laidGrid(shape, this->sag, 0.7 * number,
      { 3.0 * number - 4.0, 5.0 - 3.0 * number }, NoiseMm, 50 + number);
  }

  // A patient of no other test: any place, depth and tilt of the sag, any turn of the grid.
  static Patient any(const GridShape& shape, unsigned seed)
  {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    const glm::dvec3 side(normal(random), normal(random), std::abs(normal(random)));
    const double depthMm = 5.0 + 10.0 * uniform(random);
    const double tiltDegrees = 20.0 * uniform(random);
    const double turn = 2.0 * 3.14159265358979 * uniform(random);
    const glm::dvec2 aside(12.0 * uniform(random) - 6.0, 12.0 * uniform(random) - 6.0);
    Patient patient;
    patient.sag = sagAt(side, depthMm, tiltDegrees, seed + 1);
    patient.grid = laidGrid(shape, patient.sag, turn, aside, NoiseMm, seed + 2);
    return patient;
  }

  OpeningBall opening(const Sheet& sheet) const
  {
    std::vector<glm::dvec3> contacts;
    for (const std::optional<glm::dvec3>& contact : sheet.contacts)
    {
      if (contact)
      {
        contacts.push_back(*contact);
      }
    }
    return ballAround(contacts);
  }

  std::vector<SurfacePoint> anchors(const Sheet& sheet) const
  {
    const OpeningBall ball = this->opening(sheet);
    return chooseAnchors(cortexPoints(), [&](const glm::dvec3& rest) {
      return glm::distance(rest, ball.centre) < ball.radiusMm + AnchorMarginMm;
    });
  }
};

// What a fit makes of pairs and traces: as brainshift.electrodes calls it.
Fit fitOf(
  const Sheet& sheet, const std::vector<glm::dvec3>& rest, const std::vector<SurfacePoint>& anchors)
{
  Measurements measured;
  measured.anchors = anchors;
  for (std::size_t k = 0; k < sheet.contacts.size(); ++k)
  {
    if (const std::optional<glm::dvec3>& contact = sheet.contacts[k])
    {
      measured.traces.push_back(*contact);
      if (!rest.empty())
      {
        measured.landmarks.push_back({ rest[k], *contact });
      }
    }
  }
  Fit fit;
  fit.solve(measured, {}, onCortex);
  return fit;
}

struct Figures
{
  Figure leftBent;   // mm: predicted from true positions of contacts that are left out
  Figure leftFilled; // mm: the same without a sheet, filled in smoothly
  Figure rest;       // mm: of all contacts at rest
  Figure restByNearest;
  Figure restByTraces;
  Figure tissue; // mm: where the fit puts the tissue of contacts that are left out
  Figure tissueByTraces;
  Figure pitch;  // a fraction: of mean distances at rest, of each patient
  Figure still;  // mm: what moves of the cortex that stays where it is
  Figure beyond; // mm: of that, cortex beyond the opening that the fit knows, around the contacts
};

// Leaves out some contacts of a patient and adds what that shows.
void judge(const Patient& patient, const std::set<int>& left, Figures& figures)
{
  const LaidGrid& grid = patient.grid;
  Sheet sheet = grid.sheet;
  for (const int k : left)
  {
    sheet.contacts[k].reset();
  }
  const std::vector<SurfacePoint> anchors = patient.anchors(sheet);
  const std::vector<SheetPlace> places = fitSheets({ sheet }, onCortex, anchors).front();
  std::vector<glm::dvec3> rest;
  rest.reserve(places.size());
  for (const SheetPlace& place : places)
  {
    rest.push_back(place.rest);
  }
  const std::vector<glm::dvec3> filled = filledSheet(sheet);
  const Fit fit = fitOf(sheet, rest, anchors);
  const Fit traced = fitOf(sheet, {}, anchors);
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < static_cast<int>(places.size()); ++k)
  {
    if (left.count(k))
    {
      figures.leftBent.add(glm::distance(places[k].bent, grid.bent[k]));
      figures.leftFilled.add(glm::distance(filled[k], grid.bent[k]));
      figures.tissue.add(glm::distance(fit.measuredFromRest(grid.rest[k]), grid.bent[k]));
      figures.tissueByTraces.add(
        glm::distance(traced.measuredFromRest(grid.rest[k]), grid.bent[k]));
    }
    figures.rest.add(glm::distance(rest[k], grid.rest[k]));
    figures.restByNearest.add(glm::distance(WavyCortex::nearest(filled[k]).position, grid.rest[k]));
    glm::dvec3 back = filled[k];
    for (int i = 0; i < 30; ++i)
    {
      back = filled[k] - traced.bend(back);
    }
    figures.restByTraces.add(glm::distance(back, grid.rest[k]));
    if ((k + 1) % sheet.columns != 0)
    {
      sum += glm::distance(rest[k], rest[k + 1]) / sheet.pitchMm - 1.0;
      ++count;
    }
  }
  figures.pitch.add(std::abs(sum / count));
  const OpeningBall opening = patient.opening(sheet);
  for (const SurfacePoint& point : cortexPoints())
  {
    if (glm::distance(point.position, patient.sag.centre) > patient.sag.radiusMm + AnchorMarginMm)
    {
      const double moved = std::abs(glm::dot(point.normal, fit.bend(point.position)));
      figures.still.add(moved);
      if (glm::distance(point.position, opening.centre) > opening.radiusMm + AnchorMarginMm)
      {
        figures.beyond.add(moved);
      }
    }
  }
}

void print(const GridShape& shape, const char* what, const Figures& f)
{
  std::printf(
    "%dx%d %4.1f mm%s %-9s | left out %.2f mm (largest %.2f), filled in %.2f | at rest %.2f, "
    "nearest %.2f, traces %.2f | tissue %.2f, traces %.2f | pitch %.1f %% | still %.2f, beyond the "
    "opening %.2f\n",
    shape.rows, shape.columns, shape.pitchMm, shape.isLaidBefore ? " laid before" : "", what,
    f.leftBent.mean(), f.leftBent.largest, f.leftFilled.mean(), f.rest.mean(),
    f.restByNearest.mean(), f.restByTraces.mean(), f.tissue.mean(), f.tissueByTraces.mean(),
    100.0 * f.pitch.largest, f.still.largest, f.beyond.largest);
}
}

class SheetFitOf : public ::testing::TestWithParam<GridShape>
{
};

TEST_P(SheetFitOf, PredictsContactsThatAreLeftOut)
{
  const GridShape shape = GetParam();
  Figures figures;
  for (int number = 0; number < Cases; ++number)
  {
    const Patient patient(shape, number);
    std::mt19937 random(number);
    std::set<int> left;
    while (static_cast<int>(left.size()) < shape.rows * shape.columns / 8)
    {
      left.insert(static_cast<int>(random() % (shape.rows * shape.columns)));
    }
    judge(patient, left, figures);
  }
  print(shape, "contacts", figures);
  EXPECT_LT(figures.leftBent.mean(), 0.6);
  EXPECT_LT(figures.rest.mean(), figures.restByNearest.mean());
  EXPECT_LT(figures.pitch.largest, 0.02);
  EXPECT_LT(figures.still.mean(), 0.1);
  EXPECT_LT(figures.beyond.largest, 0.5);
}

TEST_P(SheetFitOf, PredictsRowsThatAreLeftOut)
{
  const GridShape shape = GetParam();
  Figures figures;
  for (int number = 0; number < Cases; ++number)
  {
    const Patient patient(shape, number);
    for (const int row : { 0, shape.rows / 2 })
    {
      std::set<int> left;
      for (int column = 0; column < shape.columns; ++column)
      {
        left.insert(row * shape.columns + column);
      }
      judge(patient, left, figures);
    }
  }
  print(shape, "rows", figures);
  EXPECT_LT(figures.leftBent.mean(), 0.9);
  EXPECT_LT(figures.leftBent.mean(), figures.leftFilled.mean());
  EXPECT_LT(figures.pitch.largest, 0.02);
  EXPECT_LT(figures.beyond.largest, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SheetFitOf,
  ::testing::Values(GridShape{ 8, 8, 10.0 }, GridShape{ 4, 8, 10.0 }, GridShape{ 6, 6, 5.0 },
    GridShape{ 8, 8, 10.0, true }, GridShape{ 4, 8, 10.0, true }));

// A sheet that was laid before the cortex sagged stretches with it by 2 to 6 %, alike where it is
// near. If each pair of neighbours stretched for itself, the error would be 0.98 mm.
TEST(SheetFit, PredictsRowsOfASheetThatStretchedWithTheCortex)
{
  Figures figures;
  for (unsigned number = 0; number < 5; ++number)
  {
    const Patient patient = Patient::any({ 8, 8, 10.0, true }, 47000 + 10 * number);
    for (const int row : { 0, 4 })
    {
      std::set<int> left;
      for (int column = 0; column < 8; ++column)
      {
        left.insert(row * 8 + column);
      }
      judge(patient, left, figures);
    }
  }
  print({ 8, 8, 10.0, true }, "any rows", figures);
  EXPECT_LT(figures.leftBent.mean(), 0.75);
  EXPECT_LT(figures.pitch.largest, 0.02);
}

TEST(SheetFit, LeavesTheCortexBeyondTheOpening)
{
  for (const GridShape& shape : { GridShape{ 5, 8, 10.0 }, GridShape{ 6, 8, 10.0, true },
         GridShape{ 8, 8, 5.0 }, GridShape{ 8, 8, 10.0 } })
  {
    Figures figures;
    for (unsigned number = 0; number < 3; ++number)
    {
      const Patient patient = Patient::any(shape, 500 + 10 * number);
      std::set<int> left;
      for (int column = 0; column < shape.columns; ++column)
      {
        left.insert(column);
      }
      judge(patient, left, figures);
    }
    print(shape, "any row", figures);
    EXPECT_LT(figures.beyond.largest, 0.4);
  }
}

TEST(SheetFit, LeavesAGridWhereNothingMoved)
{
  Sag still = sagAt({ 1.0, 0.2, 0.4 }, 0.0, 0.0, 1);
  still.swellBy = glm::dvec3(0.0);
  const LaidGrid laid = laidGrid({ 5, 4, 10.0 }, still, 0.2, { 0.0, 0.0 }, 0.0, 1);
  const std::vector<SheetPlace> places = fitSheets({ laid.sheet }, onCortex, {}).front();
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    EXPECT_LT(glm::distance(places[k].rest, laid.rest[k]), 0.1);
    EXPECT_LT(std::abs(places[k].outside), 0.1);
    EXPECT_FALSE(places[k].isOff());
  }
}

TEST(SheetFit, SaysWhichContactsAreNotOnTheCortex)
{
  const Patient patient({ 8, 8, 10.0 }, 1);
  Sheet sheet = patient.grid.sheet;
  const glm::dvec3 up = WavyCortex::nearest(patient.grid.rest[20]).normal;
  const glm::dvec3 down = -WavyCortex::nearest(patient.grid.rest[45]).normal;
  sheet.contacts[20] = sheet.contacts[20].value_or(glm::dvec3(0.0)) + 4.0 * up;
  sheet.contacts[45] = sheet.contacts[45].value_or(glm::dvec3(0.0)) + 4.0 * down;
  const std::vector<SheetPlace> places =
    fitSheets({ sheet }, onCortex, patient.anchors(sheet)).front();
  EXPECT_NEAR(places[20].outside, 4.0, 1.2);
  EXPECT_NEAR(places[45].outside, -4.0, 1.2);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    EXPECT_EQ(places[k].isOff(), k == 20 || k == 45) << k;
  }
  // They do not pull the cortex along.
  EXPECT_LT(glm::distance(places[20].bent, patient.grid.bent[20]), 1.0);
}

TEST(SheetFit, IsNotLedAsideByAContactThatFloats)
{
  for (int number = 0; number < 3; ++number)
  {
    const Patient patient({ 4, 5, 10.0, true }, number);
    Sheet floating = patient.grid.sheet;
    Sheet without = floating;
    without.contacts[7].reset();
    floating.contacts[7] = floating.contacts[7].value_or(glm::dvec3(0.0)) +
      6.0 * WavyCortex::nearest(patient.grid.rest[7]).normal;
    const std::vector<SurfacePoint> anchors = patient.anchors(without);
    const std::vector<SheetPlace> led = fitSheets({ floating }, onCortex, anchors).front();
    const std::vector<SheetPlace> right = fitSheets({ without }, onCortex, anchors).front();
    EXPECT_TRUE(led[7].isOff());
    for (std::size_t k = 0; k < led.size(); ++k)
    {
      EXPECT_LT(glm::distance(led[k].rest, right[k].rest), 0.3) << number << " " << k;
    }
  }
}

TEST(SheetFit, StretchesMoreIfItIsLessStiff)
{
  const Patient patient({ 4, 8, 10.0 }, 2);
  const std::vector<SurfacePoint> anchors = patient.anchors(patient.grid.sheet);
  const auto unevenness = [&](double stiffness) {
    SheetSettings settings;
    settings.stiffness = stiffness;
    const std::vector<SheetPlace> places =
      fitSheets({ patient.grid.sheet }, onCortex, anchors, settings).front();
    Figure figure;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
    {
      if ((k + 1) % 8 != 0)
      {
        figure.add(std::abs(glm::distance(places[k].bent, places[k + 1].bent) / 10.0 - 1.0));
      }
    }
    return figure.mean();
  };
  const double free = unevenness(0.0);
  const double usual = unevenness(1.0);
  const double stiff = unevenness(10.0);
  EXPECT_GT(free, usual);
  EXPECT_GT(usual, stiff);
  EXPECT_LT(stiff, 0.01);
}

TEST(SheetFit, RefusesWhatItCannotFit)
{
  SheetSettings settings;
  const Sheet empty{ 4, 4, 10.0, std::vector<std::optional<glm::dvec3>>(16) };
  EXPECT_THROW(fitSheets({ empty }, onCortex, {}), Problem);
  Sheet sheet = Patient({ 4, 5, 10.0 }, 0).grid.sheet;
  settings.stiffness = -1.0;
  EXPECT_THROW(fitSheets({ sheet }, onCortex, {}, settings), Problem);
  settings = {};
  settings.contactDeviation = 0.0;
  EXPECT_THROW(fitSheets({ sheet }, onCortex, {}, settings), Problem);
  EXPECT_THROW(
    fitSheets({ sheet }, [](const glm::dvec3&, std::size_t) { return std::nullopt; }, {}), Problem);
  sheet.pitchMm = 0.0;
  EXPECT_THROW(fitSheets({ sheet }, onCortex, {}), Problem);
  EXPECT_TRUE(fitSheets({}, onCortex, {}).empty());
}
