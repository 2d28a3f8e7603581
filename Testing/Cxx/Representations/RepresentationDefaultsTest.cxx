// SPDX-License-Identifier: BSD-3-Clause
// Proves that the defaults in the XML of "Deformed Volume", "Deformed Slices" and "Trace Points"
// are those of the classes behind them.
#include "Testing/Cxx/Filters/TestDefaults.h"
#include "vtkDeformedSlicesMapper.h"
#include "vtkDeformedSlicesRepresentation.h"
#include "vtkDeformedVolumeMapper.h"
#include "vtkDeformedVolumeReport.h"
#include "vtkDeformedVolumeRepresentation.h"
#include "vtkTracePointsRepresentation.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

using namespace brainshift::testing;

TEST(Defaults, OfDeformedVolumeReportLiveInTheClass)
{
  vtkNew<vtkDeformedVolumeReport> report;
  const int* pixel = report->GetPixel();
  const double* place = report->GetPlace();
  const Defaults expected{ { "Pixel", { double(pixel[0]), double(pixel[1]) } },
    { "Place", { place[0], place[1], place[2] } }, { "ToRest", { double(report->GetToRest()) } } };
  EXPECT_EQ(defaultsIn("Representations/Proxies/DeformedVolumeReport.xml"), expected);
}

TEST(Defaults, OfDeformedSlicesLiveInTheMapper)
{
  vtkNew<vtkDeformedSlicesMapper> mapper;
  vtkNew<vtkDeformedSlicesRepresentation> representation;
  const double* position = mapper->GetSlicePosition();
  const double* wipe = mapper->GetWipePosition();
  const Defaults expected{ { "ShowSagittal", { double(mapper->GetShowSagittal()) } },
    { "ShowCoronal", { double(mapper->GetShowCoronal()) } },
    { "ShowAxial", { double(mapper->GetShowAxial()) } },
    { "SlicePosition", { position[0], position[1], position[2] } },
    { "ShowCrosshair", { double(mapper->GetCrosshair()) } },
    { "SliceInterpolation", { double(mapper->GetInterpolation()) } },
    { "MapSliceOpacity", { double(mapper->GetMapOpacity()) } },
    { "OrientationMarks", { double(representation->GetOrientationMarks()) } },
    { "WorldAxes", { double(representation->GetWorldAxes()) } },
    { "Opacity", { mapper->GetOpacity() } }, { "MemoryLimit", { mapper->GetMemoryLimit() } },
    { "SliceComparison", { double(mapper->GetComparison()) } },
    { "ComparisonColors", { double(mapper->GetComparisonColors()) } },
    { "CheckerSize", { mapper->GetCheckerSize() } },
    { "ReferenceRange", { mapper->GetReferenceRange()[0], mapper->GetReferenceRange()[1] } },
    { "FullGradient", { mapper->GetFullGradient() } },
    { "SimilarityWindow", { mapper->GetSimilarityWindow() } },
    { "WipePosition", { wipe[0], wipe[1], wipe[2] } } };
  EXPECT_EQ(defaultsIn("Representations/Proxies/DeformedSlices.xml"), expected);
}

TEST(Defaults, OfDeformedVolumeLiveInTheMapper)
{
  vtkNew<vtkDeformedVolumeRepresentation> representation;
  vtkNew<vtkDeformedVolumeMapper> mapper;
  const Defaults expected{ { "SampleDistance", { mapper->GetSampleDistance() } },
    { "EmptySpaceSkipping", { double(mapper->GetEmptySpaceSkipping()) } },
    { "AdaptiveQuality", { double(mapper->GetAdaptiveQuality()) } },
    { "AmbientOcclusion", { mapper->GetAmbientOcclusion() } },
    { "OcclusionRadius", { mapper->GetOcclusionRadius() } },
    { "KeepPicture", { double(mapper->GetKeepPicture()) } },
    { "CountSamples", { double(mapper->GetCountSamples()) } },
    { "MemoryLimit", { mapper->GetMemoryLimit() } },
    { "VolumeNormalTexture", { double(mapper->GetNormalTexture()) } },
    { "VolumeComparison", { double(mapper->GetComparison()) } },
    { "ComparisonColors", { double(mapper->GetComparisonColors()) } },
    { "AgreementDistance", { mapper->GetAgreementDistance() } },
    { "VolumeReferenceRange", { mapper->GetReferenceRange()[0], mapper->GetReferenceRange()[1] } },
    { "DrawSegment", { double(mapper->GetDrawSegment()) } } };
  EXPECT_EQ(defaultsIn("Representations/Proxies/DeformedVolume.xml"), expected);
  vtkNew<vtkDeformedSlicesMapper> slices;
  const Defaults ofEvidence{ { "ShowEvidence",
    { double(mapper->GetShowEvidence()), double(slices->GetShowEvidence()) } } };
  EXPECT_EQ(defaultsIn("Representations/Proxies/ShowEvidence.xml"), ofEvidence);
  const Defaults ofRanks{ { "RankHalo",
    { representation->GetRankHalo(), representation->GetRankHalo() } } };
  EXPECT_EQ(defaultsIn("Representations/Proxies/RankHalo.xml"), ofRanks);
}

TEST(Defaults, OfTracePointsLiveInTheClass)
{
  vtkNew<vtkTracePointsRepresentation> points;
  const Defaults expected{ { "GaussianRadius", { points->GetSplatSize() } },
    { "HiddenPoints", { double(points->GetHiddenPoints()) } },
    { "HiddenOpacity", { points->GetHiddenOpacity() } } };
  EXPECT_EQ(defaultsIn("Representations/Proxies/TracePoints.xml"), expected);
}
