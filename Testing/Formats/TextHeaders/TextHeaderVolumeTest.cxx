// SPDX-License-Identifier: BSD-3-Clause
// Proves that MetaImage and NRRD volumes are read in every type, byte order and encoding, from one
// file or many, with time and components, and that damaged headers are named.
#include "Common/WorldAxes.h"
#include "Testing/Formats/Volumes/VolumeFormatTesting.h"

#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <numeric>

using namespace brainshift::testing;

namespace
{

const std::string NRRDBegin = "NRRD0005\ndimension: 3\nsizes: 2 2 2\nspace: RAS\n"
                              "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n";
const std::string MetaBegin =
  "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = -1 0 0 0 -1 0 0 0 1\n"
  "Offset = 0 0 0\nElementSpacing = 1 1 1\n";

// The numbers 1 to `count`.
template <typename T = std::uint8_t>
std::string numbers(int count, bool big = false)
{
  std::string bytes;
  for (int i = 1; i <= count; ++i)
  {
    const auto number = static_cast<T>(i);
    std::string raw(sizeof(T), '\0');
    std::memcpy(&raw[0], &number, sizeof(T));
    const std::uint16_t one = 1;
    const bool machineIsBig = *reinterpret_cast<const char*>(&one) == 0;
    bytes += machineIsBig == big ? raw : std::string(raw.rbegin(), raw.rend());
  }
  return bytes;
}

std::vector<double> countedTo(int count)
{
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

template <typename Reader>
void expectCounted(const std::string& name, const std::string& bytes, int count = 8)
{
  writeFile(name, bytes);
  FormatReading<Reader> reading(name);
  EXPECT_EQ(reading.said(), "") << bytes.substr(0, 400);
  EXPECT_EQ(reading.values(), countedTo(count)) << bytes.substr(0, 400);
}

// A header and its numbers, which may hold any byte.
std::string joined(const std::vector<std::string>& parts)
{
  std::string whole;
  for (const std::string& part : parts)
  {
    whole += part;
  }
  return whole;
}

template <typename T>
void expectType(const std::string& nrrd, const std::string& meta)
{
  for (const bool big : { false, true })
  {
    expectCounted<NRRD>("type.nrrd",
      joined({ NRRDBegin, "type: ", nrrd, "\nencoding: raw\nendian: ", big ? "big" : "little",
        "\n\n", numbers<T>(8, big) }));
    expectCounted<Meta>("type.mha",
      joined({ MetaBegin, "DimSize = 2 2 2\nBinaryDataByteOrderMSB = ", big ? "True" : "False",
        "\nElementType = MET_", meta, "\nElementDataFile = LOCAL\n", numbers<T>(8, big) }));
  }
}

const std::string Bytes = "type: uchar\nencoding: raw\n"; // of one byte, so without an order
const std::string MetaBytes = "DimSize = 2 2 2\nElementType = MET_UCHAR\n";
}

TEST(TextHeaderVolume, AllTypesInBothByteOrders)
{
  expectType<std::int8_t>("signed char", "CHAR");
  expectType<std::uint8_t>("uint8", "UCHAR");
  expectType<std::int16_t>("short", "SHORT");
  expectType<std::uint16_t>("unsigned short int", "USHORT");
  expectType<std::int32_t>("int", "INT");
  expectType<std::int32_t>("int32_t", "LONG"); // 4 bytes in this format
  expectType<std::uint32_t>("uint32", "UINT");
  expectType<std::int64_t>("long long", "LONG_LONG");
  expectType<std::uint64_t>("uint64_t", "ULONG_LONG");
  expectType<float>("float", "FLOAT");
  expectType<double>("double", "DOUBLE_ARRAY");
}

TEST(TextHeaderVolume, NumbersAsText)
{
  expectCounted<NRRD>(
    "text.nrrd", NRRDBegin + "type: short\nencoding: ascii\n\n1 2, 3\n4\t5,6 +7\n8\n");
  std::string header = MetaBegin + MetaBytes;
  header.replace(header.find("True"), 4, "False");
  expectCounted<Meta>("text.mha", header + "ElementDataFile = LOCAL\n1 2 3 4 5 6 7 8");
  const std::string bytes = NRRDBegin + "type: uchar\nencoding: ascii\n\n";
  expectRefused<NRRD>("text.nrrd", bytes + "1 2 3 4 5 6 7 256", "has '256' where a number");
  expectRefused<NRRD>("text.nrrd", bytes + "1 2 3 4 5 6 7 x", "has 'x' where a number of its type");
  expectRefused<NRRD>("text.nrrd", bytes + "1 2 3 4 5 6 7         ",
    "has 7 numbers as text where the header announces 8");
  expectRefused<NRRD>("text.nrrd", bytes + "1 2 3", "where the header announces 15");
}

TEST(TextHeaderVolume, NumbersInOtherFiles)
{
  writeFile("half0.raw", numbers(4));
  writeFile("half1.raw", numbers(8).substr(4));
  writeFile("whole.raw", "xyz" + numbers(8));
  const std::string files = "VolumeFormats-";
  const std::string nhdr = NRRDBegin + Bytes;
  expectCounted<NRRD>("one.nhdr", nhdr + "byte skip: 3\ndata file: " + files + "whole.raw\n");
  expectCounted<NRRD>("end.nhdr", nhdr + "byte skip: -1\ndata file: ./" + files + "whole.raw\n");
  expectCounted<NRRD>(
    "list.nhdr", nhdr + "data file: LIST\n" + files + "half0.raw\n" + files + "half1.raw\n");
  expectCounted<NRRD>("pattern.nhdr", nhdr + "data file: " + files + "half%d.raw 0 1 1\n");
  writeFile("part008.raw", numbers(4)); // padded
  writeFile("part009.raw", numbers(8).substr(4));
  expectCounted<NRRD>("padded.nhdr", nhdr + "data file: " + files + "part%03d.raw 8 9 1\n");
  const std::string mhd = MetaBegin + MetaBytes;
  expectCounted<Meta>(
    "one.mhd", mhd + "HeaderSize = 3\nElementDataFile = " + files + "whole.raw\n");
  expectCounted<Meta>("end.mhd", mhd + "HeaderSize = -1\nElementDataFile = " + files + "whole.raw");
  expectCounted<Meta>(
    "list.mhd", mhd + "ElementDataFile = LIST\n" + files + "half0.raw\n" + files + "half1.raw\n");
  expectCounted<Meta>("pattern.mhd", mhd + "ElementDataFile = " + files + "half%01d.raw 0 1 1\n");
  expectRefused<NRRD>("missing.nhdr", nhdr + "data file: no.raw\n", "no.raw, which does not exist");
  expectRefused<NRRD>("many.nhdr", nhdr + "data file: a%d.raw 0 99999999 1\n",
    "names 100000000 data files; it may name 65536");
  expectRefused<NRRD>("uneven.nhdr", nhdr + "data file: a%d.raw 1 3 1\n", "3 files, which cannot");
  expectRefused<NRRD>("half.nhdr", nhdr + "data file: " + files + "half0.raw\n",
    "half0.raw, which has 4 bytes of numbers where the header announces 8");
  expectRefused<NRRD>("end.nrrd", nhdr + "byte skip: -1\n\n" + numbers(7),
    "has 7 bytes of numbers where the header announces 8"); // and not a byte of the header
  expectRefused<NRRD>("wrong.nhdr", nhdr + "data file: a%d.raw 0 x 1\n", "whole numbers: a%d.raw");
}

TEST(TextHeaderVolume, TimeBecomesSteps)
{
  const std::string begin = "NRRD0005\ndimension: 4\nspace: RAS\nspace origin: (0,0,0)\n" + Bytes;
  const std::string first = "sizes: 3 2 2 2\nkinds: time domain domain domain\n"
                            "space directions: none (1,0,0) (0,1,0) (0,0,1)\n\n";
  const std::string last = "sizes: 2 2 2 3\nkinds: domain domain domain list\n"
                           "space directions: (1,0,0) (0,1,0) (0,0,1) none\n\n";
  writeFile("first.nrrd", begin + first + numbers(24));
  writeFile("last.nrrd", begin + last + numbers(24));
  writeFile("last.mha",
    "NDims = 4\nBinaryData = True\nDimSize = 2 2 2 3\nElementSpacing = 1 1 1 1\n"
    "TransformMatrix = -1 0 0 0 0 -1 0 0 0 0 1 0 0 0 0 1\nOffset = 0 0 0 0\n"
    "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n" +
      numbers(24));
  const auto expectSteps = [](auto& reading, bool isFirst) {
    EXPECT_EQ(reading.said(), "");
    vtkInformation* output = reading.reader->GetOutputInformation(0);
    ASSERT_EQ(output->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
    for (int step = 0; step < 3; ++step)
    {
      reading.reader->UpdateTimeStep(step);
      ASSERT_EQ(reading.image()->GetNumberOfScalarComponents(), 1);
      const std::vector<double> values = reading.values();
      for (int i = 0; i < 8; ++i)
      {
        EXPECT_EQ(values.at(i), isFirst ? 3 * i + step + 1 : 8 * step + i + 1);
      }
    }
  };
  FormatReading<NRRD> byFirst("first.nrrd");
  expectSteps(byFirst, true);
  FormatReading<NRRD> byLast("last.nrrd");
  expectSteps(byLast, false);
  FormatReading<Meta> ofMeta("last.mha");
  expectSteps(ofMeta, false);
}

TEST(TextHeaderVolume, ColoursAreComponents)
{
  writeFile("colours.mha",
    MetaBegin + MetaBytes + "ElementNumberOfChannels = 3\n" + "ElementDataFile = LOCAL\n" +
      numbers(24));
  FormatReading<Meta> meta("colours.mha");
  EXPECT_EQ(meta.image()->GetNumberOfScalarComponents(), 3);
  EXPECT_EQ(meta.values(), countedTo(24));
  writeFile("colours.nrrd",
    "NRRD0005\ndimension: 4\nsizes: 3 2 2 2\nspace: RAS\n" + Bytes +
      "kinds: RGB-color domain domain domain\nspace origin: (0,0,0)\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\n\n" +
      numbers(24));
  FormatReading<NRRD> nrrd("colours.nrrd");
  EXPECT_EQ(nrrd.image()->GetNumberOfScalarComponents(), 3);
  EXPECT_EQ(nrrd.values(), countedTo(24));
}

// The kind of the last axis says whether its numbers belong to one voxel.
TEST(TextHeaderVolume, ComponentsMayBeTheLastAxis)
{
  const auto text = [](const std::string& kinds, const std::string& sizes = "2 2 2 3") {
    const bool hasFive = sizes.size() > 7;
    return "NRRD0005\ndimension: " + std::string(hasFive ? "5" : "4") + "\nsizes: " + sizes +
      "\nspace: RAS\n" + Bytes + "kinds: " + kinds + "\nspace origin: (0,0,0)\n" +
      "space directions: " + (hasFive ? "none " : "") + "(1,0,0) (0,1,0) (0,0,1) none\n\n" +
      numbers(hasFive ? 48 : 24);
  };
  for (const char* kind : { "vector", "RGB-color", "3-color", "3-vector", "covariant-vector" })
  {
    writeFile("last.nrrd", text(std::string("space space space ") + kind));
    FormatReading<NRRD> reading("last.nrrd");
    EXPECT_EQ(reading.said(), "") << kind;
    EXPECT_EQ(reading.reader->GetOutputInformation(0)->Length(
                vtkStreamingDemandDrivenPipeline::TIME_STEPS()),
      0);
    ASSERT_EQ(reading.image()->GetNumberOfScalarComponents(), 3) << kind;
    for (int i = 0; i < 24; ++i)
    {
      EXPECT_EQ(reading.values().at(i), 8 * (i % 3) + i / 3 + 1) << kind;
    }
  }
  expectRefused<NRRD>("both.nrrd", text("list space space space vector", "2 2 2 2 3"),
    "has the kinds list space space space vector: components of a voxel after the axes of space");
}

TEST(TextHeaderVolume, SidesAreKnownOnlyWhereTheFileSaysSo)
{
  using brainshift::WorldAxes;
  writeFile("sides.nrrd",
    "NRRD0005\ndimension: 3\nsizes: 2 2 2\nspacings: 1 2 3\n" + Bytes + "\n" + numbers(8));
  FormatReading<NRRD> bare("sides.nrrd");
  EXPECT_TRUE(isOnlyOfSides(bare.said()));
  EXPECT_EQ(brainshift::worldAxesOf(bare.image()), WorldAxes::Unknown);
  EXPECT_EQ(bare.image()->GetSpacing()[2], 3.0);
  EXPECT_EQ(bare.values(), countedTo(8));
  writeFile("sides.mha",
    "NDims = 3\nBinaryData = True\nElementSpacing = 1 2 3\n" + MetaBytes +
      "ElementDataFile = LOCAL\n" + numbers(8));
  FormatReading<Meta> noMatrix("sides.mha");
  EXPECT_EQ(brainshift::worldAxesOf(noMatrix.image()), WorldAxes::Unknown);
}

namespace
{
brainshift::WorldAxes axesOfMeta(const std::string& lines)
{
  writeFile("said.mha",
    "NDims = 3\nBinaryData = True\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n" + lines + MetaBytes +
      "ElementDataFile = LOCAL\n" + numbers(8));
  return brainshift::worldAxesOf(FormatReading<Meta>("said.mha").image());
}

brainshift::WorldAxes axesOfNRRD(const std::string& space)
{
  writeFile("said.nrrd",
    "NRRD0005\n" + space + "type: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n" +
      "space directions: (1,0,0) (0,1,0) (0,0,1)\n\n" + numbers(8));
  return brainshift::worldAxesOf(FormatReading<NRRD>("said.nrrd").image());
}
}

// Programs write a matrix for volumes whose sides they do not know: the rest of the header says so.
TEST(TextHeaderVolume, AFileMaySayThatSidesAreNotKnown)
{
  using brainshift::WorldAxes;
  EXPECT_EQ(axesOfMeta("AnatomicalOrientation = RAI\n"), WorldAxes::RAS);
  EXPECT_EQ(axesOfMeta("AnatomicalOrientation = ???\n"), WorldAxes::Unknown);
  EXPECT_EQ(axesOfMeta("Comment = sides of the patient not known\n"), WorldAxes::Unknown);
  EXPECT_EQ(axesOfMeta("Comment = a head\n"), WorldAxes::RAS);
  EXPECT_EQ(axesOfNRRD("space: LPS\n"), WorldAxes::RAS);
  EXPECT_EQ(axesOfNRRD("# sides of the patient not known\nspace: LPS\n"), WorldAxes::Unknown);
  EXPECT_EQ(axesOfNRRD("# a head\nspace: LPS\n"), WorldAxes::RAS);
  for (const char* space : { "", "space dimension: 3\n", "space: scanner-xyz\n",
         "space: 3D-right-handed\n", "space: 3D-left-handed\n" })
  {
    EXPECT_EQ(axesOfNRRD(space), WorldAxes::Unknown) << space;
  }
}

TEST(TextHeaderVolume, UnitsScaleAndSlopesRescale)
{
  expectRefused<NRRD>("units.nrrd",
    NRRDBegin + Bytes + "space units: \"cm\" \"um\" \"furlong\"\n\n" + numbers(8),
    "measures in the unit 'furlong'; BrainShift reads");
  expectRefused<NRRD>("units.nrrd", NRRDBegin + Bytes + "space units: um um um\n\n" + numbers(8),
    "has the space units um um um; it must have 3, in quotation marks");
  writeFile(
    "units.nrrd", NRRDBegin + Bytes + "space units: \"cm\" \"um\" \"pixel\"\n\n" + numbers(8));
  FormatReading<NRRD> units("units.nrrd");
  EXPECT_NE(units.said().find("unit 'pixel', which counts as mm"), std::string::npos);
  EXPECT_DOUBLE_EQ(units.image()->GetSpacing()[0], 10.0);
  EXPECT_DOUBLE_EQ(units.image()->GetSpacing()[1], 0.001);
  std::string placed = NRRDBegin + Bytes + "space units: \"cm\" \"um\" \"m\"\n\n" + numbers(8);
  placed.replace(placed.find("(0,0,0)"), 7, "(1.5,-200,0.003)");
  writeFile("placed.nrrd", placed);
  FormatReading<NRRD> origin("placed.nrrd");
  EXPECT_EQ(origin.said(), "");
  EXPECT_DOUBLE_EQ(origin.image()->GetOrigin()[0], 15.0);
  EXPECT_DOUBLE_EQ(origin.image()->GetOrigin()[1], -0.2);
  EXPECT_DOUBLE_EQ(origin.image()->GetOrigin()[2], 3.0);
  writeFile("spacings.nrrd", // without directions
    "NRRD0005\ndimension: 3\nsizes: 2 2 2\nspacings: 1 2 3\nunits: \"cm\" \"mm\" \"um\"\n" + Bytes +
      "\n" + numbers(8));
  FormatReading<NRRD> spacings("spacings.nrrd");
  EXPECT_DOUBLE_EQ(spacings.image()->GetSpacing()[0], 10.0);
  EXPECT_DOUBLE_EQ(spacings.image()->GetSpacing()[1], 2.0);
  EXPECT_DOUBLE_EQ(spacings.image()->GetSpacing()[2], 0.003);
  writeFile("slope.mha",
    MetaBegin + MetaBytes + "ElementToIntensityFunctionSlope = 0.5\n" +
      "ElementToIntensityFunctionOffset = -1\nElementDataFile = LOCAL\n" + numbers(8));
  FormatReading<Meta> slope("slope.mha");
  EXPECT_EQ(slope.image()->GetScalarType(), VTK_FLOAT);
  EXPECT_EQ(slope.values().at(7), 3.0);
}

TEST(TextHeaderVolume, TheMatrixCountsBeforeTheLetters)
{
  const auto saidOf = [](const std::string& letters) {
    writeFile("letters.mha",
      MetaBegin + MetaBytes + "AnatomicalOrientation = " + letters + "\nElementDataFile = LOCAL\n" +
        numbers(8));
    FormatReading<Meta> reading("letters.mha");
    EXPECT_EQ(reading.values(), countedTo(8)); // as the matrix says
    return reading.said();
  };
  EXPECT_EQ(saidOf("LPI"), ""); // from where the axes come
  EXPECT_EQ(saidOf("RAS"), ""); // where they lead
  EXPECT_TRUE(isOnlyOfSides(saidOf("???")));
  EXPECT_NE(saidOf("RAI").find("but its TransformMatrix means LPI"), std::string::npos);
}

TEST(TextHeaderVolume, HeadersThatCannotBe)
{
  const std::string end = Bytes + "\n" + numbers(8);
  const auto nrrd = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string header = NRRDBegin + end;
    header.replace(header.find(from), from.size(), to);
    expectRefused<NRRD>("bad.nrrd", header, words);
  };
  nrrd("NRRD0005", "NERD0005", "does not begin with NRRD");
  nrrd("sizes: 2 2 2", "sizes: 2 0 2", "has the sizes 2 0 2; it must have 3 to 5 whole numbers");
  nrrd("sizes: 2 2 2", "sizes: 99999 99999 99999",
    "has 8 bytes of numbers where the header announces");
  nrrd("sizes: 2 2 2", "sizes: 2 2", "has the dimension 3 but 2 sizes");
  nrrd("dimension: 3\nsizes: 2 2 2", "dimension: 3\nsizes: 1 1 1", "has 1 voxel");
  nrrd("uchar", "block", "has the type block; BrainShift reads");
  nrrd("raw", "bzip2", "has the encoding bzip2; it must be raw, gzip or ascii");
  nrrd("type: uchar", "type: short", "has the endian ''; it must be little or big");
  nrrd("space: RAS", "space: RSA", "is in the space RSA");
  nrrd("(0,1,0)", "(0,1,0", "has the space directions");
  nrrd("(0,1,0)", "none", "has 2 axes in space; a volume must have 3");
  nrrd("(0,1,0)", "(1,0,0)", "singular");
  nrrd("(0,1,0)", "(0,nan,0)", "cannot be placed");
  nrrd("(0,0,0)", "(0,0)", "has the space origin (0,0)");
  const std::string metaEnd = "ElementDataFile = LOCAL\n" + numbers(8);
  const auto meta = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string header = MetaBegin + MetaBytes + metaEnd;
    header.replace(header.find(from), from.size(), to);
    expectRefused<Meta>("bad.mha", header, words);
  };
  meta("NDims = 3", "NDims = 2", "has the NDims 2; it must be 3, or 4 with time");
  meta("DimSize = 2 2 2", "DimSize = 2 2 9999999999", "whole number from 1 to 2147483647");
  meta(
    "DimSize = 2 2 2", "DimSize = 2 2 3", "has 8 bytes of numbers where the header announces 12");
  meta("MET_UCHAR", "MET_STRING", "has the ElementType MET_STRING");
  meta("Offset = 0 0 0", "Offset = 0 0", "has the Offset 0 0; it must have 3 numbers (mm)");
  meta(
    "ElementSpacing = 1 1 1", "ElementSpacing = 1 1 0", "column 2 of the affine has length 0 mm");
  meta("ElementSpacing = 1 1 1", "HeaderSize = -3", "has the HeaderSize -3");
}

