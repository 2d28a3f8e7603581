// SPDX-License-Identifier: BSD-3-Clause
// Proves, without a window, that the list of strokes reads the property at once, whoever changed
// it, writes each edit as one list of strokes, and refuses what would lose them; that advice is
// given on the right side of its limits; that each key and gesture means one command; and that
// Documentation/keys.md says what the table of commands says. With BRAINSHIFT_WRITE_KEYS set, the
// test writes that file.
#include "Filters/Looks/Look.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/Tools.h"
#include "Panel/Parts/Advice.h"
#include "Panel/Parts/List.h"
#include "Panel/Strokes/StrokeList.h"
#include "Panel/Tools/LookChoice.h"
#include "Panel/Window/KeysText.h"
#include "Testing/Cxx/Window/Application.h"

#include <vtkNew.h>
#include <vtkSMDoubleVectorProperty.h>

#include <QFile>
#include <QSet>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include <cmath>

using namespace brainshift;

namespace
{
Stroke stamp(double pull)
{
  Stroke stroke;
  stroke.tool = Tool::Stamp;
  stroke.anchor = { 10.0, 20.0, 30.0 };
  stroke.axis = { 0.0, 0.0, -2.0 };
  stroke.vector = { 0.0, 0.0, pull };
  stroke.major = 40.0;
  stroke.minor = 25.0;
  return stroke;
}

Stroke soft()
{
  Stroke stroke;
  stroke.tool = Tool::Soft;
  stroke.vector = { 3.0, 4.0, 0.0 };
  stroke.major = 30.0;
  return stroke;
}

class StrokesInAList : public testing::Test
{
protected:
  StrokesInAList() { application(); }

  void set(const std::vector<Stroke>& strokes)
  {
    const std::vector<double> numbers = numbersFromStrokes(strokes);
    this->Property->SetNumberOfElements(static_cast<unsigned int>(numbers.size()));
    this->Property->SetElements(numbers.data(), static_cast<unsigned int>(numbers.size()));
    this->Model.update();
  }

  QVariant at(int row, int column, int role = Qt::DisplayRole) const
  {
    return this->Model.data(this->Model.index(row, column), role);
  }
  bool edit(int row, int column, const QVariant& value, int role = Qt::EditRole)
  {
    return this->Model.setData(this->Model.index(row, column), value, role);
  }

  vtkNew<vtkSMDoubleVectorProperty> Property;
  std::vector<std::vector<Stroke>> Written;
  StrokeModel Model{ Property, [this](const std::vector<Stroke>& strokes, const QString& label) {
                      EXPECT_FALSE(label.isEmpty());
                      this->Written.push_back(strokes);
                      this->set(strokes);
                    } };
};
}

TEST_F(StrokesInAList, ReadsThePropertyWhenAsked)
{
  this->set({ stamp(-10.0), soft() });
  EXPECT_EQ(this->Model.rowCount(), 2);
  EXPECT_EQ(this->at(0, StrokeModel::ToolColumn).toString(), "1 Stamp");
  EXPECT_EQ(this->at(0, StrokeModel::WhereColumn).toString(), "10, 20, 30");
  EXPECT_EQ(this->at(0, StrokeModel::AmountColumn).toString(), "-10.0");
  EXPECT_EQ(this->at(0, StrokeModel::MinorColumn).toString(), "25.0");
  EXPECT_EQ(this->at(1, StrokeModel::AmountColumn).toString(), "5.0");
  EXPECT_EQ(this->at(1, StrokeModel::MinorColumn).toString(), "");
  // Without being told: there is no copy to be out of date.
  this->Property->SetElement(1, 11.0);
  EXPECT_EQ(this->at(0, StrokeModel::WhereColumn).toString(), "11, 20, 30");
}

