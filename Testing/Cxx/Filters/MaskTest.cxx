// SPDX-License-Identifier: BSD-3-Clause
// Proves that with a mask only what is inside moves: nothing outside it does, by any amount;
// nothing of it is seen inside; the rim does not fold; and that what is no mask is refused.
#include "Filters/Deformation/Kernels.h"
#include "Filters/Attached/MaskImage.h"
#include "Filters/Deformation/MaskWeights.h"
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/Replay.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCellData.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int Samples = 4;
constexpr int Brain = 4;
constexpr int Skull = 7;

// Two millimetres a voxel.
const Grid VolumeGrid = plainGrid({ 41, 37, 33 }, glm::dvec3(2.0));
const glm::dvec3 Middle(40.0, 36.0, 32.0);

// A head: a brain with a cleft from above, in a skull. Labels from a position (mm).
int labelAt(const glm::dvec3& world)
{
  const double fromMiddle = glm::length((world - Middle) / glm::dvec3(1.2, 1.1, 1.0));
  const bool cleft = std::abs(world.x - Middle.x) < 2.5 && world.z > Middle.z + 6.0;
  return fromMiddle > 28.0 ? 0 : fromMiddle > 24.0 || cleft ? Skull : Brain;
}

vtkSmartPointer<vtkImageData> headOn(const Grid& grid)
{
  return volumeOn(grid, VTK_UNSIGNED_CHAR, [&](vtkIdType i) {
    const glm::ivec3& side = grid.dimensions;
    return labelAt(
      grid.worldFromGrid(glm::dvec3(i % side.x, i / side.x % side.y, i / side.x / side.y)));
  });
}

// A finer grid that shares no axis with the volume and covers it.
Grid obliqueMaskGrid()
{
  Grid grid = plainGrid(glm::ivec3(90), glm::dvec3(1.3));
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1.0, -2.0, 0.5)));
  grid.origin = Middle - grid.worldVectorFromGrid(glm::dvec3(44.5));
  return grid;
}

Mask brainOn(const Grid& grid)
{
  Mask mask;
  EXPECT_EQ(readMask(headOn(grid), { Brain }, VolumeGrid, mask), "");
  return mask;
}

// Whether a point lies in a voxel that is inside.
bool isInside(const Mask& mask, const glm::dvec3& world)
{
  const glm::ivec3 voxel(glm::floor(mask.grid.gridFromWorld(world) + 0.5));
  return mask.inside[mask.grid.offset(voxel.x, voxel.y, voxel.z)] != 0;
}

Lattice maskedLattice(const Mask& mask, double feather, int kernel = KernelCatmullRom)
{
  Lattice lattice = makeLattice(withDimensions(VolumeGrid, glm::ivec3(12)), kernel);
  lattice.mask = maskWeights(lattice.grid, Samples, mask, feather);
  return lattice;
}

// Strokes all over the head, most of which would fold tissue.
std::vector<Stroke> strongStrokes(unsigned int seed, int count)
{
  Random random(seed);
  std::vector<Stroke> strokes;
  for (int i = 0; i < count; ++i)
  {
    Stroke stroke = strokeAt(i % 2 ? Tool::Soft : Tool::Stamp, random.point(VolumeGrid, -4.0),
      random.between(glm::dvec3(-25.0), glm::dvec3(25.0)));
    stroke.major = random.between(12.0, 40.0);
    stroke.minor = random.between(10.0, 30.0);
    strokes.push_back(stroke);
  }
  return strokes;
}

class MaskOnGrid : public ::testing::TestWithParam<bool>
{
protected:
  Mask Inside = brainOn(GetParam() ? obliqueMaskGrid() : VolumeGrid);
};
}

