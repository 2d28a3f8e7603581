// SPDX-License-Identifier: BSD-3-Clause
// Proves that the filter attaches what DeformableVolume.h promises, touches no voxel, and keeps the
// last good deformation whatever it is given.
#include "Common/Problem.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkCallbackCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix3x3.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

class FreeFormDeformation : public ::testing::Test
{
protected:
  FreeFormDeformation()
    : VolumeGrid(obliqueGrid({ 21, 16, 13 }))
    , Volume(volumeOn(VolumeGrid, VTK_SHORT, [](vtkIdType i) { return double(i % 100); }))
  {
    this->Filter->SetInputData(this->Volume);
  }

  Stroke stamp() const
  {
    return strokeAt(Tool::Stamp, this->VolumeGrid.worldFromGrid({ 10, 8, 6 }), { 4.0, -3.0, 6.0 });
  }

  vtkImageData* output()
  {
    this->Filter->Update();
    return this->Filter->GetOutputDataObject(0)
      ? vtkImageData::SafeDownCast(this->Filter->GetOutputDataObject(0))
      : nullptr;
  }

  // The filter says `words` and goes on showing the deformation it showed before.
  void expectKeepsDeformation(const std::vector<std::string>& words)
  {
    const std::string error = this->Heard.take();
    for (const std::string& word : words)
    {
      EXPECT_NE(error.find(word), std::string::npos) << '"' << error << "\" lacks " << word;
    }
    EXPECT_NE(error.find("stays as it was"), std::string::npos);
    const Deformation kept = deformationOf(this->output());
    EXPECT_EQ(kept.lattice.displacements, this->LastGood.lattice.displacements);
    EXPECT_EQ(kept.lattice.grid, this->LastGood.lattice.grid);
    EXPECT_EQ(kept.samples, this->LastGood.samples);
    EXPECT_EQ(kept.strength, this->LastGood.strength);
    this->Heard.take();
  }

  // Bends once, well, so that there is something to keep.
  void bend()
  {
    setStrokes(this->Filter, { this->stamp() });
    this->LastGood = deformationOf(this->output());
    EXPECT_EQ(this->Heard.take(), "");
    EXPECT_GT(maximumDisplacement(this->LastGood.lattice), 1.0);
  }

  Grid VolumeGrid;
  vtkSmartPointer<vtkImageData> Volume;
  vtkNew<vtkFreeFormDeformation> Filter;
  Errors Heard{ Filter };
  Deformation LastGood;
};

vtkDataArray* fieldArray(vtkImageData* image, const char* name, int components, vtkIdType tuples)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name);
  if (!array)
  {
    ADD_FAILURE() << name << " is missing";
    return nullptr;
  }
  EXPECT_EQ(array->GetNumberOfComponents(), components) << name;
  EXPECT_EQ(array->GetNumberOfTuples(), tuples) << name;
  return array;
}
}

TEST_F(FreeFormDeformation, TouchesNoVoxel)
{
  this->bend();
  vtkDataArray* passed = this->output()->GetPointData()->GetScalars();
  EXPECT_EQ(
    passed->GetVoidPointer(0), this->Volume->GetPointData()->GetScalars()->GetVoidPointer(0));
  EXPECT_STREQ(passed->GetName(), this->Volume->GetPointData()->GetScalars()->GetName());
  EXPECT_EQ(gridOf(this->output()), gridOf(this->Volume));
  EXPECT_FALSE(carriesDeformation(this->Volume)) << "the input is not its to change";
}

TEST_F(FreeFormDeformation, PassesTheSameArrayOnUntilItChanges)
{
  this->bend();
  vtkDataArray* passed = this->output()->GetPointData()->GetScalars();
  const auto time = passed->GetMTime();
  this->Filter->SetStrength(0.5);
  this->Filter->Update();
  EXPECT_EQ(this->output()->GetPointData()->GetScalars(), passed);
  EXPECT_EQ(passed->GetMTime(), time) << "drawing would upload the volume anew";
  vtkDataArray* source = this->Volume->GetPointData()->GetScalars();
  double range[2];
  passed->GetRange(range);
  EXPECT_EQ(range[1], source->GetRange()[1]);
  source->SetComponent(0, 0, 200.0);
  source->Modified();
  this->Volume->Modified();
  this->Filter->Update();
  this->output()->GetPointData()->GetRange(source->GetName(), range);
  EXPECT_EQ(range[1], 200.0) << "the range must follow the voxels";
}

