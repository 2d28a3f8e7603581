// SPDX-License-Identifier: BSD-3-Clause
// Proves that a segmentation travels with a volume as the same array object, with names of labels.
#include "Filters/Attached/Segmentation.h"
#include "Filters/Deformation/ControlPoints.h"
#include "Testing/Cxx/Deformation/TestBall.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using namespace brainshift;
using namespace brainshift::testing;
using namespace brainshift::testing::ball;

namespace
{
vtkSmartPointer<vtkImageData> labelsOn(const Grid& grid)
{
  return volumeOn(grid, VTK_UNSIGNED_CHAR,
    [&](vtkIdType i) { return labelAt(grid.worldFromGrid(glm::dvec3(indexOf(grid, i)))); });
}

class SegmentedFilter : public ::testing::Test
{
protected:
  SegmentedFilter()
  {
    this->Filter->SetInputData(volumeOn(VolumeGrid, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
    this->Filter->SetLatticeDimensions(5, 5, 5);
  }
  vtkImageData* output()
  {
    this->Filter->Update();
    return vtkImageData::SafeDownCast(this->Filter->GetOutputDataObject(0));
  }
  Segmentation attached() { return readSegmentation(this->output()); }

  vtkNew<vtkFreeFormDeformation> Filter;
  Errors Heard{ Filter };
};
}

TEST_F(SegmentedFilter, AttachesTheSegmentationOrElseTheMask)
{
  EXPECT_FALSE(this->attached().labels);
  const auto mask = labelsOn(VolumeGrid);
  this->Filter->SetInputDataObject(2, mask);
  EXPECT_EQ(this->attached().grid, VolumeGrid);
  EXPECT_TRUE(this->attached().chosen.empty());
  this->Filter->AddMaskLabel(3);
  this->Filter->AddMaskLabel(5);
  EXPECT_EQ(this->attached().chosen, (std::vector<int>{ 3, 5 }));
  this->Filter->SetInputDataObject(3, labelsOn(obliqueLabels()));
  const Segmentation own = this->attached();
  EXPECT_EQ(own.grid, obliqueLabels());
  EXPECT_TRUE(own.chosen.empty()) << "the labels are the mask's";
  EXPECT_TRUE(deformationOf(this->output()).lattice.mask) << "which still masks";
  this->Filter->SetInputDataObject(2, nullptr);
  EXPECT_FALSE(deformationOf(this->output()).lattice.mask) << "a segmentation holds nothing still";
  this->Filter->SetInputDataObject(3, nullptr);
  EXPECT_FALSE(this->attached().labels);
  EXPECT_STREQ(mask->GetPointData()->GetScalars()->GetName(), "Intensity") << "not ours to rename";
  EXPECT_EQ(this->Heard.take(), "");
}

TEST_F(SegmentedFilter, PassesTheSameArrayAgain)
{
  const auto image = labelsOn(VolumeGrid);
  this->Filter->SetInputDataObject(3, image);
  const Segmentation first = this->attached();
  setStrokes(this->Filter, { strokeAt(Tool::Soft, Middle, { 3.0, 0.0, 0.0 }) });
  const Segmentation next = this->attached();
  EXPECT_EQ(first.labels, next.labels);
  EXPECT_EQ(first.labels->GetVoidPointer(0), image->GetPointData()->GetScalars()->GetVoidPointer(0))
    << "no voxel is copied";
  image->GetPointData()->GetScalars()->Fill(5.0);
  image->GetPointData()->GetScalars()->Modified();
  image->Modified();
  const Segmentation changed = this->attached();
  EXPECT_NE(changed.labels, first.labels);
  EXPECT_EQ(changed.labels->GetTuple1(0), 5.0);
}

TEST_F(SegmentedFilter, CarriesTheNamesOfTheLabels)
{
  const auto volume = volumeOn(VolumeGrid, VTK_FLOAT, [](vtkIdType) { return 1.0; });
  attachLabels(volume, { { 1, "the volume's own", { 1, 2, 3 }, {} } });
  this->Filter->SetInputDataObject(0, volume);
  const auto named = labelsOn(VolumeGrid);
  attachLabels(named, { { 3, "sulcus", { 4, 5, 6 }, {} }, { -5, "below", { 7, 8, 9 }, {} } });
  for (const int port : { 2, 3 }) // mask or segmentation
  {
    this->Filter->SetInputDataObject(port, named);
    vtkImageData* output = this->output();
    const std::vector<Label> labels = attachedLabels(output, SegmentationLabels);
    ASSERT_EQ(labels.size(), 2u);
    EXPECT_EQ(labels[1].value, -5);
    EXPECT_EQ(labels[1].color, (std::array<unsigned char, 3>{ 7, 8, 9 }));
    EXPECT_EQ(labelName(output, 3.0, SegmentationLabels), "sulcus");
    EXPECT_EQ(labelName(output, -5.0, SegmentationLabels), "below");
    for (const double nameless : { 1.0, 3.5 })
    {
      EXPECT_EQ(labelName(output, nameless, SegmentationLabels), "");
    }
    EXPECT_EQ(labelName(output, 1.0), "the volume's own");
    EXPECT_EQ(labelName(output, 3.0), "");
    this->Filter->SetInputDataObject(port, nullptr);
    EXPECT_TRUE(attachedLabels(this->output(), SegmentationLabels).empty());
  }
  output()->GetFieldData()->RemoveArray("LabelColors");
  EXPECT_EQ(labelName(output(), 1.0), "") << "a table that is not whole";
}

TEST_F(SegmentedFilter, SaysWhichLabelsMayMove)
{
  const auto labels = labelsOn(VolumeGrid);
  this->Filter->SetInputDataObject(3, labels);
  EXPECT_FALSE(this->attached().moving) << "a segmentation holds nothing still";
  this->Filter->SetInputDataObject(2, labels);
  EXPECT_EQ(this->attached().moving, std::vector<int>()) << "all above 0";
  this->Filter->AddMaskLabel(3);
  EXPECT_EQ(this->attached().moving, std::vector<int>{ 3 });
  this->Filter->SetInputDataObject(3, nullptr);
  EXPECT_EQ(this->attached().moving, std::vector<int>{ 3 }) << "of the mask alone";
  EXPECT_EQ(this->attached().mask, nullptr);
  const Mask alone = movingTissue(this->attached());
  this->Filter->SetInputDataObject(3, labelsOn(obliqueLabels()));
  EXPECT_EQ(this->attached().moving, std::vector<int>{ 3 }) << "the mask is another image";
  EXPECT_EQ(this->attached().maskGrid.dimensions, VolumeGrid.dimensions);
  const Mask beside = movingTissue(this->attached());
  EXPECT_EQ(beside.inside, alone.inside);
  EXPECT_GT(std::count(alone.inside.begin(), alone.inside.end(), 1), 0);
  this->Filter->SetInputDataObject(2, nullptr);
  EXPECT_TRUE(movingTissue(this->attached()).inside.empty());
}

TEST_F(SegmentedFilter, ReadsNoLabelForAStroke)
{
  // ParaView asks each output for the range of all its arrays.
  const auto image = labelsOn(VolumeGrid);
  this->Filter->SetInputDataObject(3, image);
  double range[2];
  this->output()->GetFieldData()->GetRange(SegmentationName, range);
  EXPECT_EQ(range[1], 5.0);
  image->GetPointData()->GetScalars()->SetTuple1(0, 200.0); // behind everybody's back
  setStrokes(this->Filter, { strokeAt(Tool::Soft, Middle, { 3.0, 0.0, 0.0 }) });
  this->output()->GetFieldData()->GetRange(SegmentationName, range);
  EXPECT_EQ(range[1], 5.0);
}

TEST_F(SegmentedFilter, TakesNoneThatLiesElsewhere)
{
  this->Filter->SetInputDataObject(3, labelsOn(VolumeGrid));
  const Segmentation good = this->attached();
  Grid away = VolumeGrid;
  away.origin.x = 500.0;
  this->Filter->SetInputDataObject(3, labelsOn(away));
  EXPECT_EQ(this->attached().labels, good.labels);
  EXPECT_NE(this->Heard.take().find("The segmentation (x 499 to 549"), std::string::npos);
}

TEST(Segmentation, IsNoneWhereItsNumbersDoNotFit)
{
  const auto volume = volumeOn(VolumeGrid, VTK_FLOAT, [](vtkIdType) { return 1.0; });
  EXPECT_FALSE(readSegmentation(volume).labels);
  Segmentation segmentation = SegmentationSource().find(labelsOn(VolumeGrid), VolumeGrid);
  attachSegmentation(volume, segmentation);
  EXPECT_TRUE(readSegmentation(volume).labels);
  segmentation.grid.dimensions.x += 1;
  attachSegmentation(volume, segmentation);
  EXPECT_FALSE(readSegmentation(volume).labels);
}

TEST(Segmentation, LiesInCellsAtTheirMiddles)
{
  auto image = imageOn(VolumeGrid);
  image->GetCellData()->AddArray(arrayOf(
    VTK_SHORT, "Label", image->GetNumberOfCells(), [](vtkIdType i) { return i == 0 ? 2.0 : 0.0; }));
  const Segmentation segmentation = SegmentationSource().find(image, VolumeGrid);
  EXPECT_EQ(segmentation.grid.origin, glm::dvec3(1.0));
  EXPECT_EQ(segmentation.grid.dimensions, VolumeGrid.dimensions - 1);
}

TEST(Segmentation, ASegmentIsTheVoxelsOfItsLabels)
{
  const Segmentation segmentation =
    SegmentationSource().find(labelsOn(obliqueLabels()), VolumeGrid);
  for (const std::vector<int>& labels : { std::vector<int>{ 3 }, { 5 }, { 3, 5 }, {} })
  {
    const Mask segment = segmentOf(segmentation, labels);
    ASSERT_EQ(segment.grid, obliqueLabels());
    for (std::size_t i = 0; i < segment.inside.size(); ++i)
    {
      const int label = labelAt(segment.grid.worldFromGrid(glm::dvec3(indexOf(segment.grid, i))));
      const bool isChosen = std::find(labels.begin(), labels.end(), label) != labels.end();
      ASSERT_EQ(segment.inside[i] != 0, labels.empty() ? label > 0 : isChosen) << i;
    }
  }
}
