// SPDX-License-Identifier: BSD-3-Clause
// Proves that Deformation Field holds PointMap's displacements and determinants, both ways, on
// every kind of grid, rotated ones included; and that it refuses grids it cannot make.
#include "Common/FieldDirection.h"
#include "Common/FieldWord.h"
#include "Common/LabelTable.h"
#include "Common/WorldAxes.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkCompareVolumes.h"
#include "vtkDeformationField.h"
#include "vtkDeformationLattice.h"
#include "vtkInvertDisplacementField.h"

#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// Rotated, anisotropic volume, pulled by one stamp.
class DeformationField : public ::testing::Test
{
protected:
  const Grid Volume = obliqueGrid({ 20, 18, 16 });
  vtkNew<vtkFreeFormDeformation> Bend;
  vtkNew<vtkDeformationField> Filter;

  void SetUp() override
  {
    this->Bend->SetInputData(volumeOn(this->Volume, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
    const glm::dvec3 middle = this->Volume.worldFromGrid({ 9.5, 8.5, 7.5 });
    setStrokes(this->Bend, { strokeAt(Tool::Stamp, middle, { 9.0, -6.0, 4.0 }) });
    this->Filter->SetInputConnection(this->Bend->GetOutputPort());
  }

  vtkImageData* run()
  {
    this->Filter->Update();
    return this->Filter->GetOutput();
  }

  PointMap map()
  {
    this->Bend->Update();
    const Deformation deformation =
      deformationOf(vtkImageData::SafeDownCast(this->Bend->GetOutputDataObject(0)));
    return PointMap(effectiveLattice(deformation), deformation.inverse);
  }
};

glm::dvec3 positionOf(vtkImageData* image, vtkIdType point)
{
  const double* p = image->GetPoint(point);
  return { p[0], p[1], p[2] };
}

glm::dvec3 displacementOf(vtkImageData* image, vtkIdType point)
{
  const double* d = image->GetPointData()->GetVectors()->GetTuple(point);
  return { d[0], d[1], d[2] };
}

double determinantOf(vtkImageData* image, vtkIdType point)
{
  return image->GetPointData()->GetScalars()->GetTuple1(point);
}

double largestDisplacement(vtkImageData* image)
{
  double largest = 0.0;
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    largest = std::max(largest, glm::length(displacementOf(image, point)));
  }
  return largest;
}

// Float32 arrays of displacements of some 10 mm.
constexpr double RoundingMm = 2e-6;
constexpr double PlaceMm = 1e-9; // how well VTK and Grid agree on where a point lies
}

TEST_F(DeformationField, ForwardIsPointMapOnTheVolumesOwnPoints)
{
  this->Filter->SetDirection(vtkDeformationField::Forward);
  vtkImageData* field = this->run();
  const PointMap map = this->map();
  EXPECT_EQ(gridOf(field), this->Volume);
  for (vtkIdType point = 0; point < field->GetNumberOfPoints(); ++point)
  {
    const glm::dvec3 rest = positionOf(field, point);
    const glm::dvec3 expected = map.deformedFromRest(rest) - rest;
    EXPECT_LT(glm::length(displacementOf(field, point) - expected), RoundingMm);
    EXPECT_NEAR(determinantOf(field, point), glm::determinant(map.jacobian(rest)), 1e-5);
  }
  EXPECT_GT(largestDisplacement(field), 8.0) << "mm; the stamp must move something";
}

TEST_F(DeformationField, BackwardTheDefaultIsTheInverse)
{
  vtkImageData* field = this->run();
  const PointMap map = this->map();
  for (vtkIdType point = 0; point < field->GetNumberOfPoints(); ++point)
  {
    const glm::dvec3 deformed = positionOf(field, point);
    const glm::dvec3 rest = deformed + displacementOf(field, point);
    EXPECT_LT(glm::length(map.deformedFromRest(rest) - deformed), 1e-3) << "mm";
    EXPECT_NEAR(determinantOf(field, point) * glm::determinant(map.jacobian(rest)), 1.0, 1e-4);
  }
  EXPECT_GT(largestDisplacement(field), 7.0) << "mm";
}

TEST_F(DeformationField, DeterminantsOfNegatedAreItsOwn)
{
  this->Bend->SetInverse(1);
  this->Filter->SetDirection(vtkDeformationField::Backward);
  vtkImageData* field = this->run();
  const PointMap map = this->map();
  constexpr double step = 0.01; // mm
  double furthestFromOne = 0.0;
  for (vtkIdType point = 0; point < field->GetNumberOfPoints(); point += 37)
  {
    const glm::dvec3 at = positionOf(field, point);
    glm::dmat3 derivatives;
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 aside(0.0);
      aside[axis] = step;
      derivatives[axis] =
        (map.restFromDeformed(at + aside) - map.restFromDeformed(at - aside)) / (2.0 * step);
    }
    // At the box, where the displacement stops changing, a derivative has two values.
    const glm::dvec3 index = this->Volume.gridFromWorld(at);
    const glm::dvec3 last(this->Volume.dimensions - 1);
    if (glm::all(glm::greaterThan(index, glm::dvec3(0.5))) &&
      glm::all(glm::lessThan(index, last - 0.5)))
    {
      EXPECT_NEAR(determinantOf(field, point), glm::determinant(derivatives), 2e-3);
      furthestFromOne = std::max(furthestFromOne, std::abs(determinantOf(field, point) - 1.0));
    }
  }
  EXPECT_GT(furthestFromOne, 0.1);
}

