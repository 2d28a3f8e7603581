// SPDX-License-Identifier: BSD-3-Clause
// Proves that baking moves voxels where the deformation says and invents no value.
#include "Common/Numbers.h"
#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCellData.h>
#include <vtkStringArray.h>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int ScalarTypes[] = { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
  VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
  VTK_UNSIGNED_LONG_LONG, VTK_FLOAT, VTK_DOUBLE };
constexpr int AllInterpolations[] = { vtkBakeDeformation::Nearest, vtkBakeDeformation::Linear,
  vtkBakeDeformation::Cubic };

// Four voxels to a lattice cell of five control points a side: shifts are exact in binary.
const Grid VolumeGrid = plainGrid(glm::ivec3(17), glm::dvec3(1.0));

double someValue(vtkIdType i)
{
  return 3.0 + (i * 7919 + i / 17 * 31) % 113;
}

// A volume through both filters.
class Pipeline
{
public:
  explicit Pipeline(vtkImageData* volume)
  {
    this->Deform->SetInputData(volume);
    this->Deform->SetLatticeDimensions(5, 5, 5);
    this->Bake->SetInputConnection(this->Deform->GetOutputPort());
  }

  // Moves everything by a vector (mm).
  void translate(const glm::dvec3& shift)
  {
    const Grid grid = gridOf(vtkImageData::SafeDownCast(this->Deform->GetInputDataObject(0, 0)));
    this->Field =
      fieldOn(withDimensions(grid, glm::ivec3(2)), [&](const glm::dvec3&) { return shift; });
    this->Deform->SetInputDataObject(1, this->Field);
  }

  vtkImageData* baked(int interpolation)
  {
    this->Bake->SetInterpolation(interpolation);
    this->Bake->Update();
    return this->Bake->GetOutput();
  }

  vtkNew<vtkFreeFormDeformation> Deform;
  vtkNew<vtkBakeDeformation> Bake;

private:
  vtkSmartPointer<vtkImageData> Field;
};

bool sameBits(vtkDataArray* left, vtkDataArray* right)
{
  const std::size_t bytes = static_cast<std::size_t>(left->GetNumberOfValues()) *
    static_cast<std::size_t>(left->GetDataTypeSize());
  return left->GetDataType() == right->GetDataType() &&
    left->GetNumberOfValues() == right->GetNumberOfValues() &&
    std::memcmp(left->GetVoidPointer(0), right->GetVoidPointer(0), bytes) == 0;
}
}

TEST(Bake, OfNoDisplacementIsTheSameBits)
{
  for (const int type : ScalarTypes)
  {
    auto volume = volumeOn(VolumeGrid, type, someValue);
    Pipeline pipeline(volume);
    for (const int interpolation : AllInterpolations)
    {
      vtkImageData* baked = pipeline.baked(interpolation);
      EXPECT_TRUE(
        sameBits(volume->GetPointData()->GetScalars(), baked->GetPointData()->GetScalars()))
        << volume->GetScalarTypeAsString() << " interpolation " << interpolation;
      EXPECT_EQ(gridOf(baked), gridOf(volume));
      EXPECT_STREQ(baked->GetPointData()->GetScalars()->GetName(), "Intensity");
    }
  }
}

TEST(Bake, LeavesVoxelsThatTheStrokeDoesNotReach)
{
  for (const int type : ScalarTypes)
  {
    auto volume = volumeOn(VolumeGrid, type, someValue);
    Pipeline pipeline(volume);
    setStrokes(pipeline.Deform, { strokeAt(Tool::Move, { 0, 0, 0 }, { 1.3, 0.4, -0.7 }) });
    for (const int interpolation : AllInterpolations)
    {
      vtkDataArray* source = volume->GetPointData()->GetScalars();
      vtkDataArray* target = pipeline.baked(interpolation)->GetPointData()->GetScalars();
      int same = 0;
      for (int i = 0; i < 17 * 17 * 17; ++i)
      {
        const glm::ivec3 index(i % 17, i / 17 % 17, i / 289);
        const bool unmoved = source->GetTuple1(i) == target->GetTuple1(i);
        same += unmoved;
        // Beyond two cells of the moved point, and the one voxel it may reach further.
        EXPECT_TRUE(unmoved || glm::all(glm::lessThan(index, glm::ivec3(10)))) << i;
      }
      EXPECT_LT(same, 17 * 17 * 17 - 50) << "the stroke must reach something";
    }
  }
}