TEST(TextHeaderVolume, PackedNumbersMustBeWhole)
{
  std::string bytes = NRRDBegin + "type: uchar\nencoding: gzip\n\n";
  expectRefused<NRRD>("packed.nrrd", bytes + std::string("\x1f\x8b\x08\x00", 4) + "abcdefgh",
    "has packed numbers that are damaged or too few");
  bytes.replace(bytes.find("2 2 2"), 5, "2000 2000 2000");
  expectRefused<NRRD>("packed.nrrd", bytes + "abcdefgh",
    "has 8 packed bytes where the header announces 8000000000 bytes of numbers");
}

TEST(TextHeaderVolume, CanReadFileLeavesFieldsAndPicturesToOthers)
{
  NRRD nrrd;
  Meta meta;
  const auto canRead = [](auto& reader, const std::string& name, const std::string& bytes) {
    writeFile(name, bytes);
    return reader->CanReadFile(scratchFile(name).c_str());
  };
  EXPECT_EQ(canRead(nrrd, "can.nrrd", NRRDBegin + Bytes + "\n" + numbers(8)), 1);
  EXPECT_EQ(canRead(meta, "can.nrrd", NRRDBegin + Bytes + "\n" + numbers(8)), 0);
  EXPECT_EQ(canRead(meta, "can.mha", MetaBegin + MetaBytes + "ElementDataFile = LOCAL\n"), 1);
  EXPECT_EQ(canRead(nrrd, "can.mha", MetaBegin + MetaBytes + "ElementDataFile = LOCAL\n"), 0);
  EXPECT_EQ(canRead(meta, "flat.mha", "NDims = 2\nDimSize = 2 2\nElementDataFile = LOCAL\n"), 0);
  EXPECT_EQ(canRead(nrrd, "flat.nrrd", "NRRD0005\ndimension: 2\nsizes: 2 2\n" + Bytes), 0);
  EXPECT_EQ(canRead(meta, "field.mha",
              MetaBegin + "DimSize = 2 2 2\nElementType = MET_FLOAT\n" +
                "ElementNumberOfChannels = 3\nElementDataFile = LOCAL\n"),
    0);
  EXPECT_EQ(nrrd->CanReadFile(scratchFile("missing.nrrd").c_str()), 0);
  EXPECT_EQ(nrrd->CanReadFile(nullptr), 0);
}

