// SPDX-License-Identifier: BSD-3-Clause
// Proves that inverting a field gives the field that undoes it, that a backward field so becomes a
// base lattice that draws what the field means, and that folds and wrong directions are told.
#include "Common/FieldDirection.h"
#include "Filters/Deformation/OffsetField.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkDeformationField.h"
#include "vtkDeformationLattice.h"
#include "vtkInvertDisplacementField.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const Grid Rotated = obliqueGrid({ 49, 47, 43 });

// A smooth backward field: a bump of 12 mm, about 100 mm wide.
glm::dvec3 bump(const glm::dvec3& world)
{
  const glm::dvec3 middle = Rotated.worldFromGrid({ 24, 23, 21 });
  const double away = glm::length(world - middle) / 100.0;
  return glm::dvec3(7.0, -8.0, 5.0) * std::exp(-away * away * 2.0);
}

vtkSmartPointer<vtkImageData> backwardField()
{
  auto field = fieldOn(Rotated, bump);
  nameDirection(field, Direction::Backward);
  return field;
}

glm::dvec3 displacementOf(vtkImageData* image, vtkIdType point)
{
  const double* d = image->GetPointData()->GetArray("Displacement")->GetTuple(point);
  return { d[0], d[1], d[2] };
}
}

TEST(InvertDisplacementField, UndoesTheField)
{
  vtkNew<vtkInvertDisplacementField> invert;
  invert->SetInputData(backwardField());
  invert->Update();
  vtkImageData* forward = invert->GetOutput();
  EXPECT_EQ(gridOf(forward), Rotated);
  EXPECT_EQ(directionOf(forward), Direction::Forward);
  EXPECT_LT(invert->GetLargestError(), 0.001) << "mm";
  double worst = 0.0;
  double furthest = 0.0;
  for (vtkIdType point = 0; point < forward->GetNumberOfPoints(); ++point)
  {
    const double* p = forward->GetPoint(point);
    const glm::dvec3 rest(p[0], p[1], p[2]);
    const glm::dvec3 deformed = rest + displacementOf(forward, point);
    // Outside its points the field is its nearest point's, the bump is not.
    const glm::dvec3 index = Rotated.gridFromWorld(deformed);
    if (glm::all(glm::greaterThan(index, glm::dvec3(0.0))) &&
      glm::all(glm::lessThan(index, glm::dvec3(Rotated.dimensions - 1))))
    {
      worst = std::max(worst, glm::length(deformed + bump(deformed) - rest));
    }
    furthest = std::max(furthest, glm::length(deformed - rest));
  }
  EXPECT_LT(worst, 0.1) << "mm: the bump between points 8 mm apart";
  EXPECT_GT(furthest, 11.0) << "mm";
}

