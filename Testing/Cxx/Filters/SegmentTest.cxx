// SPDX-License-Identifier: BSD-3-Clause
// Proves that a segmentation travels with a volume as the same array object, and that the shares
// its segment is drawn by put every voxel's middle on the side of its label, smoothly, on any grid.
#include "Filters/Deformation/SegmentShares.h"
#include "Filters/Attached/Segmentation.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Half = 0.5 * WholeShare;

const Grid VolumeGrid = plainGrid({ 25, 21, 23 }, glm::dvec3(2.0));
const glm::dvec3 Middle(24.0, 20.0, 22.0);

// Labels: 3 in a ball of 12 mm, 5 around it up to 17 mm.
int labelAt(const glm::dvec3& world)
{
  const double away = glm::distance(world, Middle);
  return away < 12.0 ? 3 : away < 17.0 ? 5 : 0;
}

glm::ivec3 indexOf(const Grid& grid, vtkIdType i)
{
  const glm::ivec3& side = grid.dimensions;
  return { i % side.x, i / side.x % side.y, i / side.x / side.y };
}

vtkSmartPointer<vtkImageData> labelsOn(const Grid& grid)
{
  return volumeOn(grid, VTK_UNSIGNED_CHAR,
    [&](vtkIdType i) { return labelAt(grid.worldFromGrid(glm::dvec3(indexOf(grid, i)))); });
}

// A finer grid that shares no axis with the volume and covers it.
Grid obliqueLabels()
{
  Grid grid = plainGrid(glm::ivec3(70), glm::dvec3(1.1));
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(1.0, -2.0, 0.5)));
  grid.origin = Middle - grid.worldVectorFromGrid(glm::dvec3(34.5));
  return grid;
}

Mask segmentOn(const Grid& grid, const std::vector<int>& labels)
{
  Segmentation segmentation;
  SegmentationSource source;
  EXPECT_EQ(source.find(labelsOn(grid), VolumeGrid, segmentation), "");
  return segmentOf(segmentation, labels);
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
  Segmentation segmentation;
  SegmentationSource source;
  ASSERT_EQ(source.find(labelsOn(VolumeGrid), VolumeGrid, segmentation), "");
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
  Segmentation segmentation;
  SegmentationSource source;
  ASSERT_EQ(source.find(image, VolumeGrid, segmentation), "");
  EXPECT_EQ(segmentation.grid.origin, glm::dvec3(1.0));
  EXPECT_EQ(segmentation.grid.dimensions, VolumeGrid.dimensions - 1);
}

TEST(SegmentShares, PutEveryVoxelOnItsSide)
{
  for (const std::vector<int>& labels : { std::vector<int>{ 3 }, { 5 }, { 3, 5 }, {} })
  {
    const Mask segment = segmentOn(VolumeGrid, labels);
    const std::vector<std::uint8_t> shares = segmentShares(segment, VolumeGrid);
    ASSERT_EQ(shares.size(), VolumeGrid.count());
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      EXPECT_EQ(shares[i] > Half, segment.inside[i] != 0) << i;
    }
    EXPECT_GT(std::count(shares.begin(), shares.end(), 0), 100);
  }
}

TEST(SegmentShares, KeepWhatIsThin)
{
  const Grid grid = plainGrid(glm::ivec3(9), glm::dvec3(1.0));
  Mask segment{ grid, std::vector<char>(grid.count(), 0) };
  segment.inside[grid.offset(4, 4, 4)] = 1;
  const std::vector<std::uint8_t> shares = segmentShares(segment, grid);
  EXPECT_GT(shares[grid.offset(4, 4, 4)], Half);
  EXPECT_LT(shares[grid.offset(5, 4, 4)], Half);
  EXPECT_GT(shares[grid.offset(6, 4, 4)], 0) << "two voxels are smoothed into";
  EXPECT_EQ(shares[grid.offset(7, 4, 4)], 0);
}

TEST(SegmentShares, SlopeAcrossAFlatEdge)
{
  const Grid grid = plainGrid(glm::ivec3(12), glm::dvec3(1.0));
  Mask segment{ grid, std::vector<char>(grid.count(), 0) };
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    segment.inside[i] = i % 12 >= 6;
  }
  const std::vector<std::uint8_t> shares = segmentShares(segment, grid);
  const int expected[] = { 0, 0, 0, 0, 16, 80, 175, 239, 255, 255 }; // sixteenths: 0 1 5 11 15 16
  for (int x = 0; x < 10; ++x)
  {
    EXPECT_NEAR(shares[grid.offset(x, 6, 6)], expected[x], 1.0) << x;
  }
  EXPECT_LT(shares[grid.offset(11, 6, 6)], WholeShare) << "nothing beyond belongs to it";
}

TEST(SegmentShares, LieOnAnyGrid)
{
  // Against what is known: the surface of label 3 is 12 mm from the middle.
  const Grid oblique = obliqueLabels();
  const Mask segment = segmentOn(oblique, { 3 });
  const std::vector<std::uint8_t> shares = segmentShares(segment, VolumeGrid);
  int near = 0;
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    const glm::ivec3 at = indexOf(VolumeGrid, static_cast<vtkIdType>(i));
    const double inside = 12.0 - glm::distance(VolumeGrid.worldFromGrid(glm::dvec3(at)), Middle);
    near += std::abs(inside) < 3.0;
    if (std::abs(inside) > 0.8)
    {
      EXPECT_EQ(shares[i] > Half, inside > 0.0) << inside;
    }
  }
  EXPECT_GT(near, 500);
  Grid away = VolumeGrid;
  away.origin.x = 300.0;
  const std::vector<std::uint8_t> beyond = segmentShares(segment, away);
  EXPECT_EQ(*std::max_element(beyond.begin(), beyond.end()), 0);
}