TEST(Bake, MovesWholeVoxelsExactly)
{
  for (const int type : ScalarTypes)
  {
    auto volume = volumeOn(VolumeGrid, type, someValue);
    vtkDataArray* source = volume->GetPointData()->GetScalars();
    Pipeline pipeline(volume);
    pipeline.translate({ 2.0, -4.0, 1.0 });
    for (const int interpolation : AllInterpolations)
    {
      vtkDataArray* target = pipeline.baked(interpolation)->GetPointData()->GetScalars();
      for (int i = 0; i < 17 * 17 * 17; ++i)
      {
        const glm::ivec3 from = glm::ivec3(i % 17, i / 17 % 17, i / 289) - glm::ivec3(2, -4, 1);
        const bool inside = from == glm::clamp(from, glm::ivec3(0), glm::ivec3(16));
        const double expected = inside
          ? source->GetTuple1(VolumeGrid.offset(from.x, from.y, from.z))
          : source->GetRange()[0];
        ASSERT_EQ(target->GetTuple1(i), expected)
          << volume->GetScalarTypeAsString() << " interpolation " << interpolation << " at " << i;
      }
    }
  }
}

TEST(Bake, FollowsTheWorldOnAnObliqueVolume)
{
  // Intensity is a linear function of the world position, which linear reading reproduces.
  const Grid grid = obliqueGrid({ 17, 13, 21 });
  const glm::dvec3 slope(0.5, -0.25, 1.0);
  const auto intensity = [&](const glm::dvec3& rest) { return glm::dot(slope, rest); };
  auto volume = volumeOn(grid, VTK_DOUBLE, [&](vtkIdType i) {
    return intensity(grid.worldFromGrid(glm::dvec3(i % 17, i / 17 % 13, i / 221)));
  });
  const glm::dvec3 shift(3.0, 5.0, -4.0);
  Pipeline pipeline(volume);
  pipeline.translate(shift);
  vtkDataArray* target = pipeline.baked(vtkBakeDeformation::Linear)->GetPointData()->GetScalars();
  for (const glm::ivec3& index : { glm::ivec3(8, 6, 10), glm::ivec3(4, 9, 15) })
  {
    const glm::dvec3 deformed = grid.worldFromGrid(glm::dvec3(index));
    EXPECT_NEAR(
      target->GetTuple1(grid.offset(index.x, index.y, index.z)), intensity(deformed - shift), 1e-3);
  }
}

// How far from each voxel that moves the tissue arrives that was baked into it, mm. Each voxel of
// the volume holds its own position, so the baked voxel holds where its tissue comes from.
class Misses
{
public:
  Misses(Pipeline& pipeline, const Grid& grid)
  {
    vtkDataArray* rest =
      pipeline.baked(vtkBakeDeformation::Linear)->GetPointData()->GetArray("Position");
    const Deformation deformation =
      deformationOf(vtkImageData::SafeDownCast(pipeline.Deform->GetOutputDataObject(0)));
    const PointMap map(effectiveLattice(deformation), deformation.inverse);
    for (vtkIdType i = 0; i < rest->GetNumberOfTuples(); ++i)
    {
      glm::dvec3 from;
      rest->GetTuple(i, &from.x);
      const glm::dvec3 deformed = positionOf(grid, i);
      // Tissue from outside the volume has the lowest value of each component: the first position.
      if (map.deformedFromRest(deformed) != deformed && from != grid.origin)
      {
        ++this->Moved;
        this->Largest =
          std::max(this->Largest, glm::distance(map.deformedFromRest(from), deformed));
      }
    }
  }

  static glm::dvec3 positionOf(const Grid& grid, vtkIdType i)
  {
    const vtkIdType row = i / grid.dimensions.x;
    return grid.worldFromGrid(
      glm::dvec3(i % grid.dimensions.x, row % grid.dimensions.y, row / grid.dimensions.y));
  }

  // Every voxel holds its position.
  static vtkSmartPointer<vtkImageData> volumeOn(const Grid& grid)
  {
    auto image = imageOn(grid);
    auto positions = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    positions->SetName("Position");
    positions->SetNumberOfComponents(3);
    positions->SetNumberOfTuples(image->GetNumberOfPoints());
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      positions->SetTuple(i, &positionOf(grid, i)[0]);
    }
    image->GetPointData()->AddArray(positions);
    return image;
  }

  int Moved = 0; // voxels
  double Largest = 0.0;
};

