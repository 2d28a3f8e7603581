// SPDX-License-Identifier: BSD-3-Clause
// Proves that the part of a reference that a rank keeps has the values of the whole wherever its
// box reads, that it knows the whole's range and size, and that its arrays stay the same while a
// reference moves by less than the halo.
#include "Representations/Window/ReferencePart.h"

#include "Filters/Attached/ReferenceVolume.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkShortArray.h>
#include <vtkUnsignedCharArray.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

using namespace brainshift;

namespace
{
const glm::ivec3 Sides(41, 31, 21);
constexpr int Numbers = 41 * 31 * 21; // each voxel has its own
constexpr Box Part{ -3.0, 9.0, -8.0, 4.0, 1.0, 11.0 };
constexpr double HaloMm = 4.0;

// Oblique, around the origin.
Grid obliqueGrid(const glm::ivec3& sides, const glm::dvec3& spacing)
{
  Grid grid;
  grid.dimensions = sides;
  grid.spacing = spacing;
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1.0, 2.0, -0.5)));
  grid.origin = -(grid.direction * (grid.spacing * glm::dvec3(sides - 1) * 0.5));
  return grid;
}

template <typename Array>
vtkSmartPointer<Array> numbered(const char* name, const Grid& grid, int numbers)
{
  auto voxels = vtkSmartPointer<Array>::New();
  voxels->SetName(name);
  voxels->SetNumberOfTuples(static_cast<vtkIdType>(grid.count()));
  for (vtkIdType i = 0; i < voxels->GetNumberOfTuples(); ++i)
  {
    voxels->SetComponent(i, 0, static_cast<double>(i % numbers));
  }
  return voxels;
}

// A volume that carries a reference, and a cavity on another grid.
class Carrier
{
public:
  Carrier() { this->move({ 0.0, 0.0, 0.0 }); }

  // Attaches the whole of both, as a filter does after each change.
  void move(const glm::dvec3& shift)
  {
    this->Whole.voxels = this->Voxels;
    this->Whole.cavity.voxels = this->Cavity;
    this->Whole.grid = movedBy(this->Grids[0], shift);
    this->Whole.cavity.grid = movedBy(this->Grids[1], shift);
    this->Whole.show = ReferenceShow::Reference;
    attachReference(this->Volume, this->Whole);
  }

  ReferenceVolume cut(const Box& box, double haloMm = HaloMm)
  {
    this->Reference.cut(this->Volume, box, haloMm);
    return readReference(this->Volume);
  }

  const ReferenceVolume& whole() const { return this->Whole; }
  void touch() { this->Voxels->Modified(); }

private:
  static Grid movedBy(Grid grid, const glm::dvec3& shift)
  {
    grid.origin += shift;
    return grid;
  }

  const Grid Grids[2]{ obliqueGrid(Sides, { 1.0, 1.5, 2.0 }),
    obliqueGrid({ 25, 26, 27 }, { 1.6, 1.7, 1.5 }) };
  vtkSmartPointer<vtkShortArray> Voxels =
    numbered<vtkShortArray>(ReferenceVoxelsName, Grids[0], Numbers);
  vtkSmartPointer<vtkUnsignedCharArray> Cavity =
    numbered<vtkUnsignedCharArray>("CavityVoxels", Grids[1], 251);
  ReferenceVolume Whole;
  vtkSmartPointer<vtkImageData> Volume = vtkSmartPointer<vtkImageData>::New();
  ReferencePart Reference;
};

// The value of the voxel nearest to a place; none outside.
std::optional<double> valueAt(const PlacedVoxels& placed, const glm::dvec3& world)
{
  const glm::ivec3 index(glm::round(placed.grid.gridFromWorld(world)));
  const bool isIn = glm::all(glm::greaterThanEqual(index, glm::ivec3(0))) &&
    glm::all(glm::lessThan(index, placed.grid.dimensions));
  return isIn ? std::optional<double>(placed.voxels->GetComponent(
                  static_cast<vtkIdType>(placed.grid.offset(index.x, index.y, index.z)), 0))
              : std::nullopt;
}

