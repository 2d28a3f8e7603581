// SPDX-License-Identifier: BSD-3-Clause
// Proves that a mask is read from any image of labels or scalars, that what is no mask is refused,
// and that the filter bends what lies inside the mask alone.
#include "Common/Problem.h"
#include "Filters/Attached/MaskImage.h"
#include "Filters/Deformation/ControlPoints.h"
#include "Testing/Cxx/Deformation/TestHead.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCellData.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace brainshift;
using namespace brainshift::testing;
using namespace brainshift::testing::head;

namespace
{
vtkSmartPointer<vtkImageData> headOn(const Grid& grid)
{
  return volumeOn(grid, VTK_UNSIGNED_CHAR, [&](vtkIdType i) {
    const glm::ivec3& side = grid.dimensions;
    return labelAt(
      grid.worldFromGrid(glm::dvec3(i % side.x, i / side.x % side.y, i / side.x / side.y)));
  });
}

Mask brainOn(const Grid& grid)
{
  return readMask(headOn(grid), { Brain }, VolumeGrid);
}
}

TEST(ReadMask, TakesLabelsOrWhatIsAboveZero)
{
  const auto head = headOn(VolumeGrid);
  const auto countOf = [&](const std::vector<int>& labels) {
    const Mask mask = readMask(head, labels, VolumeGrid);
    return std::count(mask.inside.begin(), mask.inside.end(), 1);
  };
  const auto brain = countOf({ Brain });
  const auto skull = countOf({ Skull });
  EXPECT_EQ(countOf({}), brain + skull);
  EXPECT_EQ(countOf({ Brain, Skull }), brain + skull);
  EXPECT_GT(brain, 1000);
}

TEST(ReadMask, TakesCellsAtTheirMiddles)
{
  auto image = imageOn(VolumeGrid);
  image->GetCellData()->AddArray(arrayOf(VTK_FLOAT, "Weight", image->GetNumberOfCells(),
    [](vtkIdType i) { return i == 0 ? 0.5 : 0.0; }));
  const Mask mask = readMask(image, {}, VolumeGrid);
  EXPECT_EQ(mask.grid.origin, glm::dvec3(1.0));
  EXPECT_EQ(mask.grid.dimensions, VolumeGrid.dimensions - 1);
  EXPECT_EQ(mask.inside[0], 1);
}

TEST(ReadMask, RefusesWhatIsNone)
{
  const auto problemOfMask = [](vtkImageData* image, const std::vector<int>& labels = {}) {
    return problemOf([&] { readMask(image, labels, VolumeGrid); });
  };
  Grid away = VolumeGrid;
  away.origin.x = 500.0;
  EXPECT_EQ(problemOfMask(headOn(away)),
    "The mask (x 499 to 581, y -1 to 73, z -1 to 65 mm) does not overlap the volume (x 0 to 80, y "
    "0 to 72, z 0 to 64 mm)");
  EXPECT_EQ(problemOfMask(headOn(VolumeGrid), { 3, 5 }),
    "The mask has no voxel of label 3 or 5 (MaskLabels)");
  const auto zero = [](vtkIdType) { return 0.0; };
  EXPECT_EQ(problemOfMask(volumeOn(VolumeGrid, VTK_SHORT, zero)), "The mask has no voxel above 0");
  const auto field = fieldOn(VolumeGrid, [](const glm::dvec3&) { return glm::dvec3(1.0); });
  EXPECT_EQ(problemOfMask(field), "The mask has no point or cell array of one component");
  const auto sheared = headOn(VolumeGrid);
  shear(sheared);
  EXPECT_NE(problemOfMask(sheared).find(NotPerpendicular), std::string::npos);
}

