// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of the panel's plots share: a plot in white and red on black, and its picture.
#ifndef BrainShift_PlotTesting_h
#define BrainShift_PlotTesting_h

#include "Testing/Cxx/Window/Application.h"

#include <QImage>
#include <QPalette>

#include <gtest/gtest.h>

#include <memory>

namespace brainshift
{
template <typename PlotType>
class PlotTest : public testing::Test
{
protected:
  /// @param width   of the plot, pixels; it is as high as it must be
  explicit PlotTest(int width)
  {
    application();
    QPalette palette;
    palette.setColor(QPalette::Window, Qt::black);
    palette.setColor(QPalette::WindowText, Qt::white);
    palette.setColor(QPalette::Highlight, Qt::red);
    this->Plot = std::make_unique<PlotType>();
    this->Plot->setPalette(palette);
    this->Plot->resize(width, this->Plot->minimumSizeHint().height());
  }

  void highlight(const QColor& color)
  {
    QPalette palette = this->Plot->palette();
    palette.setColor(QPalette::Highlight, color);
    this->Plot->setPalette(palette);
  }

  QImage drawn() const { return this->Plot->grab().toImage(); }

  std::unique_ptr<PlotType> Plot;
};
}

#endif