TEST_P(MaskOnGrid, NothingOutsideMoves)
{
  Lattice lattice = maskedLattice(this->Inside, 4.0);
  std::fill(lattice.displacements.begin(), lattice.displacements.end(), glm::vec3(30, -20, 25));
  const NodeField field = refine(lattice, Samples);
  const PointMap map(lattice);
  Random random(31);
  int outside = 0;
  double largest = 0.0;
  for (int i = 0; i < 200000; ++i)
  {
    const glm::dvec3 rest = random.point(VolumeGrid, 0.0);
    const glm::vec3 moved = field.displacement(glm::vec3(lattice.grid.gridFromWorld(rest)));
    if (!isInside(this->Inside, rest))
    {
      ++outside;
      EXPECT_EQ(moved, glm::vec3(0.0f));
      EXPECT_EQ(map.deformedFromRest(rest), rest);
    }
    largest = std::max(largest, glm::distance(map.deformedFromRest(rest), rest));
  }
  EXPECT_GT(outside, 20000);
  EXPECT_NEAR(largest, glm::length(glm::vec3(30, -20, 25)), 1e-3) << "deep inside all of it moves";
  EXPECT_EQ(map.deformedFromRest({ -50.0, 36.0, 32.0 }), glm::dvec3(-50.0, 36.0, 32.0));
}