TEST(MaskSource, FindsWeightsAnewOnlyAfterAChange)
{
  const auto head = headOn(VolumeGrid);
  MaskRequest request{ head, { Brain }, 0.0, 4.0, VolumeGrid, VolumeGrid, 0 };
  MaskSource source;
  std::shared_ptr<const NodeWeights> first = source.find(request);
  std::shared_ptr<const NodeWeights> next = source.find(request);
  EXPECT_TRUE(first);
  EXPECT_EQ(first, next);
  const auto expectOthers = [&](const char* what) {
    next = source.find(request);
    EXPECT_FALSE(sameMask(first, next)) << what;
    first = next;
  };
  request.featherMm = 9.0;
  expectOthers("feather");
  request.growMm = 5.0;
  expectOthers("growth");
  request.labels = { Brain, Skull };
  expectOthers("labels");
  request.samples = 1;
  expectOthers("samples");
  head->GetPointData()->GetScalars()->Fill(Skull);
  head->GetPointData()->GetScalars()->Modified();
  expectOthers("the image's values");
  request.image = nullptr;
  EXPECT_FALSE(source.find(request));
}

namespace
{
// A head of labels, bent under a mask and baked.
class MaskedHead : public ::testing::Test
{
protected:
  MaskedHead()
  {
    this->Filter->SetInputData(this->Head);
    this->Filter->SetLatticeDimensions(12, 12, 12);
    this->Filter->SetInputDataObject(2, headOn(obliqueMaskGrid()));
    this->Filter->AddMaskLabel(Brain);
    this->Filter->SetFeather(4.0);
    this->Filter->SetMaskGrowth(0.0);
    setStrokes(this->Filter, strongStrokes(34, 12));
  }
  vtkImageData* output()
  {
    this->Filter->Update();
    return vtkImageData::SafeDownCast(this->Filter->GetOutputDataObject(0));
  }

  vtkSmartPointer<vtkImageData> Head = headOn(VolumeGrid);
  vtkNew<vtkFreeFormDeformation> Filter;
  Errors Heard{ Filter };
};
}

TEST_F(MaskedHead, NoSkullVoxelAppearsInTheBrain)
{
  vtkNew<vtkBakeDeformation> bake;
  bake->SetInputConnection(this->Filter->GetOutputPort());
  bake->SetInterpolation(vtkBakeDeformation::Nearest);
  const auto count = [&](bool masked) {
    bake->Update();
    vtkDataArray* before = this->Head->GetPointData()->GetScalars();
    vtkDataArray* after = bake->GetOutput()->GetPointData()->GetScalars();
    int skull = 0;
    for (vtkIdType i = 0; i < before->GetNumberOfTuples(); ++i)
    {
      skull += before->GetTuple1(i) == Brain && after->GetTuple1(i) != Brain;
      if (masked && before->GetTuple1(i) != Brain)
      {
        EXPECT_EQ(after->GetTuple1(i), before->GetTuple1(i));
      }
    }
    return skull;
  };
  EXPECT_EQ(count(true), 0);
  EXPECT_GT(this->Filter->GetMaximumDisplacement(), 2.0);
  EXPECT_GE(this->Filter->GetMinimumJacobian(), 0.1 - 5e-5);
  this->Filter->SetInputDataObject(2, nullptr);
  EXPECT_GT(count(false), 100) << "without the mask";
  const std::string said = this->Heard.take();
  EXPECT_NE(said.find("The mask holds back the tissue"), std::string::npos) << said;
  EXPECT_EQ(said.find("Error"), std::string::npos) << said;
}

TEST_F(MaskedHead, AttachesItsWeights)
{
  const Deformation masked = deformationOf(this->output());
  ASSERT_TRUE(masked.lattice.mask);
  EXPECT_EQ(masked.lattice.mask->perCell, Samples + 1);
  EXPECT_TRUE(sameMask(masked.lattice.mask,
    maskWeights(masked.lattice.grid, Samples, brainOn(obliqueMaskGrid()), 4.0)));
  this->Filter->SetSamples(2);
  EXPECT_EQ(deformationOf(this->output()).lattice.mask->perCell, 3);
  this->Filter->SetFeather(8.0);
  EXPECT_FALSE(sameMask(deformationOf(this->output()).lattice.mask,
    maskWeights(masked.lattice.grid, 2, brainOn(obliqueMaskGrid()), 4.0)));
  this->Filter->SetInputDataObject(2, nullptr);
  EXPECT_FALSE(deformationOf(this->output()).lattice.mask);
}

