// SPDX-License-Identifier: BSD-3-Clause
// Proves that numbers of a NIfTI header that contradict each other, or are none, do not count
// without a word: times, scale, units, and the two places of a volume.
#include "Testing/Formats/NIFTI/NIFTITestFile.h"
#include "Testing/Formats/NIFTI/NIFTITestReading.h"

#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace brainshift::testing;

namespace
{
std::string said(const NIFTITestFile& file)
{
  writePlain(temporary("said.nii"), file.bytes());
  Reading reading(temporary("said.nii"));
  return reading.errors + reading.warnings;
}

void expectSays(const NIFTITestFile& file, const std::string& words)
{
  const std::string text = said(file);
  EXPECT_NE(text.find(words), std::string::npos) << words << " not in: " << text;
}

// Three volumes, their times and what was said of them.
void expectTimes(double step, int units, const std::vector<double>& times, const std::string& words)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.dimensions = { 4, 3, 5, 3 };
  file.pixelSize[3] = step;
  file.units = units;
  writePlain(temporary("times.nii"), file.bytes());
  Reading reading(temporary("times.nii"));
  EXPECT_EQ(reading.errors, "");
  EXPECT_EQ(reading.warnings.empty(), words.empty()) << reading.warnings;
  EXPECT_NE(reading.warnings.find(words), std::string::npos) << reading.warnings;
  vtkInformation* information = reading.reader->GetOutputInformation(0);
  ASSERT_EQ(information->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(
      information->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[i], times[i], 1e-9);
  }
}
}

TEST(NIFTISaid, TimesThatAreNone)
{
  expectTimes(2.5, 2 + 8, { 0.0, 2.5, 5.0 }, "");
  expectTimes(2500.0, 2 + 16, { 0.0, 2.5, 5.0 }, "");
  expectTimes(2500000.0, 2 + 24, { 0.0, 2.5, 5.0 }, "");
  expectTimes(2.5, 0, { 0.0, 2.5, 5.0 }, "");
  expectTimes(2500.0, 2, { 0.0, 2500.0, 5000.0 }, "names no unit of time (xyzt_units 2)");
  expectTimes(2.0, 2 + 32, { 0.0, 1.0, 2.0 }, "in Hz (xyzt_units 34), which is no time");
  expectTimes(2.0, 2 + 40, { 0.0, 1.0, 2.0 }, "in ppm (xyzt_units 42)");
  expectTimes(2.0, 2 + 48, { 0.0, 1.0, 2.0 }, "in rad/s (xyzt_units 50)");
  expectTimes(2.0, 2 + 56, { 0.0, 2.0, 4.0 }, "unit of time 56 NIfTI does not know");
  expectTimes(0.0, 2 + 8, { 0.0, 1.0, 2.0 }, "has the time step 0 (pixdim[4])");
  expectTimes(0.0, 2 + 16, { 0.0, 1.0, 2.0 }, "count as 1 s apart");
  expectTimes(-2.0, 2 + 8, { 0.0, 2.0, 4.0 }, "has the time step -2 (pixdim[4])");
  expectTimes(std::nan(""), 2 + 8, { 0.0, 1.0, 2.0 }, "has the time step nan");
}

TEST(NIFTISaid, ScaleAndUnits)
{
  const double infinite = std::numeric_limits<double>::infinity();
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  EXPECT_EQ(said(file), "");
  file.slope = infinite;
  expectSays(file, "has the scl_slope inf; it must be finite");
  file.slope = std::nan("");
  file.intercept = std::nan(""); // as nibabel writes them
  EXPECT_EQ(said(file), "");
  file.intercept = 7.0;
  expectSays(file, "has the scl_inter 7 but no scl_slope");
  file.slope = 1.0;
  file.intercept = infinite;
  expectSays(file, "has the scl_inter inf; it must be finite");
  file = withSform(glm::dmat4(1.0));
  file.units = 5 + 8;
  expectSays(file, "unit of length 5 NIfTI does not know");
  file.units = 2 + 8 + 64;
  expectSays(file, "has the xyzt_units 74, which is more than NIfTI knows");
}

// float32 holds 30000000 and 30000002, but not what is between them.
TEST(NIFTISaid, RescaledNumbersKeepTheirDigits)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.slope = 1.0;
  file.intercept = 30000000.0;
  const auto expectDigits = [&](const std::vector<char>& bytes) {
    writePlain(temporary("digits.nii"), bytes);
    Reading reading(temporary("digits.nii"));
    EXPECT_EQ(reading.errors + reading.warnings, "");
    EXPECT_EQ(reading.image()->GetScalarComponentAsDouble(0, 0, 0, 0), 30000001.0);
  };
  file.dataType = NIFTIType<std::int32_t>;
  expectDigits(file.bytes<std::int32_t>());
  file.dataType = NIFTIType<double>;
  expectDigits(file.bytes<double>());
}

