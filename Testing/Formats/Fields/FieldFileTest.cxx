// SPDX-License-Identifier: BSD-3-Clause
// Proves that displacement fields keep their place, their vectors and their direction through every
// format, byte for byte as ITK, Slicer and NiftyReg mean them; and that damaged files are named.
#include "Formats/Fields/FieldFile.h"
#include "Common/FieldDirection.h"
#include "Common/Problem.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "Testing/Formats/NIFTI/NIFTITestFile.h"
#include "vtkDisplacementFieldReader.h"
#include "vtkDisplacementFieldWriter.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
std::string scratch(const std::string& name)
{
  return std::string(BRAINSHIFT_TEST_TEMP) + "/" + name;
}

DirectedField someField(Direction direction)
{
  DirectedField field;
  field.grid = obliqueGrid({ 4, 5, 6 });
  Random random(8);
  for (std::size_t i = 0; i < field.grid.count(); ++i)
  {
    field.displacements.emplace_back(random.between(glm::dvec3(-9), glm::dvec3(9)));
  }
  field.direction = direction;
  return field;
}

// Where a field leads a point (mm, RAS), trilinear: asked of both fields, whichever way their
// points are ordered in memory.
glm::dvec3 displacementAt(const DirectedField& field, const glm::dvec3& world)
{
  const glm::dvec3 at = glm::clamp(
    field.grid.gridFromWorld(world), glm::dvec3(0.0), glm::dvec3(field.grid.dimensions - 1));
  const glm::ivec3 low = glm::min(glm::ivec3(at), field.grid.dimensions - 2);
  const glm::dvec3 within = at - glm::dvec3(low);
  glm::dvec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weight = glm::mix(1.0 - within, within, glm::dvec3(side));
    const glm::ivec3 p = low + side;
    sum += weight.x * weight.y * weight.z *
      glm::dvec3(field.displacements[field.grid.offset(p.x, p.y, p.z)]);
  }
  return sum;
}

void expectSameField(const DirectedField& found, const DirectedField& expected, double tolerance)
{
  ASSERT_EQ(found.displacements.size(), expected.displacements.size());
  EXPECT_EQ(found.direction, expected.direction);
  Random random(4);
  for (int i = 0; i < 100; ++i)
  {
    const glm::dvec3 point = random.point(expected.grid, 0.0);
    EXPECT_LT(
      glm::length(displacementAt(found, point) - displacementAt(expected, point)), tolerance);
  }
}

std::string contentOf(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

template <typename T>
T numberIn(const std::string& bytes, std::size_t offset)
{
  T number;
  std::memcpy(&number, bytes.data() + offset, sizeof(T));
  return number;
}

// A file of 2 x 2 x 2 vectors; the first one is (1, 2, 3).
NIFTITestFile vectorFile()
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.dimensions = { 2, 2, 2, 1, 3 };
  file.dataType = NIFTIType<float>;
  return file;
}

std::string writeVectors(const char* name, int intent, const char* intentName, float p1)
{
  const NIFTITestFile file = vectorFile();
  std::vector<char> bytes = file.header();
  file.put(bytes, 68, static_cast<std::int16_t>(intent));
  file.put(bytes, 56, p1);
  std::copy_n(intentName, std::strlen(intentName), bytes.begin() + 328);
  for (int i = 0; i < 24; ++i) // component by component: x of all points, then y, then z
  {
    const int component = i / 8;
    const float value = i % 8 == 0 ? float(component + 1) : 0.0f;
    const char* raw = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), raw, raw + 4);
  }
  writePlain(scratch(name), bytes);
  return scratch(name);
}
}

class FieldFileFormat : public ::testing::TestWithParam<const char*>
{
};

TEST_P(FieldFileFormat, KeepsPlaceVectorsAndDirection)
{
  const std::string fileName = scratch(std::string("field") + GetParam());
  for (const Direction direction : { Direction::Forward, Direction::Backward })
  {
    const DirectedField field = someField(direction);
    ASSERT_EQ(problemOf([&] { writeFieldFile(fileName, field); }), "");
    EXPECT_TRUE(isFieldFile(fileName));
    DirectedField found;
    ASSERT_EQ(problemOf([&] { readFieldFile(fileName, found); }), "");
    // NIfTI places by float32: 705 mm from the origin to 0.00003 mm, times vectors' steepness.
    expectSameField(found, field, 1e-3);
  }
}

