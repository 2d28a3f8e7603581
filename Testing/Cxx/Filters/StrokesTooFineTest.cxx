// SPDX-License-Identifier: BSD-3-Clause
// Proves that a lattice that is too coarse for a stroke is told once for each change.
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <gtest/gtest.h>

#include <string>

using namespace brainshift;
using namespace brainshift::testing;

TEST(StrokesTooFine, IsToldOnceForEachChange)
{
  vtkNew<vtkFreeFormDeformation> filter;
  Errors heard(filter);
  auto volume =
    volumeOn(plainGrid(glm::ivec3(11), glm::dvec3(16.0)), VTK_SHORT, [](vtkIdType) { return 1.0; });
  filter->SetInputData(volume);
  Stroke stroke = strokeAt(Tool::Soft, glm::dvec3(80.0), { 1, 0, 0 });
  stroke.major = 12.0;
  const auto said = [&] {
    setStrokes(filter, { stroke });
    filter->Update();
    return heard.take();
  };
  EXPECT_EQ(said(), "");
  filter->SetLatticeDimensions(9, 9, 9);
  EXPECT_NE(said().find("stroke 1 (12 mm): its spacing is 20 mm"), std::string::npos);
  stroke.vector.y = 0.5;
  EXPECT_EQ(said(), "") << "told already";
  filter->SetLatticeDimensions(19, 19, 19);
  EXPECT_EQ(said(), "");
  filter->SetLatticeDimensions(9, 9, 9);
  EXPECT_NE(said(), "") << "a change again";
}
