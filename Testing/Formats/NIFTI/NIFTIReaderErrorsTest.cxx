// SPDX-License-Identifier: BSD-3-Clause
// Proves that the reader of NIfTI lets no damaged file through, says what is wrong with it, and
// works again with the next good one.
#include "Testing/Formats/NIFTI/NIFTITestFile.h"
#include "Testing/Formats/NIFTI/NIFTITestReading.h"

#include <vtkDemandDrivenPipeline.h>

#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#ifndef _WIN32
#include <sys/stat.h>
#endif

using namespace brainshift::testing;

namespace
{
void expectFailure(const std::string& fileName, const std::string& words)
{
  Reading reading(fileName);
  EXPECT_NE(reading.errors.find(words), std::string::npos) << reading.errors;
  EXPECT_EQ(reading.image()->GetNumberOfPoints(), 0);
}

void expectFailure(const std::vector<char>& bytes, const std::string& words)
{
  writePlain(temporary("bad.nii"), bytes);
  expectFailure(temporary("bad.nii"), words);
}
}

TEST(NIFTIReaderErrors, FilesThatAreNoNIFTI)
{
  expectFailure(temporary("missing.nii"), "does not exist");
  expectFailure("", "FileName is empty");
  expectFailure(BRAINSHIFT_TEST_TEMP, "is a folder");
  expectFailure(std::vector<char>{}, "has 0 readable bytes; a NIfTI header has 348");
  expectFailure(std::vector<char>(100, 'x'), "has 100 readable bytes");
  expectFailure(std::vector<char>(1000, 'x'), "is not NIfTI");
  NIFTITestFile analyze;
  analyze.magic = "";
  expectFailure(analyze.bytes(), "is not NIfTI");
  std::vector<char> cifti = NIFTITestFile().bytes();
  cifti[68] = static_cast<char>(3006 & 0xff); // intent_code of dense scalars
  cifti[69] = 3006 >> 8;
  expectFailure(cifti, "is a CIFTI file of values of surfaces and grey matter, and no volume");
}

TEST(NIFTIReaderErrors, TruncatedFiles)
{
  NIFTITestFile file;
  file.dimensions = { 20, 20, 20 };
  std::vector<char> bytes = file.bytes();
  bytes.pop_back();
  expectFailure(bytes, "bad.nii has 16351 bytes where the header announces 16352");
  writePacked(temporary("short.nii.gz"), bytes);
  expectFailure(temporary("short.nii.gz"), "truncated");

  writePacked(temporary("whole.nii.gz"), file.bytes());
  std::ifstream whole(temporary("whole.nii.gz"), std::ios::binary);
  std::vector<char> packed{ std::istreambuf_iterator<char>(whole), {} };
  packed.resize(packed.size() / 2);
  writePlain(temporary("cut.nii.gz"), packed);
  expectFailure(temporary("cut.nii.gz"), "truncated");

  NIFTITestFile pair;
  pair.magic = "ni1";
  pair.voxelOffset = 0.0;
  writePlain(temporary("cut.hdr"), pair.header());
  writePlain(temporary("cut.img"), std::vector<char>(20, 0));
  expectFailure(temporary("cut.hdr"), "cut.img has 20 bytes where the header announces 120");
  writePlain(temporary("lonely.hdr"), pair.header());
  expectFailure(temporary("lonely.hdr"), "lonely.img does not exist");
}

TEST(NIFTIReaderErrors, HeadersThatCannotBe)
{
  NIFTITestFile file;
  file.dataType = 1536; // 128-bit floats
  expectFailure(file.bytes(), "data type 1536");
  file = NIFTITestFile();
  file.voxelOffset = 0.0;
  expectFailure(file.bytes(), "byte 0 (vox_offset); the first possible byte is 352");
  file.voxelOffset = 350.0;
  expectFailure(file.bytes(), "byte 350 (vox_offset); the first possible byte is 352");
  file.voxelOffset = 352.5;
  expectFailure(file.bytes(), "has the vox_offset 352.5; it must be a whole number");
  for (const std::vector<int>& dimensions : { std::vector<int>{ 4, 0, 5 }, { 4, -3, 5 } })
  {
    file = NIFTITestFile();
    file.dimensions = dimensions;
    expectFailure(file.header(), "in dimension 2; it must have from 1 to 2147483647");
  }
  file.dimensions = { 1, 1, 1 };
  expectFailure(file.bytes(), "has 1 voxel");
  file.dimensions = {};
  expectFailure(file.header(), "has 0 dimensions");
  file.dimensions = { 2, 2, 2, 1, 1, 2 };
  expectFailure(file.bytes(), "has 2 entries in dimension 6");
  file.dimensions = { 32767, 32767, 32767, 32767 };
  expectFailure(file.header(), "bad.nii has 352 bytes where");
}