TEST_P(MaskOnGrid, TheRimDoesNotFoldAndKeepsWhatIsInside)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    Replay replay;
    const Lattice& bent = replay.run(
      maskedLattice(this->Inside, 5.0, kernel), strongStrokes(33, 16), { true, Samples });
    EXPECT_GT(maximumDisplacement(bent), 2.0);
    EXPECT_GT(minimumJacobian(bent), 0.1 - 5e-5);
    const PointMap map(bent);
    Random random(32);
    for (int i = 0; i < 50000; ++i)
    {
      const glm::dvec3 rest = random.point(VolumeGrid, 0.0);
      const glm::dvec3 goes = map.deformedFromRest(rest);
      EXPECT_EQ(isInside(this->Inside, goes), isInside(this->Inside, rest));
      EXPECT_EQ(isInside(this->Inside, map.restFromDeformed(rest)), isInside(this->Inside, rest));
      EXPECT_LT(glm::distance(map.restFromDeformed(goes), rest), 2e-3);
      EXPECT_GT(glm::determinant(map.jacobian(rest)), 0.1 - 5e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, MaskOnGrid, ::testing::Values(false, true));

TEST(MaskWeights, RiseOverTheFeather)
{
  // Inside: x from 1.5 to 8.5 cells of 10 mm. Nodes every 2 mm: the first that may move lies at 18,
  // the last that may not at 16.
  Mask mask{ plainGrid({ 10, 3, 3 }, { 10.0, 50.0, 50.0 }), std::vector<char>(90, 1) };
  mask.grid.origin = { 0.0, -5.0, -5.0 };
  for (std::size_t voxel = 0; voxel < 90; ++voxel)
  {
    mask.inside[voxel] = voxel % 10 > 1 && voxel % 10 < 9;
  }
  const Grid lattice = plainGrid(glm::ivec3(10), glm::dvec3(10.0));
  const auto weights = maskWeights(lattice, 4, mask, 20.0);
  const int side = 46;
  ASSERT_EQ(weights->values.size(), std::size_t(side * side * side));
  const auto at = [&](int x) { return weights->values[(22 * side + 22) * side + x]; };
  EXPECT_EQ(at(8), 0.0f);
  EXPECT_NEAR(at(9), 0.1 * 0.1 * 2.8, 1e-6);
  EXPECT_NEAR(at(13), 0.5, 1e-6);
  EXPECT_EQ(at(18), 1.0f);
  EXPECT_EQ(at(30), 1.0f);
  EXPECT_EQ(at(42), 0.0f) << "84 mm, and 85 is the edge";
  EXPECT_GT(at(41), 0.0f);
  EXPECT_EQ(weights->values[(22 * side + 0) * side + 22], 0.0f) << "the volume's border";
  const auto hard = maskWeights(lattice, 4, mask, 0.0);
  EXPECT_EQ(hard->values[(22 * side + 22) * side + 8], 0.0f);
  EXPECT_EQ(hard->values[(22 * side + 22) * side + 9], 1.0f);
}

TEST(ReadMask, TakesLabelsOrWhatIsAboveZero)
{
  Mask mask;
  const auto head = headOn(VolumeGrid);
  const auto count = [&] { return std::count(mask.inside.begin(), mask.inside.end(), 1); };
  ASSERT_EQ(readMask(head, { Brain }, VolumeGrid, mask), "");
  const auto brain = count();
  ASSERT_EQ(readMask(head, { Skull }, VolumeGrid, mask), "");
  const auto skull = count();
  ASSERT_EQ(readMask(head, {}, VolumeGrid, mask), "");
  EXPECT_EQ(count(), brain + skull);
  ASSERT_EQ(readMask(head, { Brain, Skull }, VolumeGrid, mask), "");
  EXPECT_EQ(count(), brain + skull);
  EXPECT_GT(brain, 1000);
}

TEST(ReadMask, TakesCellsAtTheirMiddles)
{
  auto image = imageOn(VolumeGrid);
  image->GetCellData()->AddArray(arrayOf(VTK_FLOAT, "Weight", image->GetNumberOfCells(),
    [](vtkIdType i) { return i == 0 ? 0.5 : 0.0; }));
  Mask mask;
  ASSERT_EQ(readMask(image, {}, VolumeGrid, mask), "");
  EXPECT_EQ(mask.grid.origin, glm::dvec3(1.0));
  EXPECT_EQ(mask.grid.dimensions, VolumeGrid.dimensions - 1);
  EXPECT_EQ(mask.inside[0], 1);
}

TEST(ReadMask, RefusesWhatIsNone)
{
  Mask mask;
  Grid away = VolumeGrid;
  away.origin.x = 500.0;
  EXPECT_EQ(readMask(headOn(away), {}, VolumeGrid, mask),
    "The mask (x 499 to 581, y -1 to 73, z -1 to 65 mm) does not overlap the volume (x 0 to 80, y "
    "0 to 72, z 0 to 64 mm)");
  EXPECT_EQ(readMask(headOn(VolumeGrid), { 3, 5 }, VolumeGrid, mask),
    "The mask has no voxel of label 3 or 5 (MaskLabels)");
  const auto zero = [](vtkIdType) { return 0.0; };
  EXPECT_EQ(readMask(volumeOn(VolumeGrid, VTK_SHORT, zero), {}, VolumeGrid, mask),
    "The mask has no voxel above 0");
  const auto field = fieldOn(VolumeGrid, [](const glm::dvec3&) { return glm::dvec3(1.0); });
  EXPECT_EQ(
    readMask(field, {}, VolumeGrid, mask), "The mask has no point or cell array of one component");
}

TEST(MaskSource, FindsWeightsAnewOnlyAfterAChange)
{
  const auto head = headOn(VolumeGrid);
  MaskRequest request{ head, { Brain }, 4.0, VolumeGrid, VolumeGrid, 0 };
  MaskSource source;
  std::shared_ptr<const NodeWeights> first;
  std::shared_ptr<const NodeWeights> next;
  ASSERT_EQ(source.find(request, first), "");
  ASSERT_EQ(source.find(request, next), "");
  EXPECT_EQ(first, next);
  const auto expectOthers = [&](const char* what) {
    ASSERT_EQ(source.find(request, next), "");
    EXPECT_FALSE(sameMask(first, next)) << what;
    first = next;
  };
  request.featherMm = 9.0;
  expectOthers("feather");
  request.labels = { Brain, Skull };
  expectOthers("labels");
  request.samples = 1;
  expectOthers("samples");
  head->GetPointData()->GetScalars()->Fill(Skull);
  head->GetPointData()->GetScalars()->Modified();
  expectOthers("the image's values");
  request.image = nullptr;
  ASSERT_EQ(source.find(request, next), "");
  EXPECT_FALSE(next);
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
  EXPECT_EQ(this->Heard.take(), "");
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
  EXPECT_NE(this->Heard.take().find("leaves nothing to move"), std::string::npos);
}
