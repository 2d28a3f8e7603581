// SPDX-License-Identifier: BSD-3-Clause
// Proves that Compare Volumes attaches reference, cavity and what to show without copying voxels
// anew, that the cavity means what masks mean and is moved with the reference, that it can be read
// back, and that what is no cavity is refused.
#include "Filters/Attached/MaskImage.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkCompareVolumes.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const Grid ComparedGrid = plainGrid({ 21, 19, 17 }, glm::dvec3(2.0));

// A bent volume and a reference on another grid, compared.
class CompareVolumes : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const auto value = [](vtkIdType i) { return double(i % 17); };
    this->Bend->SetInputData(volumeOn(ComparedGrid, VTK_SHORT, value));
    this->Filter->SetInputConnection(this->Bend->GetOutputPort());
    this->Reference = volumeOn(this->ReferenceGrid, VTK_SHORT, value);
    this->Filter->SetInputData(1, this->Reference);
  }

  ReferenceVolume run()
  {
    this->Filter->Update();
    return readReference(this->Filter->GetOutput());
  }

  const Grid ReferenceGrid = [] {
    Grid grid = plainGrid({ 31, 31, 31 }, glm::dvec3(1.5));
    grid.origin = { -2.0, 1.0, 3.0 };
    return grid;
  }();
  vtkSmartPointer<vtkImageData> Reference;
  vtkNew<vtkFreeFormDeformation> Bend;
  vtkNew<vtkCompareVolumes> Filter;
  Errors Said{ this->Filter };
};

// Labels 3 and 5 at two voxels, on a grid of its own.
vtkSmartPointer<vtkImageData> twoLabels(const Grid& grid)
{
  return volumeOn(grid, VTK_SHORT, [](vtkIdType i) {
    return i == 0 ? 3.0 : i == 1 ? 5.0 : i == 2 ? -1.0 : 0.0;
  });
}
}

TEST_F(CompareVolumes, NeitherAStrokeNorShowMakesNewArrays)
{
  this->Filter->SetInputData(2, twoLabels(this->ReferenceGrid));
  const ReferenceVolume before = this->run();
  ASSERT_NE(before.voxels, nullptr);
  ASSERT_NE(before.cavity.voxels, nullptr);
  EXPECT_EQ(before.voxels->GetVoidPointer(0),
    this->Reference->GetPointData()->GetScalars()->GetVoidPointer(0))
    << "shared, not copied";
  EXPECT_EQ(before.show, ReferenceShow::Both);
  vtkDataArray* own = this->Filter->GetOutput()->GetPointData()->GetScalars();
  const auto times = [&](const ReferenceVolume& reference) {
    return std::vector<vtkMTimeType>{ own->GetMTime(), reference.voxels->GetMTime(),
      reference.cavity.voxels->GetMTime() };
  };
  const auto timesBefore = times(before);

  setStrokes(this->Bend, { strokeAt(Tool::Soft, { 20.0, 18.0, 16.0 }, { 3.0, 0.0, 0.0 }) });
  for (const auto show : { ReferenceShow::Reference, ReferenceShow::Deformed })
  {
    this->Filter->SetShow(static_cast<int>(show));
    const ReferenceVolume after = this->run();
    EXPECT_EQ(after.show, show);
    EXPECT_EQ(after.voxels, before.voxels);
    EXPECT_EQ(after.cavity.voxels, before.cavity.voxels);
    EXPECT_EQ(this->Filter->GetOutput()->GetPointData()->GetScalars(), own);
    EXPECT_EQ(times(after), timesBefore);
  }
  EXPECT_EQ(this->Said.take(), "");
}

TEST_F(CompareVolumes, TheCavityMeansWhatMasksMean)
{
  this->Filter->SetInputData(2, twoLabels(this->ReferenceGrid));
  const auto inside = [&](vtkIdType voxel) {
    return this->run().cavity.voxels->GetComponent(voxel, 0) == 1.0;
  };
  EXPECT_TRUE(inside(0) && inside(1) && !inside(2) && !inside(3)) << "above 0";
  this->Filter->AddCavityLabel(5);
  EXPECT_TRUE(!inside(0) && inside(1) && !inside(2)) << "a label";
  this->Filter->ClearCavityLabels();
  EXPECT_TRUE(inside(0) && inside(1));

  auto cells = imageOn(this->ReferenceGrid);
  cells->GetCellData()->AddArray(arrayOf(VTK_FLOAT, "Weight", cells->GetNumberOfCells(),
    [](vtkIdType i) { return i == 0 ? 0.5 : 0.0; }));
  this->Filter->SetInputData(2, cells);
  const PlacedVoxels cavity = this->run().cavity;
  EXPECT_EQ(cavity.grid.dimensions, this->ReferenceGrid.dimensions - 1);
  EXPECT_TRUE(isRemoved(cavity, this->ReferenceGrid.origin + 0.1));
  EXPECT_FALSE(isRemoved(cavity, this->ReferenceGrid.origin + 1.6));
}

