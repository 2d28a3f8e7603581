// SPDX-License-Identifier: BSD-3-Clause
// Proves that Deform Geometry moves points exactly as PointMap does, both ways; that normals stay
// across the surface; and that nothing else changes.
#include "Filters/Attached/DeformableVolume.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkDeformGeometry.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSphereSource.h>
#include <vtkStructuredGrid.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// Rotated, anisotropic volume, pulled by one stamp.
class DeformGeometry : public ::testing::Test
{
protected:
  const Grid Volume = obliqueGrid({ 20, 18, 16 });
  const glm::dvec3 Middle = Volume.worldFromGrid({ 9.5, 8.5, 7.5 });
  vtkNew<vtkFreeFormDeformation> Bend;
  vtkNew<vtkDeformGeometry> Filter;

  void SetUp() override
  {
    this->Bend->SetInputData(volumeOn(this->Volume, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
    setStrokes(this->Bend, { strokeAt(Tool::Stamp, this->Middle, { 9.0, -6.0, 4.0 }) });
    this->Bend->Update();
    this->Filter->SetDeformationConnection(this->Bend->GetOutputPort());
  }

  PointMap map() const
  {
    const Deformation deformation =
      deformationOf(vtkImageData::SafeDownCast(this->Bend->GetOutputDataObject(0)));
    return PointMap(effectiveLattice(deformation), deformation.inverse);
  }

  // Points all over the volume and outside it, of which the stamp moves some.
  vtkSmartPointer<vtkPolyData> points(int type, int count) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    Random random(7);
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec3 point = i % 2
        ? random.point(this->Volume, 3.0)
        : this->Middle + random.between(glm::dvec3(-20), glm::dvec3(20));
      points->InsertNextPoint(point.x, point.y, point.z);
    }
    auto set = vtkSmartPointer<vtkPolyData>::New();
    set->SetPoints(points);
    return set;
  }

  vtkPointSet* run(vtkPointSet* input, int direction)
  {
    this->Filter->SetInputData(input);
    this->Filter->SetDirection(direction);
    this->Filter->Update();
    return vtkPointSet::SafeDownCast(this->Filter->GetOutputDataObject(0));
  }
};

glm::dvec3 pointOf(vtkPointSet* set, vtkIdType point)
{
  const double* p = set->GetPoint(point);
  return { p[0], p[1], p[2] };
}

// Largest cosine between a cell's normal and an edge of it: 0 if it stands across.
double largestSlant(vtkPolyData* mesh, vtkDataArray* normals, bool ofPoints)
{
  double largest = 0.0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, corners);
    const double* n = normals->GetTuple(ofPoints ? corners->GetId(0) : cell);
    const glm::dvec3 normal(n[0], n[1], n[2]);
    for (int i = 0; i < 2; ++i)
    {
      const glm::dvec3 edge =
        pointOf(mesh, corners->GetId(i + 1)) - pointOf(mesh, corners->GetId(i));
      largest = std::max(largest, std::abs(glm::dot(glm::normalize(edge), normal)));
    }
  }
  return largest;
}
}

TEST_F(DeformGeometry, MovesPointsAsPointMapDoesToTheLastBit)
{
  const auto set = this->points(VTK_DOUBLE, 2000);
  const PointMap map = this->map();
  for (const int direction : { vtkDeformGeometry::Forward, vtkDeformGeometry::Backward })
  {
    vtkPointSet* moved = this->run(set, direction);
    ASSERT_EQ(moved->GetNumberOfPoints(), 2000);
    double furthest = 0.0;
    for (vtkIdType i = 0; i < 2000; ++i)
    {
      const glm::dvec3 from = pointOf(set, i);
      const glm::dvec3 to = direction == vtkDeformGeometry::Forward ? map.deformedFromRest(from)
                                                                    : map.restFromDeformed(from);
      EXPECT_EQ(pointOf(moved, i), to) << "point " << i;
      furthest = std::max(furthest, glm::length(to - from));
    }
    EXPECT_GT(furthest, 8.0) << "the stamp must move something, mm";
  }
}

TEST_F(DeformGeometry, BackwardUndoesForward)
{
  const auto set = this->points(VTK_DOUBLE, 1000);
  vtkNew<vtkPolyData> moved;
  moved->ShallowCopy(this->run(set, vtkDeformGeometry::Forward));
  vtkPointSet* back = this->run(moved, vtkDeformGeometry::Backward);
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    EXPECT_LT(glm::length(pointOf(back, i) - pointOf(set, i)), 1e-3) << "mm, point " << i;
  }
}

TEST_F(DeformGeometry, KeepsPrecisionArraysAndCells)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(this->Middle.x, this->Middle.y, this->Middle.z);
  sphere->SetRadius(15.0);
  sphere->Update();
  vtkPolyData* input = sphere->GetOutput();
  input->GetPointData()->AddArray(
    arrayOf(VTK_INT, "Number", input->GetNumberOfPoints(), [](vtkIdType i) { return double(i); }));
  auto* moved = vtkPolyData::SafeDownCast(this->run(input, vtkDeformGeometry::Forward));
  ASSERT_NE(moved, nullptr);
  EXPECT_EQ(moved->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(moved->GetNumberOfCells(), input->GetNumberOfCells());
  EXPECT_EQ(moved->GetPointData()->GetArray("Number"), input->GetPointData()->GetArray("Number"));
  EXPECT_GT(glm::length(pointOf(moved, 0) - pointOf(input, 0)), 1.0);
}

