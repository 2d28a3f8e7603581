// SPDX-License-Identifier: BSD-3-Clause
// Proves that Resection attaches tumour and cavity, its own or that of Compare Volumes where the
// reference was moved to, that a stroke makes no new arrays, that no reference is left, and that it
// says what is missing.
#include "Filters/Attached/Resection.h"
#include "Filters/Attached/MaskImage.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkCompareVolumes.h"
#include "vtkResection.h"

#include <vtkFieldData.h>

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const Grid ResectedGrid = plainGrid({ 21, 19, 17 }, glm::dvec3(2.0));
constexpr vtkIdType One = 0;
constexpr vtkIdType Two = 1;

// Labels 3 and 5 in the first two voxels.
vtkSmartPointer<vtkImageData> twoLabels(const Grid& grid)
{
  return volumeOn(grid, VTK_SHORT, [](vtkIdType i) {
    return i == One ? 3.0 : i == Two ? 5.0 : 0.0;
  });
}

// A bent volume.
class ResectionFilter : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Bend->SetInputData(
      volumeOn(ResectedGrid, VTK_SHORT, [](vtkIdType i) { return double(i % 17); }));
    this->Filter->SetInputConnection(this->Bend->GetOutputPort());
  }

  Resection run()
  {
    this->Filter->Update();
    return readResection(this->Filter->GetOutput());
  }

  const Grid MaskGrid = [] {
    Grid grid = plainGrid({ 11, 11, 11 }, glm::dvec3(1.5));
    grid.origin = { 4.0, 5.0, 6.0 };
    return grid;
  }();
  vtkNew<vtkFreeFormDeformation> Bend;
  vtkNew<vtkResection> Filter;
  Errors Said{ this->Filter };
};
}

TEST_F(ResectionFilter, AttachesBothMasksByTheirLabels)
{
  this->Filter->SetInputData(1, twoLabels(this->MaskGrid));
  this->Filter->SetInputData(2, twoLabels(ResectedGrid));
  this->Filter->AddCavityLabel(5);
  const Resection found = this->run();
  ASSERT_TRUE(found.tumour.voxels && found.cavity.voxels);
  EXPECT_EQ(found.tumour.grid, this->MaskGrid);
  EXPECT_EQ(found.cavity.grid, ResectedGrid);
  EXPECT_EQ(found.tumour.voxels->GetComponent(One, 0), 1.0);
  EXPECT_EQ(found.tumour.voxels->GetComponent(Two, 0), 1.0);
  EXPECT_EQ(found.cavity.voxels->GetComponent(One, 0), 0.0);
  EXPECT_EQ(found.cavity.voxels->GetComponent(Two, 0), 1.0);
  this->Filter->AddTumourLabel(3);
  EXPECT_EQ(this->run().tumour.voxels->GetComponent(Two, 0), 0.0);
}

TEST_F(ResectionFilter, AStrokeMakesNoNewArrays)
{
  this->Filter->SetInputData(1, twoLabels(this->MaskGrid));
  this->Filter->SetInputData(2, twoLabels(ResectedGrid));
  const Resection before = this->run();
  this->Bend->SetSamples(3);
  const Resection after = this->run();
  EXPECT_EQ(before.tumour.voxels, after.tumour.voxels);
  EXPECT_EQ(before.cavity.voxels, after.cavity.voxels);
}

TEST_F(ResectionFilter, TakesTheCavityOfCompareVolumesWhereTheReferenceWasMovedTo)
{
  vtkNew<vtkCompareVolumes> compare;
  compare->SetInputConnection(this->Bend->GetOutputPort());
  compare->SetInputData(1, volumeOn(ResectedGrid, VTK_SHORT, [](vtkIdType) { return 1.0; }));
  compare->SetInputData(2, twoLabels(this->MaskGrid));
  compare->SetReferenceTranslation(1.0, 2.0, 3.0);
  this->Filter->SetInputConnection(compare->GetOutputPort());
  const Resection found = this->run();
  ASSERT_TRUE(found.cavity.voxels);
  EXPECT_EQ(found.cavity.grid.origin, this->MaskGrid.origin + glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_FALSE(found.tumour.voxels);
  EXPECT_FALSE(readReference(this->Filter->GetOutput()).voxels) << "the volume is shown alone";
  EXPECT_TRUE(readReference(compare->GetOutput()).voxels) << "its input keeps the reference";
}

TEST_F(ResectionFilter, LeavesTissueThereIfAsked)
{
  this->Filter->SetInputData(1, twoLabels(this->MaskGrid));
  this->Filter->SetInputData(2, twoLabels(ResectedGrid));
  this->Filter->RemoveTissueOff();
  const Resection found = this->run();
  EXPECT_TRUE(found.tumour.voxels);
  EXPECT_FALSE(found.cavity.voxels);
}

TEST_F(ResectionFilter, SaysWhatIsMissingOrWrong)
{
  const auto says = [this](const char* words) {
    this->Filter->Update();
    const std::string said = this->Said.take();
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  says("neither a tumour nor a cavity");
  Grid far = this->MaskGrid;
  far.origin = glm::dvec3(500.0);
  this->Filter->SetInputData(1, twoLabels(far));
  says("does not overlap the volume");
  this->Filter->SetInputData(1, twoLabels(this->MaskGrid));
  this->Filter->AddTumourLabel(4);
  says("tumour has no voxel of label 4 (TumourLabels)");
}
