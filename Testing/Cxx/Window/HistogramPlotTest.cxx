// SPDX-License-Identifier: BSD-3-Clause
// Proves that the histogram of the panel draws bars as tall as its counts in the colours of the
// palette, says in words what it shows, and tells what lies under the cursor.
#include "Panel/Parts/Plots.h"
#include "Testing/Cxx/Window/PlotTesting.h"

#include <QImage>

#include <gtest/gtest.h>

using namespace brainshift;

namespace
{
constexpr int BinPixels = 20;

class Histogram : public PlotTest<HistogramPlot>
{
protected:
  Histogram()
    : PlotTest(4 * BinPixels)
  {
  }

  // Pixels of the highlight's colour in the middle of a bin.
  int tallOf(int bin) const
  {
    const QImage image = this->drawn();
    int tall = 0;
    for (int y = 0; y < image.height(); ++y)
    {
      tall += image.pixelColor(bin * BinPixels + BinPixels / 4, y) == QColor(Qt::red) ? 1 : 0;
    }
    return tall;
  }
};
}

TEST_F(Histogram, BarsAreAsTallAsTheirCounts)
{
  this->Plot->setHistogram(0.5, { 0.0, 4.0, 2.0, 1.0 });
  EXPECT_EQ(this->tallOf(0), 0);
  const int most = this->tallOf(1);
  EXPECT_GT(most, this->Plot->height() / 2);
  EXPECT_NEAR(this->tallOf(2), most / 2.0, 1.0);
  EXPECT_NEAR(this->tallOf(3), most / 4.0, 1.0);
}

TEST_F(Histogram, FollowsThePalette)
{
  this->Plot->setHistogram(0.5, { 0.0, 4.0, 2.0, 1.0 });
  this->highlight(Qt::blue);
  EXPECT_EQ(this->tallOf(1), 0) << "no red any more";
  EXPECT_EQ(this->drawn().pixelColor(BinPixels + 5, 10), QColor(Qt::blue));
}

TEST_F(Histogram, SaysWhatItShows)
{
  EXPECT_EQ(this->Plot->accessibleName(), "Histogram of distances");
  EXPECT_EQ(this->Plot->accessibleDescription(), "no points");
  this->Plot->setHistogram(0.5, { 0.0, 4.0, 2.0, 1.0 });
  EXPECT_TRUE(this->Plot->accessibleDescription().contains("-0.5 mm to 0 mm: 4 point"))
    << this->Plot->accessibleDescription().toStdString();
  this->Plot->setHistogram(0.0, { 0.0, 0.0 });
  EXPECT_EQ(this->Plot->accessibleDescription(), "no points");
}

TEST_F(Histogram, TellsTheBinUnderTheCursor)
{
  EXPECT_EQ(this->Plot->binAt({ 5.0, 5.0 }), -1) << "there are none";
  this->Plot->setHistogram(0.5, { 0.0, 4.0, 2.0, 1.0 });
  EXPECT_EQ(this->Plot->binAt({ 3.5 * BinPixels, 5.0 }), 3);
  EXPECT_EQ(this->Plot->binAt({ 0.0, 5.0 }), 0);
  EXPECT_EQ(this->Plot->binAt({ 5.0, this->Plot->height() - 1.0 }), -1) << "on the labels";
  EXPECT_TRUE(this->Plot->textOf(3).startsWith("0.5 mm to 1 mm"));
}
