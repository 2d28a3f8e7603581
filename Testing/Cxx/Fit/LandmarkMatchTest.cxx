// SPDX-License-Identifier: BSD-3-Clause
// Proves that landmarks match by name, by order only where neither list has names or where it is
// asked for, and that those without a partner and names that occur twice are named.
#include "Filters/Fit/Measurements.h"

#include <gtest/gtest.h>

using namespace brainshift;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
using Names = std::vector<std::string>;

TEST(LandmarkMatch, ByLabel)
{
  const LandmarkMatch match =
    matchLandmarks({ "tip", "", "vein", "lost" }, { "vein", "new", "tip" });
  EXPECT_EQ(match.pairs, (Pairs{ { 0, 2 }, { 2, 0 } }));
  EXPECT_EQ(match.unmatched,
    (Names{ "landmark 2 at rest", "landmark lost at rest", "measured landmark new" }));
}

TEST(LandmarkMatch, LabelsThatRepeatMatchInTheirOrder)
{
  const LandmarkMatch match = matchLandmarks({ "a", "b", "a", "a" }, { "b", "a", "a" });
  EXPECT_EQ(match.pairs, (Pairs{ { 0, 1 }, { 1, 0 }, { 2, 2 } }));
  EXPECT_EQ(match.unmatched, Names{ "landmark a at rest" });
  EXPECT_EQ(match.repeated, Names{ "a" });
  EXPECT_TRUE(matchLandmarks({ "a", "a" }, { "a", "a" }, true).repeated.empty());
}

TEST(LandmarkMatch, ByOrderWithoutNames)
{
  const LandmarkMatch match = matchLandmarks({ "", "", "" }, { "", "" });
  EXPECT_EQ(match.pairs, (Pairs{ { 0, 0 }, { 1, 1 } }));
  EXPECT_EQ(match.unmatched, Names{ "landmark 3 at rest" });
  EXPECT_TRUE(matchLandmarks({}, {}).pairs.empty());
  EXPECT_TRUE(matchLandmarks({ "a" }, {}).pairs.empty());
}

// A prefix, other case, blanks, another language; names on one list only.
TEST(LandmarkMatch, IsRefusedWhereNoNameIsOnBothLists)
{
  const Names rest{ "AC", "PC", "left ventricle", "RV" };
  for (const Names& measured :
    { Names{ "F-1", "F-2", "F-3", "F-4" }, Names{ "ac", "pc", "Left Ventricle", "rv" },
      Names{ "", "", "", "" }, Names{ "Kommissur", "", "", "" } })
  {
    for (const bool isMirrored : { false, true })
    {
      const auto match = [&](bool byOrder) {
        return isMirrored ? matchLandmarks(measured, rest, byOrder)
                          : matchLandmarks(rest, measured, byOrder);
      };
      const std::string problem = problemOf([&] { match(false); });
      EXPECT_NE(problem.find(R"("AC", "PC", "left ventricle" ...)"), std::string::npos) << problem;
      EXPECT_NE(problem.find("Pair By Order"), std::string::npos) << problem;
      EXPECT_EQ(match(true).pairs, (Pairs{ { 0, 0 }, { 1, 1 }, { 2, 2 }, { 3, 3 } }));
    }
  }
}
