// SPDX-License-Identifier: BSD-3-Clause
// Proves that Trace Distance gives the signed distance to the cortex as deformed, that its numbers
// are those of the array, that cavities do not count, and that a stroke redoes only its own part,
// with the result of doing all of it.
#include "Common/Numbers.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Traces/TissueSurface.h"
#include "Filters/Traces/TraceStatistics.h"
#include "Filters/Traces/TriangleTree.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkCompareVolumes.h"
#include "vtkDoubleArray.h"
#include "vtkTraceDistance.h"

#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double BallRadius = 15.0; // mm, of a ball of tissue

double trace(vtkPointSet* set, vtkIdType point)
{
  return set->GetPointData()->GetArray("DistanceToCortex")->GetTuple1(point);
}

double numberOf(vtkDataObject* data, const char* name)
{
  return data->GetFieldData()->GetArray(name)->GetTuple1(0);
}

vtkSmartPointer<vtkPolyData> pointsAt(const std::vector<glm::dvec3>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  for (const glm::dvec3& p : positions)
  {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  auto set = vtkSmartPointer<vtkPolyData>::New();
  set->SetPoints(points);
  return set;
}

// A ball of tissue in a rotated volume: scalars are mm inside its surface, so that the threshold 0
// is a sphere to some hundredths of a mm.
class TraceDistance : public ::testing::Test
{
protected:
  const Grid Volume = [] {
    Grid grid = obliqueGrid({ 41, 45, 49 });
    grid.spacing = { 1.0, 0.9, 1.1 };
    return grid;
  }();
  const glm::dvec3 Middle = Volume.worldFromGrid({ 20, 22, 24 });
  vtkNew<vtkFreeFormDeformation> Bend;
  vtkNew<vtkTraceDistance> Filter;

  double depth(const glm::dvec3& world) const
  {
    return BallRadius - glm::length(world - this->Middle);
  }

  vtkSmartPointer<vtkImageData> image(const std::function<double(const glm::dvec3&)>& value) const
  {
    return volumeOn(this->Volume, VTK_FLOAT, [&](vtkIdType i) {
      const glm::ivec3& n = this->Volume.dimensions;
      return value(this->Volume.worldFromGrid({ i % n.x, i / n.x % n.y, i / n.x / n.y }));
    });
  }

  void SetUp() override
  {
    this->Bend->SetInputData(this->image([&](const glm::dvec3& p) { return this->depth(p); }));
    this->Filter->SetDeformationConnection(this->Bend->GetOutputPort());
    this->Filter->SetThreshold(0.0);
  }

  vtkPointSet* run(vtkPointSet* points)
  {
    this->Filter->SetInputData(points);
    this->Filter->Update();
    return vtkPointSet::SafeDownCast(this->Filter->GetOutputDataObject(0));
  }

  PointMap map()
  {
    this->Bend->Update();
    return PointMap(effectiveLattice(
      deformationOf(vtkImageData::SafeDownCast(this->Bend->GetOutputDataObject(0)))));
  }

  // Positions within some mm of the sphere, on both sides.
  std::vector<glm::dvec3> around(int count) const
  {
    Random random(17);
    std::vector<glm::dvec3> positions;
    while (static_cast<int>(positions.size()) < count)
    {
      const glm::dvec3 aside = random.between(glm::dvec3(-1), glm::dvec3(1));
      if (glm::length(aside) > 0.1)
      {
        positions.push_back(
          this->Middle + glm::normalize(aside) * (BallRadius + random.between(-6.0, 6.0)));
      }
    }
    return positions;
  }
};
}

TEST_F(TraceDistance, OfAnUnbentSphereIsKnown)
{
  const auto positions = this->around(500);
  vtkPointSet* traced = this->run(pointsAt(positions));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    EXPECT_NEAR(trace(traced, i), -this->depth(positions[i]), 0.03) << "mm";
  }
}