TEST(TextHeaderVolume, AGoodFileAfterABadOneLoads)
{
  expectRefused<NRRD>("again.nrrd", "NRRD0005\n", "has the sizes");
  FormatReading<NRRD> reading("again.nrrd");
  writeFile("good.nrrd", NRRDBegin + Bytes + "\n" + numbers(8));
  reading.said();
  reading.reader->SetFileName(scratchFile("good.nrrd").c_str());
  reading.reader->Update();
  EXPECT_EQ(reading.said(), "");
  EXPECT_EQ(reading.values(), countedTo(8));
}

namespace
{
// The times of a file, s, and what was said of it.
std::vector<double> timesOf(const std::string& name, const std::string& bytes, std::string& said)
{
  writeFile(name, bytes);
  FormatReading<NRRD> reading(name);
  said = reading.said();
  vtkInformation* output = reading.reader->GetOutputInformation(0);
  const double* times = output->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  const int count = output->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  return { times, times + (times ? count : 0) };
}

// Three volumes along the last axis, with these lines.
std::vector<double> timesWith(const std::string& lines, std::string& said)
{
  return timesOf("series.nrrd",
    "NRRD0005\ndimension: 4\nspace: RAS\nsizes: 2 2 2 3\n" + Bytes +
      "space origin: (0,0,0)\nspace directions: (1,0,0) (0,1,0) (0,0,1) NONE\n" + lines + "\n" +
      numbers(24),
    said);
}
}

