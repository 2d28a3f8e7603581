// SPDX-License-Identifier: BSD-3-Clause
// Proves that a default in the XML is the class's own: it is written twice but lives once.
#include "Formats/Volumes/vtkVolumeFileReader.h"
#include "Testing/Cxx/Filters/TestDefaults.h"
#include "vtkBakeDeformation.h"
#include "vtkCompareVolumes.h"
#include "vtkDeformGeometry.h"
#include "vtkDeformationField.h"
#include "vtkDisplacementFieldReader.h"
#include "vtkDisplacementFieldWriter.h"
#include "vtkElectrodeGrids.h"
#include "vtkFitDeformation.h"
#include "vtkFreeFormDeformation.h"
#include "vtkLandmarkReader.h"
#include "vtkLandmarkWriter.h"
#include "vtkMoments.h"
#include "vtkOMEZarrWriter.h"
#include "vtkRefinedLattice.h"
#include "vtkRegistrationRun.h"
#include "vtkResection.h"
#include "vtkSurfaceReader.h"
#include "vtkTraceDistance.h"
#include "vtkTransformPoints.h"
#include "vtkTransformReader.h"
#include "vtkVolumeFileWriter.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace brainshift::testing;

TEST(Defaults, OfLatticesLiveInTheirBase)
{
  vtkNew<vtkRefinedLattice> lattice;
  const int* sides = lattice->GetLatticeDimensions();
  const Defaults expected{
    { "Feather", { lattice->GetFeather() } },
    { "Kernel", { double(lattice->GetKernel()) } },
    { "LatticeDimensions", { double(sides[0]), double(sides[1]), double(sides[2]) } },
    { "MaskGrowth", { lattice->GetMaskGrowth() } },
    { "Samples", { double(lattice->GetSamples()) } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/LatticeSettings.xml"), expected);
  const Defaults ofRefined{ { "LatticeDimensions", expected.at("LatticeDimensions") } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/RefinedLattice.xml"), ofRefined);
}

TEST(Defaults, OfFreeFormDeformationLiveInTheClass)
{
  vtkNew<vtkFreeFormDeformation> filter;
  const double* interest = filter->GetPointOfInterest();
  const Defaults expected{
    { "GuardFolding", { double(filter->GetGuardFolding()) } },
    { "Inverse", { double(filter->GetInverse()) } },
    { "PointOfInterest", { interest[0], interest[1], interest[2] } },
    { "Strength", { filter->GetStrength() } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/FreeFormDeformation.xml"), expected);
}

TEST(Defaults, OfCompareVolumesLiveInTheClass)
{
  vtkNew<vtkCompareVolumes> filter;
  const double* turn = filter->GetReferenceRotation();
  const double* move = filter->GetReferenceTranslation();
  const Defaults expected{ { "ReferenceRotation", { turn[0], turn[1], turn[2] } },
    { "ReferenceTranslation", { move[0], move[1], move[2] } },
    { "Show", { double(filter->GetShow()) } } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/CompareVolumes.xml"), expected);
}

TEST(Defaults, OfBakeDeformationLiveInTheClass)
{
  vtkNew<vtkBakeDeformation> filter;
  const Defaults expected{ { "Interpolation", { double(filter->GetInterpolation()) } },
    { "MemoryLimit", { filter->GetMemoryLimit() } } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/BakeDeformation.xml"), expected);
}

TEST(Defaults, OfDeformGeometryLiveInTheClass)
{
  vtkNew<vtkDeformGeometry> filter;
  const Defaults expected{ { "Direction", { double(filter->GetDirection()) } } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/DeformGeometry.xml"), expected);
}

TEST(Defaults, OfDeformationFieldLiveInTheClass)
{
  vtkNew<vtkDeformationField> filter;
  const int* sides = filter->GetDimensions();
  const double* spacing = filter->GetSpacing();
  const Defaults expected{
    { "Dimensions", { double(sides[0]), double(sides[1]), double(sides[2]) } },
    { "Direction", { double(filter->GetDirection()) } },
    { "SampleGrid", { double(filter->GetSampleGrid()) } },
    { "Spacing", { spacing[0], spacing[1], spacing[2] } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/DeformationField.xml"), expected);
}

TEST(Defaults, OfTraceDistanceLiveInTheClass)
{
  vtkNew<vtkTraceDistance> filter;
  const Defaults expected{
    { "Label", { double(filter->GetLabel()) } },
    { "SurfaceBy", { double(filter->GetSurfaceBy()) } },
    { "Threshold", { filter->GetThreshold() } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/TraceDistance.xml"), expected);
}

TEST(Defaults, OfDICOMReaderLiveInTheClass)
{
  vtkNew<vtkVolumeFileReader> reader;
  EXPECT_STREQ(reader->GetChoice(), "");
  const Defaults expected{ { "Format", {} }, // the text "DICOM"
    { "ResampleSlices", { double(reader->GetResampleSlices()) } },
    { "Luminance", { double(reader->GetLuminance()) } } };
  EXPECT_EQ(defaultsIn("Formats/DICOM/DICOMVolumeReader.xml"), expected);
}

TEST(Defaults, OfNRRDReaderLiveInTheClass)
{
  vtkNew<vtkVolumeFileReader> reader;
  const double* rows = reader->GetWorldFromFile();
  const Defaults expected{ { "Format", {} }, // the text "NRRD"
    { "WorldFromFile", std::vector<double>(rows, rows + 16) } };
  EXPECT_EQ(defaultsIn("Formats/TextHeaders/NRRDVolumeReader.xml"), expected);
}

TEST(Defaults, OfOMEZarrReaderLiveInTheClass)
{
  vtkNew<vtkVolumeFileReader> reader;
  EXPECT_STREQ(reader->GetArrayName(), "");
  const Defaults expected{ { "Channel", { double(reader->GetChannel()) } },
    { "Format", {} }, // the text "OMEZarr"
    { "Level", { double(reader->GetLevel()) } }, { "MemoryLimit", { reader->GetMemoryLimit() } } };
  EXPECT_EQ(defaultsIn("Formats/OMEZarr/OMEZarrReader.xml"), expected);
}

TEST(Defaults, OfElectrodeGridsLiveInTheClass)
{
  vtkNew<vtkElectrodeGrids> filter;
  const double* centre = filter->GetOpeningCentre();
  const Defaults expected{
    { "ContactDeviation", { filter->GetContactDeviation() } },
    { "Label", { double(filter->GetLabel()) } },
    { "OpeningCentre", { centre[0], centre[1], centre[2] } },
    { "OpeningRadius", { filter->GetOpeningRadius() } },
    { "ShowMissing", { double(filter->GetShowMissing()) } },
    { "PointAxes", { double(filter->GetPointAxes()) } },
    { "Stiffness", { filter->GetStiffness() } },
    { "SurfaceBy", { double(filter->GetSurfaceBy()) } },
    { "Threshold", { filter->GetThreshold() } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/ElectrodeGrids.xml"), expected);
}

TEST(Defaults, OfResectionLiveInTheClass)
{
  vtkNew<vtkResection> filter;
  const Defaults expected{ { "RemoveTissue", { double(filter->GetRemoveTissue()) } } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/Resection.xml"), expected);
}

TEST(Defaults, OfMomentsLiveInTheClass)
{
  vtkNew<vtkMoments> filter;
  const Defaults expected{ { "Interpolate", { double(filter->GetInterpolate()) } } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/Moments.xml"), expected);
}

TEST(Defaults, OfFitDeformationLiveInTheClass)
{
  vtkNew<vtkFitDeformation> filter;
  const double* centre = filter->GetOpeningCentre();
  const Defaults expected{
    { "Anchors", { double(filter->GetAnchors()) } },
    { "Evidence", { double(filter->GetEvidence()) } },
    { "GuardFolding", { double(filter->GetGuardFolding()) } },
    { "Label", { double(filter->GetLabel()) } },
    { "Live", { double(filter->GetLive()) } },
    { "OpeningCentre", { centre[0], centre[1], centre[2] } },
    { "OpeningRadius", { filter->GetOpeningRadius() } },
    { "PointAxes", { double(filter->GetPointAxes()) } },
    { "PairByOrder", { double(filter->GetPairByOrder()) } },
    { "SurfaceBy", { double(filter->GetSurfaceBy()) } },
    { "Threshold", { filter->GetThreshold() } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/FitDeformation.xml"), expected);
}

TEST(Defaults, OfRegistrationLiveInTheClass)
{
  vtkNew<vtkRegistrationRun> run;
  const double* rotation = run->GetStartRotation();
  const double* translation = run->GetStartTranslation();
  const Defaults ofRun{
    { "KeepFailed", { double(run->GetKeepFailed()) } },
    { "Similarity", { double(run->GetSimilarity()) } },
    { "StartRotation", { rotation[0], rotation[1], rotation[2] } },
    { "StartTranslation", { translation[0], translation[1], translation[2] } },
    { "Starts", { double(run->GetStarts()) } },
    { "Stiffness", { run->GetStiffness() } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/RegistrationRun.xml"), ofRun);
}

TEST(RegistrationRun, TakesTheNearestNumberOfStarts)
{
  vtkNew<vtkRegistrationRun> run;
  for (const int number : { -1, 0, 1, 8, 64, 65 })
  {
    run->SetStarts(number);
    EXPECT_EQ(run->GetStarts(), std::clamp(number, 1, 64));
  }
}

// Scripts set a similarity by its number.
TEST(RegistrationRun, TakesTheNearestSimilarity)
{
  vtkNew<vtkRegistrationRun> run;
  const std::string names = run->GetSimilarityNames();
  EXPECT_EQ(names.rfind("auto\nsame contrast\nultrasound", 0), 0u) << names;
  const auto last = static_cast<int>(std::count(names.begin(), names.end(), '\n'));
  for (const int number : { -1, 0, 2, last, last + 1 })
  {
    run->SetSimilarity(number);
    EXPECT_EQ(run->GetSimilarity(), std::clamp(number, 0, last));
  }
}

TEST(Defaults, OfDisplacementFieldFilesLiveInTheClasses)
{
  vtkNew<vtkDisplacementFieldReader> reader;
  const Defaults ofReader{
    { "Direction", { double(reader->GetDirection()) } },
    { "World", { double(reader->GetWorld()) } },
  };
  EXPECT_EQ(defaultsIn("Formats/Fields/DisplacementFieldReader.xml"), ofReader);
  vtkNew<vtkDisplacementFieldWriter> writer;
  const Defaults ofWriter{ { "World", { double(writer->GetWorld()) } } };
  EXPECT_EQ(defaultsIn("Formats/Writers/DisplacementFieldWriter.xml"), ofWriter);
}

TEST(Defaults, OfLandmarkFilesLiveInTheClasses)
{
  vtkNew<vtkLandmarkReader> reader;
  const Defaults ofReader{
    { "TableAxes", { double(reader->GetTableAxes()) } },
    { "Volume", { double(reader->GetVolume()) } },
  };
  EXPECT_EQ(defaultsIn("Formats/Landmarks/LandmarkReader.xml"), ofReader);
  vtkNew<vtkLandmarkWriter> writer;
  const Defaults ofWriter{ { "FileAxes", { double(writer->GetFileAxes()) } } };
  EXPECT_EQ(defaultsIn("Formats/Landmarks/LandmarkWriter.xml"), ofWriter);
}

TEST(Defaults, OfSurfaceFilesLiveInTheClasses)
{
  vtkNew<vtkSurfaceReader> surface;
  const double* center = surface->GetVolumeCenter();
  const Defaults ofSurface{ { "VolumeCenter", { center[0], center[1], center[2] } } };
  EXPECT_EQ(defaultsIn("Formats/Surfaces/SurfaceReader.xml"), ofSurface);
  EXPECT_EQ(defaultsIn("Formats/Surfaces/TractReader.xml"), Defaults());
  EXPECT_EQ(defaultsIn("Formats/Surfaces/TractWriter.xml"), Defaults());
}

TEST(Defaults, OfVolumeFilesLiveInTheClass)
{
  vtkNew<vtkVolumeFileWriter> writer;
  const Defaults ofSeries{ { "World", { double(writer->GetWorld()) } } };
  EXPECT_EQ(defaultsIn("Formats/Writers/MedicalSeriesWriter.xml"), ofSeries);
  const Defaults ofVolumes{ { "World", { double(writer->GetWorld()) } },
    { "MemoryLimit", { writer->GetMemoryLimit() } } };
  EXPECT_EQ(defaultsIn("Formats/Writers/MedicalVolumeWriter.xml"), ofVolumes);
  vtkNew<vtkOMEZarrWriter> pyramids;
  const Defaults ofPyramids{ { "World", { double(pyramids->GetWorld()) } },
    { "Version", { double(pyramids->GetVersion()) } },
    { "Labels", { double(pyramids->GetLabels()) } },
    { "MemoryLimit", { pyramids->GetMemoryLimit() } } };
  EXPECT_EQ(defaultsIn("Formats/OMEZarr/OMEZarrWriter.xml"), ofPyramids);
}

TEST(Defaults, OfTransformPointsLiveInTheClass)
{
  vtkNew<vtkTransformPoints> filter;
  const Defaults expected{ { "Direction", { double(filter->GetDirection()) } } };
  EXPECT_EQ(defaultsIn("Filters/Proxies/TransformPoints.xml"), expected);
}

TEST(Defaults, OfTransformReaderLiveInTheClass)
{
  vtkNew<vtkTransformReader> reader;
  const int* sides = reader->GetLatticeDimensions();
  const Defaults expected{
    { "Direction", { double(reader->GetDirection()) } },
    { "FieldsBetween", { double(reader->GetFieldsBetween()) } },
    { "Kernel", { double(reader->GetKernel()) } },
    { "LatticeDimensions", { double(sides[0]), double(sides[1]), double(sides[2]) } },
    { "MatrixProgram", { double(reader->GetMatrixProgram()) } },
    { "OutputDirection", { double(reader->GetOutputDirection()) } },
    { "World", { double(reader->GetWorld()) } },
  };
  EXPECT_EQ(defaultsIn("Filters/Proxies/TransformReader.xml"), expected);
}
