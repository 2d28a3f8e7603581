// SPDX-License-Identifier: BSD-3-Clause
// Proves that a bake of parts has the numbers of a bake of the whole, bit for bit, and reads no
// more of its input than that takes.
#include "Common/LabelTable.h"
#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Filters/PartSource.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkImageAlgorithm.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const Extent WholeExtent{ 5, 64, -3, 46, 2, 41 };

// Spacings of a voxel in which a lattice cell has no whole number of them.
Grid obliqueVolume()
{
  Grid grid = obliqueGrid({ 60, 50, 40 });
  grid.spacing = { 1.1, 0.9, 1.3 };
  return grid;
}

double partValue(vtkIdType i)
{
  return 20.0 + (i * 7919 + i / 17 * 31) % 1113;
}

// 60 x 50 x 40 points whose extent begins at 5, -3, 2, with numbers of several types. The lowest
// ones are in the last corner.
vtkSmartPointer<vtkImageData> manyNumbers()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const Grid grid = obliqueVolume();
  const glm::dmat3 rows = glm::transpose(grid.direction);
  image->SetExtent(const_cast<int*>(WholeExtent.data()));
  image->SetOrigin(&grid.origin.x);
  image->SetSpacing(&grid.spacing.x);
  image->SetDirectionMatrix(&rows[0][0]);
  const vtkIdType points = image->GetNumberOfPoints();
  const vtkIdType cells = image->GetNumberOfCells();
  auto scalars = arrayOf(VTK_SHORT, "Intensity", points, partValue);
  scalars->SetTuple1(points - 1, -700.0);
  image->GetPointData()->SetScalars(scalars);
  auto vectors = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_FLOAT));
  vectors->SetName("Three");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    vectors->SetTuple3(i, std::sin(0.1 * i), i % 501 == 0 ? NAN : std::cos(0.3 * i), 0.001 * i);
  }
  vectors->SetTuple3(points - 1, -3.0, -4.0, -5.0);
  image->GetPointData()->AddArray(vectors);
  auto ofCells =
    arrayOf(VTK_DOUBLE, "OfCells", cells, [](vtkIdType i) { return 0.37 * (i % 999); });
  ofCells->SetTuple1(cells - 1, -9.0);
  image->GetCellData()->AddArray(ofCells);
  return image;
}

// What bends the volume.
enum class Bend
{
  Strokes, // within
  Border,  // takes tissue from outside
  Masked,  // trilinear between masked nodes
  Negated, // subtracts the displacement there
  Coarse,  // B-splines
  Folding, // random: the inverse is not one
};

class PartsPipeline
{
public:
  explicit PartsPipeline(vtkImageData* volume, Bend bend = Bend::Strokes, int interpolation = 1)
  {
    this->Source->Whole = volume;
    this->Deform->SetInputConnection(this->Source->GetOutputPort());
    this->Deform->SetLatticeDimensions(9, 8, 7);
    this->Bake->SetInputConnection(this->Deform->GetOutputPort());
    this->Bake->SetMemoryLimit(0.0); // only parts, as small as they can be
    this->Bake->SetInterpolation(interpolation);
    const Grid grid = gridOf(volume);
    const glm::dvec3 last(grid.dimensions - 1);
    const bool isBorder = bend == Bend::Border;
    const glm::dvec3 anchor = grid.worldFromGrid((isBorder ? 0.05 : 0.5) * last);
    setStrokes(this->Deform,
      { strokeAt(Tool::Soft, anchor, { 4.0, -3.0, 3.5 }),
        strokeAt(Tool::Move, grid.worldFromGrid(0.4 * last), { -2.0, 1.0, 2.5 }) });
    this->Deform->SetKernel(bend == Bend::Coarse ? KernelBSpline : KernelCatmullRom);
    this->Deform->SetInverse(bend == Bend::Negated ? 1 : 0);
    if (bend == Bend::Masked)
    {
      this->Mask = volumeOn(grid, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return i % 60 < 31; });
      this->Deform->SetInputDataObject(2, this->Mask);
      this->Deform->SetFeather(5.0);
    }
    if (bend == Bend::Folding)
    {
      Random random(11);
      this->Field = fieldOn(withDimensions(grid, { 9, 8, 7 }),
        [&](const glm::dvec3&) { return random.between(glm::dvec3(-17.0), glm::dvec3(17.0)); });
      this->Deform->SetInputDataObject(1, this->Field);
      this->Deform->SetGuardFolding(false);
    }
  }

  vtkImageData* whole()
  {
    this->Bake->UpdateWholeExtent();
    return this->Bake->GetOutput();
  }

  vtkImageData* part(const Extent& extent)
  {
    this->Bake->UpdateExtent(extent.data());
    return this->Bake->GetOutput();
  }

  // Tissue moves in the middle alone, two lattice cells around.
  void moveMiddle()
  {
    const Grid grid = gridOf(this->Source->Whole);
    const glm::dvec3 middle = grid.worldFromGrid(0.5 * glm::dvec3(grid.dimensions - 1));
    setStrokes(this->Deform, { strokeAt(Tool::Move, middle, { 4.0, -3.0, 3.5 }) });
  }

  vtkNew<PartSource> Source;
  vtkNew<vtkFreeFormDeformation> Deform;
  vtkNew<vtkBakeDeformation> Bake;

