// SPDX-License-Identifier: BSD-3-Clause
// Proves that a field file is replaced whole or not at all: on a full disk the old file keeps its
// bytes, nothing is left beside it, and the writer names the file and the reason.
#include "Common/Problem.h"
#include "Formats/Fields/FieldFile.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
namespace fs = std::filesystem;

// Files of this process stay below some bytes while this lives: to it, every disk is full.
class FullDisk
{
public:
  explicit FullDisk(rlim_t bytes)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &this->Before);
    const rlimit limit{ bytes, this->Before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &this->Before); }

private:
  rlimit Before{};
};

DirectedField someField(Direction direction)
{
  DirectedField field;
  field.grid = obliqueGrid({ 20, 21, 22 });
  Random random(8);
  for (std::size_t i = 0; i < field.grid.count(); ++i)
  {
    field.displacements.emplace_back(random.between(glm::dvec3(-9), glm::dvec3(9)));
  }
  field.direction = direction;
  return field;
}

std::string contentOf(const fs::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

// A folder with nothing in it.
fs::path freshFolder()
{
  const fs::path folder = fs::path(BRAINSHIFT_TEST_TEMP) / "whole_file";
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::size_t filesIn(const fs::path& folder)
{
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}
}

class WholeFileFormat : public ::testing::TestWithParam<const char*>
{
};

TEST_P(WholeFileFormat, AFullDiskKeepsTheOldFile)
{
  const fs::path folder = freshFolder();
  const std::string name = (folder / (std::string("field") + GetParam())).string();
  ASSERT_EQ(problemOf([&] { writeFieldFile(name, someField(Direction::Forward)); }), "");
  const std::string old = contentOf(name);
  // Also in the last bytes, which stay in a buffer until the file is closed.
  for (const std::size_t room : { std::size_t(0), std::size_t(1000), old.size() - 200 })
  {
    const std::string problem = [&] {
      const FullDisk full(room);
      return brainshift::problemOf([&] { writeFieldFile(name, someField(Direction::Backward)); });
    }();
    EXPECT_EQ(problem.find("File " + name + " cannot be written: "), 0u) << room << problem;
    EXPECT_TRUE(contentOf(name) == old) << room;
    EXPECT_EQ(filesIn(folder), 1u) << room;
  }
  ASSERT_EQ(problemOf([&] { writeFieldFile(name, someField(Direction::Backward)); }), "");
  DirectedField found;
  ASSERT_EQ(problemOf([&] { readFieldFile(name, found); }), "");
  EXPECT_EQ(found.direction, Direction::Backward);
  EXPECT_EQ(filesIn(folder), 1u);
}

INSTANTIATE_TEST_SUITE_P(
  All, WholeFileFormat, ::testing::Values(".nii", ".nii.gz", ".mha", ".mhd", ".nrrd"));

TEST(WholeFile, KeepsLinksAndRights)
{
  const fs::path folder = freshFolder();
  const fs::path file = folder / "field.mha";
  ASSERT_EQ(problemOf([&] { writeFieldFile(file.string(), someField(Direction::Forward)); }), "");
  const fs::perms rights = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(file, rights);
  fs::create_symlink(file, folder / "link.mha");
  ASSERT_EQ(problemOf([&] {
    writeFieldFile((folder / "link.mha").string(), someField(Direction::Backward));
  }),
    "");
  EXPECT_TRUE(fs::is_symlink(folder / "link.mha"));
  EXPECT_EQ(fs::status(file).permissions(), rights);
  DirectedField found;
  ASSERT_EQ(problemOf([&] { readFieldFile(file.string(), found); }), "");
  EXPECT_EQ(found.direction, Direction::Backward);
}

TEST(WholeFile, WhatIsNoFileIsNotReplaced)
{
  const fs::path folder = freshFolder() / "folder.nrrd";
  fs::create_directories(folder);
  const std::string problem =
    problemOf([&] { writeFieldFile(folder.string(), someField(Direction::Forward)); });
  EXPECT_NE(problem.find("it exists and is not a file"), std::string::npos) << problem;
  EXPECT_TRUE(fs::is_directory(folder));
  EXPECT_EQ(filesIn(folder.parent_path()), 1u);
}
#endif
