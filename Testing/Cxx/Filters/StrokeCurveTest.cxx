// SPDX-License-Identifier: BSD-3-Clause
// Proves that Trace Distance remembers the RMS after each stroke: the curve grows with the strokes,
// follows undo and redo, and mixes neither other strokes, masks and strengths nor other points and
// thresholds into it.
#include "Filters/Traces/StrokeMarks.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkTraceDistance.h"

#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Radius = 12.0; // mm, of a ball of tissue
const glm::dvec3 Middle(20.0);

class CurveOverStrokes : public ::testing::Test
{
protected:
  vtkNew<vtkFreeFormDeformation> Bend;
  vtkNew<vtkTraceDistance> Filter;
  vtkNew<vtkPolyData> Trace;

  void SetUp() override
  {
    Grid grid;
    grid.dimensions = glm::ivec3(41);
    this->Bend->SetInputData(volumeOn(grid, VTK_FLOAT, [](vtkIdType i) {
      return Radius - glm::length(glm::dvec3(i % 41, i / 41 % 41, i / 41 / 41) - Middle);
    }));
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(20.0, 20.0, 35.0);
    points->InsertNextPoint(20.0, 20.0, 5.0);
    this->Trace->SetPoints(points);
    this->Filter->SetInputData(this->Trace);
    this->Filter->SetDeformationConnection(this->Bend->GetOutputPort());
    this->Filter->SetThreshold(0.0);
  }

  static Stroke pulled(double mm)
  {
    Stroke stroke = strokeAt(Tool::Soft, Middle + glm::dvec3(0, 0, Radius), { 0, 0, mm });
    stroke.major = 8.0;
    return stroke;
  }

  std::vector<double> curveAfter(const std::vector<Stroke>& strokes)
  {
    setStrokes(this->Bend, strokes);
    this->Filter->Update();
    vtkDoubleArray* numbers = this->Filter->GetRMSAfterStrokes();
    return { numbers->GetPointer(0), numbers->GetPointer(0) + numbers->GetNumberOfValues() };
  }
};
}

TEST_F(CurveOverStrokes, GrowsByOnePointAndFollowsUndoAndRedo)
{
  const std::vector<double> none = this->curveAfter({});
  ASSERT_EQ(none.size(), 1U);
  EXPECT_EQ(none[0], this->Filter->GetRMS());
  const std::vector<double> one = this->curveAfter({ pulled(1.0) });
  ASSERT_EQ(one.size(), 2U);
  EXPECT_EQ(one[0], none[0]);
  EXPECT_EQ(one[1], this->Filter->GetRMS());
  EXPECT_LT(one[1], none[0] - 0.1) << "the cortex came nearer to the trace";
  const std::vector<double> two = this->curveAfter({ pulled(1.0), pulled(0.5) });
  EXPECT_EQ(two, (std::vector<double>{ one[0], one[1], this->Filter->GetRMS() }));
  EXPECT_EQ(this->curveAfter({ pulled(1.0) }), one) << "undo";
  EXPECT_EQ(this->curveAfter({ pulled(1.0), pulled(0.5) }), two) << "redo";
}

TEST_F(CurveOverStrokes, OtherStrokesAreAnotherCurve)
{
  const std::vector<double> one = this->curveAfter({ pulled(1.0) });
  EXPECT_TRUE(std::isnan(one[0])) << "it was not measured before the first stroke";
  this->curveAfter({ pulled(1.0), pulled(0.5) });
  const std::vector<double> changed = this->curveAfter({ pulled(1.5), pulled(0.5) });
  ASSERT_EQ(changed.size(), 3U);
  EXPECT_TRUE(std::isnan(changed[1])) << "the first stroke is another one";
  EXPECT_EQ(changed[2], this->Filter->GetRMS());
}

TEST_F(CurveOverStrokes, OtherSettingsAreAnotherCurve)
{
  const std::vector<Stroke> strokes{ pulled(1.0) };
  this->curveAfter({});
  const std::vector<double> first = this->curveAfter(strokes);
  ASSERT_FALSE(std::isnan(first[0]));
  this->Bend->SetStrength(0.5);
  EXPECT_TRUE(std::isnan(this->curveAfter(strokes)[0]));
  this->Bend->SetStrength(1.0);
  EXPECT_EQ(this->curveAfter(strokes), first);
  this->Bend->SetLatticeDimensions(12, 12, 12);
  EXPECT_TRUE(std::isnan(this->curveAfter(strokes)[0]));
  this->Bend->SetLatticeDimensions(19, 19, 19);
  this->Filter->SetThreshold(1.0);
  EXPECT_TRUE(std::isnan(this->curveAfter(strokes)[0]));
  this->Filter->SetThreshold(0.0);
  EXPECT_EQ(this->curveAfter(strokes), first);
  this->Trace->GetPoints()->SetPoint(0, 20.0, 20.0, 36.0);
  this->Trace->GetPoints()->Modified();
  EXPECT_TRUE(std::isnan(this->curveAfter(strokes)[0]));
}

TEST_F(CurveOverStrokes, AMaskIsPartOfTheMarks)
{
  const auto marks = [&] {
    this->Bend->Update();
    return readMarks(this->Bend->GetOutputDataObject(0));
  };
  setStrokes(this->Bend, { pulled(1.0) });
  const StrokeMarks without = marks();
  ASSERT_EQ(without.size(), 2U);
  Grid grid;
  grid.dimensions = glm::ivec3(41);
  vtkNew<vtkFreeFormDeformation> masked;
  masked->SetInputDataObject(0, this->Bend->GetInputDataObject(0, 0));
  masked->SetInputDataObject(
    2, volumeOn(grid, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return i % 41 > 10; }));
  setStrokes(masked, { pulled(1.0) });
  masked->Update();
  const StrokeMarks with = readMarks(masked->GetOutputDataObject(0));
  ASSERT_EQ(with.size(), 2U);
  EXPECT_NE(with[0], without[0]);
  EXPECT_NE(with[1], without[1]);
  EXPECT_TRUE(readMarks(masked->GetInputDataObject(0, 0)).empty());
}