TEST_F(CompareVolumes, TheCavityIsMovedWithTheReference)
{
  Grid coarse = plainGrid({ 9, 9, 9 }, glm::dvec3(4.0));
  coarse.origin = { 4.0, 7.0, 5.0 };
  this->Filter->SetInputData(2, twoLabels(coarse));
  const glm::dvec3 turn(0.0, 0.0, 90.0);
  const glm::dvec3 move(1.0, -2.0, 3.0);
  this->Filter->SetReferenceRotation(&turn[0]);
  this->Filter->SetReferenceTranslation(&move[0]);
  // A quarter turn about z through the middle of the reference, which is not that of the cavity.
  const glm::dvec3 middle = this->ReferenceGrid.origin + 22.5;
  const auto moved = [&](const glm::dvec3& p) {
    return middle + glm::dvec3(-(p.y - middle.y), p.x - middle.x, p.z - middle.z) + move;
  };
  const PlacedVoxels cavity = this->run().cavity;
  for (int voxel = 0; voxel < 3; ++voxel)
  {
    const glm::dvec3 place = coarse.origin + glm::dvec3(4.0 * voxel, 0.0, 0.0);
    EXPECT_EQ(isRemoved(cavity, moved(place)), voxel < 2) << voxel;
    EXPECT_EQ(isRemoved(cavity, moved(place + glm::dvec3(0.0, 0.0, -1.9))), voxel < 2);
    EXPECT_FALSE(isRemoved(cavity, moved(place + glm::dvec3(0.0, 0.0, -2.1)))) << "beyond its box";
  }
  EXPECT_FALSE(isRemoved(PlacedVoxels(), middle));
}

TEST(MovedRigidly, TurnsAboutXThenYThenZ)
{
  // Quarter turns do not commute: z goes to -y, stays, and goes to x.
  const Grid moved = movedRigidly(plainGrid(glm::ivec3(3), glm::dvec3(1.0)),
    { glm::dvec3(0.0), glm::dvec3(90.0, 90.0, 90.0), glm::dvec3(0.0) });
  EXPECT_LT(glm::distance(moved.direction * glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)), 1e-12);
  EXPECT_LT(glm::distance(moved.direction * glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(FollowedBy, MovesTwice)
{
  Grid grid = plainGrid(glm::ivec3(4), glm::dvec3(1.0, 2.0, 1.5));
  grid.origin = { 3.0, -40.0, 12.0 };
  const RigidMotion first{ middleOf(grid), { 20.0, -50.0, 110.0 }, { 4.0, -6.0, 9.0 } };
  const RigidMotion second{ glm::dvec3(0.0), { -7.0, 12.0, 31.0 }, { -5.0, 1.0, 2.0 } };
  const Grid expected = movedRigidly(movedRigidly(grid, first), second);
  const glm::dmat3 turn = movedRigidly(plainGrid(glm::ivec3(2), glm::dvec3(1.0)), second).direction;
  const RigidMotion both = followedBy(first, turn, second.translation);
  EXPECT_EQ(both.middle, first.middle);
  const Grid moved = movedRigidly(grid, both);
  for (const glm::dvec3& corner : { glm::dvec3(0.0), glm::dvec3(3.0, 1.0, 2.0) })
  {
    EXPECT_LT(glm::distance(moved.worldFromGrid(corner), expected.worldFromGrid(corner)), 1e-9);
  }
}

TEST_F(CompareVolumes, WithoutACavityThatOfAnEarlierOneIsGone)
{
  this->Filter->SetInputData(2, twoLabels(this->ReferenceGrid));
  vtkNew<vtkCompareVolumes> second;
  second->SetInputConnection(this->Filter->GetOutputPort());
  second->SetInputData(1, this->Reference);
  second->Update();
  EXPECT_EQ(readReference(second->GetOutput()).cavity.voxels, nullptr);
  EXPECT_FALSE(second->GetOutput()->GetFieldData()->HasArray("CavityVoxels"));
  EXPECT_NE(readReference(this->Filter->GetOutput()).cavity.voxels, nullptr);
}

// Places are found by the transpose of the axes, so other axes would be wrong without a word.
TEST_F(CompareVolumes, RefusesAxesThatAreNotPerpendicular)
{
  shear(this->Reference);
  this->Filter->Update();
  EXPECT_NE(
    this->Said.take().find(std::string("The reference's ") + NotPerpendicular), std::string::npos);
  const auto value = [](vtkIdType i) { return double(i % 17); };
  const auto volume = volumeOn(ComparedGrid, VTK_SHORT, value);
  shear(volume);
  Errors said(this->Bend);
  this->Bend->SetInputData(volume);
  this->Bend->Update();
  EXPECT_NE(said.take().find(NotPerpendicular), std::string::npos);
  const auto straight = volumeOn(this->ReferenceGrid, VTK_SHORT, value);
  const double mirror[9] = { -1, 0, 0, 0, 0.6, 0.80002, 0, -0.8, 0.6 }; // five decimals
  straight->SetDirectionMatrix(mirror);
  this->Filter->SetInputData(0, straight);
  this->Filter->SetInputData(1, straight);
  this->Filter->Update();
  EXPECT_EQ(this->Said.take(), "");
}

TEST_F(CompareVolumes, RefusesWhatIsNoCavity)
{
  Grid away = this->ReferenceGrid;
  away.origin.x = 500.0;
  this->Filter->SetInputData(2, twoLabels(away));
  this->run();
  EXPECT_NE(this->Said.take().find("The cavity (x 499.25 to 545.75, y 0.25 to 46.75, z 2.25 to "
                                   "48.75 mm) does not overlap the reference (x -2 to 43"),
    std::string::npos);
  this->Filter->SetInputData(2, twoLabels(this->ReferenceGrid));
  this->Filter->AddCavityLabel(8);
  this->run();
  EXPECT_NE(
    this->Said.take().find("The cavity has no voxel of label 8 (CavityLabels)"), std::string::npos);
}
