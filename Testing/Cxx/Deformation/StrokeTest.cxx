// SPDX-License-Identifier: BSD-3-Clause
// Proves that strokes are read as written, that each bad number is named with its value and limit,
// and that weights fall off as documented.
#include "Filters/Deformation/Stroke.h"
#include "Common/Problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace brainshift;

namespace
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

// Where a number stands in a stroke.
enum Place
{
  ToolPlace = 0,
  AxisPlace = 7,
  MajorPlace = 10,
  MinorPlace = 11,
  SigmaPlace = 12,
};

std::vector<double> numbersOf(Tool tool)
{
  return { double(int(tool)), 1, 2, 3, 4, 5, 6, 0, 0, 2, 40, 25, 0.5, 1 };
}

// The error about a good stroke followed by one with a wrong number.
std::string errorAbout(Tool tool, int place, double value)
{
  std::vector<double> numbers = numbersOf(Tool::Soft);
  std::vector<double> wrong = numbersOf(tool);
  wrong[place] = value;
  numbers.insert(numbers.end(), wrong.begin(), wrong.end());
  return problemOf([&] { strokesFromNumbers(numbers); });
}

void expectNames(const std::string& error, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(error.find(word), std::string::npos) << '"' << error << "\" lacks \"" << word << '"';
  }
}
}

