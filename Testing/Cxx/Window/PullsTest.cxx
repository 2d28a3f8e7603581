// SPDX-License-Identifier: BSD-3-Clause
// Proves, without a window, that pulls and pins are read from the numbers of a fit and written back
// unchanged, and that their list shows and edits them: each edit is written once, whole.
#include "Filters/Fit/PackedTables.h"
#include "Panel/Measured/PullsPane.h"
#include "Testing/Cxx/Window/Application.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

using namespace brainshift;

namespace
{
const std::vector<double> TwoPulls{ 1, 2, 3, 4, 6, 3, 1, 10, 20, 30, 10, 20, 38, 0 };
const std::vector<double> OnePin{ 5, 6, 7, 1 };

class PullsInAList : public testing::Test
{
protected:
  PullsInAList()
  {
    application();
    this->Model.show({ rowsFrom<Pull>(TwoPulls), rowsFrom<Pin>(OnePin) });
  }

  QVariant at(int row, int column, int role = Qt::DisplayRole) const
  {
    return this->Model.data(this->Model.index(row, column), role);
  }
  bool edit(int row, int column, const QVariant& value, int role = Qt::EditRole)
  {
    return this->Model.setData(this->Model.index(row, column), value, role);
  }

  std::vector<Pulled> Written;
  PullModel Model{ [this](const Pulled& pulled, const QString& label) {
                    EXPECT_FALSE(label.isEmpty());
                    this->Written.push_back(pulled);
                    this->Model.show(pulled);
                  },
    std::make_shared<FormerWeights>() };
};
}

TEST(Pulls, AreReadFromNumbersAndWrittenBack)
{
  EXPECT_EQ(numbersFrom(rowsFrom<Pull>(TwoPulls)), TwoPulls);
  EXPECT_EQ(numbersFrom(rowsFrom<Pin>(OnePin)), OnePin);
  std::vector<double> more = TwoPulls;
  more.push_back(3.0); // the filter says what is wrong with it
  EXPECT_EQ(rowsFrom<Pull>(more).size(), 2U);
  EXPECT_TRUE(rowsFrom<Pin>({ 1.0, 2.0 }).empty());
}

TEST(Pulls, AreTakenFromNearby)
{
  const std::vector<Pull> pulls = rowsFrom<Pull>(TwoPulls);
  EXPECT_EQ(nearest(pulls, { 1.0, 2.0, 4.0 }, 2.0), 0U);
  EXPECT_EQ(nearest(pulls, { 10.0, 20.0, 29.0 }, 100.0), 1U);
  EXPECT_EQ(nearest(pulls, { 1.0, 2.0, 6.0 }, 2.0), 2U); // none
  EXPECT_EQ(nearest(rowsFrom<Pin>(OnePin), { 5.0, 6.0, 7.0 }, 0.0), 0U);
}

TEST_F(PullsInAList, TellWhatWasAskedAndMissed)
{
  ASSERT_EQ(this->Model.rowCount(), 3);
  EXPECT_EQ(this->at(0, PullModel::KindColumn), "Pull 1");
  EXPECT_EQ(this->at(2, PullModel::KindColumn), "Pin 1");
  EXPECT_EQ(this->at(0, PullModel::AskedColumn), "5.0");
  EXPECT_EQ(this->at(0, PullModel::MissedColumn), ""); // not known yet
  this->Model.setPlaces({ { 4.0, 6.0, 4.5 }, { 0.0, 0.0, 0.0 }, { 5.0, 8.0, 7.0 } });
  EXPECT_EQ(this->at(0, PullModel::MissedColumn), "1.5");
  EXPECT_EQ(this->at(1, PullModel::MissedColumn), ""); // switched off
  EXPECT_EQ(this->at(2, PullModel::MissedColumn), "2.0");
  // A pin that a base holds elsewhere.
  this->Model.setPlaces(
    { { 4.0, 6.0, 4.5 }, { 0.0, 0.0, 0.0 }, { 5.0, 8.0, 7.0 } }, { { 5.0, 8.0, 7.5 } });
  EXPECT_EQ(this->at(2, PullModel::MissedColumn), "0.5");
  EXPECT_EQ(this->at(1, PullModel::KindColumn, Qt::CheckStateRole).toInt(), Qt::Unchecked);
  EXPECT_EQ(this->at(2, PullModel::KindColumn, Qt::CheckStateRole).toInt(), Qt::Checked);
}

TEST_F(PullsInAList, AreEditedAsAWhole)
{
  EXPECT_TRUE(this->edit(0, PullModel::AskedColumn, 10.0));
  ASSERT_EQ(this->Written.size(), 1U);
  const glm::dvec3 twiceAsFar(7.0, 10.0, 3.0);
  EXPECT_LT(glm::distance(this->Written.back().pulls[0].measured, twiceAsFar), 1e-12);
  EXPECT_EQ(this->Written.back().pulls.size() + this->Written.back().pins.size(), 3U);
  EXPECT_TRUE(this->edit(0, PullModel::WeightColumn, 4.0));
  EXPECT_EQ(this->Written.back().pulls[0].weight, 4.0);
  EXPECT_TRUE(this->edit(0, PullModel::WeightColumn, 4.0)); // the same is no edit
  EXPECT_EQ(this->Written.size(), 2U);
  EXPECT_FALSE(this->edit(0, PullModel::AskedColumn, -1.0));
  EXPECT_FALSE(this->edit(0, PullModel::WeightColumn, 0.0)); // the tick does that
  EXPECT_FALSE(this->edit(2, PullModel::AskedColumn, 3.0));  // a pin asks for nothing
  EXPECT_EQ(this->Written.size(), 2U);
}

TEST_F(PullsInAList, AreSwitchedOffAndDeleted)
{
  EXPECT_TRUE(this->edit(0, PullModel::KindColumn, Qt::Unchecked, Qt::CheckStateRole));
  EXPECT_EQ(this->Written.back().pulls[0].weight, 0.0);
  this->Model.setOn({ 0, 1, 2 }, true);
  EXPECT_EQ(this->Written.back().pulls[1].weight, 1.0);
  this->Model.setOn({ 2 }, false);
  EXPECT_FALSE(this->Written.back().pins[0].enabled);
  this->Model.removeRowsOf({ 2, 0 });
  ASSERT_EQ(this->Model.rowCount(), 1);
  EXPECT_EQ(this->Written.back().pulls[0].rest, glm::dvec3(10.0, 20.0, 30.0));
  this->Model.removeAll();
  EXPECT_EQ(this->Model.rowCount(), 0);
}

TEST_F(PullsInAList, KeepTheirWeightWhileTheyAreOff)
{
  ASSERT_TRUE(this->edit(0, PullModel::WeightColumn, 4.0));
  this->Model.setOn({ 0, 1 }, false);
  EXPECT_EQ(this->Written.back().pulls[0].weight, 0.0);
  this->Model.setOn({ 0, 1 }, true);
  EXPECT_EQ(this->Written.back().pulls[0].weight, 4.0);
  EXPECT_EQ(this->Written.back().pulls[1].weight, 1.0); // it was off from the start
}

TEST_F(PullsInAList, KeepTheirWeightWhereTheyAreOn)
{
  ASSERT_TRUE(this->edit(0, PullModel::WeightColumn, 4.0));
  this->Model.setOn({ 0, 1 }, true);
  EXPECT_EQ(this->Written.back().pulls[0].weight, 4.0);
  EXPECT_EQ(this->Written.back().pulls[1].weight, 1.0);
}