TEST_F(FreeFormDeformation, AttachesTheContract)
{
  this->Filter->SetLatticeDimensions(8, 7, 6);
  this->Filter->SetKernel(KernelBSpline);
  this->Filter->SetSamples(3);
  this->Filter->SetInverse(1);
  this->Filter->SetStrength(0.5);
  this->bend();
  vtkImageData* image = this->output();
  EXPECT_EQ(fieldArray(image, "FFDDisplacements", 3, 336)->GetDataType(), VTK_FLOAT);
  const double* sides = fieldArray(image, "FFDDimensions", 3, 1)->GetTuple3(0);
  EXPECT_EQ(glm::dvec3(sides[0], sides[1], sides[2]), glm::dvec3(8, 7, 6));
  EXPECT_EQ(fieldArray(image, "FFDKernel", 1, 1)->GetTuple1(0), KernelBSpline);
  EXPECT_EQ(fieldArray(image, "FFDSamples", 1, 1)->GetTuple1(0), 3.0);
  EXPECT_EQ(fieldArray(image, "FFDInverse", 1, 1)->GetTuple1(0), 1.0);
  EXPECT_EQ(fieldArray(image, "FFDStrength", 1, 1)->GetTuple1(0), 0.5);
  vtkDataArray* box = fieldArray(image, "FFDBox", 15, 1);
  const glm::dvec3 spacing =
    this->VolumeGrid.spacing * glm::dvec3(20, 15, 12) / glm::dvec3(7, 6, 5);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(box->GetComponent(0, axis), this->VolumeGrid.origin[axis], 1e-9);
    EXPECT_NEAR(box->GetComponent(0, 3 + axis), spacing[axis], 1e-9);
    for (int column = 0; column < 3; ++column)
    {
      EXPECT_EQ(box->GetComponent(0, 6 + 3 * axis + column),
        this->Volume->GetDirectionMatrix()->GetElement(axis, column));
    }
  }
}

TEST_F(FreeFormDeformation, AttachesWhatTheStrokesDo)
{
  this->bend();
  Lattice lattice =
    makeLattice(withDimensions(gridOf(this->Volume), glm::ivec3(19)), KernelCatmullRom);
  applyStroke(lattice, this->stamp());
  EXPECT_EQ(this->LastGood.lattice.grid, lattice.grid);
  EXPECT_EQ(this->LastGood.lattice.displacements, lattice.displacements);
  EXPECT_NEAR(this->Filter->GetMaximumDisplacement(), maximumDisplacement(lattice), 1e-6);
  EXPECT_NEAR(this->Filter->GetMinimumJacobian(), minimumJacobian(lattice), 1e-6);
}

TEST_F(FreeFormDeformation, ReplaysItsStrokesOnAnotherLattice)
{
  const glm::dvec3 top = this->stamp().anchor;
  this->bend();
  for (const int side : { 13, 41 })
  {
    this->Filter->SetLatticeDimensions(side, side, side);
    const Deformation deformation = deformationOf(this->output());
    EXPECT_EQ(deformation.lattice.grid.dimensions, glm::ivec3(side));
    // The stamp's middle moves by its whole vector, sampled by whatever points lie near.
    const glm::dvec3 moved = PointMap(deformation.lattice).deformedFromRest(top) - top;
    EXPECT_LT(glm::distance(moved, this->stamp().vector), 1.0) << side << " points a side";
  }
}

TEST_F(FreeFormDeformation, ScalesWithStrength)
{
  this->bend();
  const double whole = this->Filter->GetMaximumDisplacement();
  EXPECT_LT(this->Filter->GetMinimumJacobian(), 0.95);
  this->Filter->SetStrength(0.25);
  const Deformation quarter = deformationOf(this->output());
  EXPECT_EQ(quarter.lattice.displacements, this->LastGood.lattice.displacements);
  EXPECT_NEAR(maximumDisplacement(effectiveLattice(quarter)), 0.25 * whole, 1e-5);
  EXPECT_NEAR(this->Filter->GetMaximumDisplacement(), 0.25 * whole, 1e-5);
  EXPECT_NEAR(this->Filter->GetMinimumJacobian(), minimumJacobian(effectiveLattice(quarter)), 1e-6);
  this->Filter->SetStrength(0.0);
  EXPECT_EQ(maximumDisplacement(effectiveLattice(deformationOf(this->output()))), 0.0);
  this->Filter->SetStrength(2.0);
  EXPECT_EQ(this->Filter->GetStrength(), 1.0);
}

