// SPDX-License-Identifier: BSD-3-Clause
// Proves that files are written whole and read whatever their names are on this system: with
// spaces, umlauts and letters of other scripts (UTF-8), and with more than 260 characters; and that
// bytes beyond 4 GB are found, though `long` has 32 bits.
#include "Common/Problem.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/SystemPath.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Landmarks/LandmarkFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

using namespace brainshift;

namespace
{
namespace fs = std::filesystem;

constexpr const char* Text = "rest;deformed\r\n1;2\n";

// A folder with nothing in it, as a name in UTF-8.
std::string freshFolder(const std::string& name)
{
  const std::string folder = std::string(BRAINSHIFT_TEST_TEMP) + "/" + name;
  fs::remove_all(systemPath(folder));
  fs::create_directories(systemPath(folder));
  return folder;
}

std::ptrdiff_t filesIn(const std::string& folder)
{
  return std::distance(fs::directory_iterator(systemPath(folder)), fs::directory_iterator());
}

void writeAndRead(const std::string& fileName)
{
  for (const char* text : { "first\n", Text })
  {
    ASSERT_EQ(
      problemOf([&] { writeWholeStream(fileName, [&](std::ostream& file) { file << text; }); }),
      "");
    EXPECT_TRUE(isPlainFile(fileName));
    EXPECT_EQ(readPlainText(fileName, 1000), text);
    EXPECT_EQ(readBeginning(fileName, 5), std::string(text).substr(0, 5));
    EXPECT_EQ(fileBytes(fileName, 2, 3), std::string(text).substr(2, 3));
  }
}

// Written and read as the reader and the writer of landmarks do it.
void expectLandmarks(const std::string& beginning)
{
  for (const char* ending : { ".mrk.json", ".fcsv", ".tag", ".csv", ".tsv" })
  {
    const std::string fileName = beginning + ending;
    LandmarkList list;
    list.points.emplace_back();
    list.points[0].position = { 1.25, -2.5, 3.0 };
    ASSERT_EQ(problemOf([&] { writeLandmarkFile(fileName, {}, list); }), "");
    LandmarkList found;
    ASSERT_EQ(problemOf([&] { found = readLandmarkFile(fileName, 1, {}); }), "");
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_EQ(found.points[0].position, list.points[0].position);
    EXPECT_TRUE(isLandmarkFile(fileName));
  }
}
}

class FileNames : public ::testing::TestWithParam<const char*>
{
};

TEST_P(FileNames, AreTakenAsTheyAre)
{
  const std::string folder = freshFolder(GetParam());
  writeAndRead(folder + "/" + GetParam() + ".csv");
  EXPECT_EQ(filesIn(folder), 1);
  EXPECT_EQ(systemPath(folder).filename().u8string(), GetParam());
  expectLandmarks(folder + "/landmarks " + GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, FileNames,
  ::testing::Values("plain", "with two  spaces",
    "\xC3\x9C"
    "bergr\xC3\xB6\xC3\x9F"
    "e",                                                  // Übergröße
    "\xD0\xBC\xD0\xBE\xD0\xB7\xD0\xB3", "\xE8\x84\xB3")); // Russian, Chinese

TEST(LongFileName, OfMoreThan260CharactersIsTaken)
{
  // Of a new name, because the C++ library of MinGW does not clear so long a path.
  std::string folder =
    std::string(BRAINSHIFT_TEST_TEMP) + "/long" + std::to_string(std::random_device()());
  for (const char letter : { 'a', 'b', 'c', 'd', 'e', 'f' })
  {
    folder += "/" + std::string(60, letter);
  }
  fs::create_directories(systemPath(folder));
  writeAndRead(folder + "/table.csv");
  expectLandmarks(folder + "/landmarks");
}

TEST(LargeFile, IsReadBeyond4GB)
{
  constexpr std::uint64_t Place = 4'500'000'000; // bytes; the system keeps no block of zeros
  const std::string fileName = freshFolder("large") + "/large.raw";
  std::ofstream(systemPath(fileName)).put('a');
  fs::resize_file(systemPath(fileName), Place);
  std::ofstream(systemPath(fileName), std::ios::binary | std::ios::app) << "end";
  EXPECT_EQ(fileBytes(fileName, Place - 1, 4), std::string("\0end", 4));
  EXPECT_NE(
    problemOf([&] { readPlainText(fileName, 1000); }).find("4500000003"), std::string::npos);
  fs::remove(systemPath(fileName));
}