private:
  vtkSmartPointer<vtkImageData> Mask;
  vtkSmartPointer<vtkImageData> Field;
};

// How many numbers of a part have other bits than those of the whole, which is cropped to it.
int differentNumbers(vtkImageData* part, vtkImageData* whole)
{
  vtkNew<vtkImageData> expected;
  expected->ShallowCopy(whole);
  expected->Crop(part->GetExtent());
  int different = 0;
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* to = expected->GetAttributes(kind);
    for (int i = 0; i < to->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* right = to->GetArray(i);
      vtkDataArray* found = part->GetAttributes(kind)->GetArray(right->GetName());
      EXPECT_TRUE(found && found->GetNumberOfTuples() == right->GetNumberOfTuples() &&
        found->GetDataType() == right->GetDataType())
        << right->GetName();
      const int bytes = right->GetDataTypeSize();
      const auto* a = static_cast<const char*>(found->GetVoidPointer(0));
      const auto* b = static_cast<const char*>(right->GetVoidPointer(0));
      for (vtkIdType n = 0; n < right->GetNumberOfValues(); ++n)
      {
        different += std::memcmp(a + n * bytes, b + n * bytes, bytes) != 0;
      }
    }
  }
  return different;
}

// Slabs as writers ask for them, a layer, a column, boxes in the middle and in the corners. None is
// within the one before: the pipeline would not ask for it.
std::vector<Extent> someParts()
{
  return { { 5, 64, -3, 46, 2, 11 }, { 5, 64, -3, 46, 12, 21 }, { 5, 64, -3, 46, 30, 30 },
    { 5, 64, -3, 46, 22, 41 }, { 20, 20, 10, 10, 2, 41 }, { 30, 55, 10, 33, 15, 40 },
    { 63, 64, 45, 46, 40, 41 }, { 5, 6, -3, -2, 2, 3 } };
}

int numbersThatMove(vtkImageData* volume, vtkImageData* baked)
{
  vtkDataArray* before = volume->GetPointData()->GetScalars();
  vtkDataArray* after = baked->GetPointData()->GetScalars();
  int moved = 0;
  for (vtkIdType i = 0; i < before->GetNumberOfTuples(); ++i)
  {
    moved += before->GetTuple1(i) != after->GetTuple1(i);
  }
  return moved;
}
}

class BakeParts : public ::testing::TestWithParam<Bend>
{
};