Stroke stampAt(const glm::dvec3& anchor, double amount, double major, double minor)
{
  Stroke stamp = strokeAt(Tool::Stamp, anchor, { 0.0, 0.0, amount });
  stamp.major = major;
  stamp.minor = minor;
  return stamp;
}

TEST(Bake, PutsTissueWhereStrokesSay)
{
  const Grid grid = plainGrid({ 86, 86, 50 }, glm::dvec3(3.0));
  const std::vector<Stroke> strokes = { stampAt({ 128, 128, 110 }, 20.0, 60.0, 40.0),
    stampAt({ 126, 131, 70 }, 20.0, 20.0, 12.0),
    strokeAt(Tool::Move, { 127, 125, 74 }, { 6, 0, 2 }),
    strokeAt(Tool::Soft, { 120, 120, 80 }, { 9, 7, -12 }) };
  auto volume = Misses::volumeOn(grid);
  for (std::size_t i = 0; i < strokes.size(); ++i)
  {
    for (const int kernel : { KernelCatmullRom, KernelBSpline })
    {
      for (const int samples : { 0, 4 })
      {
        Pipeline pipeline(volume);
        pipeline.Deform->SetLatticeDimensions(19, 19, 19);
        pipeline.Deform->SetKernel(kernel);
        pipeline.Deform->SetSamples(samples);
        setStrokes(pipeline.Deform, { strokes[i] });
        const Misses misses(pipeline, grid);
        EXPECT_GT(misses.Moved, 200);
        // 0.0001 cells of 14 mm, and at the volume's border a thousandth of a voxel.
        EXPECT_LT(misses.Largest, 0.005)
          << "stroke " << i << ", kernel " << kernel << ", " << samples << " samples";
      }
    }
  }
}

TEST(Bake, PutsTissueWhereTheMaskedFieldSays)
{
  const Grid grid = plainGrid(glm::ivec3(33), glm::dvec3(2.0));
  Pipeline pipeline(Misses::volumeOn(grid));
  auto mask = volumeOn(grid, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return i % 33 < 19; });
  pipeline.Deform->SetInputDataObject(2, mask);
  pipeline.Deform->SetFeather(6.0);
  pipeline.Deform->SetMaskGrowth(0.0);
  setStrokes(pipeline.Deform, { strokeAt(Tool::Soft, { 24, 32, 32 }, { -4, 3, 2 }) });
  const Misses misses(pipeline, grid);
  EXPECT_GT(misses.Moved, 200);
  EXPECT_LT(misses.Largest, 0.0015);
}

TEST(Bake, NegatedSubtractsTheDisplacementThere)
{
  const Grid grid = plainGrid(glm::ivec3(33), glm::dvec3(2.0));
  Pipeline pipeline(Misses::volumeOn(grid));
  pipeline.Deform->SetInverse(static_cast<int>(Inverse::Negated));
  const glm::dvec3 anchor(32.0);
  setStrokes(pipeline.Deform, { strokeAt(Tool::Soft, anchor, { -4, 3, 2 }) });
  vtkDataArray* rest =
    pipeline.baked(vtkBakeDeformation::Linear)->GetPointData()->GetArray("Position");
  const PointMap map(
    deformationOf(vtkImageData::SafeDownCast(pipeline.Deform->GetOutputDataObject(0))).lattice);
  double farthest = 0.0;
  for (vtkIdType i = 0; i < rest->GetNumberOfTuples(); ++i)
  {
    glm::dvec3 from;
    rest->GetTuple(i, &from.x);
    const glm::dvec3 deformed = Misses::positionOf(grid, i);
    const glm::dvec3 moves = map.deformedFromRest(deformed) - deformed;
    farthest = std::max(farthest, glm::length(moves));
    const bool outside = from == grid.origin; // the lowest value
    // A thousandth of a voxel at the volume's border.
    ASSERT_TRUE(outside || glm::distance(from, deformed - moves) < 0.0021) << i;
  }
  EXPECT_GT(farthest, 3.0);
}