TEST(TextHeaderVolume, TimesOfAnAxisAreThoseOfTheFile)
{
  using Times = std::vector<double>;
  std::string said;
  const std::string kinds = "kinds: domain domain domain time\n";
  const std::string spacings = "spacings: nan NaN nan 2.5\n";
  EXPECT_EQ(
    timesWith(kinds + spacings + "units: \"\" \"\" \"\" \"s\"\n", said), (Times{ 0.0, 2.5, 5.0 }));
  EXPECT_EQ(said, "");
  EXPECT_EQ(timesWith(spacings, said), (Times{ 0.0, 2.5, 5.0 }));
  const auto inUnit = [&](const std::string& unit) {
    const Times times =
      timesWith(kinds + spacings + "units: \"\" \"\" \"\" \"" + unit + "\"\n", said);
    return times.at(2);
  };
  EXPECT_NEAR(inUnit("ms"), 0.005, 1e-12);
  EXPECT_NEAR(inUnit("\xce\xbcs"), 5e-6, 1e-12);
  EXPECT_NEAR(inUnit("\xc2\xb5s"), 5e-6, 1e-12);
  EXPECT_NEAR(inUnit("Seconds"), 5.0, 1e-12);
  EXPECT_NEAR(inUnit("min"), 300.0, 1e-9);
  EXPECT_EQ(said, "");
  EXPECT_EQ(inUnit("Hz"), 2.0);
  EXPECT_NE(said.find("in the unit 'Hz', which is none of time"), std::string::npos);
  EXPECT_EQ(timesWith(kinds + "spacings: nan nan nan -1\n", said), (Times{ 0.0, 1.0, 2.0 }));
  EXPECT_NE(said.find("has the time step -1"), std::string::npos);
  EXPECT_EQ(
    timesWith(kinds + spacings + "axis mins: nan nan nan 10\ncenters: ??? ??? ??? node\n", said),
    (Times{ 10.0, 12.5, 15.0 }));
}