TEST_F(FreeFormDeformation, GuardsFoldingUntilToldNotTo)
{
  Stroke far = this->stamp();
  far.vector *= 20.0;
  setStrokes(this->Filter, { this->stamp(), far });
  this->output();
  EXPECT_GE(this->Filter->GetMinimumJacobian(), 0.1);
  EXPECT_EQ(this->Filter->GetShortenedStrokes(), 1);
  ASSERT_EQ(this->Filter->GetStrokeShares()->GetNumberOfValues(), 2);
  EXPECT_EQ(this->Filter->GetStrokeShares()->GetValue(0), 1.0);
  EXPECT_LT(this->Filter->GetStrokeShares()->GetValue(1), 0.9);
  EXPECT_EQ(this->Heard.take(), "");
  this->Filter->GuardFoldingOff();
  this->output();
  EXPECT_LT(this->Filter->GetMinimumJacobian(), 0.0);
  EXPECT_EQ(this->Filter->GetShortenedStrokes(), 0);
  EXPECT_EQ(this->Filter->GetStrokeShares()->GetValue(1), 1.0);
}

TEST_F(FreeFormDeformation, SaysOnceThatTheBaseFoldsByItself)
{
  const glm::dvec3 corner = this->VolumeGrid.origin;
  this->Filter->SetInputDataObject(1, fieldOn(this->VolumeGrid, [&](const glm::dvec3& rest) {
    return glm::distance(rest, corner) < 30.0 ? -1.5 * (rest - corner) : glm::dvec3(0.0);
  }));
  setStrokes(this->Filter, { this->stamp() });
  this->output();
  const std::string warning = this->Heard.take();
  EXPECT_NE(warning.find("base lattice folds by itself"), std::string::npos) << warning;
  EXPECT_NE(warning.find("below 0.1 in "), std::string::npos) << warning;
  EXPECT_EQ(this->Filter->GetShortenedStrokes(), 0);
  this->Filter->SetStrength(0.5);
  this->output();
  EXPECT_EQ(this->Heard.take(), "") << "told already";
}

TEST_F(FreeFormDeformation, AppliesOneStrokeWhileTheLastIsChanged)
{
  std::vector<Stroke> strokes{ this->stamp(), this->stamp(), this->stamp() };
  setStrokes(this->Filter, strokes);
  this->output();
  EXPECT_EQ(this->Filter->GetAppliedStrokes(), 3);
  strokes.back().vector *= 0.5;
  setStrokes(this->Filter, strokes);
  this->output();
  EXPECT_EQ(this->Filter->GetAppliedStrokes(), 1);
}

TEST_F(FreeFormDeformation, RefusesBadStrokes)
{
  this->bend();
  std::vector<double> numbers = numbersFromStrokes({ this->stamp() });
  numbers.push_back(1.0);
  this->Filter->SetStrokeNumbers(numbers);
  this->output();
  this->expectKeepsDeformation({ "Strokes", "15" });
  numbers.pop_back();
  numbers[5] = std::numeric_limits<double>::quiet_NaN();
  this->Filter->SetStrokeNumbers(numbers);
  this->output();
  this->expectKeepsDeformation({ "Stroke 1", "number 5", "nan" });
}

TEST_F(FreeFormDeformation, RefusesBadLattices)
{
  this->bend();
  this->Filter->SetLatticeDimensions(19, 1, 19);
  this->output();
  this->expectKeepsDeformation({ "Lattice Dimensions", "19 x 1 x 19", "4 to 257" });
  this->Filter->SetLatticeDimensions(2000, 19, 19);
  this->output();
  this->expectKeepsDeformation({ "Lattice Dimensions", "2000 x 19 x 19", "4 to 257" });
  this->Filter->SetLatticeDimensions(19, 19, 19);
  for (const int samples : { -1, 17 })
  {
    this->Filter->SetSamples(samples);
    this->output();
    this->expectKeepsDeformation({ "Samples is " + std::to_string(samples), "0 to 16" });
  }
}

TEST_F(FreeFormDeformation, RefusesAStrengthThatIsNoNumber)
{
  this->bend();
  this->Filter->SetStrength(std::numeric_limits<double>::quiet_NaN());
  this->output();
  this->expectKeepsDeformation({ "Strength is not a number", "0 to 1" });
}