TEST(Bake, HoldsTheBorderOfALatticeThatEndsWithinTheVolume)
{
  auto volume = volumeOn(VolumeGrid, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return i % 17; });
  Deformation deformation;
  Grid middle = plainGrid(glm::ivec3(5), glm::dvec3(1.0));
  middle.origin = glm::dvec3(5.0);
  deformation.lattice = latticeOf(middle, 0, [](const glm::dvec3&) { return glm::dvec3(2, 0, 0); });
  deformation.samples = 0;
  attach(volume, deformation);
  vtkNew<vtkBakeDeformation> bake;
  bake->SetInputData(volume);
  bake->Update();
  vtkDataArray* baked = bake->GetOutput()->GetPointData()->GetScalars();
  const vtkIdType row = VolumeGrid.offset(0, 8, 8);
  for (int x = 2; x < 17; ++x)
  {
    EXPECT_EQ(baked->GetTuple1(row + x), x - 2.0);
  }
}

TEST(Bake, RoundsIntegers)
{
  auto volume = volumeOn(VolumeGrid, VTK_SHORT, [](vtkIdType i) { return 10.0 * (i % 17) - 50.0; });
  Pipeline pipeline(volume);
  pipeline.translate({ -0.25, 0.0, 0.0 }); // voxel i shows what was at i + 0.25: 2.5 more
  vtkDataArray* target = pipeline.baked(vtkBakeDeformation::Linear)->GetPointData()->GetScalars();
  EXPECT_EQ(target->GetTuple1(2), -27.0) << "-27.5 rounds up";
  EXPECT_EQ(target->GetTuple1(7), 23.0) << "22.5 rounds up";
  pipeline.translate({ -0.125, 0.0, 0.0 });
  target = pipeline.baked(vtkBakeDeformation::Linear)->GetPointData()->GetScalars();
  EXPECT_EQ(target->GetTuple1(2), -29.0) << "-28.75";
  EXPECT_EQ(target->GetTuple1(7), 21.0) << "21.25";
}

TEST(Bake, KeepsIntegersWithinTheirType)
{
  // Catmull-Rom overshoots beside an edge; 0 and 255 must not wrap around.
  auto volume =
    volumeOn(VolumeGrid, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return i % 17 < 8 ? 0.0 : 255.0; });
  Pipeline pipeline(volume);
  pipeline.translate({ 0.5, 0.0, 0.0 });
  vtkDataArray* target = pipeline.baked(vtkBakeDeformation::Cubic)->GetPointData()->GetScalars();
  EXPECT_EQ(target->GetTuple1(7), 0.0);
  EXPECT_EQ(target->GetTuple1(8), 128.0) << "127.5 rounds up";
  EXPECT_EQ(target->GetTuple1(9), 255.0);
}

TEST(Bake, MakesNoNewLabelsWithNearest)
{
  const std::set<double> labels{ 0.0, 3.0, 17.0, 200.0 };
  auto volume = volumeOn(VolumeGrid, VTK_UNSIGNED_CHAR,
    [&](vtkIdType i) { return *std::next(labels.begin(), (i / 3) % 4); });
  Pipeline pipeline(volume);
  setStrokes(pipeline.Deform, { strokeAt(Tool::Soft, { 8, 8, 8 }, { 2.3, -1.1, 0.7 }) });
  std::set<double> found;
  vtkDataArray* target = pipeline.baked(vtkBakeDeformation::Nearest)->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < target->GetNumberOfTuples(); ++i)
  {
    found.insert(target->GetTuple1(i));
  }
  EXPECT_EQ(found, labels);
  EXPECT_FALSE(sameBits(target, volume->GetPointData()->GetScalars()));
}

