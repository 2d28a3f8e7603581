// SPDX-License-Identifier: BSD-3-Clause
// Proves that tissue moves by what a base lattice has at the control points, whatever the kernel of
// either: a field is not taken for control points, and control points of one kernel not for those
// of the other.
#include "Filters/Fields/BaseLattice.h"

#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkInvertDisplacementField.h"
#include "vtkRefinedLattice.h"

#include <vtkFieldData.h>
#include <vtkIntArray.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const Grid Points = obliqueGrid({ 11, 12, 13 }); // control points
constexpr double PeakMm = 6.0;

// A bump of a deviation of 1.5 cells of the lattice.
glm::dvec3 bump(const glm::dvec3& world)
{
  const double away = glm::length(Points.gridFromWorld(world) - glm::dvec3(5.0, 6.0, 6.0));
  return glm::dvec3(0.6, 0.0, 0.8) * (PeakMm * std::exp(-away * away / (2.0 * 1.5 * 1.5)));
}

// The same box, with points in the middles of cells, too.
Grid finer(const Grid& grid)
{
  return withDimensions(grid, 2 * grid.dimensions - 1);
}

glm::dvec3 displacementAt(const Lattice& lattice, const glm::dvec3& world)
{
  return glm::dvec3(cubicDisplacement(lattice.grid.dimensions, lattice.kernel,
    lattice.displacements.data(), lattice.grid.gridFromWorld(world)));
}

// How far (mm) a lattice with this base is from what tissue should do, at most, at its own points.
double worstMiss(const Grid& grid, int kernel, vtkImageData* base,
  const std::function<glm::dvec3(const glm::dvec3&)>& expected)
{
  Lattice lattice = makeLattice(grid, kernel);
  addBase(lattice, base);
  double worst = 0.0;
  forEachIndex(glm::ivec3(0), grid.dimensions - 1, [&](const glm::ivec3& index) {
    const glm::dvec3 world = grid.worldFromGrid(glm::dvec3(index));
    worst = std::max(worst, glm::distance(displacementAt(lattice, world), expected(world)));
  });
  return worst;
}

vtkSmartPointer<vtkImageData> imageOf(const Lattice& lattice)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  setLattice(image, lattice);
  return image;
}

class BothKernels : public ::testing::TestWithParam<int>
{
};
}

TEST_P(BothKernels, TissueFollowsAField)
{
  EXPECT_LT(worstMiss(Points, GetParam(), fieldOn(finer(Points), bump), bump), 1e-4) << "mm";
  EXPECT_LT(worstMiss(Points, GetParam(), fieldOn(Points, bump), bump), 1e-4)
    << "mm: a field on the control points is a field, too";
}

TEST_P(BothKernels, TissueFollowsControlPointsOfEitherKernel)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    const Lattice base = randomLattice(Points, kernel, 5, 0.4);
    const auto expected = [&](const glm::dvec3& world) { return displacementAt(base, world); };
    for (const Grid& grid : { Points, finer(Points) })
    {
      EXPECT_LT(worstMiss(grid, GetParam(), imageOf(base), expected), 1e-3)
        << "mm, of kernel " << kernel << ", on " << grid.dimensions.x;
    }
  }
}

TEST_P(BothKernels, ItsOwnControlPointsStayToTheBit)
{
  const Lattice base = randomLattice(Points, GetParam(), 7, 0.4);
  for (const int named : { GetParam(), AnyKernel })
  {
    Lattice image = base;
    image.kernel = named;
    Lattice lattice = makeLattice(Points, GetParam());
    lattice.grid.origin.x *= 1.0 + 1e-14; // another piece's box
    addBase(lattice, imageOf(image));
    EXPECT_EQ(lattice.displacements, base.displacements);
  }
}

TEST_P(BothKernels, AFieldArrivesThroughTheFilter)
{
  vtkNew<vtkFreeFormDeformation> bend;
  bend->SetInputData(volumeOn(Points, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  bend->SetInputData(1, fieldOn(finer(Points), bump));
  bend->SetLatticeDimensions(11, 12, 13);
  bend->SetKernel(GetParam());
  bend->Update();
  const PointMap map(
    effectiveLattice(deformationOf(vtkImageData::SafeDownCast(bend->GetOutputDataObject(0)))));
  const glm::dvec3 top = Points.worldFromGrid({ 5.0, 6.0, 6.0 });
  EXPECT_NEAR(glm::distance(map.deformedFromRest(top), top), PeakMm, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
  BaseLattice, BothKernels, ::testing::Values(KernelCatmullRom, KernelBSpline));

// A refinement is stored without its kernel: it is made for the deformation that has it.
TEST(BaseLattice, ARefinementIsOfTheKernelThatTakesIt)
{
  const Lattice refined = randomLattice(Points, KernelBSpline, 11, 0.4);
  vtkNew<vtkRefinedLattice> hold;
  hold->SetInputData(volumeOn(Points, VTK_FLOAT, [](vtkIdType) { return 1.0; }));
  hold->SetLatticeDimensions(11, 12, 13);
  for (const glm::vec3& d : refined.displacements)
  {
    hold->AddControlPoint(d.x, d.y, d.z);
  }
  hold->Update();
  Lattice lattice = makeLattice(Points, KernelBSpline);
  addBase(lattice, vtkImageData::SafeDownCast(hold->GetOutputDataObject(0)));
  EXPECT_EQ(lattice.displacements, refined.displacements);
}

TEST(BaseLattice, TheInverseIsThatOfTissue)
{
  Lattice lattice = makeLattice(Points, KernelBSpline);
  addBase(lattice, fieldOn(Points, bump)); // its numbers are up to twice as large
  vtkNew<vtkInvertDisplacementField> invert;
  vtkNew<vtkInvertDisplacementField> expected;
  invert->SetInputData(imageOf(lattice));
  expected->SetInputData(fieldOn(Points, bump));
  invert->Update();
  expected->Update();
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(Points.count()); ++i)
  {
    double a[3];
    double b[3];
    invert->GetOutput()->GetPointData()->GetArray("Displacement")->GetTuple(i, a);
    expected->GetOutput()->GetPointData()->GetArray("Displacement")->GetTuple(i, b);
    ASSERT_LT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 1e-3) << "mm";
  }
}

TEST(BaseLattice, AKernelThatIsNoneIsNamed)
{
  auto image = imageOf(makeLattice(Points, KernelCatmullRom));
  vtkIntArray::SafeDownCast(image->GetFieldData()->GetArray("FFDKernel"))->SetValue(0, 7);
  Lattice lattice = makeLattice(Points, KernelCatmullRom);
  const std::string said = problemOf([&] { addBase(lattice, image); });
  EXPECT_NE(said.find("FFDKernel is 7; of control points it must be 0, 1 or -1"), std::string::npos)
    << said;
}