TEST(TextHeaderVolume, TimesOfSlicersSequences)
{
  using Times = std::vector<double>;
  std::string said;
  const std::string index = "axis 3 index type:=numeric\naxis 3 index values:=";
  EXPECT_EQ(timesWith(index + "0 2.5 10\n", said), (Times{ 0.0, 2.5, 10.0 }));
  EXPECT_EQ(said, "");
  EXPECT_EQ(timesWith("units: \"\" \"\" \"\" \"ms\"\n" + index + "0 2.5 10\n", said).at(1), 0.0025);
  EXPECT_EQ(timesWith(index + "0 2.5\n", said), (Times{ 0.0, 1.0, 2.0 }));
  EXPECT_NE(said.find("index values of an axis of volumes that are not 3"), std::string::npos);
  EXPECT_EQ(timesWith(index + "0 2.5 1\n", said), (Times{ 0.0, 1.0, 2.0 }));
  EXPECT_NE(said.find("index values"), std::string::npos);
  EXPECT_EQ(timesOf("first.seq.nrrd",
              "NRRD0005\ndimension: 4\nspace: RAS\nsizes: 3 2 2 2\n" + Bytes +
                "space directions: none (1,0,0) (0,1,0) (0,0,1)\n"
                "kinds: list domain domain domain\nlabels: \"time\" \"\" \"\" \"\"\n"
                "axis 0 index type:=numeric\naxis 0 index values:=0 2.5 10\n\n" +
                numbers(24),
              said),
    (Times{ 0.0, 2.5, 10.0 }));
}

