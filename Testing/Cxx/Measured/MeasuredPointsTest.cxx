// SPDX-License-Identifier: BSD-3-Clause
// Proves that pairs of landmarks are called by their labels or by their numbers from 1 on; that the
// distance to a mask is in mm, whatever the spacing and the direction of its voxels are, and that
// it counts beyond the mask's own image.
#include "Filters/Measured/MeasuredPoints.h"

#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace brainshift;

namespace
{
constexpr double NearMm = 6.0;

// Voxels of three sizes along axes that are rotated by a quarter about z.
Grid someGrid()
{
  Grid grid;
  grid.dimensions = { 9, 8, 7 };
  grid.spacing = { 0.5, 2.0, 3.0 };
  grid.origin = { -40.0, 25.0, 10.0 };
  grid.direction = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1);
  return grid;
}

Mask maskOf(const std::vector<glm::ivec3>& voxels)
{
  Mask mask{ someGrid(), {} };
  mask.inside.assign(mask.grid.count(), 0);
  for (const glm::ivec3& voxel : voxels)
  {
    mask.inside[mask.grid.offset(voxel.x, voxel.y, voxel.z)] = 1;
  }
  return mask;
}

vtkSmartPointer<vtkPolyData> landmarks(
  const std::vector<std::string>& labels, const glm::dvec3& first, const glm::dvec3& step)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkStringArray> names;
  names->SetName("Label");
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const glm::dvec3 place = first + static_cast<double>(i) * step;
    points->InsertNextPoint(&place.x);
    names->InsertNextValue(labels[i]);
  }
  result->SetPoints(points);
  result->GetPointData()->AddArray(names);
  return result;
}
}

TEST(LandmarkPairs, AreCalledByTheirLabelsOrNumbers)
{
  const auto rest = landmarks({ "", "", "" }, { 1.0, 2.0, 3.0 }, { 10.0, 0.0, 0.0 });
  const auto measured = landmarks({ "", "" }, { 1.5, 2.0, 3.0 }, { 10.0, 0.0, 0.0 });
  const NamedPairs byOrder = landmarkPairs(rest, measured);
  EXPECT_EQ(byOrder.names, (std::vector<std::string>{ "1", "2" }));
  ASSERT_EQ(byOrder.pairs.size(), 2U);
  EXPECT_EQ(byOrder.pairs[1].rest, glm::dvec3(11.0, 2.0, 3.0));
  EXPECT_EQ(byOrder.pairs[1].measured, glm::dvec3(11.5, 2.0, 3.0));
  EXPECT_EQ(byOrder.pairs[1].weight, 1.0);
  EXPECT_NE(byOrder.unmatched.find("landmark 3 at rest"), std::string::npos) << byOrder.unmatched;
  const auto named = landmarks({ "sulcus", "vein", "tumour" }, glm::dvec3(0.0), glm::dvec3(1.0));
  const auto other = landmarks({ "tumour", "sulcus" }, glm::dvec3(5.0), glm::dvec3(1.0));
  const NamedPairs byLabel = landmarkPairs(named, other);
  EXPECT_EQ(byLabel.names, (std::vector<std::string>{ "sulcus", "tumour" }));
  ASSERT_EQ(byLabel.pairs.size(), 2U);
  EXPECT_EQ(byLabel.pairs[0].measured, glm::dvec3(6.0));
  EXPECT_EQ(byLabel.pairs[1].measured, glm::dvec3(5.0));
  EXPECT_TRUE(landmarkPairs(nullptr, nullptr).pairs.empty());
}

TEST(NearMask, MeasuresInMmAlongEachAxis)
{
  const Mask mask = maskOf({ { 4, 3, 2 } });
  const NearMask near(mask, NearMm);
  const glm::dvec3 middle = mask.grid.worldFromGrid({ 4, 3, 2 });
  EXPECT_TRUE(near.holds(middle));
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      glm::dvec3 away(0.0);
      away[axis] = sign;
      EXPECT_TRUE(near.holds(middle + (NearMm - 0.01) * away)) << axis << sign;
      EXPECT_FALSE(near.holds(middle + (NearMm + 0.01) * away)) << axis << sign;
    }
  }
  const glm::dvec3 diagonal(1.0 / std::sqrt(3.0));
  EXPECT_TRUE(near.holds(middle + (NearMm - 0.01) * diagonal));
  EXPECT_FALSE(near.holds(middle + (NearMm + 0.01) * diagonal));
}

// The first and the last voxel that are inside count, at the image's corners too.
TEST(NearMask, AnyVoxelThatIsInsideCounts)
{
  const glm::ivec3 last = someGrid().dimensions - 1;
  const Mask mask = maskOf({ { 0, 0, 0 }, last });
  const NearMask near(mask, NearMm);
  const double outward[] = { -1.0, 1.0 };
  const glm::ivec3 corners[] = { { 0, 0, 0 }, last };
  for (int i = 0; i < 2; ++i)
  {
    const glm::dvec3 corner = mask.grid.worldFromGrid(corners[i]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const glm::dvec3 away = outward[i] * mask.grid.direction[axis];
      EXPECT_TRUE(near.holds(corner + (NearMm - 0.01) * away)) << i << axis;
      EXPECT_FALSE(near.holds(corner + (NearMm + 0.01) * away)) << i << axis;
    }
  }
  EXPECT_FALSE(near.holds(mask.grid.worldFromGrid(0.5 * glm::dvec3(last)))) << "between both";
}

TEST(NearMask, NothingIsNearAnEmptyMask)
{
  const Mask empty = maskOf({});
  EXPECT_FALSE(NearMask(empty, 1000.0).holds(empty.grid.origin));
}