// A NIfTI-2 header may announce more steps than memory has room for their times.
TEST(NIFTIReaderErrors, TimeStepsHaveALimit)
{
  const NIFTITestFile file; // for put
  std::vector<char> bytes(544, 0);
  file.put<std::int32_t>(bytes, 0, 540);
  const char magic[8] = { 'n', '+', '2', 0, '\r', '\n', '\x1a', '\n' };
  std::copy(magic, magic + 8, bytes.begin() + 4);
  file.put<std::int16_t>(bytes, 12, NIFTIType<std::uint8_t>);
  file.put<std::int64_t>(bytes, 168, 544);
  const std::int64_t steps = 20000000;
  const std::int64_t dimensions[8] = { 4, 2, 2, 2, steps, 1, 1, 1 };
  for (int i = 0; i < 8; ++i)
  {
    file.put(bytes, 16 + 8 * i, dimensions[i]);
  }
  writePlain(temporary("steps.nii"), bytes);
  std::filesystem::resize_file(temporary("steps.nii"), 544 + 8 * steps); // takes no room
  expectFailure(
    temporary("steps.nii"), "has 20000000 entries in dimension 4; it must have from 1 to 65536");
  std::filesystem::remove(temporary("steps.nii"));
}

#ifndef _WIN32
// Opening a pipe waits until somebody writes into it.
TEST(NIFTIReaderErrors, PipesAreNoFiles)
{
  std::filesystem::remove(temporary("pipe.nii"));
  ASSERT_EQ(mkfifo(temporary("pipe.nii").c_str(), 0600), 0);
  NIFTI reader;
  EXPECT_EQ(reader->CanReadFile(temporary("pipe.nii").c_str()), 0);
  expectFailure(temporary("pipe.nii"), "is a pipe or a device");
  NIFTITestFile pair;
  pair.magic = "ni1";
  pair.voxelOffset = 0.0;
  writePlain(temporary("piped.hdr"), pair.header());
  std::filesystem::remove(temporary("piped.img"));
  ASSERT_EQ(mkfifo(temporary("piped.img").c_str(), 0600), 0);
  expectFailure(temporary("piped.hdr"), "piped.img is a pipe or a device");
}
#endif

TEST(NIFTIReaderErrors, AffinesThatCannotBe)
{
  glm::dmat4 sform(1.0);
  sform[2][1] = std::nan("");
  expectFailure(withSform(sform).bytes(), "row 1, column 2 of the affine is nan");
  sform[2] = glm::dvec4(0.0);
  expectFailure(withSform(sform).bytes(), "column 2 of the affine has length 0 mm");
  sform[2] = sform[0] + sform[1];
  expectFailure(withSform(sform).bytes(), "singular");
  sform = glm::dmat4(1.0);
  sform[1][1] = 1e30;
  expectFailure(withSform(sform).bytes(), "column 1 of the affine has length 1e+30 mm");
  sform = glm::dmat4(1.0);
  sform[3][0] = -3e16;
  expectFailure(withSform(sform).bytes(), "offset of the affine is 3e+16 mm; it must be at most");
  NIFTITestFile file;
  file.slope = 1.0;
  file.intercept = std::nan("");
  expectFailure(file.bytes(), "scl_inter");
}

// ParaView goes on to RequestData; its voxels must not be read into another one's grid.
TEST(NIFTIReaderErrors, ABadFileAfterAGoodOneGivesNoVoxels)
{
  writePlain(temporary("good.nii"), NIFTITestFile().bytes());
  glm::dmat4 sform(1.0);
  sform[3][0] = std::nan("");
  NIFTITestFile bad = withSform(sform);
  bad.dimensions = { 2, 2, 2 };
  writePlain(temporary("bad.nii"), bad.bytes());
  Reading reading(temporary("good.nii"));
  ASSERT_EQ(reading.errors, "");
  reading.reader->SetFileName(temporary("bad.nii").c_str());
  reading.reader->UpdateInformation();
  EXPECT_NE(reading.errors.find("column 3 of the affine is nan"), std::string::npos);
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(reading.reader->GetExecutive());
  pipeline->UpdateData(0);
  EXPECT_EQ(reading.image()->GetNumberOfPoints(), 0);
}

TEST(NIFTIReaderErrors, AGoodFileAfterABadOneLoads)
{
  writePlain(temporary("good.nii"), NIFTITestFile().bytes());
  Reading reading(temporary("missing.nii"));
  EXPECT_NE(reading.errors, "");
  reading.errors.clear();
  reading.reader->SetFileName(temporary("good.nii").c_str());
  reading.reader->Update();
  EXPECT_EQ(reading.errors, "");
  EXPECT_EQ(reading.image()->GetNumberOfPoints(), NIFTITestFile().count());
}

TEST(NIFTIReaderErrors, CanReadFileLooksInside)
{
  writePlain(temporary("can.nii"), NIFTITestFile().bytes());
  writePlain(temporary("cannot.nii"), std::vector<char>(1000, 'x'));
  NIFTI reader;
  EXPECT_EQ(reader->CanReadFile(temporary("can.nii").c_str()), 1);
  EXPECT_EQ(reader->CanReadFile(temporary("cannot.nii").c_str()), 0);
  EXPECT_EQ(reader->CanReadFile(temporary("missing.nii").c_str()), 0);
  EXPECT_EQ(reader->CanReadFile(nullptr), 0);
}

TEST(NIFTIReaderErrors, TheSameNameDoesNotModify)
{
  NIFTI reader;
  reader->SetFileName("a.nii");
  const vtkMTimeType before = reader->GetMTime();
  reader->SetFileName("a.nii");
  EXPECT_EQ(reader->GetMTime(), before);
  reader->SetFileName("b.nii");
  EXPECT_GT(reader->GetMTime(), before);
}