TEST(NIFTISaid, VectorsInTheAxisOfTime)
{
  for (const int intent : { 1004, 1005, 1006, 1007, 2006, 2018 })
  {
    NIFTITestFile file = withSform(glm::dmat4(1.0));
    file.dimensions = { 4, 3, 5, 3 };
    file.pixelSize[3] = 1.0;
    std::vector<char> bytes = file.bytes();
    file.put<std::int16_t>(bytes, 68, static_cast<std::int16_t>(intent));
    writePlain(temporary("said.nii"), bytes);
    Reading reading(temporary("said.nii"));
    EXPECT_NE(reading.warnings.find("3 entries in dim[4], which count as times"), std::string::npos)
      << intent;
    file.dimensions = { 4, 3, 5, 1, 3 };
    bytes = file.bytes();
    file.put<std::int16_t>(bytes, 68, static_cast<std::int16_t>(intent));
    writePlain(temporary("said.nii"), bytes);
    EXPECT_EQ(Reading(temporary("said.nii")).warnings, "") << intent;
  }
}

TEST(NIFTISaid, TheTwoPlacesOfAVolume)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.qformCode = 1;
  EXPECT_EQ(said(file), "");
  file.qfac = -1.0;
  expectSays(file, "has a qform that mirrors the volume against its sform");
  file.qfac = 1.0;
  file.sform[0][0] = -1.0;
  expectSays(file, "mirrors");
  file.sform = glm::dmat4(0.0);
  file.qformOffset = glm::dvec3(-10.0, 20.0, 30.0);
  expectSays(file, "has the sform_code 1 but an sform of zeros; the qform counts");
  Reading reading(temporary("said.nii"));
  EXPECT_EQ(reading.errors, "");
  EXPECT_EQ(reading.image()->GetOrigin()[0], -10.0);
  file.qformCode = 0;
  expectSays(file, "column 0 of the affine has length 0 mm");
}

// A volume of 100 mm with a sform and a qform, in mm.
TEST(NIFTISaid, HowFarTheTwoPlacesAreFromEachOther)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.qformCode = 1;
  file.dimensions = { 101, 3, 5 };
  file.qformOffset = glm::dvec3(0.0, 0.4, 0.0); // less than half a voxel
  EXPECT_EQ(said(file), "");
  file.qformOffset = glm::dvec3(0.0, 3.0, 4.0);
  expectSays(file, "has a qform that places its corners up to 5 mm from where its sform does");
  expectSays(file, "the sform counts");
  file.qformOffset = glm::dvec3(0.0);
  file.quaternion = glm::dvec3(0.0, 0.0, std::sin(0.005)); // turned by 0.01 around z
  expectSays(file, "up to 1 mm");
  file.quaternion = glm::dvec3(0.0, 0.0, std::sin(0.0015)); // a corner is 0.3 mm away
  EXPECT_EQ(said(file), "");
  file.quaternion = glm::dvec3(0.0);
  file.pixelSize[0] = 1.1;
  expectSays(file, "up to 10 mm");
  file.units = 1 + 8; // metres
  expectSays(file, "up to 10000 mm");
}

// float32 loses up to 3e-4 of a quaternion's real part near half a turn.
TEST(NIFTISaid, RoundedQuaternionsAreNotTold)
{
  const double angle = 6e-4; // less than half a turn
  glm::dmat4 sform(0.1);
  sform[0] = glm::dvec4(-0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.0, 0.0);
  sform[1] = glm::dvec4(-0.1 * std::sin(angle), -0.1 * std::cos(angle), 0.0, 0.0);
  sform[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
  NIFTITestFile file = withSform(sform);
  file.qformCode = 1;
  file.dimensions = { 2000, 2, 2 };
  file.pixelSize = { 0.1, 0.1, 0.1, 0.0 };
  file.quaternion = glm::dvec3(0.0, 0.0, std::cos(0.5 * angle));
  EXPECT_EQ(said(file), "");
}

TEST(NIFTISaid, NumbersOfTheQformThatDoNotCount)
{
  NIFTITestFile file;
  file.qformCode = 1;
  EXPECT_EQ(said(file), "");
  file.pixelSize[1] = 0.0;
  expectSays(file, "has the pixdim[2] 0, which counts as 1");
  file.pixelSize[1] = -2.0;
  expectSays(file, "has the pixdim[2] -2, whose sign does not count");
  file.pixelSize[1] = 1.0;
  file.quaternion = glm::dvec3(2.0, 0.0, 0.0);
  expectSays(file, "of the length 2, which counts as one of the length 1");
  file.quaternion = glm::dvec3(0.0);
  file.qfac = -3.0;
  expectSays(file, "has the pixdim[0] -3, of which only the sign counts");
}
