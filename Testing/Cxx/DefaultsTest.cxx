// SPDX-License-Identifier: BSD-3-Clause
// Proves that a default in the XML is the class's own: it is written twice but lives once.
#include "TestDefaults.h"
#include "vtkBakeDeformation.h"
#include "vtkCompareVolumes.h"
#include "vtkFreeFormDeformation.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

using namespace brainshift::testing;

TEST(Defaults, OfFreeFormDeformationLiveInTheClass)
{
  vtkNew<vtkFreeFormDeformation> filter;
  const int* sides = filter->GetLatticeDimensions();
  const double* interest = filter->GetPointOfInterest();
  const Defaults expected{
    { "Feather", { filter->GetFeather() } },
    { "GuardFolding", { double(filter->GetGuardFolding()) } },
    { "Inverse", { double(filter->GetInverse()) } },
    { "Kernel", { double(filter->GetKernel()) } },
    { "LatticeDimensions", { double(sides[0]), double(sides[1]), double(sides[2]) } },
    { "PointOfInterest", { interest[0], interest[1], interest[2] } },
    { "Samples", { double(filter->GetSamples()) } },
    { "Strength", { filter->GetStrength() } },
  };
  EXPECT_EQ(defaultsIn("Filters/FreeFormDeformation.xml"), expected);
}

TEST(Defaults, OfCompareVolumesLiveInTheClass)
{
  vtkNew<vtkCompareVolumes> filter;
  const double* turn = filter->GetReferenceRotation();
  const double* move = filter->GetReferenceTranslation();
  const Defaults expected{ { "ReferenceRotation", { turn[0], turn[1], turn[2] } },
    { "ReferenceTranslation", { move[0], move[1], move[2] } } };
  EXPECT_EQ(defaultsIn("Filters/CompareVolumes.xml"), expected);
}

TEST(Defaults, OfBakeDeformationLiveInTheClass)
{
  vtkNew<vtkBakeDeformation> filter;
  const Defaults expected{ { "Interpolation", { double(filter->GetInterpolation()) } } };
  EXPECT_EQ(defaultsIn("Filters/BakeDeformation.xml"), expected);
}
