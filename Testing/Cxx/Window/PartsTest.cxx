// SPDX-License-Identifier: BSD-3-Clause
// Proves that a field shows one decimal and keeps the number exact until another one is typed; that
// the drawing of a tool's reach has the shape and the sizes of the tool, is shaded as its tissue
// follows, reads on light and dark palettes, and says all this in words.
#include "Filters/Deformation/Stroke.h"
#include "Panel/Parts/MillimetreField.h"
#include "Panel/Parts/ReachDrawing.h"
#include "Testing/Cxx/Window/Application.h"

#include <QImage>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;

namespace
{
constexpr double Exact = -71.828182845904523;

class FieldOfMillimetres : public testing::Test
{
protected:
  FieldOfMillimetres() { application(); }

  // As the user does: into the field, over its text, out of it.
  void type(const QString& text)
  {
    this->Field.selectAll();
    QTest::keyClicks(&this->Field, text);
    QTest::keyClick(&this->Field, Qt::Key_Return);
  }

  MillimetreField Field{ "X", -1000.0 };
  QSignalSpy Edited{ &Field, &MillimetreField::valueEdited };
};

Reach reach(double along, double across, bool hasAxis, double sigma = 0.5)
{
  return { along, across, hasAxis, [sigma](double distance) { return falloff(distance, sigma); } };
}

QImage drawn(const Reach& reach, const QPalette& palette = {})
{
  application();
  ReachDrawing drawing;
  drawing.setPalette(palette);
  drawing.resize(300, drawing.sizeHint().height());
  drawing.setReach(reach);
  return drawing.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

QPalette colours(const QColor& window, const QColor& text)
{
  QPalette palette;
  palette.setColor(QPalette::Window, window);
  palette.setColor(QPalette::WindowText, text);
  palette.setColor(QPalette::Highlight, QColor(48, 140, 198));
  return palette;
}

// How many pixels are shaded: neither the window's colour nor grey.
int shadedPixels(const QImage& image)
{
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      count += image.pixelColor(x, y).hsvSaturation() > 60 ? 1 : 0;
    }
  }
  return count;
}
}

TEST_F(FieldOfMillimetres, ShowsOneDecimalAndKeepsAll)
{
  this->Field.setValue(Exact);
  EXPECT_EQ(this->Field.text(), "-71.8");
  EXPECT_EQ(this->Field.value(), Exact);
  this->Field.setValue(0.025); // would read as nothing
  EXPECT_EQ(this->Field.text(), "0.025");
  EXPECT_EQ(this->Edited.count(), 0);
}

TEST_F(FieldOfMillimetres, LeavesAloneWhatIsNotTyped)
{
  this->Field.setValue(Exact);
  QTest::keyClick(&this->Field, Qt::Key_Return);
  EXPECT_EQ(this->Edited.count(), 0);
  EXPECT_EQ(this->Field.value(), Exact);
  this->type("-71.8");
  EXPECT_EQ(this->Edited.count(), 0) << "the same text is no edit";
  EXPECT_EQ(this->Field.value(), Exact);
}

TEST_F(FieldOfMillimetres, TakesWhatIsTyped)
{
  this->Field.setValue(Exact);
  this->type("12.345");
  ASSERT_EQ(this->Edited.count(), 1);
  EXPECT_EQ(this->Edited.front().front().toDouble(), 12.345);
  EXPECT_EQ(this->Field.value(), 12.345);
  EXPECT_EQ(this->Field.text(), "12.3");
  this->type("far");
  this->type("-2000"); // below the least
  EXPECT_EQ(this->Edited.count(), 1);
  EXPECT_EQ(this->Field.value(), 12.345);
}

TEST_F(FieldOfMillimetres, HasRoomForItsNumbers)
{
  const int room = this->Field.minimumSizeHint().width();
  EXPECT_GT(room, this->Field.fontMetrics().horizontalAdvance("-1000.0"));
  EXPECT_LT(room, this->Field.fontMetrics().horizontalAdvance("-1000.0") + 30);
}

TEST(ReachOfATool, IsToldInWords)
{
  application();
  const QString stamp = describe(reach(40.0, 25.0, true));
  EXPECT_TRUE(stamp.contains("40.0 mm") && stamp.contains("25.0 mm")) << stamp.toStdString();
  EXPECT_TRUE(describe(reach(30.0, 30.0, false)).contains("30.0 mm"));
  EXPECT_TRUE(describe(Reach()).isEmpty());
  ReachDrawing drawing;
  drawing.setReach(reach(40.0, 25.0, true));
  EXPECT_EQ(drawing.accessibleDescription(), stamp);
  EXPECT_FALSE(drawing.accessibleName().isEmpty());
}

TEST(ReachOfATool, IsDashedWhereTissueFollowsHalf)
{
  for (const double sigma : { 0.05, 0.5, 2.0 })
  {
    EXPECT_NEAR(falloff(halfDistance(reach(1.0, 1.0, false, sigma)), sigma), 0.5, 1e-6) << sigma;
  }
}

TEST(ReachOfATool, IsDrawnWithItsNumbers)
{
  const QPalette light = colours(Qt::white, Qt::black);
  const int middling = shadedPixels(drawn(reach(40.0, 25.0, true), light));
  const int peak = shadedPixels(drawn(reach(40.0, 25.0, true, 0.1), light));
  const int full = shadedPixels(drawn(reach(40.0, 25.0, true, 2.0), light));
  EXPECT_LT(peak, middling);
  EXPECT_LT(middling, full);
  EXPECT_NE(drawn(reach(40.0, 25.0, true), light), drawn(reach(41.0, 25.0, true), light));
  EXPECT_EQ(shadedPixels(drawn(Reach(), light)), 0);
}

TEST(ReachOfATool, FollowsThePalette)
{
  const QImage dark = drawn(reach(40.0, 25.0, true), colours(QColor(53, 53, 53), Qt::white));
  const QImage light = drawn(reach(40.0, 25.0, true), colours(QColor(239, 239, 239), Qt::black));
  const auto brightest = [](const QImage& image, bool least) {
    int found = least ? 255 : 0;
    for (int y = 0; y < image.height(); ++y)
    {
      for (int x = 0; x < image.width(); ++x)
      {
        const int value = qGray(image.pixel(x, y));
        found = least ? std::min(found, value) : std::max(found, value);
      }
    }
    return found;
  };
  EXPECT_GT(brightest(dark, false), 200) << "light lines on dark";
  EXPECT_LT(brightest(light, true), 60) << "dark lines on light";
}