TEST(InvertDisplacementField, ABackwardFieldIsDrawnThrough)
{
  vtkNew<vtkInvertDisplacementField> invert;
  invert->SetInputData(backwardField());
  vtkNew<vtkFreeFormDeformation> bend;
  bend->SetInputData(volumeOn(Rotated, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  bend->SetLatticeConnection(invert->GetOutputPort());
  const auto errorAt = [&](int side) {
    bend->SetLatticeDimensions(side, side, side);
    bend->Update();
    const Deformation deformation =
      deformationOf(vtkImageData::SafeDownCast(bend->GetOutputDataObject(0)));
    const Lattice lattice = effectiveLattice(deformation);
    const NodeField drawn = offsetField(lattice, deformation.samples, deformation.inverse);
    Random random(31);
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i)
    {
      const glm::dvec3 deformed = random.point(Rotated, -2.0);
      const glm::vec3 offset = drawn.displacement(glm::vec3(lattice.grid.gridFromWorld(deformed)));
      worst = std::max(
        worst, glm::length(lattice.grid.worldVectorFromGrid(glm::dvec3(offset)) - bump(deformed)));
    }
    return worst;
  };
  const double usual = errorAt(19);
  const double dense = errorAt(31);
  std::cout << "Drawn through a lattice of 19: " << usual << " mm off, of 31: " << dense << " mm\n";
  EXPECT_LT(usual, 0.25) << "mm, of a bump of 12 mm";
  EXPECT_LT(dense, 0.2) << "mm";
}

TEST(InvertDisplacementField, NoDisplacementHasNone)
{
  vtkNew<vtkInvertDisplacementField> invert;
  invert->SetInputData(fieldOn(Rotated, [](const glm::dvec3&) { return glm::dvec3(0.0); }));
  invert->Update();
  for (vtkIdType point = 0; point < Rotated.dimensions.x; ++point)
  {
    EXPECT_EQ(displacementOf(invert->GetOutput(), point), glm::dvec3(0.0));
  }
  EXPECT_EQ(directionOf(invert->GetOutput()), Direction::Forward)
    << "what does not say leads backward";
}

TEST(InvertDisplacementField, FoldsAndWrongInputsAreTold)
{
  vtkNew<vtkInvertDisplacementField> invert;
  Errors errors(invert);
  std::string warned;
  vtkNew<vtkCallbackCommand> keep;
  keep->SetClientData(&warned);
  keep->SetCallback([](vtkObject*, unsigned long, void* text, void* said) {
    *static_cast<std::string*>(text) += static_cast<const char*>(said);
  });
  invert->AddObserver(vtkCommand::WarningEvent, keep);
  // Every point is led to one plane, so no other point has an inverse.
  invert->SetInputData(
    fieldOn(Rotated, [](const glm::dvec3& p) { return glm::dvec3(-p.x, 0.0, 0.0); }));
  invert->Update();
  EXPECT_NE(warned.find("folds"), std::string::npos) << warned;
  double largest = 0.0; // mm: what leads to the plane misses by its distance from it
  for (vtkIdType point = 0; point < invert->GetOutput()->GetNumberOfPoints(); ++point)
  {
    const double* p = invert->GetOutput()->GetPoint(point);
    const glm::dvec3 from =
      glm::dvec3(p[0], p[1], p[2]) + displacementOf(invert->GetOutput(), point);
    const glm::dvec3 cell = Rotated.gridFromWorld(from);
    const bool isInside = glm::all(glm::greaterThanEqual(cell, glm::dvec3(0.0))) &&
      glm::all(glm::lessThanEqual(cell, glm::dvec3(Rotated.dimensions - 1)));
    largest = isInside ? std::max(largest, std::abs(p[0])) : largest;
  }
  ASSERT_GT(largest, 10.0);
  EXPECT_GE(invert->GetLargestError(), largest - 1e-3);
  invert->SetInputData(
    fieldOn(Rotated, [](const glm::dvec3&) { return glm::dvec3(std::nan(""), 0.0, 0.0); }));
  invert->Update();
  EXPECT_NE(errors.take().find("not finite"), std::string::npos);
  EXPECT_TRUE(std::isnan(invert->GetLargestError())) << "not that of the field before";
  invert->SetInputData(volumeOn(Rotated, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  invert->Update();
  EXPECT_NE(errors.take().find("3 components"), std::string::npos);
}

TEST(InvertDisplacementField, ABackwardBaseLatticeIsRefused)
{
  vtkNew<vtkFreeFormDeformation> bend;
  Errors errors(bend);
  bend->SetInputData(volumeOn(Rotated, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  bend->SetInputData(1, backwardField());
  bend->Update();
  const std::string said = errors.take();
  EXPECT_NE(said.find("is a backward field"), std::string::npos) << said;
  EXPECT_NE(said.find("Invert Displacement Field"), std::string::npos) << said;
}

// Grids and vectors on which the solver would leave its numbers, and its memory.
TEST(InvertDisplacementField, WhatCannotBeInvertedIsNamed)
{
  vtkNew<vtkInvertDisplacementField> invert;
  Errors errors(invert);
  const auto said = [&](vtkImageData* field) {
    invert->SetInputData(field);
    invert->Update();
    return errors.take();
  };
  const auto expectSays = [](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  const Grid good = plainGrid(glm::ivec3(5), glm::dvec3(2.0));
  const auto fieldOf = [&](const glm::dvec3& vector) {
    return fieldOn(good, [&](const glm::dvec3&) { return vector; });
  };
  auto flat = fieldOf(glm::dvec3(1.0));
  flat->SetSpacing(2.0, 0.0, 2.0);
  expectSays(said(flat), "spacing is 2 0 2 mm; it must be from");
  flat->SetSpacing(2.0, std::nan(""), 2.0);
  expectSays(said(flat), "spacing is 2 nan 2 mm");
  auto nowhere = fieldOf(glm::dvec3(1.0));
  nowhere->SetOrigin(0.0, std::nan(""), 0.0);
  expectSays(said(nowhere), "origin is 0 nan 0 mm; it must be finite");
  auto sheared = fieldOf(glm::dvec3(1.0));
  shear(sheared);
  expectSays(said(sheared), NotPerpendicular);
  expectSays(said(fieldOf(glm::dvec3(1e38))), "one of 5e+37 spacings of its grid; the limit is");
  expectSays(said(fieldOf(glm::dvec3(1e39))), "holds a number that is not finite");
  expectSays(said(fieldOf(glm::dvec3(std::nan("")))), "holds a number that is not finite");

  auto empty = fieldOf(glm::dvec3(1.0));
  empty->GetPointData()->GetArray("Displacement")->SetNumberOfTuples(0);
  expectSays(said(empty), "has 5 x 5 x 5 points and 0 displacements");
  empty->SetExtent(0, -1, 0, -1, 0, -1);
  expectSays(said(empty), "has 0 x 0 x 0 points and 0 displacements");
  EXPECT_EQ(invert->GetOutput()->GetNumberOfPoints(), 0);

  EXPECT_EQ(said(fieldOf(glm::dvec3(1.0))), "");
  EXPECT_EQ(displacementOf(invert->GetOutput(), 0), glm::dvec3(-1.0));
}

TEST(DeformationLattice, IsTheSameDeformationWhenGivenBack)
{
  for (const int kernel : { 0, 1 })
  {
    vtkNew<vtkFreeFormDeformation> bend;
    bend->SetInputData(volumeOn(Rotated, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
    bend->SetLatticeDimensions(9, 10, 11);
    bend->SetKernel(kernel);
    bend->SetStrength(0.75);
    setStrokes(
      bend, { strokeAt(Tool::Stamp, Rotated.worldFromGrid({ 24, 23, 21 }), { 9.0, -6.0, 4.0 }) });
    vtkNew<vtkDeformationLattice> lattice;
    lattice->SetInputConnection(bend->GetOutputPort());
    lattice->Update();
    EXPECT_EQ(directionOf(lattice->GetOutput()), Direction::Forward);

    vtkNew<vtkFreeFormDeformation> again;
    again->SetInputConnection(bend->GetInputConnection(0, 0));
    again->SetLatticeDimensions(9, 10, 11);
    again->SetKernel(kernel);
    again->SetLatticeConnection(lattice->GetOutputPort());
    bend->Update();
    again->Update();
    const Lattice first =
      effectiveLattice(deformationOf(vtkImageData::SafeDownCast(bend->GetOutputDataObject(0))));
    const Lattice second =
      effectiveLattice(deformationOf(vtkImageData::SafeDownCast(again->GetOutputDataObject(0))));
    EXPECT_EQ(gridOf(lattice->GetOutput()), first.grid);
    double worst = 0.0;
    double furthest = 0.0;
    for (std::size_t i = 0; i < first.displacements.size(); ++i)
    {
      worst =
        std::max<double>(worst, glm::length(first.displacements[i] - second.displacements[i]));
      furthest = std::max<double>(furthest, glm::length(first.displacements[i]));
    }
    EXPECT_LT(worst, 1e-5) << "mm";
    EXPECT_GT(furthest, 1.0) << "mm";
  }
}

TEST(DeformationLattice, AVolumeWithoutLatticeIsRefused)
{
  vtkNew<vtkDeformationLattice> lattice;
  Errors errors(lattice);
  lattice->SetInputData(volumeOn(Rotated, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  lattice->Update();
  EXPECT_NE(errors.take().find("carries no deformation"), std::string::npos);
}
