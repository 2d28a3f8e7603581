// SPDX-License-Identifier: BSD-3-Clause
// Proves what outside programs cannot say: that maps turn back, where they end, that a lattice gets
// the coefficients of a B-spline back, and that damaged files end in a sentence.
#include "Common/Problem.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Fields/TransformLattice.h"
#include "Formats/Transforms/PointTransform.h"
#include "Formats/Transforms/TransformFile.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkTransformPoints.h"
#include "vtkTransformReader.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using namespace brainshift;

namespace
{
LinkGrid gridOf(const glm::ivec3& sides)
{
  LinkGrid grid;
  grid.dimensions = sides;
  grid.origin = { -12.0, 5.0, 9.0 };
  const double turn = 0.3;
  grid.worldFromGrid = glm::dmat3({ 10 * std::cos(turn), 10 * std::sin(turn), 0 },
    { -11 * std::sin(turn), 11 * std::cos(turn), 0 }, { 0, 0, 12 });
  grid.gridFromWorld = glm::inverse(grid.worldFromGrid);
  return grid;
}

SplineLink randomSpline()
{
  SplineLink spline;
  spline.grid = gridOf({ 9, 8, 7 });
  std::mt19937 random(4);
  std::uniform_real_distribution<double> mm(-2.0, 2.0);
  spline.coefficients.resize(spline.grid.count());
  for (glm::dvec3& coefficient : spline.coefficients)
  {
    coefficient = { mm(random), mm(random), mm(random) };
  }
  return spline;
}

std::string writtenFile(const std::string& name, const std::string& text)
{
  const std::string path = std::string(BRAINSHIFT_TEST_TEMP) + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string problemOf(const std::string& name, const std::string& text)
{
  return brainshift::problemOf(
    [&] { readTransformFiles({ { writtenFile(name, text) }, "", "" }); });
}
}

TEST(PointTransform, OfNoLinksIsTheIdentity)
{
  const glm::dvec3 point(3.0, -4.0, 5.0);
  EXPECT_EQ(mapped({}, point), point);
  EXPECT_EQ(mappedBack({}, point), point);
  EXPECT_EQ(kindOf({}), "identity");
}

TEST(PointTransform, TurnsBack)
{
  const SplineLink spline = randomSpline();
  const PointTransform transform{ { AffineLink{ glm::dmat3(1.1), { 2.0, -3.0, 1.0 } }, spline } };
  for (double share = 2.2; share < 4.5; share += 0.13)
  {
    const glm::dvec3 at(share, 0.9 * share + 0.4, 0.7 * share + 0.5);
    const glm::dvec3 to = spline.grid.origin + spline.grid.worldFromGrid * at;
    EXPECT_LT(glm::distance(mapped(transform, mappedBack(transform, to)), to), 1e-5);
  }
}

TEST(PointTransform, ReadsTheNearestPointOfAField)
{
  const SplineLink spline = randomSpline();
  FieldLink field{ spline.grid, {}, Between::Nearest };
  for (std::size_t point = 0; point < spline.grid.count(); ++point)
  {
    field.displacements.emplace_back(point % spline.grid.dimensions.x, 0.0f, 0.0f);
  }
  for (const double x : { 3.0, 3.4, 3.6, 4.4 })
  {
    const glm::dvec3 from =
      spline.grid.origin + spline.grid.worldFromGrid * glm::dvec3(x, 3.0, 3.0);
    EXPECT_NEAR(mapped({ { field } }, from).x - from.x, std::round(x), 1e-9) << x;
  }
}

TEST(PointTransform, StaysOutsideASplineAndAField)
{
  const SplineLink spline = randomSpline();
  const auto place = [&](double x) {
    return spline.grid.origin + spline.grid.worldFromGrid * glm::dvec3(x, 3.0, 3.0);
  };
  EXPECT_NE(mapped({ { spline } }, place(1.001)), place(1.001));
  EXPECT_EQ(mapped({ { spline } }, place(0.999)), place(0.999));
  EXPECT_NE(mapped({ { spline } }, place(6.999)), place(6.999));
  EXPECT_EQ(mapped({ { spline } }, place(7.001)), place(7.001));
  FieldLink field{ spline.grid, std::vector<glm::vec3>(spline.grid.count(), glm::vec3(1.0f)) };
  EXPECT_NE(mapped({ { field } }, place(-0.499)), place(-0.499));
  EXPECT_EQ(mapped({ { field } }, place(-0.501)), place(-0.501));
  EXPECT_NE(mapped({ { field } }, place(8.499)), place(8.499));
  EXPECT_EQ(mapped({ { field } }, place(8.501)), place(8.501));
}

TEST(PointTransform, ReversedOnBothSidesMapsReversedPoints)
{
  const SplineLink spline = randomSpline();
  PointTransform lps{ { AffineLink{ glm::dmat3(0.9), { 2.0, -3.0, 1.0 } }, spline } };
  PointTransform ras = lps;
  reverseXY(ras);
  const glm::dvec3 flip(-1.0, -1.0, 1.0);
  const glm::dvec3 point = spline.grid.origin + spline.grid.worldFromGrid * glm::dvec3(3.0);
  EXPECT_GT(glm::distance(mapped(lps, point), point), 0.5);
  EXPECT_LT(glm::distance(flip * mapped(ras, flip * point), mapped(lps, point)), 1e-9);
}

TEST(TransformLattice, GivesTheCoefficientsOfASplineBack)
{
  Lattice lattice =
    makeLattice({ { 7, 6, 5 }, { 1.0, 2.0, 3.0 }, { 4.0, 5.0, 6.0 } }, KernelBSpline);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> mm(-3.0f, 3.0f);
  for (glm::vec3& displacement : lattice.displacements)
  {
    displacement = { mm(random), mm(random), mm(random) };
  }
  Lattice sampled = lattice;
  for (std::size_t i = 0; i < lattice.displacements.size(); ++i)
  {
    const auto row = i / 7;
    const glm::dvec3 at(i % 7, row % 6, row / 6);
    sampled.displacements[i] =
      cubicDisplacement(lattice.grid.dimensions, lattice.kernel, lattice.displacements.data(), at);
  }
  interpolateAtPoints(sampled);
  for (std::size_t i = 0; i < lattice.displacements.size(); ++i)
  {
    EXPECT_LT(glm::distance(sampled.displacements[i], lattice.displacements[i]), 1e-4f);
  }
}

TEST(TransformFile, DamagedFilesEndInASentence)
{
  std::string matlab(20, '\0');
  matlab[4] = matlab[8] = '\x7f'; // 127 x 127 numbers
  matlab[16] = '\x03';
  const auto says = [](const std::string& problem, const char* words) {
    return problem.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(problemOf("t.mat", matlab), "ends within a variable"));
  EXPECT_TRUE(says(problemOf("t.mat", matlab.substr(0, 10)), "ends within a variable"));
  EXPECT_TRUE(says(problemOf("t.mat", std::string(20, '\x01')), "is no MATLAB file"));
  std::string least(20, '\0'); // the least number of 32 bits, the highest byte first
  least[0] = '\x80';
  EXPECT_TRUE(says(problemOf("t.mat", least), "is no MATLAB file"));
  EXPECT_TRUE(says(problemOf("t.h5", "\x89HDF\r\n\x1a\n damaged"), "is damaged"));
  EXPECT_FALSE(isTransformFile(writtenFile("t.csv", "x,y,z\n1,2,3\n")));
  EXPECT_FALSE(isTransformFile(std::string(BRAINSHIFT_TEST_TEMP)));
}

TEST(TransformReader, AnswersWithoutAPipelineAndSaysWhatIsWrong)
{
  vtkNew<vtkTransformReader> reader;
  EXPECT_EQ(reader->GetProblem(), "FileName is empty; it must name a transform");
  EXPECT_EQ(reader->GetKind(), "");
  reader->SetFileName(writtenFile("t.txt", "1 0 0 4  0 1 0 5  0 0 1 6  0 0 0 1"));
  EXPECT_NE(reader->GetProblem().find("name the program"), std::string::npos);
  reader->SetMatrixProgram(vtkTransformReader::NiftyReg);
  EXPECT_EQ(reader->GetProblem(), "");
  EXPECT_EQ(reader->GetKind(), "rigid");
  ASSERT_EQ(reader->GetMatrix()->GetNumberOfValues(), 16);
  EXPECT_EQ(reader->GetMatrix()->GetValue(7), 5.0);
  reader->AddPoint(1.0, 2.0, 3.0);
  ASSERT_EQ(reader->GetMappedPoints()->GetNumberOfValues(), 4);
  EXPECT_EQ(reader->GetMappedPoints()->GetValue(0), 5.0);
}

namespace
{
// Some points with a number each.
vtkSmartPointer<vtkPolyData> somePoints()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Number");
  for (int i = 0; i < 5; ++i)
  {
    points->InsertNextPoint(3.0 * i, 7.0 - i, 2.0);
    numbers->InsertNextValue(i);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(numbers);
  return data;
}

glm::dvec3 pointOf(vtkTransformPoints* filter, vtkIdType index)
{
  glm::dvec3 point;
  filter->GetOutput()->GetPoint(index, &point.x);
  return point;
}

const std::string Shift =
  "#Insight Transform File V1.0\nTransform: TranslationTransform_double_3_3\n"
  "Parameters: 1 2 3\nFixedParameters:\n";
}

TEST(TransformPoints, MovesPointsAlongTheMapAndBackAndKeepsTheirArrays)
{
  vtkNew<vtkTransformReader> reader;
  reader->SetWorld(vtkTransformReader::LPS);
  reader->SetFileName(writtenFile("shift.tfm", Shift));
  vtkNew<vtkTransformPoints> filter;
  filter->SetInputData(somePoints());
  filter->SetTransform(reader);
  for (const int direction : { vtkTransformPoints::Forward, vtkTransformPoints::Backward })
  {
    filter->SetDirection(direction);
    filter->Update();
    const double sign = direction == vtkTransformPoints::Forward ? 1.0 : -1.0;
    const glm::dvec3 expected = glm::dvec3(9.0, 4.0, 2.0) + sign * glm::dvec3(1.0, 2.0, 3.0);
    EXPECT_LT(glm::distance(pointOf(filter, 3), expected), 1e-9);
    EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Number")->GetTuple1(3), 3.0);
  }
  // Another file of the same reader moves them anew.
  reader->SetFileName(writtenFile("identity.tfm",
    "#Insight Transform File V1.0\n"
    "Transform: TranslationTransform_double_3_3\n"
    "Parameters: 0 0 0\nFixedParameters:\n"));
  filter->Update();
  EXPECT_EQ(pointOf(filter, 3), glm::dvec3(9.0, 4.0, 2.0)) << "the identity";
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(TransformPoints, SaysWhatIsWrong)
{
  vtkNew<vtkTransformPoints> filter;
  brainshift::testing::Errors heard(filter);
  filter->SetInputData(somePoints());
  filter->Update();
  EXPECT_NE(heard.take().find("Transform is not set"), std::string::npos);
  vtkNew<vtkTransformReader> reader;
  reader->SetFileName(writtenFile("bad.tfm", "hello"));
  filter->SetTransform(reader);
  filter->Update();
  EXPECT_NE(heard.take().find("is no transform"), std::string::npos);
}