TEST_F(StrokesInAList, BeginsWithWhatMattersMost)
{
  const auto title = [this](int column) {
    return this->Model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
  };
  EXPECT_EQ(title(0), "Stroke");
  EXPECT_EQ(title(1), "Amount");
  EXPECT_EQ(title(2), "Reached");
  this->set({ stamp(-10.0), soft() });
  ListTree tree(&this->Model, { 4, 9, {} });
  for (const int width : { 120, 260, 600 }) // pixels
  {
    tree.resize(width, 200);
    tree.grab(); // lays it out
    EXPECT_GE(
      tree.columnWidth(StrokeModel::ToolColumn), tree.fontMetrics().horizontalAdvance("1 Stamp"))
      << width;
    EXPECT_EQ(tree.isColumnHidden(StrokeModel::WhereColumn), width < 600) << width;
  }
}

TEST_F(StrokesInAList, FollowsOtherLengths)
{
  QSignalSpy inserted(&this->Model, &QAbstractItemModel::rowsInserted);
  QSignalSpy removed(&this->Model, &QAbstractItemModel::rowsRemoved);
  this->set({ soft(), soft(), soft() });
  this->set({ soft() });
  this->set({});
  EXPECT_EQ(inserted.count(), 1);
  EXPECT_EQ(removed.count(), 2);
  EXPECT_EQ(this->Model.rowCount(), 0);
  // Between a change of the property and the notice of it, rows that are gone read as nothing.
  this->set({ soft(), soft() });
  this->Property->SetNumberOfElements(NumbersPerStroke);
  EXPECT_EQ(this->Model.stroke(1), Stroke());
}

TEST_F(StrokesInAList, EditsNumbersInOneListEach)
{
  this->set({ stamp(-10.0), soft() });
  EXPECT_TRUE(this->edit(0, StrokeModel::AmountColumn, 4.0));
  EXPECT_TRUE(this->edit(1, StrokeModel::AmountColumn, 10.0));
  EXPECT_TRUE(this->edit(1, StrokeModel::MajorColumn, 12.5));
  EXPECT_TRUE(this->edit(0, StrokeModel::MinorColumn, 9.0));
  ASSERT_EQ(this->Written.size(), 4u);
  EXPECT_EQ(this->Model.stroke(0).vector, glm::dvec3(0.0, 0.0, 4.0));
  EXPECT_EQ(this->Model.stroke(1).vector, glm::dvec3(6.0, 8.0, 0.0));
  EXPECT_EQ(this->Model.stroke(1).major, 12.5);
  EXPECT_EQ(this->Model.stroke(0).minor, 9.0);
}

TEST_F(StrokesInAList, RefusesWhatWouldNotBeAStroke)
{
  Stroke still = soft();
  still.vector = glm::dvec3(0.0);
  this->set({ stamp(-10.0), soft(), still });
  EXPECT_FALSE(this->edit(1, StrokeModel::MajorColumn, 0.0));
  EXPECT_FALSE(this->edit(1, StrokeModel::AmountColumn, -5.0)); // only Stamp knows a sign
  EXPECT_FALSE(this->edit(2, StrokeModel::AmountColumn, 5.0));  // along which direction?
  EXPECT_FALSE(this->edit(1, StrokeModel::MinorColumn, 5.0));
  EXPECT_FALSE(this->edit(0, StrokeModel::MajorColumn, "wide"));
  EXPECT_FALSE(this->edit(0, StrokeModel::WhereColumn, 5.0));
  EXPECT_TRUE(this->edit(0, StrokeModel::AmountColumn, -10.0)); // nothing new is nothing to undo
  EXPECT_TRUE(this->Written.empty());
}

TEST_F(StrokesInAList, EnablesDeletesAndResets)
{
  this->set({ stamp(1.0), stamp(2.0), stamp(3.0), stamp(4.0) });
  EXPECT_TRUE(this->edit(1, StrokeModel::ToolColumn, Qt::Unchecked, Qt::CheckStateRole));
  EXPECT_FALSE(this->Model.stroke(1).enabled);
  this->Model.setOn({ 0, 1 }, true);
  EXPECT_TRUE(this->Model.stroke(1).enabled);
  this->Model.removeRowsOf({ 0, 2 });
  ASSERT_EQ(this->Model.rowCount(), 2);
  EXPECT_EQ(this->Model.stroke(0), stamp(2.0));
  EXPECT_EQ(this->Model.stroke(1), stamp(4.0));
  this->Model.removeAll();
  EXPECT_EQ(this->Model.rowCount(), 0);
  EXPECT_EQ(this->Written.size(), 4u);
}