TEST_F(TraceDistance, FollowsTheBentSurface)
{
  // Independent of triangles: the sphere in 0.1 mm samples, each put where PointMap puts it.
  const glm::dvec3 top = this->Middle + glm::dvec3(0, 0, BallRadius);
  setStrokes(this->Bend, { strokeAt(Tool::Stamp, top, { 1.0, 2.0, -7.0 }) });
  const PointMap map = this->map();
  std::vector<glm::dvec3> sphere;
  constexpr int rings = 450;
  for (int ring = 0; ring <= rings; ++ring)
  {
    const double polar = M_PI * ring / rings;
    const int around = static_cast<int>(2 * rings * std::sin(polar)) + 1;
    for (int i = 0; i < around; ++i)
    {
      const double turn = 2 * M_PI * i / around;
      sphere.push_back(map.deformedFromRest(this->Middle +
        BallRadius *
          glm::dvec3(
            std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar))));
    }
  }
  const auto positions = this->around(150);
  vtkPointSet* traced = this->run(pointsAt(positions));
  double furthestFromUnbent = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    double nearest = 1e9;
    for (const glm::dvec3& sample : sphere)
    {
      nearest = std::min(nearest, glm::length(sample - positions[i]));
    }
    const double rest = this->depth(map.restFromDeformed(positions[i]));
    EXPECT_NEAR(trace(traced, i), rest > 0.0 ? -nearest : nearest, 0.08) << "mm, point " << i;
    furthestFromUnbent =
      std::max(furthestFromUnbent, std::abs(trace(traced, i) + this->depth(positions[i])));
  }
  EXPECT_GT(furthestFromUnbent, 4.0) << "mm; the stroke must matter";
}

TEST_F(TraceDistance, NumbersAreThoseOfTheArray)
{
  auto positions = this->around(400);
  positions.emplace_back(NaN, 0.0, 0.0);
  vtkPointSet* traced = this->run(pointsAt(positions));
  EXPECT_TRUE(std::isnan(trace(traced, 400)));
  std::vector<double> distances;
  distances.reserve(400);
  for (int i = 0; i < 400; ++i)
  {
    distances.push_back(trace(traced, i));
  }
  const TraceStatistics expected = statisticsOf(distances);
  EXPECT_EQ(this->Filter->GetCount(), 400);
  EXPECT_NEAR(this->Filter->GetMean(), expected.mean, 1e-6);
  EXPECT_NEAR(this->Filter->GetRMS(), expected.rms, 1e-6);
  EXPECT_NEAR(this->Filter->GetPercentile95(), expected.percentile95, 1e-6);
  EXPECT_EQ(numberOf(traced, "Count"), 400);
  EXPECT_EQ(numberOf(traced, "Mean"), this->Filter->GetMean());
  EXPECT_EQ(numberOf(traced, "RMS"), this->Filter->GetRMS());
  EXPECT_EQ(numberOf(traced, "Percentile95"), this->Filter->GetPercentile95());
}

// A figure that stays would be taken for one of what is there now.
TEST_F(TraceDistance, LeavesNoFigureOfARunBeforeOneThatFailed)
{
  Errors errors(this->Filter);
  Errors above(this->Bend);
  const auto set = pointsAt(this->around(20));
  vtkTraceDistance* filter = this->Filter;
  const auto expectGood = [&] {
    this->run(set);
    EXPECT_STREQ(filter->GetProblem(), "");
    EXPECT_EQ(filter->GetCount(), 20);
    EXPECT_GT(filter->GetRMS(), 0.5) << "mm";
    EXPECT_GT(filter->GetHistogram()->GetValue(0), 0.0);
    EXPECT_EQ(filter->GetRMSAfterStrokes()->GetNumberOfTuples(), 1);
  };
  const auto expectNone = [&] {
    this->run(set);
    EXPECT_STRNE(filter->GetProblem(), "");
    EXPECT_EQ(filter->GetCount(), 0);
    EXPECT_TRUE(std::isnan(filter->GetMean()) && std::isnan(filter->GetRMS()));
    EXPECT_TRUE(std::isnan(filter->GetPercentile95()));
    EXPECT_EQ(filter->GetHistogram()->GetValue(0), 0.0);
    EXPECT_EQ(filter->GetRMSAfterStrokes()->GetNumberOfTuples(), 0);
  };
  EXPECT_STRNE(filter->GetProblem(), "") << "nothing ran";
  expectGood();
  filter->SetThreshold(900.0);
  expectNone();
  EXPECT_NE(errors.take().find("Threshold is 900 and gives no surface"), std::string::npos);
  EXPECT_NE(std::string(filter->GetProblem()).find("Threshold is 900"), std::string::npos);
  filter->SetThreshold(0.0);
  expectGood();
  vtkSmartPointer<vtkDataObject> good = this->Bend->GetInput();
  this->Bend->SetInputData(imageOn(plainGrid(glm::ivec3(1), glm::dvec3(1.0)))); // no volume
  expectNone();
  EXPECT_EQ(errors.take(), "") << "the filter above said what failed";
  EXPECT_NE(above.take(), "");
  this->Bend->SetInputData(good);
  expectGood();
}