TEST(TextHeaderVolume, UnitsOfNRRDAreReadAsPeopleSpellThem)
{
  const auto spacingIn = [](const std::string& unit) {
    const std::string words = "\"" + unit + "\" ";
    writeFile("unit.nrrd",
      NRRDBegin + Bytes + "space units: " + words + words + words + "\n\n" + numbers(8));
    FormatReading<NRRD> reading("unit.nrrd");
    EXPECT_EQ(reading.said(), "") << unit;
    return reading.image()->GetSpacing()[0];
  };
  for (const char* unit :
    { "um", "\xc2\xb5m", "\xce\xbcm", "micron", "Microns", "micrometer", "micrometres" })
  {
    EXPECT_DOUBLE_EQ(spacingIn(unit), 0.001) << unit;
  }
  for (const char* unit : { "", "mm", "MM", "millimeters", "Millimetre" })
  {
    EXPECT_DOUBLE_EQ(spacingIn(unit), 1.0) << unit;
  }
  EXPECT_DOUBLE_EQ(spacingIn("inches"), 25.4);
  EXPECT_DOUBLE_EQ(spacingIn("in"), 25.4);
  EXPECT_DOUBLE_EQ(spacingIn("meters"), 1000.0);
  EXPECT_DOUBLE_EQ(spacingIn("centimetres"), 10.0);
}