TEST_F(StrokesInAList, TellsNumbersThatAreNoStrokes)
{
  this->set({ soft() });
  this->Property->SetNumberOfElements(15);
  this->Model.update();
  EXPECT_TRUE(this->Model.problem().contains("15 numbers"));
  EXPECT_EQ(this->Model.rowCount(), 0);
  this->Model.setOn({ 0 }, false);
  EXPECT_TRUE(this->Written.empty());
  this->Model.removeAll();
  EXPECT_EQ(this->Written.size(), 1u);
}

TEST_F(StrokesInAList, WarnsOfRadiiTheLatticeCannotFollow)
{
  this->set({ stamp(1.0) }); // 40 mm, 25 mm
  this->Model.setLatticeSpacing(30.0);
  EXPECT_TRUE(this->at(0, StrokeModel::MajorColumn, Qt::DecorationRole).isNull());
  EXPECT_FALSE(this->at(0, StrokeModel::MinorColumn, Qt::DecorationRole).isNull());
  const QString tip = this->at(0, StrokeModel::MinorColumn, Qt::ToolTipRole).toString();
  EXPECT_TRUE(tip.contains("25.0 mm") && tip.contains("30.0 mm")) << tip.toStdString();
}

TEST_F(StrokesInAList, TellsWhatTheGuardApplies)
{
  this->set({ stamp(-10.0), stamp(8.0) });
  this->Model.setAppliedShares({ 0.25 }); // of the second, nothing was told
  const QString tip = this->at(0, StrokeModel::AmountColumn, Qt::ToolTipRole).toString();
  EXPECT_TRUE(tip.contains("-2.5 of -10.0 mm")) << tip.toStdString();
  EXPECT_FALSE(this->at(0, StrokeModel::AmountColumn, Qt::DecorationRole).isNull());
  EXPECT_TRUE(this->at(1, StrokeModel::AmountColumn, Qt::DecorationRole).isNull());
  EXPECT_EQ(this->at(0, StrokeModel::AmountColumn).toString(), "-10.0"); // the stroke's own
  EXPECT_TRUE(guardAdvice(0).isEmpty());
  EXPECT_TRUE(guardAdvice(2).contains("2 strokes"));
}

TEST_F(StrokesInAList, ShowsHowFarTissueWent)
{
  this->set({ stamp(-10.0), stamp(8.0), stamp(4.0) });
  this->Model.setReaches({ 2.0, 7.9 }); // of the third, nothing is known
  EXPECT_EQ(this->at(0, StrokeModel::ReachColumn).toString(), "-2.0");
  EXPECT_EQ(this->at(1, StrokeModel::ReachColumn).toString(), "7.9");
  EXPECT_EQ(this->at(2, StrokeModel::ReachColumn).toString(), "");
  EXPECT_FALSE(this->at(0, StrokeModel::ReachColumn, Qt::DecorationRole).isNull());
  EXPECT_TRUE(this->at(1, StrokeModel::ReachColumn, Qt::DecorationRole).isNull());
  const QString tip = this->at(0, StrokeModel::ReachColumn, Qt::ToolTipRole).toString();
  EXPECT_TRUE(tip.contains("-2.0 of -10.0 mm")) << tip.toStdString();
}

TEST(Advice, IsGivenBelowTheSpacing)
{
  EXPECT_TRUE(radiusAdvice("The radius", 12.0, 12.0).isEmpty());
  EXPECT_FALSE(radiusAdvice("The radius", 11.9, 12.0).isEmpty());
}

TEST(Advice, GradesTheSmallestJacobian)
{
  EXPECT_EQ(jacobianGrade(1.0), Grade::Good);
  EXPECT_EQ(jacobianGrade(0.1), Grade::Doubtful);
  EXPECT_EQ(jacobianGrade(0.0), Grade::Bad);
}

