// SPDX-License-Identifier: BSD-3-Clause
// Proves that landmarks match by label wherever a label is shared, else by order, and that those
// without a partner are named.
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
}

TEST(LandmarkMatch, ByOrderWithoutASharedLabel)
{
  const LandmarkMatch match = matchLandmarks({ "a", "", "" }, { "", "x" });
  EXPECT_EQ(match.pairs, (Pairs{ { 0, 0 }, { 1, 1 } }));
  EXPECT_EQ(match.unmatched, Names{ "landmark 3 at rest" });
  EXPECT_TRUE(matchLandmarks({}, {}).pairs.empty());
}