namespace
{
// The smallest weight of a mask in its own voxels.
double leastWeightInside(const Lattice& lattice, const Mask& mask)
{
  const NodeWeights& nodes = *lattice.mask;
  const glm::ivec3 sides = (lattice.grid.dimensions - 1) * nodes.perCell + 1;
  double least = 1.0;
  for (std::size_t i = 0; i < mask.inside.size(); ++i)
  {
    const glm::dvec3 world = mask.grid.worldFromGrid(glm::dvec3(indexOf(mask.grid, i)));
    const glm::dvec3 at = lattice.grid.gridFromWorld(world) * double(nodes.perCell);
    const glm::ivec3 low(glm::floor(at));
    if (!mask.inside[i] || glm::any(glm::lessThan(low, glm::ivec3(0))) ||
      glm::any(glm::greaterThanEqual(low + 1, sides)))
    {
      continue;
    }
    for (int corner = 0; corner < 8; ++corner) // trilinear: no smaller than all of them
    {
      const glm::ivec3 node = low + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
      const std::size_t offset =
        node.x + static_cast<std::size_t>(sides.x) * (node.y + std::size_t(sides.y) * node.z);
      least = std::min(least, double(nodes.values[offset]));
    }
  }
  return least;
}
}

TEST_F(MaskedHead, MovesAllOfTheMaskUnlessTold)
{
  const Mask brain = brainOn(obliqueMaskGrid());
  this->Filter->SetFeather(3.0);
  this->Filter->SetSamples(9);
  const auto least = [&] {
    return leastWeightInside(deformationOf(this->output()).lattice, brain);
  };
  EXPECT_LT(least(), 0.01);
  this->Filter->SetMaskGrowth(3.0); // as wide as the feather: nodes beside the edge are held
  EXPECT_LT(least(), 0.9);
  this->Filter->SetMaskGrowth(vtkNew<vtkFreeFormDeformation>()->GetMaskGrowth());
  EXPECT_GT(least(), 0.999);
}

TEST_F(MaskedHead, KeepsTheDeformationWhenTheMaskIsNone)
{
  const Deformation good = deformationOf(this->output());
  const auto expectKept = [&](const std::string& words) {
    const Deformation kept = deformationOf(this->output());
    EXPECT_NE(this->Heard.take().find(words), std::string::npos) << words;
    EXPECT_EQ(kept.lattice.displacements, good.lattice.displacements);
    EXPECT_TRUE(sameMask(kept.lattice.mask, good.lattice.mask));
  };
  this->Filter->SetFeather(-1.0);
  expectKept("Feather is -1 mm; it must be 0 or more");
  this->Filter->SetFeather(4.0);
  this->Filter->SetMaskGrowth(-2.0);
  expectKept("Mask Growth is -2 mm; it must be 0 or more");
  this->Filter->SetMaskGrowth(std::numeric_limits<double>::infinity());
  expectKept("Mask Growth is inf mm; it must be 0 or more, and finite");
  this->Filter->SetMaskGrowth(0.0);
  this->Filter->SetLatticeDimensions(200, 200, 200);
  expectKept("a lattice of 200 x 200 x 200 points and 4 Samples make 9.88048e+08");
  this->Filter->SetLatticeDimensions(12, 12, 12);
  this->Filter->ClearMaskLabels();
  this->Filter->AddMaskLabel(99);
  expectKept("no voxel of label 99");
  this->Filter->ClearMaskLabels();
  Grid away = VolumeGrid;
  away.origin.z = -900.0;
  this->Filter->SetInputDataObject(2, headOn(away));
  expectKept("does not overlap the volume");
}

TEST_F(MaskedHead, SaysWhenNothingIsLeftToMove)
{
  this->Filter->ClearMaskLabels();
  // One voxel is inside, of which the volume has a corner of a millimetre.
  this->Filter->SetInputDataObject(2,
    volumeOn(plainGrid({ 2, 2, 2 }, glm::dvec3(1.0)), VTK_SHORT,
      [](vtkIdType i) { return i == 7 ? 1.0 : 0.0; }));
  this->output();
  EXPECT_NE(this->Heard.take().find("leaves no tissue to move"), std::string::npos);
}
