// SPDX-License-Identifier: BSD-3-Clause
// Proves that the text headers of fields are read within bounds and by their formats' rules: a file
// without an end of lines, a folder or a pipe in place of a file, bytes to skip, a spacing under
// its other name, and words that are spelled otherwise.
#include "Common/Problem.h"
#include "Formats/Fields/FieldFile.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#ifndef _WIN32
#include <sys/stat.h>
#endif

using namespace brainshift;

namespace
{
namespace fs = std::filesystem;

std::string scratch(const std::string& name)
{
  return std::string(BRAINSHIFT_TEST_TEMP) + "/" + name;
}

// The numbers 0 to 23, big-endian or little-endian, for 2 x 2 x 2 points.
std::string numbers(bool big)
{
  std::string bytes;
  for (int i = 0; i < 24; ++i)
  {
    const auto value = static_cast<float>(i);
    char raw[4];
    std::memcpy(raw, &value, 4);
    const int one = 1;
    const bool machineIsBig = *reinterpret_cast<const char*>(&one) == 0;
    bytes +=
      big == machineIsBig ? std::string(raw, 4) : std::string{ raw[3], raw[2], raw[1], raw[0] };
  }
  return bytes;
}

const std::string MetaLines =
  "ObjectType = Image\nNDims = 3\nBinaryData = True\nOffset = 0 0 0\n"
  "DimSize = 2 2 2\nElementNumberOfChannels = 3\nElementType = MET_FLOAT\n";
const std::string Nrrd =
  "NRRD0005\ntype: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 3 2 2 2\n"
  "space directions: none (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nspace origin: (0,0,0)\n";

// Reads a file of these bytes.
std::string problemOf(const std::string& name, const std::string& bytes, DirectedField& field)
{
  std::ofstream(scratch(name), std::ios::binary) << bytes;
  return brainshift::problemOf([&] { readFieldFile(scratch(name), field); });
}

void expectProblem(const std::string& name, const std::string& bytes, const char* words)
{
  DirectedField field;
  const std::string problem = problemOf(name, bytes, field);
  EXPECT_NE(problem.find(words), std::string::npos) << name << ": " << problem;
}
}

TEST(TextHeader, HasAnEndWithinItsBounds)
{
  // 1 GB of nothing that takes no room on the disk, in one line.
  for (const char* name : { "endless.nrrd", "endless.mha" })
  {
    expectProblem(name, name[8] == 'n' ? "NRRD0005\n" : "ObjectType = Image\n", "it must have 3");
    fs::resize_file(scratch(name), std::uintmax_t(1) << 30);
    DirectedField field;
    const std::string problem = problemOf([&] { readFieldFile(scratch(name), field); });
    EXPECT_NE(problem.find("no end of a header in its first 1048576 bytes"), std::string::npos)
      << problem;
    EXPECT_FALSE(isFieldFile(scratch(name)));
    fs::remove(scratch(name));
  }
}

TEST(TextHeader, FoldersAndPipesAreNoFiles)
{
  fs::create_directories(scratch("folder.nrrd"));
  fs::create_directories(scratch("numbers"));
  DirectedField field;
  EXPECT_NE(problemOf([&] { readFieldFile(scratch("folder.nrrd"), field); }).find("is a folder"),
    std::string::npos);
  expectProblem(
    "of_folder.mhd", MetaLines + "ElementDataFile = numbers\n", "numbers, which is a folder");
  expectProblem(
    "of_folder.nhdr", Nrrd + "endian: little\ndata file: numbers\n", "which is a folder");
#ifndef _WIN32
  fs::remove(scratch("pipe.mha"));
  ASSERT_EQ(mkfifo(scratch("pipe.mha").c_str(), 0600), 0);
  EXPECT_FALSE(isFieldFile(scratch("pipe.mha")));
  EXPECT_NE(problemOf([&] { readFieldFile(scratch("pipe.mha"), field); }).find("is a pipe"),
    std::string::npos);
  expectProblem("of_pipe.mhd", MetaLines + "ElementDataFile = pipe.mha\n", "which is a pipe");
#endif
}