TEST_F(DeformationField, GivenDimensionsSpanTheBox)
{
  this->Filter->SetSampleGrid(vtkDeformationField::GivenDimensions);
  this->Filter->SetDimensions(7, 8, 9);
  this->Filter->SetDirection(vtkDeformationField::Forward);
  vtkImageData* field = this->run();
  const PointMap map = this->map();
  EXPECT_EQ(gridOf(field), withDimensions(this->Volume, { 7, 8, 9 }));
  const vtkIdType last = field->GetNumberOfPoints() - 1;
  const glm::dvec3 corner = this->Volume.worldFromGrid(glm::dvec3(this->Volume.dimensions - 1));
  EXPECT_LT(glm::length(positionOf(field, last) - corner), 1e-9);
  for (vtkIdType point = 0; point <= last; ++point)
  {
    const glm::dvec3 rest = positionOf(field, point);
    EXPECT_LT(
      glm::length(displacementOf(field, point) - (map.deformedFromRest(rest) - rest)), RoundingMm);
  }
}

// 1.2 / 0.1 is a little less than 12 in binary numbers.
TEST_F(DeformationField, ASpacingThatDividesTheBoxReachesItsEnd)
{
  const Grid volume = plainGrid(glm::ivec3(5), glm::dvec3(0.3));
  ASSERT_LT(0.3 * 4.0 / 0.1, 12.0);
  this->Bend->SetInputData(volumeOn(volume, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  setStrokes(this->Bend, {});
  this->Filter->SetSampleGrid(vtkDeformationField::GivenSpacing);
  this->Filter->SetSpacing(0.1, 0.3, 0.5);
  const int* dimensions = this->run()->GetDimensions();
  EXPECT_EQ(dimensions[0], 13);
  EXPECT_EQ(dimensions[1], 5);
  EXPECT_EQ(dimensions[2], 3);
}

TEST_F(DeformationField, GivenSpacingStaysInTheBox)
{
  // The box is 152 x 119 x 142.5 mm.
  this->Filter->SetSampleGrid(vtkDeformationField::GivenSpacing);
  this->Filter->SetSpacing(8.0, 10.0, 142.5);
  vtkImageData* field = this->run();
  const Grid grid = gridOf(field);
  EXPECT_EQ(grid.dimensions, glm::ivec3(20, 12, 2));
  EXPECT_EQ(grid.spacing, glm::dvec3(8.0, 10.0, 142.5));
  EXPECT_EQ(grid.origin, this->Volume.origin);
  EXPECT_EQ(grid.direction, this->Volume.direction);
}

TEST_F(DeformationField, VolumesThatDoNotStartAtZeroKeepTheirPlace)
{
  auto piece = volumeOn(this->Volume, VTK_FLOAT, [](vtkIdType) { return 1.0; });
  piece->SetExtent(5, 24, -3, 14, 2, 17); // the same number of points elsewhere
  this->Bend->SetInputData(piece);
  vtkImageData* field = this->run();
  for (const vtkIdType point : { vtkIdType(0), vtkIdType(1234), field->GetNumberOfPoints() - 1 })
  {
    EXPECT_LT(glm::length(positionOf(field, point) - positionOf(piece, point)), PlaceMm);
  }
}

TEST_F(DeformationField, APieceIsAPieceOfTheWhole)
{
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(this->run());
  this->Filter->Modified();
  const int piece[6] = { 3, 9, 4, 8, 5, 11 };
  this->Filter->UpdateExtent(piece);
  vtkImageData* part = this->Filter->GetOutput();
  EXPECT_EQ(part->GetDimensions()[0], 7);
  for (vtkIdType point = 0; point < part->GetNumberOfPoints(); ++point)
  {
    int index[3] = { 3 + int(point % 7), 4 + int(point / 7 % 5), 5 + int(point / 35) };
    EXPECT_EQ(displacementOf(part, point), displacementOf(whole, whole->ComputePointId(index)));
  }
}

TEST_F(DeformationField, NoStrokeIsZeroAndKeepsVolumes)
{
  setStrokes(this->Bend, {});
  for (const int direction : { 0, 1 })
  {
    this->Filter->SetDirection(direction);
    vtkImageData* field = this->run();
    EXPECT_EQ(largestDisplacement(field), 0.0);
    double range[2];
    field->GetPointData()->GetScalars()->GetRange(range);
    EXPECT_NEAR(range[0], 1.0, 1e-6);
    EXPECT_NEAR(range[1], 1.0, 1e-6);
  }
}

TEST_F(DeformationField, SaysWhichWayItLeads)
{
  EXPECT_EQ(directionOf(this->run()), Direction::Backward);
  this->Filter->SetDirection(vtkDeformationField::Forward);
  EXPECT_EQ(directionOf(this->run()), Direction::Forward);
  vtkNew<vtkImageData> silent;
  EXPECT_EQ(directionOf(silent), std::nullopt);
}

TEST_F(DeformationField, CarriesNothingOfWhatBentTheVolume)
{
  const auto expectNone = [](vtkImageData* field) {
    for (int i = 0; i < field->GetFieldData()->GetNumberOfArrays(); ++i)
    {
      const std::string name = field->GetFieldData()->GetArrayName(i);
      EXPECT_NE(name.substr(0, 3), "FFD") << name;
    }
  };
  expectNone(this->run());
  vtkNew<vtkImageData> tagged; // a field that an earlier release saved
  this->Bend->Update();
  tagged->ShallowCopy(this->run());
  attach(tagged, deformationOf(vtkImageData::SafeDownCast(this->Bend->GetOutputDataObject(0))));
  vtkNew<vtkInvertDisplacementField> invert;
  invert->SetInputData(tagged);
  invert->Update();
  expectNone(invert->GetOutput());
}

// The values of a field are mm, and no labels of the volume.
TEST_F(DeformationField, CarriesNothingOfTheVolumeButItsSides)
{
  auto volume = volumeOn(this->Volume, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return i % 3; });
  attachLabels(volume, { { 2, "Thalamus", { 10, 20, 30 }, "" } });
  markLabelMap(volume, true);
  setFieldWord(volume, "Unit", "HU");
  nameWorldAxes(volume, WorldAxes::RAS);
  this->Bend->SetInputData(volume);
  vtkNew<vtkCompareVolumes> compare;
  compare->SetInputConnection(this->Bend->GetOutputPort());
  compare->SetReferenceConnection(this->Bend->GetOutputPort());
  vtkNew<vtkDeformationLattice> lattice;
  vtkNew<vtkInvertDisplacementField> invert;
  vtkNew<vtkInvertDisplacementField> tagged;
  this->Filter->SetInputConnection(compare->GetOutputPort());
  lattice->SetInputConnection(compare->GetOutputPort());
  invert->SetInputConnection(this->Filter->GetOutputPort());
  vtkImageData* field = this->run();
  EXPECT_TRUE(isLabelMap(vtkImageData::SafeDownCast(compare->GetOutputDataObject(0))));
  auto labelled = vtkSmartPointer<vtkImageData>::New(); // as an earlier release saved it
  labelled->ShallowCopy(field);
  markLabelMap(labelled, true);
  tagged->SetInputData(labelled);
  for (vtkImageAlgorithm* filter :
    { static_cast<vtkImageAlgorithm*>(this->Filter), static_cast<vtkImageAlgorithm*>(lattice),
      static_cast<vtkImageAlgorithm*>(invert), static_cast<vtkImageAlgorithm*>(tagged) })
  {
    filter->Update();
    EXPECT_FALSE(isLabelMap(filter->GetOutput()));
    EXPECT_EQ(worldAxesOf(filter->GetOutput()), WorldAxes::RAS);
    std::set<std::string> names;
    for (int i = 0; i < filter->GetOutput()->GetFieldData()->GetNumberOfArrays(); ++i)
    {
      names.insert(filter->GetOutput()->GetFieldData()->GetArrayName(i));
    }
    std::set<std::string> expected{ "WorldAxes", "DisplacementDirection" };
    if (filter == static_cast<vtkImageAlgorithm*>(lattice))
    {
      expected.insert({ "FFDKernel", "FFDSamples" });
    }
    EXPECT_EQ(names, expected) << filter->GetClassName();
  }
}

TEST_F(DeformationField, GridsThatCannotBeMadeAreRefused)
{
  Errors errors(this->Filter);
  this->Filter->SetSampleGrid(vtkDeformationField::GivenDimensions);
  this->Filter->SetDimensions(10, 1, 10);
  this->Filter->Update();
  EXPECT_NE(errors.take().find("Dimensions is 10 x 1 x 10; each must be from 2 to 4096"),
    std::string::npos);
  this->Filter->SetSampleGrid(vtkDeformationField::GivenSpacing);
  for (const double wrong : { 0.0, -1.0, 1e-3, 500.0, std::nan("") })
  {
    this->Filter->SetSpacing(4.0, wrong, 4.0);
    this->Filter->Update();
    const std::string said = errors.take();
    EXPECT_NE(said.find("Spacing is 4 x "), std::string::npos) << wrong << ": " << said;
    EXPECT_NE(said.find("to 152 x 119 x 142.5 mm"), std::string::npos) << wrong << ": " << said;
  }
}

TEST_F(DeformationField, AVolumeWithoutLatticeIsRefused)
{
  Errors errors(this->Filter);
  this->Filter->SetInputData(volumeOn(this->Volume, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  this->Filter->Update();
  EXPECT_NE(errors.take().find("carries no deformation"), std::string::npos);
}

TEST_F(DeformationField, CanBeAborted)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* filter, unsigned long, void*, void*) {
    static_cast<vtkAlgorithm*>(filter)->SetAbortExecuteAndUpdateTime();
  });
  this->Filter->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(this->run()->GetPointData()->GetNumberOfArrays(), 0);
}