TEST_F(DeformGeometry, WholeNumberPointsBecomeFractions)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_INT);
  points->InsertNextPoint(
    std::round(this->Middle.x), std::round(this->Middle.y), std::round(this->Middle.z));
  vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  const glm::dvec3 moved = pointOf(this->run(set, vtkDeformGeometry::Forward), 0);
  EXPECT_EQ(moved, this->map().deformedFromRest(pointOf(set, 0)));
}

TEST_F(DeformGeometry, NormalsStayAcrossTheSurface)
{
  // Fine triangles, so that they are as good as flat: what slant is left is their own size.
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(this->Middle.x, this->Middle.y, this->Middle.z);
  sphere->SetRadius(18.0);
  sphere->SetThetaResolution(160);
  sphere->SetPhiResolution(160);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkPolyDataNormals> cellNormals;
  cellNormals->SetInputConnection(sphere->GetOutputPort());
  cellNormals->ComputePointNormalsOff();
  cellNormals->ComputeCellNormalsOn();
  cellNormals->SplittingOff();
  cellNormals->Update();
  vtkNew<vtkPolyData> input;
  input->ShallowCopy(cellNormals->GetOutput());
  input->GetPointData()->SetNormals(sphere->GetOutput()->GetPointData()->GetNormals());

  for (const int direction : { vtkDeformGeometry::Forward, vtkDeformGeometry::Backward })
  {
    for (const int inverse : { 0, 1 })
    {
      this->Bend->SetInverse(inverse);
      auto* moved = vtkPolyData::SafeDownCast(this->run(input, direction));
      vtkDataArray* ofCells = moved->GetCellData()->GetNormals();
      vtkDataArray* ofPoints = moved->GetPointData()->GetNormals();
      EXPECT_GT(largestSlant(moved, input->GetCellData()->GetNormals(), false), 0.2)
        << "unturned normals must be wrong, or the test proves nothing";
      EXPECT_LT(largestSlant(moved, ofCells, false), 0.04) << direction << inverse;
      EXPECT_LT(largestSlant(moved, ofPoints, true), 0.1) << direction << inverse;
      for (vtkIdType i = 0; i < ofPoints->GetNumberOfTuples(); i += 97)
      {
        const double* n = ofPoints->GetTuple(i);
        const double* before = input->GetPointData()->GetNormals()->GetTuple(i);
        EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1.0, 1e-6);
        EXPECT_GT(n[0] * before[0] + n[1] * before[1] + n[2] * before[2], 0.0) << "turned inside";
      }
    }
  }
}

TEST_F(DeformGeometry, StructuredMeshesAreMovedToo)
{
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(40, 50, 1); // larger than the volume: their extents have nothing in common
  grid->SetPoints(this->points(VTK_DOUBLE, 2000)->GetPoints());
  this->Bend->Modified(); // asks for the volume again
  Errors errors(this->Bend);
  vtkPointSet* moved = this->run(grid, vtkDeformGeometry::Forward);
  EXPECT_TRUE(moved->IsA("vtkStructuredGrid"));
  EXPECT_EQ(pointOf(moved, 2), this->map().deformedFromRest(pointOf(grid, 2)));
  EXPECT_EQ(errors.take(), "");
}

TEST_F(DeformGeometry, NoStrokeMovesNothing)
{
  setStrokes(this->Bend, {});
  const auto set = this->points(VTK_FLOAT, 500);
  for (const int direction : { vtkDeformGeometry::Forward, vtkDeformGeometry::Backward })
  {
    vtkPointSet* moved = this->run(set, direction);
    for (vtkIdType i = 0; i < 500; ++i)
    {
      EXPECT_EQ(pointOf(moved, i), pointOf(set, i));
    }
  }
}

TEST_F(DeformGeometry, PointsThatAreNoNumbersStay)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  points->InsertNextPoint(nan, 1.0, 2.0);
  points->InsertNextPoint(std::numeric_limits<double>::infinity(), 1.0, 2.0);
  points->InsertNextPoint(this->Middle.x, this->Middle.y, this->Middle.z);
  vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  for (const int direction : { vtkDeformGeometry::Forward, vtkDeformGeometry::Backward })
  {
    vtkPointSet* moved = this->run(set, direction);
    EXPECT_TRUE(std::isnan(pointOf(moved, 0).x));
    EXPECT_EQ(pointOf(moved, 0).y, 1.0);
    EXPECT_EQ(pointOf(moved, 1), pointOf(set, 1));
    EXPECT_NE(pointOf(moved, 2), pointOf(set, 2));
  }
}

TEST_F(DeformGeometry, NothingInNothingOut)
{
  vtkNew<vtkPolyData> empty;
  Errors errors(this->Filter);
  EXPECT_EQ(this->run(empty, vtkDeformGeometry::Forward)->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors.take(), "");
}

TEST_F(DeformGeometry, AVolumeWithoutLatticeIsRefused)
{
  vtkNew<vtkDeformGeometry> filter;
  Errors errors(filter);
  filter->SetInputData(this->points(VTK_FLOAT, 3));
  filter->SetInputData(1, volumeOn(this->Volume, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  filter->Update();
  const std::string said = errors.take();
  EXPECT_NE(said.find("carries no deformation"), std::string::npos) << said;
  EXPECT_NE(said.find("Free-Form Deformation"), std::string::npos) << said;
}

TEST_F(DeformGeometry, CanBeAborted)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* filter, unsigned long, void*, void*) {
    static_cast<vtkAlgorithm*>(filter)->SetAbortExecuteAndUpdateTime();
  });
  this->Filter->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(this->run(this->points(VTK_FLOAT, 20000), 1)->GetNumberOfPoints(), 0);
}
