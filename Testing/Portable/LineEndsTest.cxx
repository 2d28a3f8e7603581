// SPDX-License-Identifier: BSD-3-Clause
// Proves that text of landmarks is read alike with the ends of lines of each system, and that what
// is written has one kind of them everywhere.
#include "Formats/Landmarks/LandmarkFormats.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

using namespace brainshift;

namespace
{
std::string withEnds(std::string text, const std::string& end)
{
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at))
  {
    text.replace(at, 1, end);
    at += end.size();
  }
  return text;
}

LandmarkList twoPoints()
{
  LandmarkList list;
  for (const double x : { 1.25, -7.5 })
  {
    Landmark point;
    point.position = { x, 2.0 * x, 3.0 };
    point.label = x > 0 ? "sulcus" : "gyrus \xC3\xBC"; // an umlaut
    list.points.push_back(point);
  }
  return list;
}

void expectAlike(const LandmarkFormat& format)
{
  std::ostringstream written;
  LandmarkList points = twoPoints();
  format.write(written, format.axes, points);
  EXPECT_EQ(written.str().find('\r'), std::string::npos);
  for (const char* end : { "\n", "\r\n" })
  {
    LandmarkList found;
    format.read(withEnds(written.str(), end), {}, found);
    ASSERT_EQ(found.points.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_EQ(found.points[i].position, twoPoints().points[i].position);
      EXPECT_EQ(found.points[i].label, twoPoints().points[i].label);
    }
  }
}
}

TEST(LineEnds, OfEachFormat)
{
  ASSERT_GE(landmarkFormats().size(), 5u);
  for (const LandmarkFormat* format : landmarkFormats())
  {
    SCOPED_TRACE(format->endings().front());
    expectAlike(*format);
  }
}