TEST(TextHeader, LinesAndBytesBeforeTheNumbersAreSkipped)
{
  const std::string skips = "endian: little\nline skip: 2\nbyte skip: 3\n\n";
  DirectedField field;
  ASSERT_EQ(problemOf("skip.nrrd", Nrrd + skips + "a\nb\nxyz" + numbers(false), field), "");
  EXPECT_EQ(field.displacements[1], glm::vec3(-3, -4, 5));
  const std::string atEnd = Nrrd + "endian: little\nbyte skip: -1\n\nanything";
  ASSERT_EQ(problemOf("end.nrrd", atEnd + numbers(false), field), "");
  EXPECT_EQ(field.displacements[1], glm::vec3(-3, -4, 5));
  ASSERT_EQ(
    problemOf("end.mha",
      MetaLines + "HeaderSize = -1\nElementDataFile = LOCAL\nanything" + numbers(false), field),
    "");
  EXPECT_EQ(field.displacements[1], glm::vec3(-3, -4, 5));
  expectProblem("few.nrrd", Nrrd + "endian: little\nline skip: 99\n\n" + numbers(false),
    "has fewer lines than the header skips, 99");
  expectProblem("minus.nrrd", Nrrd + "endian: little\nbyte skip: -2\n\n" + numbers(false),
    "has byte skip -2; it must be a whole number, -1 or more");
  EXPECT_EQ(problemOf("noskip.nrrd",
              Nrrd + "endian: little\nbyte skip: 0\nline skip: 0\n\n" + numbers(false), field),
    "");
}

TEST(TextHeader, TheSizeOfAVoxelIsItsSpacingIfThereIsNoOther)
{
  const std::string end = "ElementDataFile = LOCAL\n" + numbers(false);
  DirectedField field;
  ASSERT_EQ(problemOf("size.mha", MetaLines + "ElementSize = 2 3 4\n" + end, field), "");
  EXPECT_EQ(field.grid.spacing, glm::dvec3(2, 3, 4));
  const std::string both = "ElementSize = 2 3 4\nElementSpacing = 5 6 7\n";
  ASSERT_EQ(problemOf("both.mha", MetaLines + both + end, field), "");
  EXPECT_EQ(field.grid.spacing, glm::dvec3(5, 6, 7));
  ASSERT_EQ(problemOf("none.mha", MetaLines + end, field), "");
  EXPECT_EQ(field.grid.spacing, glm::dvec3(1));
  expectProblem("two.mha", MetaLines + "ElementSpacing = 5 6\n" + end, "has the spacing 5 6");
}

// Nobody can read bytes that are no letters, nor a megabyte of them.
TEST(TextHeader, HalfOfANumberIsNoNumber)
{
  const std::string end = "ElementDataFile = LOCAL\n" + numbers(false);
  for (const std::string broken :
    { "ElementSpacing = 1 1 1/.5\n", "Offset = 0 0 6f5\n", "TransformMatrix = x\n",
      "TransformMatrix = 1 0 0 0 1 0 0 0 1;5\n", "ElementSpacing = 1 1+1\n",
      "ElementSpacing = 1.5.5 1\n", "ElementSpacing = 1 1 1e20\n", "Comment = a\x01b\n" })
  {
    const bool isOffset = broken[0] == 'O';
    std::string header = MetaLines;
    header.replace(header.find("Offset"), 15, isOffset ? broken : "Offset = 0 0 0\n");
    header += isOffset ? "" : broken;
    header += end;
    DirectedField field;
    EXPECT_NE(problemOf("half.mha", header, field), "") << broken;
  }
  std::string nrrd = Nrrd + "endian: little\n\n" + numbers(false);
  nrrd.replace(nrrd.find("(0,0,0)"), 7, "(0,0,0;5)");
  DirectedField field;
  EXPECT_NE(problemOf("half.nrrd", nrrd, field), "");
}

TEST(TextHeader, VectorsAreWrittenAsVectors)
{
  const std::string good = Nrrd + "endian: little\n\n" + numbers(false);
  DirectedField field;
  ASSERT_EQ(problemOf("good.nrrd", good, field), "");
  const std::size_t directions = good.find("none");
  ASSERT_NE(directions, std::string::npos);
  for (const std::string broken : { "nine", "none(", "\x18one", "" })
  {
    std::string header = good;
    header.replace(directions, 4, broken);
    const bool isEmpty = broken.empty();
    EXPECT_EQ(problemOf("broken.nrrd", header, field).empty(), isEmpty) << broken;
  }
  std::string header = good;
  header.replace(header.find("(0,0,0)"), 7, "0 0 0");
  EXPECT_NE(problemOf("origin.nrrd", header, field), "");
}

