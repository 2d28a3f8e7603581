// SPDX-License-Identifier: BSD-3-Clause
// Proves that the defaults in the XML of "Deformed Volume" are those of the classes behind it.
#include "TestDefaults.h"
#include "vtkDeformedVolumeMapper.h"
#include "vtkDeformedVolumeReport.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

using namespace brainshift::testing;

TEST(Defaults, OfDeformedVolumeReportLiveInTheClass)
{
  vtkNew<vtkDeformedVolumeReport> report;
  const int* pixel = report->GetPixel();
  const Defaults expected{ { "Pixel", { double(pixel[0]), double(pixel[1]) } } };
  EXPECT_EQ(defaultsIn("Representations/DeformedVolumeReport.xml"), expected);
}

TEST(Defaults, OfDeformedVolumeLiveInTheMapper)
{
  vtkNew<vtkDeformedVolumeMapper> mapper;
  const Defaults expected{ { "SampleDistance", { mapper->GetSampleDistance() } },
    { "EmptySpaceSkipping", { double(mapper->GetEmptySpaceSkipping()) } },
    { "AdaptiveQuality", { double(mapper->GetAdaptiveQuality()) } },
    { "KeepPicture", { double(mapper->GetKeepPicture()) } },
    { "CountSamples", { double(mapper->GetCountSamples()) } },
    { "MemoryLimit", { mapper->GetMemoryLimit() } },
    { "VolumeNormalTexture", { double(mapper->GetNormalTexture()) } } };
  EXPECT_EQ(defaultsIn("Representations/DeformedVolume.xml"), expected);
}