TEST(Bake, ResamplesCellsAndEveryComponent)
{
  auto volume = volumeOn(VolumeGrid, VTK_FLOAT, someValue);
  volume->GetCellData()->AddArray(arrayOf(
    VTK_SHORT, "Labels", volume->GetNumberOfCells(), [](vtkIdType i) { return 1.0 + i % 16; }));
  auto vectors = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_DOUBLE));
  vectors->SetName("Three");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(volume->GetNumberOfPoints());
  for (vtkIdType i = 0; i < volume->GetNumberOfPoints(); ++i)
  {
    const vtkIdType layer = i / 289;
    vectors->SetTuple3(i, i % 17, i / 17 % 17, layer);
  }
  volume->GetPointData()->AddArray(vectors);
  Pipeline pipeline(volume);
  pipeline.translate({ 4.0, 0.0, 0.0 });
  vtkImageData* baked = pipeline.baked(vtkBakeDeformation::Linear);
  vtkDataArray* cells = baked->GetCellData()->GetArray("Labels");
  ASSERT_TRUE(cells);
  ASSERT_EQ(cells->GetNumberOfTuples(), 16 * 16 * 16);
  EXPECT_EQ(cells->GetTuple1(10), 7.0);
  EXPECT_EQ(cells->GetTuple1(4), 1.0);
  EXPECT_EQ(cells->GetTuple1(2), 1.0) << "outside: the lowest label";
  const vtkIdType point = VolumeGrid.offset(9, 8, 7);
  const double* three = baked->GetPointData()->GetArray("Three")->GetTuple3(point);
  EXPECT_EQ(glm::dvec3(three[0], three[1], three[2]), glm::dvec3(5, 8, 7));
}

TEST(Bake, ReadsCellsAtTheirMiddles)
{
  // Each cell holds the x of its middle; tissue is stretched by 1.25 about x = 8.
  auto volume = volumeOn(VolumeGrid, VTK_FLOAT, someValue);
  volume->GetCellData()->AddArray(arrayOf(
    VTK_DOUBLE, "Middle", volume->GetNumberOfCells(), [](vtkIdType i) { return 0.5 + i % 16; }));
  Pipeline pipeline(volume);
  auto stretch = fieldOn(withDimensions(VolumeGrid, glm::ivec3(2)),
    [](const glm::dvec3& rest) { return glm::dvec3(0.25 * (rest.x - 8.0), 0.0, 0.0); });
  pipeline.Deform->SetInputDataObject(1, stretch);
  vtkDataArray* baked =
    pipeline.baked(vtkBakeDeformation::Linear)->GetCellData()->GetArray("Middle");
  const vtkIdType row = (8 * 16 + 8) * 16;
  EXPECT_NEAR(baked->GetTuple1(row + 10), 8.0 + 2.5 / 1.25, 1e-4);
  EXPECT_NEAR(baked->GetTuple1(row + 6), 8.0 - 1.5 / 1.25, 1e-4);
}

TEST(Bake, ShowsNotANumberWhereItWas)
{
  auto volume = volumeOn(VolumeGrid, VTK_FLOAT, [](vtkIdType i) { return i == 2456 ? NAN : 5.0; });
  Pipeline pipeline(volume);
  pipeline.translate({ 2.0, 0.0, 0.0 });
  vtkDataArray* target = pipeline.baked(vtkBakeDeformation::Nearest)->GetPointData()->GetScalars();
  EXPECT_TRUE(std::isnan(target->GetTuple1(2458)));
  EXPECT_EQ(target->GetTuple1(0), 5.0) << "the lowest value is the lowest number";
}

TEST(Bake, NeedsADeformation)
{
  vtkNew<vtkBakeDeformation> bake;
  Errors errors(bake);
  auto volume = volumeOn(VolumeGrid, VTK_FLOAT, someValue);
  bake->SetInputData(volume);
  bake->Update();
  EXPECT_NE(errors.take().find("carries no deformation"), std::string::npos);
}

// A field array of another program or of a damaged file may hold any number.
TEST(Bake, RefusesCountsThatAreNotWhole)
{
  const auto volume = volumeOn(VolumeGrid, VTK_FLOAT, someValue);
  Pipeline pipeline(volume);
  pipeline.Deform->Update();
  for (const char* name : { "FFDSamples", "FFDDimensions" })
  {
    for (const double wrong : { 4.5, 1e308, -1e308, 4294967300.0 })
    {
      const auto image = vtkSmartPointer<vtkImageData>::New();
      image->ShallowCopy(pipeline.Deform->GetOutput());
      const int components = image->GetFieldData()->GetArray(name)->GetNumberOfComponents();
      auto array = arrayOf(VTK_DOUBLE, name, components, [&](vtkIdType) { return wrong; });
      image->GetFieldData()->AddArray(array);
      const std::string said = problemOf([&] { readDeformation(image); });
      EXPECT_NE(said.find(numberText(wrong)), std::string::npos) << name << ": " << said;
      EXPECT_NE(said.find("must be a whole number from"), std::string::npos) << said;
    }
  }
}