TEST(TextHeader, AnOriginTooFarForItsSpacingIsRefused)
{
  DirectedField field;
  for (const auto& [origin, isFar] :
    { std::pair("(-33885387783937907,-50,-68)", true), std::pair("(-500000,40,3e5)", false) })
  {
    std::string header = Nrrd + "endian: little\n\n" + numbers(false);
    header.replace(header.find("(0,0,0)"), 7, origin);
    const std::string problem = problemOf("far.nrrd", header, field);
    EXPECT_EQ(problem.find("at most 1e+09 spacings away from 0") != std::string::npos, isFar)
      << problem;
  }
}

TEST(TextHeader, ErrorsShowPrintableWords)
{
  DirectedField field;
  const std::string bytes = "NRRD0004\nsizes: 3 \x8d\x8e" + std::string(100000, 'x') + "\n\n";
  const std::string problem = problemOf("bytes.nrrd", bytes, field);
  EXPECT_NE(problem.find("has the sizes 3 ??xxx"), std::string::npos) << problem;
  EXPECT_LT(problem.size(), scratch("bytes.nrrd").size() + 300);
}

TEST(TextHeader, WordsSpelledOtherwiseAreReadOrRefused)
{
  const std::string end = "ElementDataFile = LOCAL\n" + numbers(true);
  DirectedField field;
  ASSERT_EQ(problemOf("upper.mha", MetaLines + "BinaryDataByteOrderMSB = TRUE\n" + end, field), "");
  EXPECT_EQ(field.displacements[1], glm::vec3(-3, -4, 5));
  ASSERT_EQ(problemOf("big.nrrd", Nrrd + "endian: big\n\n" + numbers(true), field), "");
  EXPECT_EQ(field.displacements[1], glm::vec3(-3, -4, 5));
  ASSERT_EQ(problemOf("Big.nrrd", Nrrd + "endian: Big\n\n" + numbers(true), field), "");
  EXPECT_EQ(field.displacements[1], glm::vec3(-3, -4, 5));
  expectProblem("no_endian.nrrd", Nrrd + "\n" + numbers(true), "must be little or big");
  std::string half = MetaLines;
  half.replace(half.find("2 2 2"), 5, "2.5 2 2");
  expectProblem("half.mha", half + end, "a whole number from 1 to 2147483647");
}

TEST(TextHeader, WordsThatChangeVectorsAreRefusedByName)
{
  const auto end = [](const std::string& line) {
    return Nrrd + "endian: little\n" + line + "\n\n" + numbers(false);
  };
  DirectedField field;
  EXPECT_EQ(problemOf("words.nrrd", end("space units: \"mm\" \"MM\" \"mm\""), field), "");
  EXPECT_EQ(problemOf("words.nrrd", end("kinds: Vector domain space domain"), field), "");
  EXPECT_EQ(problemOf("words.nrrd", end("measurement frame: (1,0,0) (0,1,0) (0,0,1)"), field), "");
  expectProblem("words.nrrd", end("space units: \"um\" \"um\" \"um\""), "space units");
  expectProblem("words.nrrd", end("sample units: voxel"), "has the sample units voxel");
  expectProblem("words.nrrd", end("measurement frame: (-1,0,0) (0,-1,0) (0,0,1)"),
    "has the measurement frame (-1,0,0)");
  expectProblem("words.nrrd", end("displacement field type:=velocity"),
    "has the displacement field type velocity");
  expectProblem("words.nrrd", end("kinds: point domain domain domain"), "of the kind point");
  expectProblem("words.nrrd", end("kinds: list domain domain domain"), "of the kind list");
  expectProblem(
    "words.nrrd", end("spacing: 1 1 1 1"), "field 'spacing', which NRRD does not define");
  expectProblem("words.mha",
    MetaLines + "DistanceUnits = um\nElementDataFile = LOCAL\n" + numbers(false),
    "DistanceUnits um");
}