TEST_F(FreeFormDeformation, RefusesAPointOfInterestThatIsNowhere)
{
  this->bend();
  this->Filter->SetPointOfInterest(1.5, std::numeric_limits<double>::infinity(), 3.0);
  this->output();
  this->expectKeepsDeformation({ "Point Of Interest is 1.5 inf 3 mm", "finite" });
  this->Filter->SetPointOfInterest(1.5, 2.0, 3.0);
  EXPECT_EQ(
    deformationOf(this->output()).lattice.displacements, this->LastGood.lattice.displacements)
    << "it bends nothing";
  EXPECT_EQ(this->Heard.take(), "");
}

TEST_F(FreeFormDeformation, AddsStrokesToABaseOnItsOwnGrid)
{
  const Lattice base =
    randomLattice(withDimensions(gridOf(this->Volume), glm::ivec3(19)), KernelCatmullRom, 41, 0.1);
  std::size_t next = 0;
  auto field =
    fieldOn(base.grid, [&](const glm::dvec3&) { return glm::dvec3(base.displacements[next++]); });
  this->Filter->SetInputDataObject(1, field);
  const Deformation plain = deformationOf(this->output());
  for (std::size_t point = 0; point < base.displacements.size(); ++point)
  {
    EXPECT_LT(glm::distance(plain.lattice.displacements[point], base.displacements[point]), 1e-5f);
  }
  this->bend();
  Lattice both = plain.lattice;
  applyStroke(both, this->stamp());
  EXPECT_EQ(this->LastGood.lattice.displacements, both.displacements);
}

TEST_F(FreeFormDeformation, ReadsABaseOnAnyGrid)
{
  // A linear field, which linear reading reproduces, on a grid that shares no axis with the volume.
  Grid dense = plainGrid({ 60, 60, 60 }, glm::dvec3(8.0));
  dense.origin = this->VolumeGrid.worldFromGrid({ 10, 8, 6 }) - glm::dvec3(236.0);
  const glm::dmat3 gradient(0.01, -0.02, 0.0, 0.03, 0.01, 0.0, 0.02, 0.0, -0.01);
  const auto displacement = [&](
                              const glm::dvec3& rest) { return gradient * (rest - dense.origin); };
  this->Filter->SetInputDataObject(1, fieldOn(dense, displacement));
  const Lattice lattice = deformationOf(this->output()).lattice;
  for (int point = 0; point < 19 * 19 * 19; ++point)
  {
    const glm::dvec3 rest =
      lattice.grid.worldFromGrid(glm::dvec3(point % 19, point / 19 % 19, point / 361));
    EXPECT_LT(glm::distance(glm::dvec3(lattice.displacements[point]), displacement(rest)), 1e-4);
  }
}

TEST_F(FreeFormDeformation, RefusesABaseThatIsNoField)
{
  this->bend();
  this->Filter->SetInputDataObject(1, this->Volume);
  this->output();
  this->expectKeepsDeformation({ "base lattice", "3 components" });
  auto infinite = fieldOn(this->VolumeGrid,
    [](const glm::dvec3&) { return glm::dvec3(std::numeric_limits<double>::infinity()); });
  this->Filter->SetInputDataObject(1, infinite);
  this->output();
  this->expectKeepsDeformation({ "Displacement", "not finite" });
}

TEST_F(FreeFormDeformation, RefusesABaseThatIsNowhere)
{
  // A position in such a grid is no number, and no array has an element of that index.
  this->bend();
  auto base = fieldOn(this->VolumeGrid, [](const glm::dvec3&) { return glm::dvec3(1.0); });
  this->Filter->SetInputDataObject(1, base);
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  for (const double spacing : { 0.0, -1.0, 1e-300, Infinity, NotANumber })
  {
    base->SetSpacing(2.0, spacing, 2.0);
    this->output();
    this->expectKeepsDeformation({ "base lattice's spacing is 2 ", "from 1e-09 to 1e+09 mm" });
  }
  base->SetSpacing(2.0, 2.0, 2.0);
  for (const double origin : { NotANumber, -Infinity })
  {
    base->SetOrigin(5.0, 6.0, origin);
    this->output();
    this->expectKeepsDeformation({ "base lattice's origin is 5 6 ", "must be finite" });
  }
}

