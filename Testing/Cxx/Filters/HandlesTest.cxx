// SPDX-License-Identifier: BSD-3-Clause
// Proves that exactly the control points are told that are drawn within a ball or a cone, moved or
// near a plane; also on a turned lattice, on a large one, and through the object a client asks.
#include "Filters/Deformation/Handles.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkFreeFormDeformation.h"
#include "vtkLatticeReport.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <vector>

using namespace brainshift;

namespace
{
// A turned lattice, bent about its middle, with its floats beside it.
struct Bent
{
  Lattice lattice;
  DrawnLattice drawn;

  explicit Bent(int side, double strength = 1.0)
  {
    Grid grid;
    grid.dimensions = glm::ivec3(side, side + 1, side + 2);
    grid.origin = { 5.0, -7.0, 11.0 };
    grid.spacing = { 2.0, 3.0, 2.5 };
    grid.direction = glm::dmat3(0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0);
    this->lattice = makeLattice(grid, 0);
    Stroke soft;
    soft.tool = Tool::Soft;
    soft.anchor = this->middle();
    soft.vector = { 4.0, -1.0, 2.0 };
    soft.major = 7.0;
    applyStroke(this->lattice, soft);
    this->drawn = { grid, &this->lattice.displacements[0].x, strength };
    this->drawn.farthest = longest(this->drawn);
  }

  glm::dvec3 middle() const
  {
    return this->lattice.grid.worldFromGrid(glm::dvec3(this->lattice.grid.dimensions - 1) / 2.0);
  }

  // The control points for which `wanted` holds of where they are drawn.
  template <typename Wanted>
  HandleSet all(Wanted wanted) const
  {
    HandleSet handles;
    for (std::size_t offset = 0; offset < this->lattice.grid.count(); ++offset)
    {
      const glm::ivec3 index = indexOf(this->lattice.grid, offset);
      const glm::dvec3 rest = this->lattice.grid.worldFromGrid(glm::dvec3(index));
      if (wanted(
            rest + this->drawn.strength * glm::dvec3(this->lattice.displacements[offset]), rest))
      {
        handles.insert(offset);
      }
    }
    return handles;
  }
};

TEST(Handles, InABallAreThoseDrawnThere)
{
  for (double strength : { 1.0, 0.5 })
  {
    const Bent bent(9, strength);
    // About where the middle went, so that some come in and others leave.
    const glm::dvec3 centre = bent.middle() + glm::dvec3(4.0, -1.0, 2.0);
    HandleSet found;
    addInBall(bent.drawn, centre, 6.0, Slab(), found);
    const HandleSet expected = bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
      return glm::distance(drawn, centre) <= 6;
    });
    EXPECT_EQ(found, expected);
    EXPECT_GT(found.size(), 20u);
  }
}

TEST(Handles, ABallBesideTheLatticeHasNone)
{
  const Bent bent(9);
  HandleSet found;
  addInBall(bent.drawn, bent.middle() + glm::dvec3(1000.0, 0.0, 0.0), 6.0, Slab(), found);
  addInBall(bent.drawn, bent.middle() - glm::dvec3(1000.0, 0.0, 0.0), 6.0, Slab(), found);
  EXPECT_TRUE(found.empty());
}

TEST(Handles, InAConeAreThoseInFrontOfTheEye)
{
  const Bent bent(9);
  const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 2.0, -1.0));
  const glm::dvec3 apex = bent.middle() - 4.0 * along;
  HandleSet found;
  addInCone(bent.drawn, apex, along, 1.0, 0.2, found);
  const HandleSet expected = bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
    const double depth = glm::dot(drawn - apex, along);
    return depth > 0.0 && glm::length(drawn - apex - depth * along) <= 1.0 + 0.2 * depth;
  });
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 5u);
}

TEST(Handles, MovedAreThoseThatLeftTheirPlace)
{
  const Bent bent(9);
  HandleSet found;
  const glm::dvec3 centre = bent.middle() + glm::dvec3(2.0, 1.0, 0.0);
  addMoved(bent.drawn, centre, 6.5, Slab(), found);
  const HandleSet expected = bent.all([&](const glm::dvec3& drawn, const glm::dvec3& rest) {
    return glm::distance(drawn, rest) >= 0.02 && glm::distance(drawn, centre) <= 6.5;
  });
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 20u);
  HandleSet all;
  addMoved(bent.drawn, centre, 1000.0, Slab(), all);
  EXPECT_GT(all.size(), found.size());
}