TEST_P(FieldFileFormat, ReaderAndWriterMeanTheSameWorld)
{
  const std::string fileName = scratch(std::string("world") + GetParam());
  const DirectedField field = someField(Direction::Backward);
  const auto image =
    fieldOn(field.grid, [&](const glm::dvec3& p) { return displacementAt(field, p); });
  vtkNew<vtkDisplacementFieldWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(fileName);
  writer->Write();
  vtkNew<vtkDisplacementFieldReader> reader;
  reader->SetFileName(fileName);
  EXPECT_EQ(vtkDisplacementFieldReader::CanReadFile(fileName.c_str()), 1);
  for (const int world : { vtkDisplacementFieldReader::RAS, vtkDisplacementFieldReader::LPS })
  {
    reader->SetWorld(world);
    reader->Update();
    DirectedField found{ gridOf(reader->GetOutput()), {}, directionOf(reader->GetOutput()) };
    vtkDataArray* vectors = reader->GetOutput()->GetPointData()->GetVectors();
    for (vtkIdType i = 0; i < vectors->GetNumberOfTuples(); ++i)
    {
      const double* v = vectors->GetTuple(i);
      found.displacements.emplace_back(v[0], v[1], v[2]);
    }
    if (world == vtkDisplacementFieldReader::LPS)
    {
      EXPECT_GT(glm::length(found.grid.origin - field.grid.origin), 100.0);
      reverseXY(found);
    }
    expectSameField(found, field, 1e-3);
  }
  reader->SetDirection(vtkDisplacementFieldReader::Forward);
  reader->Update();
  EXPECT_EQ(directionOf(reader->GetOutput()), Direction::Forward) << "the user knows better";
}

