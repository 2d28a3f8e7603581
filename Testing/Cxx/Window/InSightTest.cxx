// SPDX-License-Identifier: BSD-3-Clause
// Proves that a part of the panel stays within the visible width where its contents allow that,
// and that the panel is as wide as its widest contents whatever the part needs: it neither grows
// without end nor stays wide for the sake of a margin.
#include "Interaction/Workarounds/Docks.h"
#include "Testing/Cxx/Window/Application.h"

#include <QScrollArea>
#include <QVBoxLayout>

#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;

namespace
{
constexpr int Seen = 260; // pixels of the panel's width that are visible

// A panel as ParaView's: a wide row, and below it a part that wants to be seen whole.
struct Panel
{
  explicit Panel(int wide, int needed)
  {
    application();
    this->Area.setWidgetResizable(true);
    this->Area.setFrameShape(QFrame::NoFrame);
    this->Area.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    this->Area.resize(Seen, 400);
    auto contents = new QWidget;
    auto column = new QVBoxLayout(contents);
    column->setContentsMargins(0, 0, 0, 0);
    this->Row = new QWidget(contents);
    this->Row->setMinimumWidth(wide);
    column->addWidget(this->Row);
    this->Part = new QWidget(contents);
    auto inner = new QVBoxLayout(this->Part);
    inner->setContentsMargins(0, 0, 0, 0);
    this->Content = new QWidget(this->Part);
    this->Content->setMinimumWidth(needed);
    inner->addWidget(this->Content);
    new InSight(this->Part);
    column->addWidget(this->Part);
    this->Area.setWidget(contents);
    this->Area.show();
    settle();
  }

  // Some turns of the event loop: a layout answers a request in the next one.
  static void settle()
  {
    for (int turn = 0; turn < 20; ++turn)
    {
      QApplication::sendPostedEvents();
      QApplication::processEvents();
    }
  }

  QScrollArea Area;
  QWidget* Row = nullptr;
  QWidget* Part = nullptr;
  QWidget* Content = nullptr;
};

// A part that needs less than is seen, all of it, a little more, and more than the row.
class InSightOf : public testing::TestWithParam<int>
{
};

TEST_P(InSightOf, PanelIsAsWideAsItsWidestContents)
{
  const int needed = this->GetParam();
  const Panel panel(489, needed);
  EXPECT_EQ(panel.Area.widget()->width(), std::max(489, needed));
  EXPECT_EQ(panel.Content->width(), std::max(Seen, needed));
}

TEST_P(InSightOf, PanelNarrowsWithItsContents)
{
  const int needed = this->GetParam();
  Panel panel(489, needed);
  panel.Row->setMinimumWidth(100);
  Panel::settle();
  EXPECT_EQ(panel.Area.widget()->width(), std::max(Seen, needed));
}

TEST_P(InSightOf, ContentsMayGrowAndShrink)
{
  const int needed = this->GetParam();
  Panel panel(489, needed);
  panel.Content->setMinimumWidth(needed + 300);
  Panel::settle();
  EXPECT_EQ(panel.Area.widget()->width(), std::max(489, needed + 300));
  panel.Content->setMinimumWidth(needed);
  Panel::settle();
  EXPECT_EQ(panel.Area.widget()->width(), std::max(489, needed));
  EXPECT_EQ(panel.Content->width(), std::max(Seen, needed));
}

INSTANTIATE_TEST_SUITE_P(Widths, InSightOf, testing::Values(100, Seen, Seen + 5, 600));
}