TEST(Advice, SaysHowFarTissueIsSqueezed)
{
  EXPECT_EQ(jacobianText(1.0), "not squeezed");
  EXPECT_EQ(jacobianText(0.9999999), "not squeezed");
  EXPECT_EQ(jacobianText(0.16), "squeezed to 16 %");
  EXPECT_EQ(jacobianText(0.004), "squeezed to less than 1 %");
  EXPECT_EQ(jacobianText(0.0), "folds over itself");
  EXPECT_EQ(jacobianText(-0.5), "folds over itself");
  EXPECT_TRUE(jacobianTip(0.16).contains("0.160")); // the determinant
  EXPECT_EQ(jacobianText(0.998), "squeezed to 99 %") << "not rounded up";
}

// W3C's contrast of text on a background, 1 to 21; 4.5 is asked of text.
TEST(Advice, ColoursReadOnLightAndDark)
{
  const auto luminance = [](const QColor& color) {
    const auto linear = [](double share) {
      return share <= 0.03928 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
      0.0722 * linear(color.blueF());
  };
  for (const QColor& background :
    { QColor(239, 239, 239), QColor(255, 255, 255), QColor(53, 53, 53) })
  {
    QPalette palette;
    palette.setColor(QPalette::Window, background);
    palette.setColor(QPalette::WindowText, background.lightness() < 128 ? Qt::white : Qt::black);
    QList<QColor> colors{ quietColor(palette) };
    for (const Grade grade : { Grade::Good, Grade::Doubtful, Grade::Bad })
    {
      colors += { gradeColor(grade, palette, false), gradeColor(grade, palette, true) };
    }
    for (const QColor& color : colors)
    {
      const double text = luminance(color) + 0.05;
      const double behind = luminance(background) + 0.05;
      EXPECT_GT(std::max(text, behind) / std::min(text, behind), 4.5)
        << background.name().toStdString() << " " << color.name().toStdString();
    }
  }
}

// All of the colour-blind tell blue from yellow, or from orange. Green and red differ for others.
TEST(Advice, ColoursOfTheColourBlindDifferInBlue)
{
  for (const QColor& background : { QColor(239, 239, 239), QColor(53, 53, 53) })
  {
    QPalette palette;
    palette.setColor(QPalette::Window, background);
    const auto blueness = [&](Grade grade, bool blueAndOrange) {
      const QColor color = gradeColor(grade, palette, blueAndOrange);
      return color.blueF() - (color.redF() + color.greenF()) / 2.0;
    };
    EXPECT_GT(blueness(Grade::Good, true), 0.25);
    EXPECT_LT(blueness(Grade::Bad, true), -0.25);
    EXPECT_LT(std::abs(blueness(Grade::Good, false) - blueness(Grade::Bad, false)), 0.25);
  }
}

TEST(Commands, EachGestureMeansOneThing)
{
  QSet<QString> seen;
  for (const CommandRow& row : commandTable())
  {
    EXPECT_TRUE(row.keys.empty() != (row.mouse == Mouse::None)) << row.what;
    EXPECT_TRUE(QString(row.what).endsWith('.')) << row.what;
    EXPECT_FALSE(QString(row.hint).endsWith('.')) << row.hint;
    for (const Tool tool : row.tools.empty() ? std::vector{ Tool::None } : row.tools)
    {
      const QString gesture =
        QString("%1 %2 %3").arg(int(row.scope)).arg(int(tool)).arg(keysText(row));
      EXPECT_FALSE(seen.contains(gesture)) << gesture.toStdString();
      seen.insert(gesture);
    }
  }
}

TEST(Tools, HaveAllThatARowNeeds)
{
  QSet<int> keys;
  ASSERT_EQ(toolTable().size(), KnownTools.size());
  for (std::size_t i = 0; i < KnownTools.size(); ++i)
  {
    const ToolRow& row = toolTable()[i];
    const std::string name = row.id().toStdString();
    EXPECT_EQ(row.tool, KnownTools[i].tool) << name;
    EXPECT_EQ(&toolRow(row.tool), &row) << name;
    EXPECT_TRUE(row.make) << name;
    EXPECT_TRUE(QString(row.what).endsWith('.')) << name;
    EXPECT_TRUE(QFile::exists(row.icon())) << name;
    EXPECT_TRUE(QFile::exists(BRAINSHIFT_SOURCE_DIR "/Documentation/" + QString(row.page))) << name;
    EXPECT_FALSE(row.gestures.empty()) << name;
    keys.insert(row.key.toCombined());
    for (const CommandRow& gesture : row.gestures)
    {
      const QString hint(gesture.hint);
      EXPECT_EQ(hint.contains("%1"), gesture.number != nullptr) << gesture.hint;
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(keys.size()), KnownTools.size());
  EXPECT_FALSE(toolRow(Tool::None).make);
}

TEST(Looks, HaveAnIconAndATip)
{
  for (const LookRow& look : lookTable())
  {
    EXPECT_FALSE(iconOfLook(look.name).pixmap(16, 16).isNull()) << look.name;
    EXPECT_TRUE(tipOfLook(QString(look.name) + ": labels.nii").endsWith('.')) << look.name;
  }
  EXPECT_TRUE(tipOfLook("Nothing").isEmpty());
  EXPECT_TRUE(iconOfLook("Nothing").pixmap(16, 16).isNull());
}

TEST(Commands, AreFoundByKey)
{
  EXPECT_EQ(commandOfKey({ Scope::Tool }, Qt::Key_Space).command, Command::TakeHold);

  const auto inView = [](int key) {
    return commandOfKey({ Scope::Tool, Scope::View, Scope::Slices }, key);
  };
  EXPECT_EQ(inView(Qt::Key_Y).command, Command::HoldAxis);
  EXPECT_EQ(inView(Qt::Key_Y).index, 1);
  EXPECT_EQ(inView(Qt::Key_PageDown).index, 1);
  EXPECT_EQ(inView(Qt::Key_Delete).command, Command::None); // the list's
  EXPECT_EQ(inView(Qt::Key_K).command, Command::None);      // the window's
  EXPECT_EQ(commandOfKey({ Scope::List }, Qt::Key_Enter).command, Command::EditNumber);
  EXPECT_EQ(shortcutOf(Command::TakeTool, Tool::Stamp), QKeySequence("Alt+3"));
}

TEST(Commands, AreFoundByGesture)
{
  const auto stamp = [](bool shift, bool control) {
    return commandOfMouse(Scope::Tool, Tool::Stamp, Mouse::Wheel, shift, control);
  };
  EXPECT_EQ(stamp(false, false), Command::StepByWheel);
  EXPECT_EQ(stamp(true, false), Command::ChangeRadius);
  EXPECT_EQ(stamp(false, true), Command::None);
  EXPECT_EQ(stamp(true, true), Command::None);
  const auto slices = [](Mouse mouse, bool shift, bool control) {
    return commandOfMouse(Scope::Slices, Tool::None, mouse, shift, control);
  };
  EXPECT_EQ(slices(Mouse::Wheel, true, false), Command::StepSlices); // no row asks for Shift
  EXPECT_EQ(slices(Mouse::Wheel, true, true), Command::Zoom);
  EXPECT_EQ(slices(Mouse::Drag, true, false), Command::BringSlices);
  EXPECT_EQ(slices(Mouse::Drag, false, true), Command::None);
}

TEST(Commands, AreInTheDocumentation)
{
  QFile file(BRAINSHIFT_SOURCE_DIR "/Documentation/keys.md");
  if (qEnvironmentVariableIsSet("BRAINSHIFT_WRITE_KEYS"))
  {
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(keysAsMarkdown().toUtf8());
    file.close();
  }
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(QString::fromUtf8(file.readAll()).toStdString(), keysAsMarkdown().toStdString())
    << "Run this test once with BRAINSHIFT_WRITE_KEYS=1.";
}
