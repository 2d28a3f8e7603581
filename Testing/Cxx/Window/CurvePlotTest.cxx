// SPDX-License-Identifier: BSD-3-Clause
// Proves that the curve of the panel lies as high as its lengths in the colours of the palette,
// marks the last point, says in words what it shows, and tells the point under the cursor.
#include "Common/Numbers.h"
#include "Panel/Parts/Plots.h"
#include "Testing/Cxx/Window/PlotTesting.h"

#include <QApplication>
#include <QHelpEvent>
#include <QImage>
#include <QToolTip>

#include <gtest/gtest.h>

using namespace brainshift;

namespace
{

class Curve : public PlotTest<CurvePlot>
{
protected:
  Curve()
    : PlotTest(300)
  {
  }

  QColor colorAt(const QPointF& place) const { return this->drawn().pixelColor(place.toPoint()); }
};
}

TEST_F(Curve, LiesAsHighAsItsLengths)
{
  this->Plot->setLengths({ 4.0, 2.0, 1.0 });
  const double floor = 2.0 * this->Plot->placeOf(1).y() - this->Plot->placeOf(0).y();
  EXPECT_NEAR(
    floor - this->Plot->placeOf(2).y(), 0.25 * (floor - this->Plot->placeOf(0).y()), 1e-9);
  for (const int strokes : { 0, 1, 2 })
  {
    EXPECT_EQ(this->colorAt(this->Plot->placeOf(strokes)), QColor(Qt::red)) << strokes;
  }
  EXPECT_EQ(this->Plot->placeOf(1).x(), 150.0);
}

TEST_F(Curve, MarksTheLastPointOnly)
{
  this->Plot->setLengths({ 4.0, 2.0, 1.0 });
  const auto ringAt = [&](int strokes) {
    const QImage image = this->drawn();
    const QPoint place = this->Plot->placeOf(strokes).toPoint();
    int bright = 0;
    for (int x = -6; x <= 6; ++x)
    {
      bright += image.pixelColor(place + QPoint(x, 0)).green() > 100 ? 1 : 0;
    }
    return bright;
  };
  EXPECT_EQ(ringAt(1), 0);
  EXPECT_GE(ringAt(2), 2) << "left and right of the point";
}

TEST_F(Curve, LeavesAGapWhereItWasNotMeasured)
{
  const auto redAlong = [&] {
    const QImage image = this->drawn();
    int red = 0;
    for (int x = 0; x < image.width(); ++x)
    {
      bool any = false;
      for (int y = 0; y < image.height(); ++y)
      {
        any = any || image.pixelColor(x, y).red() > image.pixelColor(x, y).green() + 100;
      }
      red += any ? 1 : 0;
    }
    return red;
  };
  this->Plot->setLengths({ 4.0, 3.0, 2.0 });
  const int whole = redAlong();
  this->Plot->setLengths({ 4.0, NaN, 2.0 });
  EXPECT_LT(redAlong(), 0.85 * whole) << "dotted";
  EXPECT_TRUE(this->Plot->textOf(1).endsWith("not measured"));
}

// "0 to 4.00 mm" stands in the first line, so a point below it has its number below.
TEST_F(Curve, LeavesTheRangeLegible)
{
  const auto firstLine = [&] {
    const int line = this->Plot->fontMetrics().height();
    return this->drawn().copy(0, 0, this->Plot->width(), line);
  };
  this->Plot->setLengths({ 4.0, 0.5 });
  const QImage range = firstLine();
  this->Plot->setLengths({ 4.0 });
  EXPECT_EQ(firstLine(), range);
  this->Plot->setLengths({ 3.0, 4.0 });
  EXPECT_EQ(firstLine(), range);
}

TEST_F(Curve, FollowsThePalette)
{
  this->Plot->setLengths({ 4.0, 2.0 });
  this->highlight(Qt::blue);
  EXPECT_EQ(this->colorAt(this->Plot->placeOf(0)), QColor(Qt::blue));
}

TEST_F(Curve, SaysWhatItShows)
{
  EXPECT_EQ(this->Plot->accessibleName(), "RMS distance over the strokes");
  EXPECT_EQ(this->Plot->accessibleDescription(), "no strokes");
  this->Plot->setLengths({ 4.894, 2.0, 1.83 });
  EXPECT_EQ(this->Plot->accessibleDescription(),
    "before the first stroke: RMS 4.89 mm; after stroke 2: RMS 1.83 mm");
}

TEST_F(Curve, TellsThePointUnderTheCursor)
{
  EXPECT_EQ(this->Plot->pointAt({ 5.0, 5.0 }), -1) << "there are none";
  this->Plot->setLengths({ 4.0, 2.0, 1.83 });
  for (const int strokes : { 0, 1, 2 })
  {
    EXPECT_EQ(this->Plot->pointAt(this->Plot->placeOf(strokes)), strokes);
  }
  const QPointF first = this->Plot->placeOf(0);
  const QPointF way = this->Plot->placeOf(1) - first;
  EXPECT_EQ(this->Plot->pointAt(first + 0.4 * way), 0) << "the nearest";
  EXPECT_EQ(this->Plot->pointAt(first + 0.6 * way), 1) << "the nearest";
  EXPECT_EQ(this->Plot->textOf(2), "after stroke 2: RMS 1.83 mm");
  this->Plot->show();
  const QPoint place = this->Plot->placeOf(2).toPoint();
  QHelpEvent hover(QEvent::ToolTip, place, this->Plot->mapToGlobal(place));
  QApplication::sendEvent(this->Plot.get(), &hover);
  EXPECT_EQ(QToolTip::text(), "after stroke 2: RMS 1.83 mm");
}
