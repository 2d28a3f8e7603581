// SPDX-License-Identifier: BSD-3-Clause
// Proves that the defaults of "Deformed Volume" in the XML are the mapper's own.
#include "TestDefaults.h"
#include "vtkDeformedVolumeMapper.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

using namespace brainshift::testing;

TEST(Defaults, OfDeformedVolumeLiveInTheMapper)
{
  vtkNew<vtkDeformedVolumeMapper> mapper;
  const Defaults expected{ { "SampleDistance", { mapper->GetSampleDistance() } },
    { "EmptySpaceSkipping", { double(mapper->GetEmptySpaceSkipping()) } },
    { "AdaptiveQuality", { double(mapper->GetAdaptiveQuality()) } },
    { "MemoryLimit", { mapper->GetMemoryLimit() } }, { "PickedPixel", { -1, -1 } },
    { "VolumeNormalTexture", { double(mapper->GetNormalTexture()) } } };
  EXPECT_EQ(defaultsIn("Representations/DeformedVolume.xml"), expected);
}