TEST_F(FreeFormDeformation, RefusesDisplacementsThatNoFieldHolds)
{
  // The nodes that would reach so far are more than an integer counts.
  this->bend();
  std::size_t next = 0;
  auto far = fieldOn(this->VolumeGrid,
    [&](const glm::dvec3&) { return glm::dvec3(next++ == 500 ? 1e12 : 0.0, 0.0, 0.0); });
  this->Filter->SetInputDataObject(1, far);
  this->output();
  this->expectKeepsDeformation(
    { "base lattice", "Displacement", "mm; it must be at most", "10000" });
  this->Filter->SetInputDataObject(1, nullptr);
  this->Filter->GuardFoldingOff();
  const glm::dvec3 middle = this->VolumeGrid.worldFromGrid({ 10, 8, 6 });
  setStrokes(this->Filter, { strokeAt(Tool::Move, middle, { 1e8, 0.0, 0.0 }) });
  this->output();
  this->expectKeepsDeformation({ "the strokes by 1e+08 mm", "at most", "10000" });
  setStrokes(this->Filter, { strokeAt(Tool::Move, middle, { 1e39, 0.0, 0.0 }) });
  this->output();
  this->expectKeepsDeformation({ "Stroke 1", "number 4 is 1e+39", "1e+09" });
}

TEST_F(FreeFormDeformation, CanBeStoppedBetweenStrokesAndKeepsThePicture)
{
  this->bend();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* filter, unsigned long, void*, void*) {
    static_cast<vtkAlgorithm*>(filter)->SetAbortExecuteAndUpdateTime();
  });
  this->Filter->AddObserver(vtkCommand::ProgressEvent, stop);
  std::vector<Stroke> strokes(5, this->stamp());
  strokes.front().vector *= 0.5; // all are new
  setStrokes(this->Filter, strokes);
  this->output();
  this->expectKeepsDeformation({ "was stopped after 1 of 5 strokes" });
  this->Filter->RemoveObserver(stop);
  this->Filter->AbortExecuteOff();
  this->Filter->Modified();
  const Deformation whole = deformationOf(this->output());
  EXPECT_EQ(this->Heard.take(), "");
  EXPECT_NE(whole.lattice.displacements, this->LastGood.lattice.displacements);
}

TEST(FreeFormDeformationInput, NeedsTwoPointsAlongEachAxis)
{
  for (const glm::ivec3& dimensions :
    { glm::ivec3(8, 8, 1), glm::ivec3(1, 8, 8), glm::ivec3(1, 1, 1) })
  {
    auto flat =
      volumeOn(plainGrid(dimensions, glm::dvec3(1.0)), VTK_SHORT, [](vtkIdType) { return 1.0; });
    vtkNew<vtkFreeFormDeformation> filter;
    Errors heard(filter);
    filter->SetInputData(flat);
    filter->Update();
    const std::string error = heard.take();
    const std::string named = std::to_string(dimensions.x) + " x " + std::to_string(dimensions.y) +
      " x " + std::to_string(dimensions.z);
    EXPECT_NE(error.find(named), std::string::npos) << error;
    EXPECT_NE(error.find("at least 2"), std::string::npos) << error;
  }
}

TEST(FreeFormDeformationInput, NeedsAPlace)
{
  auto volume =
    volumeOn(plainGrid(glm::ivec3(8), glm::dvec3(1.0)), VTK_SHORT, [](vtkIdType) { return 1.0; });
  volume->SetSpacing(1.0, 1.0, NotANumber);
  vtkNew<vtkFreeFormDeformation> filter;
  Errors heard(filter);
  filter->SetInputData(volume);
  filter->Update();
  EXPECT_NE(heard.take().find("volume's spacing is 1 1 nan mm"), std::string::npos);
  volume->SetSpacing(1.0, 1.0, 1.0);
  volume->SetOrigin(NotANumber, 0.0, 0.0);
  filter->Update();
  EXPECT_NE(heard.take().find("volume's origin is nan 0 0 mm"), std::string::npos);
}

TEST_F(FreeFormDeformation, AttachedNumbersHaveLimits)
{
  // As a file may hold them.
  struct Case
  {
    const char* array;
    int component;
    double value;
    const char* words;
  };
  const Case cases[] = { { "FFDBox", 4, 0.0, "FFDBox, the spacing is" },
    { "FFDBox", 4, 1e-300, "1e-300" }, { "FFDStrength", 0, 1e3, "FFDStrength is 1000; it must be" },
    { "FFDStrength", 0, -0.5, "from 0 to 1" },
    { "FFDDisplacements", 1, 1e12, "field array FFDDisplacements by 1e+12 mm" } };
  for (const Case& one : cases)
  {
    this->bend();
    vtkNew<vtkImageData> image;
    image->DeepCopy(this->output());
    readDeformation(image); // throws nothing
    image->GetFieldData()->GetArray(one.array)->SetComponent(0, one.component, one.value);
    const std::string error = problemOf([&] { readDeformation(image); });
    EXPECT_NE(error.find(one.words), std::string::npos) << error;
  }
}