TEST(TextHeaderVolume, WordsOfNRRDCountWithoutCase)
{
  writeFile("case.nrrd",
    "NRRD0005\nDimension: 3\nSizes: 2 2 2\nSPACE: Left-Posterior-Superior\nType: UChar\n"
    "Encoding: RAW\nSpace Directions: (1,0,0) (0,1,0) (0,0,1)\nKinds: Domain Space DOMAIN\n"
    "space origin: (5,0,0)\n\n" +
      numbers(8));
  FormatReading<NRRD> reading("case.nrrd");
  EXPECT_EQ(reading.said(), "");
  EXPECT_EQ(brainshift::worldAxesOf(reading.image()), brainshift::WorldAxes::RAS);
  EXPECT_EQ(reading.image()->GetOrigin()[0], -6.0);
}

TEST(TextHeaderVolume, ContradictionsAreRefusedByName)
{
  const std::string end = Bytes + "\n" + numbers(8);
  const auto nrrd = [&](const std::string& line, const std::string& words) {
    expectRefused<NRRD>("said.nrrd", NRRDBegin + line + "\n" + end, words);
  };
  nrrd("kinds: domain domain", "has the kinds domain domain; it must have 3, one for each axis");
  nrrd("spacings: 1 1", "has the spacings 1 1; it must have 3");
  nrrd("spacings: 1 x 1", "has the spacings 1 x 1; each must be a finite number or nan");
  nrrd("units: \"um\" \"um\" \"um\"", "has the units \"um\" for an axis with space directions");
  nrrd("space dimension: 2", "has the space dimension 2");
  nrrd("thickness: 1 1 1", "has the field 'thickness', which NRRD does not define");
  expectRefused<NRRD>("said.nrrd",
    "NRRD0005\ndimension: 3\nsizes: 2 2 2\nspace: RAS\n"
    "space origin: (0,0,0)\n" +
      end,
    "no space directions");
  const std::string data = "ElementDataFile = LOCAL\n" + numbers(8);
  const auto meta = [&](const std::string& line, const std::string& words) {
    expectRefused<Meta>("said.mha", MetaBegin + MetaBytes + line + "\n" + data, words);
  };
  meta("Position = 1 2 3", "has the Offset 0 0 0, but the Position 1 2 3, which means the same");
  meta("Rotation = 1 0 0 0 1 0 0 0 1", "but the Rotation 1 0 0");
  meta("DistanceUnits = furlong", "has the DistanceUnits furlong");
  meta("BinaryDataByteOrderMSB = False\nElementByteOrderMSB = True", "ElementByteOrderMSB");
  expectRefused<Meta>("said.mha", "ObjectType = Tube\nNDims = 3\n" + MetaBytes + data,
    "has the ObjectType Tube; it must be Image");
}