TEST(TraceStatistics, OfKnownDistances)
{
  const TraceStatistics some = statisticsOf({ -3.0, 1.0, NaN, 4.0, -2.0 });
  EXPECT_EQ(some.count, 4u);
  EXPECT_DOUBLE_EQ(some.mean, 0.0);
  EXPECT_DOUBLE_EQ(some.rms, std::sqrt(30.0 / 4.0));
  EXPECT_DOUBLE_EQ(some.percentile95, 3.85) << "between 3 and 4";
  EXPECT_DOUBLE_EQ(statisticsOf({ -2.5 }).percentile95, 2.5);
  const TraceStatistics none = statisticsOf({ NaN });
  EXPECT_EQ(none.count, 0u);
  EXPECT_TRUE(std::isnan(none.mean) && std::isnan(none.rms) && std::isnan(none.percentile95));
}

TEST(TraceHistogram, BinsAreSymmetricAboutTheCortex)
{
  const TraceHistogram some = histogramOf({ -3.0, 0.0, 1.0, NaN, 4.0, -4.0, 0.2, -0.2 });
  EXPECT_EQ(some.width, 0.25) << "16 bins on each side hold 4 mm";
  std::array<int, TraceHistogram::Bins> expected{};
  expected[0] = 1;  // -4
  expected[4] = 1;  // -3
  expected[15] = 1; // -0.2
  expected[16] = 2; // 0 and 0.2
  expected[20] = 1; // 1
  expected[31] = 1; // 4, on the last edge
  EXPECT_EQ(some.counts, expected);
  EXPECT_EQ(histogramOf({ 4.01 }).width, 0.5);
  EXPECT_EQ(histogramOf({ 0.0 }).width, TraceHistogram::LeastWidth);
  EXPECT_EQ(histogramOf({ NaN }).width, 0.0);
}

TEST_F(TraceDistance, AStrokeRedoesOnlyWhatItReaches)
{
  const glm::dvec3 top = this->Middle + glm::dvec3(0, 0, BallRadius);
  Stroke stroke = strokeAt(Tool::Soft, top, { 0, 0, -2.0 });
  stroke.major = 8.0;
  this->run(pointsAt(this->around(10)));
  setStrokes(this->Bend, { stroke });
  this->Filter->Update();
  const vtkIdType moved = this->Filter->GetPointsMoved();
  EXPECT_GT(moved, 100);
  EXPECT_LT(moved, 4000) << "of some 9000";
  setStrokes(this->Bend, { stroke, stroke });
  this->Filter->Update();
  EXPECT_EQ(this->Filter->GetPointsMoved(), moved);
  EXPECT_EQ(this->Filter->GetSurfacesFound(), 1);
  this->Filter->SetThreshold(2.0);
  this->Filter->Update();
  EXPECT_EQ(this->Filter->GetSurfacesFound(), 2);
}