TEST_P(FieldFileFormat, TruncatedFilesAreNamed)
{
  const std::string fileName = scratch(std::string("short") + GetParam());
  ASSERT_EQ(problemOf([&] { writeFieldFile(fileName, someField(Direction::Backward)); }), "");
  const std::string whole = contentOf(fileName);
  std::ofstream(fileName, std::ios::binary) << whole.substr(0, whole.size() - 900);
  vtkNew<vtkDisplacementFieldReader> reader;
  reader->SetFileName(fileName);
  Errors errors(reader);
  reader->Update();
  EXPECT_NE(errors.take().find(fileName), std::string::npos);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

INSTANTIATE_TEST_SUITE_P(
  All, FieldFileFormat, ::testing::Values(".nii", ".nii.gz", ".mha", ".mhd", ".nrrd"));

TEST(FieldFile, NIFTISaysDisplacementAndDirection)
{
  ASSERT_EQ(
    problemOf([&] { writeFieldFile(scratch("said.nii"), someField(Direction::Forward)); }), "");
  const std::string bytes = contentOf(scratch("said.nii"));
  EXPECT_EQ(numberIn<std::int16_t>(bytes, 68), 1006);
  EXPECT_EQ(std::string(bytes.c_str() + 328), "forward");
  const std::int16_t dimensions[6] = { 5, 4, 5, 6, 1, 3 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(numberIn<std::int16_t>(bytes, 40 + 2 * i), dimensions[i]) << i;
  }
  EXPECT_GT(numberIn<std::int16_t>(bytes, 254), 0) << "sform_code";
}

TEST(FieldFile, TextHeadersSayDirectionAndLPS)
{
  DirectedField field = someField(Direction::Forward);
  field.grid.direction = glm::dmat3(1.0);
  field.displacements[0] = { 1.0f, 2.0f, 3.0f };
  ASSERT_EQ(problemOf([&] { writeFieldFile(scratch("said.nrrd"), field); }), "");
  const std::string nrrd = contentOf(scratch("said.nrrd"));
  for (const char* line : { "NRRD000", "\nspace: left-posterior-superior\n", "\nsizes: 3 4 5 6\n",
         "\nkinds: vector domain domain domain\n", "\nspace directions: none (-8,",
         "\nspace origin: (310,-42,705)\n", "\ndisplacement field type:=modeling\n" })
  {
    EXPECT_NE(nrrd.find(line), std::string::npos) << line;
  }
  const std::size_t numbers = nrrd.find("\n\n") + 2;
  EXPECT_EQ(nrrd.size() - numbers, 4u * 5 * 6 * 3 * 4);
  EXPECT_EQ(numberIn<float>(nrrd, numbers), -1.0f);
  EXPECT_EQ(numberIn<float>(nrrd, numbers + 4), -2.0f);
  EXPECT_EQ(numberIn<float>(nrrd, numbers + 8), 3.0f);
  ASSERT_EQ(problemOf([&] { writeFieldFile(scratch("said.mha"), field); }), "");
  const std::string meta = contentOf(scratch("said.mha"));
  for (const char* line : { "TransformMatrix = -1 ", "Offset = 310 -42 705\n", "forward\n",
         "ElementSpacing = 8 7 9.5\n", "ElementNumberOfChannels = 3\n" })
  {
    EXPECT_NE(meta.find(line), std::string::npos) << line;
  }
}

TEST(FieldFile, VectorsOfNIFTIFilesAreWhatTheirProgramsMean)
{
  DirectedField found;
  const auto firstOf = [&](const std::string& fileName) {
    EXPECT_EQ(problemOf([&] { readFieldFile(fileName, found); }), "");
    return found.displacements.at(0);
  };
  // DISPVECT is RAS; ITK's VECTOR is LPS; NiftyReg's is RAS.
  EXPECT_EQ(firstOf(writeVectors("dispvect.nii", 1006, "", 0)), glm::vec3(1, 2, 3));
  EXPECT_EQ(found.direction, std::nullopt);
  EXPECT_EQ(firstOf(writeVectors("vector.nii", 1007, "", 0)), glm::vec3(-1, -2, 3));
  EXPECT_EQ(firstOf(writeVectors("niftyreg1.nii", 1007, "NREG_TRANS", 1)), glm::vec3(1, 2, 3));
  EXPECT_EQ(found.direction, Direction::Backward);
  // Positions: point (1, 1, 1), the last one, is led to (0, 0, 0).
  firstOf(writeVectors("niftyreg0.nii", 1007, "NREG_TRANS", 0));
  EXPECT_EQ(found.displacements.at(0), glm::vec3(1, 2, 3));
  EXPECT_EQ(found.displacements.at(7), glm::vec3(-1, -1, -1));
  // SPM's are positions in RAS, too.
  firstOf(writeVectors("y_head.nii", 1007, "Mapping", 0));
  EXPECT_EQ(found.displacements.at(0), glm::vec3(1, 2, 3));
  EXPECT_EQ(found.displacements.at(7), glm::vec3(-1, -1, -1));
  EXPECT_EQ(found.direction, Direction::Backward);
  firstOf(writeVectors("said.nii", 1006, "Forward", 0));
  EXPECT_EQ(found.direction, Direction::Forward);
}

TEST(FieldFile, VectorsOfUnknownMeaningAreRefusedByName)
{
  DirectedField found;
  const auto said = [&](int intent, const char* name) {
    const std::string fileName = writeVectors("unknown.nii", intent, name, 0);
    EXPECT_TRUE(isFieldFile(fileName) || intent < 1006 || intent > 1007);
    return problemOf([&] { readFieldFile(fileName, found); });
  };
  EXPECT_NE(said(1007, "Velocity").find("intent_name \"Velocity\""), std::string::npos);
  EXPECT_NE(said(1007, "mapping").find("intent_name \"mapping\""), std::string::npos);
  EXPECT_NE(said(1006, "Mapping").find("intent_name \"Mapping\""), std::string::npos);
  EXPECT_NE(said(2006, "").find("2006 (FSL_FNIRT_DISPLACEMENT_FIELD)"), std::string::npos);
  EXPECT_NE(said(2016, "").find("2016 (FSL_TOPUP_CUBIC_SPLINE"), std::string::npos);
  EXPECT_NE(said(0, "").find("intent 0; a displacement field must have"), std::string::npos);
  std::string bytes = contentOf(writeVectors("metres.nii", 1006, "", 0));
  bytes[123] = 1;
  std::ofstream(scratch("metres.nii"), std::ios::binary) << bytes;
  EXPECT_NE(problemOf([&] { readFieldFile(scratch("metres.nii"), found); }).find("xyzt_units 1"),
    std::string::npos);
}

TEST(FieldFile, PackedAndForeignNumbersAreRead)
{
  // What ITK writes when asked to compress, and doubles of the other byte order.
  const DirectedField field = someField(Direction::Backward);
  const auto packed = [&](const char* name, const std::string& from, const std::string& to,
                        const std::string& end, int windowBits) {
    ASSERT_EQ(problemOf([&] { writeFieldFile(scratch(name), field); }), "");
    std::string bytes = contentOf(scratch(name));
    const std::size_t data = bytes.find(end) + end.size();
    std::string out(bytes.size() + 100, '\0');
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(&bytes[data]);
    stream.avail_in = static_cast<uInt>(bytes.size() - data);
    stream.next_out = reinterpret_cast<Bytef*>(&out[0]);
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    bytes.replace(data, std::string::npos, out);
    bytes.replace(bytes.find(from), from.size(), to);
    std::ofstream(scratch(name), std::ios::binary) << bytes;
    DirectedField found;
    EXPECT_EQ(problemOf([&] { readFieldFile(scratch(name), found); }), "");
    expectSameField(found, field, 1e-4);
    std::string broken = bytes;
    broken[broken.size() - 3] ^= 1; // in the checksum: the numbers are whole, and may be others
    std::ofstream(scratch(name), std::ios::binary) << broken;
    EXPECT_NE(problemOf([&] { readFieldFile(scratch(name), found); }).find("damaged or too few"),
      std::string::npos);
    std::ofstream(scratch(name), std::ios::binary) << bytes.substr(0, bytes.size() - 200);
    EXPECT_NE(problemOf([&] { readFieldFile(scratch(name), found); }).find("damaged or too few"),
      std::string::npos);
  };
  packed("packed.mha", "CompressedData = False", "CompressedData = True",
    "ElementDataFile = LOCAL\n", 15);
  packed("packed.nrrd", "encoding: raw", "encoding: gzip", "\n\n", 15 + 16);

  std::ofstream file(scratch("big.mhd"));
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = True\n"
          "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\n"
          "DimSize = 2 2 2\nElementNumberOfChannels = 3\nElementType = MET_DOUBLE\n"
          "ElementDataFile = big.raw\n";
  file.close();
  std::ofstream raw(scratch("big.raw"), std::ios::binary);
  for (int i = 0; i < 24; ++i)
  {
    const double value = i + 0.5;
    const char* bytes = reinterpret_cast<const char*>(&value);
    for (int b = 7; b >= 0; --b)
    {
      raw.put(bytes[b]);
    }
  }
  raw.close();
  DirectedField found;
  ASSERT_EQ(problemOf([&] { readFieldFile(scratch("big.mhd"), found); }), "");
  EXPECT_EQ(found.displacements[1], glm::vec3(-3.5f, -4.5f, 5.5f));
  EXPECT_EQ(found.direction, std::nullopt);
}

TEST(FieldFile, WhatIsNoFieldIsNamed)
{
  DirectedField found;
  const auto problemOf = [&](const std::string& fileName) {
    return brainshift::problemOf([&] { readFieldFile(fileName, found); });
  };
  const auto expectSays = [](const std::string& said, const char* words) {
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expectSays(
    problemOf(writeVectors("stat.nii", 5, "", 0)), "intent 5; a displacement field must have");
  EXPECT_FALSE(isFieldFile(scratch("stat.nii")));
  expectSays(problemOf(writeVectors("spline.nii", 1007, "NREG_TRANS", 2)),
    "NiftyReg transformation of type 2");
  writePlain(scratch("scalar.nii"), NIFTITestFile().bytes());
  expectSays(problemOf(scratch("scalar.nii")), "3 components");
  EXPECT_FALSE(isFieldFile(scratch("scalar.nii")));
  expectSays(problemOf(scratch("field.xyz")), "must be .nii");
  expectSays(problemOf(scratch("missing.mha")), "does not exist");
  EXPECT_FALSE(isFieldFile(scratch("missing.mha")));
  expectSays(brainshift::problemOf(
               [&] { writeFieldFile("/nowhere/field.mha", someField(Direction::Forward)); }),
    "/nowhere");
  expectSays(brainshift::problemOf(
               [&] { writeFieldFile("/nowhere/field.nii", someField(Direction::Forward)); }),
    "/nowhere");
  std::ofstream(scratch("wrong.nrrd"))
    << "NRRD0004\ntype: short\ndimension: 4\nsizes: 3 2 2 2\nencoding: raw\nendian: little\n"
       "space: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n";
  expectSays(problemOf(scratch("wrong.nrrd")), "type short; a field must have float or double");
  std::ofstream(scratch("wrong.mha"))
    << "DimSize = 2 2 2\nElementNumberOfChannels = 1\nElementType = MET_FLOAT\n"
       "ElementDataFile = LOCAL\n";
  expectSays(problemOf(scratch("wrong.mha")), "holds 1 components");
}
