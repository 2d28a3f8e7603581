// SPDX-License-Identifier: BSD-3-Clause
// Proves that a registration compares averages of voxels that are finer than it can use: each is
// the mean of its voxels, at their middle, and the same whichever part of the volume is there.
#include "Filters/Registered/ComparedVoxels.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkFieldData.h>
#include <vtkTrivialProducer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const Extent Whole{ 4, 10, -2, 2, 1, 4 }; // 7 x 5 x 4 voxels
const glm::ivec3 Joined{ 3, 2, 2 };
const glm::ivec3 Sides{ 7, 5, 4 };

double valueAt(const glm::ivec3& voxel)
{
  return (voxel.x * 37 + voxel.y * 101 + voxel.z * 59) % 251;
}

vtkSmartPointer<vtkDataArray> numbersIn(const Extent& part, int type)
{
  const glm::ivec3 first(part[0] - Whole[0], part[2] - Whole[2], part[4] - Whole[4]);
  const glm::ivec3 sides(part[1] - part[0] + 1, part[3] - part[2] + 1, part[5] - part[4] + 1);
  return arrayOf(type, "Intensity", vtkIdType{ sides.x } * sides.y * sides.z, [&](vtkIdType i) {
    return valueAt(first + glm::ivec3(i % sides.x, i / sides.x % sides.y, i / sides.x / sides.y));
  });
}

// The mean of a block's voxels; those beyond the volume have the value of its last one.
float meanOf(const glm::ivec3& block)
{
  double sum = 0.0;
  for (int z = 0; z < Joined.z; ++z)
  {
    for (int y = 0; y < Joined.y; ++y)
    {
      for (int x = 0; x < Joined.x; ++x)
      {
        sum += valueAt(glm::min(block * Joined + glm::ivec3(x, y, z), Sides - 1));
      }
    }
  }
  return static_cast<float>(sum / (Joined.x * Joined.y * Joined.z));
}

Grid fineGrid(const glm::ivec3& dimensions, const glm::dvec3& spacing)
{
  Grid grid = obliqueGrid(dimensions);
  grid.spacing = spacing;
  return grid;
}
}

TEST(JoinedVoxels, AreAtMostAsLongAsWanted)
{
  EXPECT_EQ(joinedVoxels(fineGrid({ 1024, 1024, 512 }, glm::dvec3(0.2)), 0.725), glm::ivec3(3));
  EXPECT_EQ(
    joinedVoxels(fineGrid({ 1024, 1024, 512 }, { 0.2, 0.25, 1.5 }), 0.5), glm::ivec3(2, 2, 1));
  EXPECT_EQ(joinedVoxels(fineGrid({ 1024, 1024, 512 }, glm::dvec3(0.25)), 0.5), glm::ivec3(2));
  EXPECT_EQ(joinedVoxels(fineGrid({ 512, 512, 512 }, glm::dvec3(0.51)), 0.5), glm::ivec3(1));
}

TEST(JoinedVoxels, LeaveEnoughOfASmallVolume)
{
  EXPECT_EQ(joinedVoxels(fineGrid({ 256, 256, 256 }, glm::dvec3(0.1)), 0.725), glm::ivec3(1));
  EXPECT_EQ(joinedVoxels(fineGrid({ 317, 317, 317 }, glm::dvec3(0.3)), 0.725), glm::ivec3(1));
  EXPECT_EQ(joinedVoxels(fineGrid({ 318, 318, 318 }, glm::dvec3(0.3)), 0.725), glm::ivec3(2));
}

TEST(AverageVoxels, AreTheMeansOfAllTypes)
{
  for (const int type : { VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_FLOAT, VTK_DOUBLE })
  {
    std::vector<float> found(3 * 3 * 2);
    averageVoxels(
      numbersIn(Whole, type), { Whole, Whole, Joined }, { 0, 2, 0, 2, 0, 1 }, found.data());
    for (int i = 0; i < 18; ++i)
    {
      EXPECT_EQ(found[i], meanOf({ i % 3, i / 3 % 3, i / 9 })) << type << ", " << i;
    }
  }
}

TEST(AverageVoxels, AreTheSameOfAPart)
{
  const Extent part{ 7, 10, -2, 1, 3, 4 };
  std::vector<float> found(2 * 2 * 1);
  averageVoxels(
    numbersIn(part, VTK_FLOAT), { part, Whole, Joined }, { 1, 2, 0, 1, 1, 1 }, found.data());
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(found[i], meanOf({ 1 + i % 2, i / 2, 1 })) << i;
  }
}

TEST(AverageVoxels, LeaveOutWhatIsNoNumber)
{
  const Extent one{ 0, 1, 0, 1, 0, 0 };
  const auto averageOf = [&](const std::vector<double>& values) {
    float found = 0.0f;
    averageVoxels(arrayOf(VTK_DOUBLE, "Intensity", 4, [&](vtkIdType i) { return values[i]; }),
      { one, one, { 2, 2, 1 } }, { 0, 0, 0, 0, 0, 0 }, &found);
    return found;
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(averageOf({ 1, none, none, 3 }), 2.0f);
  EXPECT_TRUE(std::isnan(averageOf({ 1, none, none, 1e30 })));
}

TEST(ComparedVoxels, LieInTheMiddleOfTheirs)
{
  const Grid grid = fineGrid({ 330, 321, 323 }, { 0.4, 0.5, 0.45 });
  const glm::dvec3 slope(0.3, -0.2, 0.5);
  vtkSmartPointer<vtkImageData> image = volumeOn(grid, VTK_FLOAT, [&](vtkIdType i) {
    const glm::ivec3& side = grid.dimensions;
    return glm::dot(
      slope, grid.worldFromGrid(glm::dvec3(i % side.x, i / side.x % side.y, i / side.x / side.y)));
  });
  image->GetFieldData()->AddArray(arrayOf(VTK_FLOAT, "Attached", 1, [](vtkIdType) { return 5.0; }));
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(image);
  source->UpdateInformation();
  const ComparedVoxels found = comparedVoxels(image, source->GetOutputInformation(0), 2.0);
  EXPECT_EQ(found.whole, grid);
  EXPECT_EQ(found.remark, "");
  EXPECT_TRUE(found.image->GetFieldData()->GetArray("Attached"));
  const Grid joined = gridOf(found.image);
  EXPECT_EQ(joined.dimensions, glm::ivec3(165, 161, 162));
  for (const glm::ivec3& point :
    { glm::ivec3(0), glm::ivec3(80, 159, 20), glm::ivec3(164, 3, 106) })
  {
    const double value =
      comparedScalars(found.image)->GetComponent(joined.offset(point.x, point.y, point.z), 0);
    EXPECT_NEAR(value, glm::dot(slope, joined.worldFromGrid(point)), 1e-4);
  }
}

TEST(ComparedVoxels, AreTheImageWhereTheyAreCoarse)
{
  const Grid grid = fineGrid({ 20, 21, 22 }, glm::dvec3(0.1));
  vtkSmartPointer<vtkImageData> image =
    volumeOn(grid, VTK_FLOAT, [](vtkIdType i) { return static_cast<double>(i); });
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(image);
  source->UpdateInformation();
  EXPECT_EQ(comparedVoxels(image, source->GetOutputInformation(0), 2.0).image, image);
}