TEST_P(BakeParts, HaveTheNumbersOfTheWhole)
{
  auto volume = manyNumbers();
  for (const int interpolation : { 0, 1, 2 })
  {
    PartsPipeline ofWhole(volume, GetParam(), interpolation);
    vtkImageData* whole = ofWhole.whole();
    EXPECT_EQ(ofWhole.Source->Delivered.size(), 1u) << "all at once, as it is quickest";
    EXPECT_GT(numbersThatMove(volume, whole), 3000);
    PartsPipeline ofParts(volume, GetParam(), interpolation);
    for (const Extent& extent : someParts())
    {
      vtkImageData* part = ofParts.part(extent);
      EXPECT_EQ(extentOf(part), extent);
      EXPECT_EQ(differentNumbers(part, whole), 0) << extent[0] << " " << extent[4];
      EXPECT_EQ(gridOf(part, WholeExtent.data()), gridOf(volume));
      EXPECT_STREQ(part->GetPointData()->GetScalars()->GetName(), "Intensity");
    }
    if (GetParam() != Bend::Folding)
    {
      EXPECT_LT(ofParts.Source->largestFraction(), 0.6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, BakeParts,
  ::testing::Values(
    Bend::Strokes, Bend::Border, Bend::Masked, Bend::Negated, Bend::Coarse, Bend::Folding));

TEST(BakePart, TakesTheLowestValueOfTheWholeVolume)
{
  auto volume = manyNumbers();
  PartsPipeline pipeline(volume, Bend::Border);
  vtkImageData* corner = pipeline.part({ 5, 14, -3, 6, 2, 11 });
  double range[2];
  corner->GetPointData()->GetScalars()->GetRange(range);
  EXPECT_EQ(range[0], -700.0) << "which is in the other corner";
  EXPECT_EQ(corner->GetPointData()->GetArray("Three")->GetRange(2)[0], -5.0);
  EXPECT_EQ(corner->GetCellData()->GetArray("OfCells")->GetRange()[0], -9.0);
  const std::size_t before = pipeline.Source->Delivered.size();
  pipeline.part({ 5, 14, -3, 6, 2, 12 });
  EXPECT_LT(pipeline.Source->Delivered.size(), before + 4) << "it is looked for once";
  volume->GetPointData()->GetScalars()->SetTuple1(0, -900.0);
  pipeline.Source->Modified();
  corner = pipeline.part({ 5, 14, -3, 6, 2, 11 });
  corner->GetPointData()->GetScalars()->GetRange(range);
  EXPECT_EQ(range[0], -900.0) << "of other voxels, anew";
}

TEST(BakePart, ReadsOnlyWhereItsTissueRests)
{
  PartsPipeline pipeline(manyNumbers());
  pipeline.moveMiddle();
  pipeline.part({ 5, 14, -3, 6, 2, 11 });
  for (const Extent& extent : pipeline.Source->Delivered)
  {
    EXPECT_TRUE(holds({ 5, 19, -3, 11, 2, 16 }, extent)) << extent[1] << " " << extent[3];
  }
  const std::size_t first = pipeline.Source->Delivered.size();
  EXPECT_EQ(first, 2u) << "for the lattice, then for the voxels";
  pipeline.part({ 5, 14, -3, 6, 12, 21 });
  EXPECT_EQ(pipeline.Source->Delivered.size(), first + 1) << "the lattice is known";
}

TEST(BakePart, FollowsAnotherStroke)
{
  auto volume = manyNumbers();
  PartsPipeline pipeline(volume);
  const Extent asked{ 5, 64, -3, 46, 12, 21 };
  pipeline.part(asked);
  const auto strokes = { strokeAt(
    Tool::Soft, gridOf(volume).worldFromGrid({ 30, 20, 10 }), { 1.0, 9.0, -8.0 }) };
  setStrokes(pipeline.Deform, strokes);
  vtkNew<vtkImageData> part;
  part->DeepCopy(pipeline.part(asked));
  PartsPipeline ofWhole(volume);
  setStrokes(ofWhole.Deform, strokes);
  EXPECT_EQ(differentNumbers(part, ofWhole.whole()), 0);
}

TEST(BakePart, OfLabelsMakesNoNewOnes)
{
  auto volume = manyNumbers();
  markLabelMap(volume, true);
  PartsPipeline ofWhole(volume);
  vtkImageData* whole = ofWhole.whole();
  PartsPipeline nearest(volume, Bend::Strokes, 0);
  EXPECT_EQ(differentNumbers(nearest.whole(), whole), 0);
  PartsPipeline ofParts(volume);
  vtkImageData* part = ofParts.part({ 5, 64, -3, 46, 12, 21 });
  EXPECT_EQ(differentNumbers(part, whole), 0);
  EXPECT_TRUE(isLabelMap(part));
}

TEST(BakePart, OfRanksIsReadAtOnce)
{
  auto volume = manyNumbers();
  PartsPipeline ofWhole(volume, Bend::Border);
  vtkImageData* whole = ofWhole.whole();
  double points = 0.0;
  for (int piece = 0; piece < 4; ++piece)
  {
    PartsPipeline ofRank(volume, Bend::Border);
    ofRank.Bake->UpdatePiece(piece, 4, 0);
    vtkImageData* part = ofRank.Bake->GetOutput();
    EXPECT_EQ(differentNumbers(part, whole), 0) << piece;
    EXPECT_LT(pointsIn(extentOf(part)), 0.5 * pointsIn(WholeExtent));
    points += pointsIn(extentOf(part));
  }
  EXPECT_GE(points, pointsIn(WholeExtent));
  PartsPipeline ofRank(volume);
  ofRank.moveMiddle();
  ofRank.Bake->UpdatePiece(0, 64, 0);
  EXPECT_EQ(ofRank.Source->Delivered.size(), 2u);
  EXPECT_LT(ofRank.Source->largestFraction(), 0.4);
}

TEST(BakePart, OfASmallVolumeIsReadWithTheRest)
{
  PartsPipeline pipeline(manyNumbers());
  pipeline.Bake->SetMemoryLimit(512.0);
  pipeline.part({ 5, 64, -3, 46, 12, 21 });
  pipeline.part({ 5, 64, -3, 46, 22, 31 });
  EXPECT_EQ(pipeline.Source->Delivered, std::vector<Extent>{ WholeExtent });
}

// Two branches of a pipeline that meet again: one of them must not take the other's voxels.
// What another filter makes of the input of a bake and of the bake, in one run.
class Difference : public vtkImageAlgorithm
{
public:
  static Difference* New() { return new Difference; }
  vtkTypeMacro(Difference, vtkImageAlgorithm);

protected:
  Difference() { this->SetNumberOfInputPorts(2); }

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkImageData* one = vtkImageData::GetData(inputs[0]);
    vtkImageData* other = vtkImageData::GetData(inputs[1]);
    vtkImageData* output = vtkImageData::GetData(outputs);
    const Extent asked = updateExtentOf(outputs->GetInformationObject(0));
    output->SetExtent(const_cast<int*>(asked.data()));
    output->AllocateScalars(VTK_DOUBLE, 1);
    forEachIndex(glm::ivec3(asked[0], asked[2], asked[4]), glm::ivec3(asked[1], asked[3], asked[5]),
      [&](const glm::ivec3& at) {
        output->SetScalarComponentFromDouble(at.x, at.y, at.z, 0,
          one->GetScalarComponentAsDouble(at.x, at.y, at.z, 0) -
            other->GetScalarComponentAsDouble(at.x, at.y, at.z, 0));
      });
    return 1;
  }
};

TEST(BakePart, LeavesOtherConsumersTheirVoxels)
{
  auto volume = manyNumbers();
  PartsPipeline ofWhole(volume, Bend::Border);
  vtkImageData* whole = ofWhole.whole();
  PartsPipeline pipeline(volume, Bend::Border);
  vtkNew<Difference> difference;
  difference->SetInputConnection(0, pipeline.Deform->GetOutputPort());
  difference->SetInputConnection(1, pipeline.Bake->GetOutputPort());
  const int asked[6] = { 5, 64, -3, 46, 2, 20 };
  difference->UpdateExtent(asked);
  vtkImageData* found = difference->GetOutput();
  ASSERT_EQ(found->GetExtent()[5], 20);
  int wrong = 0;
  for (int z = 2; z <= 20; ++z)
  {
    for (int y = -3; y <= 46; ++y)
    {
      for (int x = 5; x <= 64; ++x)
      {
        wrong += found->GetScalarComponentAsDouble(x, y, z, 0) !=
          volume->GetScalarComponentAsDouble(x, y, z, 0) -
            whole->GetScalarComponentAsDouble(x, y, z, 0);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(BakePart, OfAnInputThatFailsIsAnError)
{
  auto volume = manyNumbers();
  for (const int request : { 0, 1, 2 })
  {
    PartsPipeline pipeline(volume);
    pipeline.Source->FailsAt = request;
    Errors errors(pipeline.Bake);
    pipeline.part({ 5, 64, -3, 46, 12, 21 });
    if (request > 0) // the first one is the pipeline's
    {
      EXPECT_NE(errors.take().find("points that it was asked for"), std::string::npos) << request;
    }
    EXPECT_NE(extentOf(pipeline.Bake->GetOutput()), (Extent{ 5, 64, -3, 46, 12, 21 }));
    pipeline.Source->FailsAt = -1;
    pipeline.Source->Modified();
    vtkImageData* part = pipeline.part({ 5, 64, -3, 46, 12, 21 });
    PartsPipeline ofWhole(volume);
    EXPECT_EQ(differentNumbers(part, ofWhole.whole()), 0) << "it works again";
  }
}

TEST(BakePart, CanBeAborted)
{
  PartsPipeline pipeline(manyNumbers());
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* filter, unsigned long, void*, void*) {
    auto* own = static_cast<vtkAlgorithm*>(filter);
    if (own->GetProgress() > 0.3 && own->GetProgress() < 1.0)
    {
      own->SetAbortExecuteAndUpdateTime();
    }
  });
  pipeline.Bake->AddObserver(vtkCommand::ProgressEvent, abort);
  vtkImageData* part = pipeline.part({ 5, 64, -3, 46, 12, 21 });
  EXPECT_EQ(part->GetNumberOfPoints(), 0) << "no half of it";
}