TEST(Strokes, ComeBackAsTheyWereWritten)
{
  std::vector<double> numbers;
  for (const Tool tool : { Tool::Stamp, Tool::Soft, Tool::Move })
  {
    const std::vector<double> more = numbersOf(tool);
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  numbers.back() = 0; // the last one is disabled
  const std::vector<Stroke> strokes = strokesFromNumbers(numbers);
  ASSERT_EQ(strokes.size(), 3u);
  EXPECT_EQ(strokes[0].tool, Tool::Stamp);
  EXPECT_EQ(strokes[0].anchor, glm::dvec3(1, 2, 3));
  EXPECT_EQ(strokes[0].vector, glm::dvec3(4, 5, 6));
  EXPECT_EQ(strokes[0].axis, glm::dvec3(0, 0, 2));
  EXPECT_EQ(strokes[0].major, 40.0);
  EXPECT_EQ(strokes[0].minor, 25.0);
  EXPECT_EQ(strokes[0].sigma, 0.5);
  EXPECT_TRUE(strokes[0].enabled);
  EXPECT_FALSE(strokes[2].enabled);
  EXPECT_EQ(numbersFromStrokes(strokes), numbers);
}

TEST(Strokes, MayBeNone)
{
  EXPECT_TRUE(strokesFromNumbers({}).empty());
}

TEST(Strokes, DifferInEveryNumber)
{
  const Stroke stroke = strokesFromNumbers(numbersOf(Tool::Stamp)).at(0);
  for (int place = 0; place < NumbersPerStroke; ++place)
  {
    std::vector<double> other = numbersOf(Tool::Stamp);
    other[place] = place == ToolPlace ? 1.0
      : place == NumbersPerStroke - 1 ? 0.0
                                      : other[place] + 1;
    EXPECT_NE(strokesFromNumbers(other).at(0), stroke) << "number " << place;
  }
}

TEST(Strokes, NeedFourteenNumbersEach)
{
  std::vector<double> numbers = numbersOf(Tool::Soft);
  numbers.push_back(1.0);
  const std::string error = problemOf([&] { strokesFromNumbers(numbers); });
  expectNames(error, { "Strokes", "15", "14 for each stroke" });
}

TEST(Strokes, NeedFiniteNumbers)
{
  for (int place = 0; place < NumbersPerStroke; ++place)
  {
    expectNames(errorAbout(Tool::Stamp, place, NotANumber),
      { "Stroke 2", "number " + std::to_string(place) + " is ", "nan", "must be finite" });
  }
  expectNames(errorAbout(Tool::Soft, 4, -Infinity), { "Stroke 2", "number 4 is -inf", "finite" });
}

TEST(Strokes, NeedNumbersThatALatticeCanHold)
{
  for (int place = 0; place < NumbersPerStroke; ++place)
  {
    expectNames(errorAbout(Tool::Move, place, 1e39),
      { "Stroke 2", "number " + std::to_string(place) + " is 1e+39", "from -1e+09 to 1e+09" });
  }
  expectNames(errorAbout(Tool::Move, 4, -1.1e9), { "number 4 is -1.1e+09", "-1e+09" });
}

TEST(Strokes, NeedAKnownTool)
{
  const std::string limit = "it must be 0 (Move), 1 (Soft)"; // and those that follow
  expectNames(errorAbout(Tool::Move, ToolPlace, -1.0), { "Stroke 2", "tool is -1;", limit });
  expectNames(errorAbout(Tool::Move, ToolPlace, 0.5), { "Stroke 2", "tool is 0.5;", limit });
  expectNames(
    errorAbout(Tool::Move, ToolPlace, double(Tool::Pull)), { "Stroke 2", "tool is 3;", limit });
}

TEST(Strokes, NeedRadiiOfAtLeastZero)
{
  for (const Tool tool : { Tool::Move, Tool::Soft, Tool::Stamp })
  {
    expectNames(errorAbout(tool, MajorPlace, -3.0),
      { "Stroke 2", "radii are -3 and 25 mm", "must not be below 0 mm" });
    expectNames(errorAbout(tool, MinorPlace, -4.0),
      { "Stroke 2", "radii are 40 and -4 mm", "must not be below 0 mm" });
  }
}

TEST(Strokes, NeedTheRadiiTheirToolUses)
{
  expectNames(errorAbout(Tool::Soft, MajorPlace, 0.0), { "radius is 0 mm", "above 0 mm" });
  expectNames(errorAbout(Tool::Stamp, MajorPlace, 0.0), { "major radius is 0 mm", "above 0 mm" });
  expectNames(errorAbout(Tool::Stamp, MinorPlace, 0.0), { "minor radius is 0 mm", "above 0 mm" });
  EXPECT_NE(errorAbout(Tool::Stamp, MinorPlace, 0.0), errorAbout(Tool::Stamp, MajorPlace, 0.0));
}

TEST(Strokes, NeedAWidth)
{
  for (const Tool tool : { Tool::Soft, Tool::Stamp })
  {
    expectNames(errorAbout(tool, SigmaPlace, 0.0), { "Stroke 2", "sigma is 0", "0.001" });
    expectNames(errorAbout(tool, SigmaPlace, -0.5), { "Stroke 2", "sigma is -0.5", "0.001" });
    // Its square is 0, and 0 / 0 at the anchor would be no number.
    expectNames(
      errorAbout(tool, SigmaPlace, 1e-200), { "Stroke 2", "sigma is 1e-200", "at least 0.001" });
  }
}

TEST(Strokes, NeedAnAxisToStampAlong)
{
  expectNames(
    errorAbout(Tool::Stamp, AxisPlace + 2, 0.0), { "Stroke 2", "axis is 0 0 0", "length above 0" });
}

TEST(Strokes, NeedOnlyWhatTheirToolUses)
{
  EXPECT_EQ(strokesFromNumbers({ 0, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0, 1 }).size(), 1u);
  EXPECT_EQ(strokesFromNumbers({ 1, 1, 2, 3, 4, 5, 6, 0, 0, 0, 9, 0, 1, 1 }).size(), 1u);
}

TEST(Falloff, IsOneAtTheAnchorAndSmoothlyZeroAtTheRadius)
{
  constexpr double H = 1e-5;
  for (const double sigma : { 0.1, 0.5, 3.0 })
  {
    EXPECT_EQ(falloff(0.0, sigma), 1.0);
    EXPECT_EQ(falloff(1.0, sigma), 0.0);
    EXPECT_EQ(falloff(1.5, sigma), 0.0);
    EXPECT_LT(falloff(1.0 - H, sigma) / H, 10.0 * H); // slope 0: falls with the square
    double previous = 1.0;
    for (double distance = 0.01; distance < 1.0; distance += 0.01)
    {
      const double weight = falloff(distance, sigma);
      EXPECT_LT(weight, previous) << "sigma " << sigma << " at " << distance;
      EXPECT_GT(weight, 0.0);
      previous = weight;
    }
  }
}

TEST(Falloff, HalfwayIsKnown)
{
  EXPECT_NEAR(falloff(0.5, 0.5), std::exp(-0.5) * 0.75 * 0.75, 1e-15);
}

TEST(NormalisedDistance, OfASoftStrokeIsTheShareOfItsRadius)
{
  Stroke stroke;
  stroke.tool = Tool::Soft;
  stroke.anchor = { 100, 200, 300 };
  stroke.major = 10.0;
  EXPECT_NEAR(normalisedDistance(stroke, { 103, 204, 300 }), 0.5, 1e-12);
  EXPECT_NEAR(normalisedDistance(stroke, { 100, 200, 290 }), 1.0, 1e-12);
  EXPECT_EQ(normalisedDistance(stroke, stroke.anchor), 0.0);
}

TEST(NormalisedDistance, OfAStampIsOneOnItsEllipsoid)
{
  Stroke stroke;
  stroke.tool = Tool::Stamp;
  stroke.anchor = { 100, 200, 300 };
  stroke.major = 40.0;
  stroke.minor = 20.0;
  for (const double length : { 2.0, -0.1 }) // neither length nor sign of the axis counts
  {
    stroke.axis = { 0, 0, length };
    EXPECT_NEAR(normalisedDistance(stroke, { 100, 200, 340 }), 1.0, 1e-12);
    EXPECT_NEAR(normalisedDistance(stroke, { 100, 180, 300 }), 1.0, 1e-12);
    EXPECT_NEAR(normalisedDistance(stroke, { 112, 200, 268 }), 1.0, 1e-12); // 0.6, 0.8
    EXPECT_NEAR(normalisedDistance(stroke, { 106, 200, 284 }), 0.5, 1e-12);
  }
  stroke.axis = { 1, 1, 0 };
  const double along = 40.0 / std::sqrt(2.0);
  EXPECT_NEAR(normalisedDistance(stroke, { 100 + along, 200 + along, 300 }), 1.0, 1e-12);
  EXPECT_NEAR(normalisedDistance(stroke, { 100 + along, 200 - along, 300 }), 2.0, 1e-12);
  EXPECT_EQ(normalisedDistance(stroke, stroke.anchor), 0.0);
}

TEST(NormalisedDistance, OfVerySmallLengthsIsANumber)
{
  Stroke stroke;
  stroke.tool = Tool::Stamp;
  stroke.major = 40.0;
  stroke.minor = 1e-200;
  stroke.axis = { 0, 0, 3e-300 };
  EXPECT_NEAR(normalisedDistance(stroke, { 0, 0, 10 }), 0.25, 1e-12) << "on the axis";
  EXPECT_GT(normalisedDistance(stroke, { 1, 0, 10 }), 1.0) << "beside it";
  EXPECT_EQ(normalisedDistance(stroke, stroke.anchor), 0.0);
}