TEST(Handles, InASlabAreThoseDrawnNearThePlane)
{
  const Bent bent(9);
  const Slab slab{ bent.middle(), glm::normalize(glm::dvec3(1.0, -2.0, 0.5)), 1.5 };
  const auto inSlab = [&](const glm::dvec3& drawn) {
    return std::abs(glm::dot(drawn - slab.point, slab.normal)) <= slab.halfThickness;
  };
  HandleSet near;
  addInBall(bent.drawn, slab.point, 6.0, slab, near);
  EXPECT_EQ(near, bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
    return glm::distance(drawn, slab.point) <= 6.0 && inSlab(drawn);
  }));
  EXPECT_GT(near.size(), 8u);
  HandleSet moved;
  addMoved(bent.drawn, slab.point, 6.0, slab, moved);
  EXPECT_EQ(moved, bent.all([&](const glm::dvec3& drawn, const glm::dvec3& rest) {
    return glm::distance(drawn, rest) >= 0.02 && glm::distance(drawn, slab.point) <= 6.0 &&
      inSlab(drawn);
  }));
  EXPECT_GT(moved.size(), 8u);
}

TEST(Handles, OfTooManyTheNearestAreTold)
{
  const Bent bent(33);
  const glm::dvec3 centre = bent.middle();
  HandleSet found;
  addInBall(bent.drawn, centre, 1000.0, Slab(), found);
  ASSERT_EQ(found.size(), MostHandles);
  double farthest = 0.0;
  for (std::size_t offset : found)
  {
    const glm::dvec3 drawn = bent.drawn.deformed(indexOf(bent.lattice.grid, offset));
    farthest = std::max(farthest, glm::distance(drawn, centre));
  }
  const HandleSet nearer = bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
    return glm::distance(drawn, centre) < farthest;
  });
  EXPECT_LT(nearer.size(), MostHandles);
}

TEST(Handles, TheReportTellsWhatTheFilterAttached)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(10, 10, 10);
  image->SetSpacing(2.0, 2.0, 2.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  vtkNew<vtkFreeFormDeformation> filter;
  filter->SetInputData(image);
  filter->SetGuardFolding(false); // the stroke as it is
  filter->SetLatticeDimensions(4, 4, 4);
  const std::vector<double> move{ 0, 6, 6, 6, 1, 2, 3, 0, 0, 0, 0, 0, 0.5, 1 };
  for (double number : move)
  {
    filter->AddStrokeNumber(number);
  }
  vtkNew<vtkLatticeReport> report;
  EXPECT_EQ(report->GetGeometry()->GetNumberOfValues(), 0); // nothing to ask yet
  report->SetFilter(filter);
  report->SetBall(6.0, 6.0, 6.0, 0.0);
  report->SetMovedWithin(5.0);
  EXPECT_EQ(report->GetHandles()->GetNumberOfValues(), 0); // not executed yet
  filter->Update();
  vtkDoubleArray* handles = report->GetHandles();
  ASSERT_EQ(handles->GetNumberOfTuples(), 1);
  const std::vector<double> expected{ 1, 1, 1, 6, 6, 6, 7, 8, 9 };
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(handles->GetComponent(0, i), expected[i], 1e-5) << i;
  }
  const double beside[7] = { 0.0, 0.0, 12.5, 0.0, 0.0, 1.0, 3.0 };
  report->SetSlab(beside);
  EXPECT_EQ(report->GetHandles()->GetNumberOfTuples(), 0);
  vtkDoubleArray* geometry = report->GetGeometry();
  ASSERT_EQ(geometry->GetNumberOfValues(), 18);
  const std::vector<double> lattice{ 4, 4, 4, 0, 0, 0, 6, 6, 6, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  for (int i = 0; i < 18; ++i)
  {
    EXPECT_DOUBLE_EQ(geometry->GetValue(i), lattice[i]) << i;
  }
}
}