TEST(TextHeaderVolume, MetaImagesSayUnitsCentresAndTimes)
{
  const std::string data = "ElementDataFile = LOCAL\n" + numbers(8);
  writeFile("unit.mha", MetaBegin + MetaBytes + "DistanceUnits = um\n" + data);
  FormatReading<Meta> unit("unit.mha");
  EXPECT_EQ(unit.said(), "");
  EXPECT_DOUBLE_EQ(unit.image()->GetSpacing()[1], 0.001);
  writeFile("centre.mha", MetaBegin + MetaBytes + "CenterOfRotation = 1 2 3\n" + data);
  EXPECT_NE(FormatReading<Meta>("centre.mha").said().find("has the CenterOfRotation 1 2 3"),
    std::string::npos);
  const std::string times = "NDims = 4\nBinaryData = True\nDimSize = 2 2 2 3\n"
                            "ElementSpacing = 1 1 1 2.5\nOffset = 0 0 0 7\n" +
    std::string("TransformMatrix = -1 0 0 0 0 -1 0 0 0 0 1 0 0 0 0 1\n") +
    "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + numbers(24);
  writeFile("times.mha", times);
  FormatReading<Meta> series("times.mha");
  EXPECT_EQ(series.said(), "");
  EXPECT_EQ(
    series.reader->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[2],
    12.0);
  std::string leaning = times;
  leaning.replace(leaning.find("0 0 0 1\n"), 7, "0 0 1 1");
  expectRefused<Meta>("leaning.mha", leaning, "has a TransformMatrix that mixes time with space");
}