TEST_F(TraceDistance, AfterStrokesAHundredThousandPointsAreAsEvaluatedAnew)
{
  const auto positions = this->around(100000);
  const auto set = pointsAt(positions);
  this->run(set);
  const glm::dvec3 top = this->Middle + glm::dvec3(0, 0, BallRadius);
  const Stroke stamp = strokeAt(Tool::Stamp, top, { 1.0, 2.0, -7.0 });
  setStrokes(this->Bend, { stamp });
  this->Filter->Update();
  setStrokes(this->Bend, { stamp, strokeAt(Tool::Soft, this->Middle, { 3.0, -2.0, 1.0 }) });
  vtkPointSet* traced = this->run(set);
  vtkNew<vtkTraceDistance> anew;
  anew->SetInputData(set);
  anew->SetDeformationConnection(this->Bend->GetOutputPort());
  anew->SetThreshold(0.0);
  anew->Update();
  vtkPointSet* expected = vtkPointSet::SafeDownCast(anew->GetOutputDataObject(0));
  for (int i = 0; i < 100000; ++i)
  {
    ASSERT_EQ(trace(traced, i), trace(expected, i)) << i;
  }
  EXPECT_EQ(this->Filter->GetCount(), 100000);
  EXPECT_EQ(this->Filter->GetMean(), anew->GetMean());
  EXPECT_EQ(this->Filter->GetRMS(), anew->GetRMS());
  EXPECT_EQ(this->Filter->GetPercentile95(), anew->GetPercentile95());

  // Plainly: the least distance to all triangles, each put where the map puts it.
  const PointMap map = this->map();
  const auto volume = vtkImageData::SafeDownCast(this->Bend->GetOutputDataObject(0));
  const TissueRegion tissue{ this->Volume, volume->GetPointData()->GetScalars(), 0.0 };
  TriangleMesh mesh = surfaceOf(tissue);
  for (glm::dvec3& point : mesh.points)
  {
    point = map.deformedFromRest(point);
  }
  for (int i = 0; i < 100000; i += 500)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::ivec3& t : mesh.triangles)
    {
      nearest = std::min(nearest,
        squaredDistanceToTriangle(
          positions[i], mesh.points[t.x], mesh.points[t.y], mesh.points[t.z]));
    }
    const double sign = tissue.contains(map.restFromDeformed(positions[i])) ? -1.0 : 1.0;
    EXPECT_NEAR(trace(traced, i), sign * std::sqrt(nearest), 1e-5) << "mm, point " << i;
  }
}

TEST_F(TraceDistance, OtherPointsBetweenStrokesAreAsEvaluatedAnew)
{
  auto positions = this->around(2000);
  const glm::dvec3 top = this->Middle + glm::dvec3(0, 0, BallRadius);
  std::vector<Stroke> strokes;
  const auto expectAsAnew = [&](const char* when) {
    const auto set = pointsAt(positions);
    vtkPointSet* traced = this->run(set);
    vtkNew<vtkTraceDistance> anew;
    anew->SetInputData(set);
    anew->SetDeformationConnection(this->Bend->GetOutputPort());
    anew->SetThreshold(0.0);
    anew->Update();
    vtkPointSet* expected = vtkPointSet::SafeDownCast(anew->GetOutputDataObject(0));
    for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
    {
      ASSERT_EQ(trace(traced, i), trace(expected, i)) << when << ", point " << i;
    }
  };
  const auto bend = [&](const glm::dvec3& place, const glm::dvec3& by) {
    Stroke stroke = strokeAt(Tool::Soft, place, by);
    stroke.major = 12.0;
    strokes.push_back(stroke);
    setStrokes(this->Bend, strokes);
  };
  expectAsAnew("at first");
  std::reverse(positions.begin(), positions.end());
  bend(top, { 0.0, 0.0, -6.0 });
  expectAsAnew("points in another order");
  const auto all = positions;
  positions.resize(10);
  bend(top + glm::dvec3(3, 0, 0), { -3.0, 0.0, 4.0 });
  expectAsAnew("a few");
  positions = all;
  bend(this->Middle - glm::dvec3(0, 0, BallRadius), { 0.0, 2.0, 5.0 });
  expectAsAnew("all of them again, after a stroke that these did not see");
}

TEST_F(TraceDistance, ACavityCountsNeitherPointsNorTissue)
{
  // Everything above the ball's middle is gone.
  auto cavity = this->image([&](const glm::dvec3& p) { return p.z > this->Middle.z; });
  this->Filter->SetInputData(3, cavity);
  const glm::dvec3 above = this->Middle + glm::dvec3(0, 0, BallRadius + 3.0);
  const glm::dvec3 below = this->Middle - glm::dvec3(0, 0, BallRadius + 3.0);
  const glm::dvec3 beside = this->Middle + glm::dvec3(0, 0, -1.5);
  vtkPointSet* traced = this->run(pointsAt({ above, below, beside }));
  EXPECT_TRUE(std::isnan(trace(traced, 0)));
  EXPECT_NEAR(trace(traced, 1), 3.0, 0.03);
  EXPECT_EQ(this->Filter->GetCount(), 2);
  // The mask lies where tissue is drawn: tissue pushed out of it counts again.
  setStrokes(this->Bend, { [&] {
    Stroke stroke = strokeAt(Tool::Soft, this->Middle, { 0, 0, -BallRadius });
    stroke.major = 1000.0;
    stroke.sigma = 5.0;
    return stroke;
  }() });
  const glm::dvec3 inTheMiddle = this->Middle - glm::dvec3(0, 0, 1.0);
  traced = this->run(pointsAt({ above, inTheMiddle }));
  EXPECT_TRUE(std::isnan(trace(traced, 0)));
  EXPECT_NEAR(trace(traced, 1), -1.0, 0.2) << "the ball's top lies at its former middle";
}