// Compares at places of a box and of the voxels that interpolation and gradients read around it.
// Returns how many of them are in the whole.
int expectSame(const PlacedVoxels& part, const PlacedVoxels& whole, const Box& box)
{
  constexpr double BesideMm = 1.2;
  int inside = 0;
  for (double x = box[0] - BesideMm; x <= box[1] + BesideMm; x += 0.7)
  {
    for (double y = box[2] - BesideMm; y <= box[3] + BesideMm; y += 0.7)
    {
      for (double z = box[4] - BesideMm; z <= box[5] + BesideMm; z += 0.7)
      {
        const glm::dvec3 world(x, y, z);
        const std::optional<double> value = valueAt(whole, world);
        EXPECT_EQ(valueAt(part, world), value) << x << " " << y << " " << z;
        inside += value ? 1 : 0;
      }
    }
  }
  return inside;
}
}

TEST(ReferencePart, HasWhatItsBoxReads)
{
  Carrier carrier;
  for (const double halo : { 0.0, HaloMm })
  {
    const ReferenceVolume part = carrier.cut(Part, halo);
    EXPECT_LT(part.grid.count(), 0.7 * carrier.whole().grid.count()) << halo;
    EXPECT_LT(part.cavity.grid.count(), 0.95 * carrier.whole().cavity.grid.count()) << halo;
    EXPECT_GT(expectSame(part, carrier.whole(), Part), 5000);
    EXPECT_GT(expectSame(part.cavity, carrier.whole().cavity, Part), 5000);
    EXPECT_EQ(part.show, ReferenceShow::Reference);
    carrier.move({ 0.0, 0.0, 0.0 });
  }
}

TEST(ReferencePart, KnowsTheWhole)
{
  Carrier carrier;
  EXPECT_FALSE(readReference(vtkSmartPointer<vtkImageData>::New()).whole);
  // A corner lacks the least or the greatest value.
  const ReferenceVolume part = carrier.cut({ -40.0, -22.0, -40.0, -16.0, -40.0, -10.0 }, 0.0);
  EXPECT_LT(part.grid.count(), Numbers / 10);
  const WholeReference whole = wholeOf(part);
  EXPECT_EQ(whole.points, Sides);
  EXPECT_EQ(whole.range, glm::dvec2(0.0, Numbers - 1));
  const glm::dvec3 first = carrier.whole().grid.worldFromGrid(whole.first);
  EXPECT_LT(glm::distance(first, part.grid.origin), 1e-9);
  carrier.move({ 0.0, 0.0, 0.0 });
  const ReferenceVolume all = carrier.cut({ -400.0, 400.0, -400.0, 400.0, -400.0, 400.0 });
  EXPECT_EQ(all.voxels, carrier.whole().voxels) << "all of it is not copied";
  EXPECT_EQ(wholeOf(all).points, Sides);
  EXPECT_EQ(wholeOf(all).first, glm::ivec3(0));
}

TEST(ReferencePart, WhatAFileSaysOfTheWholeMayBeWrong)
{
  Carrier carrier;
  const vtkSmartPointer<vtkImageData> volume = vtkSmartPointer<vtkImageData>::New();
  ReferenceVolume reference = carrier.whole();
  reference.whole = WholeReference{ Sides, { 0, 0, 0 }, { 0.0, 1.0 } };
  attachReference(volume, reference);
  EXPECT_TRUE(readReference(volume).whole);
  vtkDataArray* numbers = volume->GetFieldData()->GetArray("ReferenceWhole");
  for (const double wrong : { std::nan(""), -1.0, 2.5, 1e12 })
  {
    numbers->SetComponent(2, 0, wrong);
    EXPECT_FALSE(readReference(volume).whole) << wrong;
  }
}

TEST(ReferencePart, KeepsItsArraysWhileTheyHaveWhatIsNeeded)
{
  Carrier carrier;
  const ReferenceVolume first = carrier.cut(Part);
  const vtkSmartPointer<vtkDataArray> ofFirst = first.voxels; // no other array gets its address
  carrier.move({ 0.5, -1.0, 0.7 });
  const ReferenceVolume near = carrier.cut(Part);
  EXPECT_EQ(near.voxels, first.voxels);
  EXPECT_EQ(near.cavity.voxels, first.cavity.voxels);
  EXPECT_NE(near.grid.origin, first.grid.origin);
  EXPECT_GT(expectSame(near, carrier.whole(), Part), 5000);
  carrier.move({ 9.0, 7.0, -8.0 });
  const ReferenceVolume far = carrier.cut(Part);
  const vtkSmartPointer<vtkDataArray> ofFar = far.voxels;
  EXPECT_NE(ofFar, ofFirst);
  expectSame(far, carrier.whole(), Part);
  carrier.touch();
  carrier.move({ 9.0, 7.0, -8.0 });
  EXPECT_NE(carrier.cut(Part).voxels, ofFar) << "its numbers changed";
}