TEST_F(TraceDistance, TheCavityOfCompareVolumesCountsAsOnesOwn)
{
  vtkNew<vtkCompareVolumes> compare;
  compare->SetInputConnection(this->Bend->GetOutputPort());
  compare->SetInputData(1, this->image([](const glm::dvec3&) { return 1.0; }));
  compare->SetInputData(
    2, this->image([&](const glm::dvec3& p) { return p.z > this->Middle.z ? 2.0 : -1.0; }));
  this->Filter->SetDeformationConnection(compare->GetOutputPort());
  const glm::dvec3 above = this->Middle + glm::dvec3(0, 0, BallRadius + 3.0);
  const glm::dvec3 below = this->Middle - glm::dvec3(0, 0, BallRadius + 3.0);
  vtkPointSet* traced = this->run(pointsAt({ above, below }));
  EXPECT_TRUE(std::isnan(trace(traced, 0)));
  EXPECT_NEAR(trace(traced, 1), 3.0, 0.03);
  // Moved away with the reference, it counts no longer.
  compare->SetReferenceTranslation(0, 0, 100.0);
  traced = this->run(pointsAt({ above }));
  EXPECT_NEAR(trace(traced, 0), 3.0, 0.03);
  EXPECT_EQ(this->Filter->GetCount(), 1);
}

TEST_F(TraceDistance, TissueIsAThresholdALabelOrASegmentation)
{
  const auto set = pointsAt({ this->Middle + glm::dvec3(0, 0, BallRadius + 4.0) });
  EXPECT_NEAR(trace(this->run(set), 0), 4.0, 0.03);
  this->Filter->SetThreshold(5.0);
  EXPECT_NEAR(trace(this->run(set), 0), 9.0, 0.05);
  // Label 7 is a smaller ball within label 9; on another grid than the volume's.
  Grid fine = withDimensions(this->Volume, { 60, 60, 60 });
  auto labels = volumeOn(fine, VTK_INT, [&](vtkIdType i) {
    const double depth = this->depth(fine.worldFromGrid({ i % 60, i / 60 % 60, i / 3600 }));
    return depth > 6.0 ? 7.0 : depth > 0.0 ? 9.0 : 0.0;
  });
  this->Filter->SetInputData(2, labels);
  this->Filter->SetSurfaceBy(vtkTraceDistance::ByLabel);
  this->Filter->SetLabel(7);
  EXPECT_NEAR(trace(this->run(set), 0), 10.0, 0.6) << "a surface of labels has steps";
  this->Filter->SetLabel(9);
  EXPECT_NEAR(trace(this->run(set), 0), 4.0, 0.6);
  EXPECT_NEAR(trace(this->run(pointsAt({ this->Middle })), 0), BallRadius - 6.0, 0.6)
    << "label 9 is a shell: its middle is outside";
}

TEST_F(TraceDistance, TheSameNumberAsThresholdAndAsLabelIsAnotherSurface)
{
  // Label 1 is a shell around label 2. From 1 on, both are tissue.
  const auto labels = this->image([&](const glm::dvec3& p) {
    return this->depth(p) > 6.0 ? 2.0 : this->depth(p) > 0.0 ? 1.0 : 0.0;
  });
  this->Filter->SetInputData(2, labels);
  this->Filter->SetThreshold(1.0);
  this->Filter->SetLabel(1);
  const auto set = pointsAt({ this->Middle });
  for (int turn = 0; turn < 2; ++turn)
  {
    this->Filter->SetSurfaceBy(vtkTraceDistance::ByThreshold);
    EXPECT_NEAR(trace(this->run(set), 0), -BallRadius, 1.5) << "a surface of labels has steps";
    this->Filter->SetSurfaceBy(vtkTraceDistance::ByLabel);
    EXPECT_NEAR(trace(this->run(set), 0), BallRadius - 6.0, 1.0) << "the middle is outside";
  }
}

TEST_F(TraceDistance, BlocksGiveOneSetOfNumbers)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, pointsAt({ this->Middle + glm::dvec3(0, 0, BallRadius + 4.0) }));
  blocks->SetBlock(
    1, pointsAt({ this->Middle + glm::dvec3(0, BallRadius - 2.0, 0), this->Middle }));
  this->Filter->SetInputData(blocks);
  this->Filter->Update();
  auto* traced = vtkMultiBlockDataSet::SafeDownCast(this->Filter->GetOutputDataObject(0));
  ASSERT_NE(traced, nullptr);
  EXPECT_NEAR(trace(vtkPointSet::SafeDownCast(traced->GetBlock(0)), 0), 4.0, 0.03);
  EXPECT_NEAR(trace(vtkPointSet::SafeDownCast(traced->GetBlock(1)), 0), -2.0, 0.03);
  EXPECT_EQ(this->Filter->GetCount(), 3);
  EXPECT_EQ(numberOf(traced, "Count"), 3);
  EXPECT_EQ(vtkPointSet::SafeDownCast(blocks->GetBlock(0))->GetPointData()->GetNumberOfArrays(), 0)
    << "the input stays as it was";
}

TEST_F(TraceDistance, NoPointsNoNumbers)
{
  vtkNew<vtkPolyData> empty;
  Errors errors(this->Filter);
  this->run(empty);
  EXPECT_EQ(errors.take(), "");
  EXPECT_EQ(this->Filter->GetCount(), 0);
  EXPECT_TRUE(std::isnan(this->Filter->GetMean()));
}

TEST_F(TraceDistance, WhatGivesNoCortexIsNamed)
{
  Errors errors(this->Filter);
  const auto set = pointsAt({ this->Middle });
  this->Filter->SetThreshold(900.0);
  this->run(set);
  std::string said = errors.take();
  EXPECT_NE(said.find("Threshold is 900 and gives no surface"), std::string::npos) << said;
  EXPECT_NE(said.find("to 15."), std::string::npos) << said;
  this->Filter->SetSurfaceBy(vtkTraceDistance::ByLabel);
  this->Filter->SetLabel(77);
  this->run(set);
  EXPECT_NE(errors.take().find("Label is 77 and gives no surface"), std::string::npos);
  this->Filter->SetInputData(2, fieldOn(this->Volume, [](const glm::dvec3& p) { return p; }));
  this->run(set);
  EXPECT_NE(errors.take().find("Displacement has 3 components; it must have 1"), std::string::npos);
  this->Filter->SetInputData(1, this->image([](const glm::dvec3&) { return 0.0; }));
  this->run(set);
  EXPECT_NE(errors.take().find("carries no deformation"), std::string::npos);
}

TEST(TissueSurface, ScalarsThatAreNoNumbersGiveNoTriangles)
{
  const Grid grid = plainGrid({ 9, 9, 9 }, glm::dvec3(1.0));
  const auto value = [](vtkIdType i) {
    const glm::dvec3 p(i % 9, i / 9 % 9, i / 81);
    return p.x > 6.0 ? NaN : 2.5 - glm::length(p - glm::dvec3(4.0));
  };
  const TissueRegion tissue{ grid, arrayOf(VTK_FLOAT, "s", 729, value), 0.0 };
  const TriangleMesh mesh = surfaceOf(tissue);
  EXPECT_GT(mesh.triangles.size(), 50u);
  for (const glm::ivec3& triangle : mesh.triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      EXPECT_LT(glm::length(mesh.points[triangle[corner]] - glm::dvec3(4.0)), 3.0);
    }
  }
  EXPECT_FALSE(tissue.contains({ 7.5, 4.0, 4.0 }));
  EXPECT_TRUE(tissue.contains({ 4.0, 4.0, 4.0 }));
  EXPECT_FALSE(tissue.contains({ 4.0, 4.0, 40.0 }));
  EXPECT_FALSE(tissue.contains({ NaN, 4.0, 4.0 }));
}
