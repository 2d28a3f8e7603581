// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/WholeFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace brainshift
{
namespace
{
namespace fs = std::filesystem;

// In the same folder, so that it can take the other's name, and with the same ending, by which
// writers choose a format.
fs::path nameBeside(const fs::path& file)
{
  const std::string number = std::to_string(std::random_device()());
  return file.parent_path() / (".part-" + number + "-" + file.filename().string());
}

// What keeps an existing file from being replaced.
std::string replacementProblem(const fs::path& file)
{
  std::error_code error;
  if (!fs::exists(file, error))
  {
    return {};
  }
  if (!fs::is_regular_file(file, error))
  {
    return "it exists and is not a file";
  }
  errno = 0;
  return std::ofstream(file, std::ios::app) ? std::string() : lastSystemError();
}

// Waits until the disk holds a file: some disks say only then that they are full.
std::string sync(const fs::path& file)
{
  errno = 0;
  std::FILE* opened = std::fopen(file.string().c_str(), "r+b");
  if (!opened)
  {
    return lastSystemError();
  }
#ifdef _WIN32
  const bool good = _commit(_fileno(opened)) == 0;
#else
  const bool good = fsync(fileno(opened)) == 0;
#endif
  const std::string problem = good ? std::string() : lastSystemError();
  std::fclose(opened);
  return problem;
}

// The new file takes the name, and the rights, of the old one.
std::string replace(const fs::path& file, const fs::path& beside)
{
  std::error_code error;
  const fs::file_status old = fs::status(file, error);
  if (fs::is_regular_file(old))
  {
    fs::permissions(beside, old.permissions(), error);
  }
  fs::rename(beside, file, error);
  return error ? error.message() : std::string();
}
}

std::string lastSystemError()
{
  return errno ? std::generic_category().message(errno) : "the disk does not take it";
}

std::string writeWhole(
  const std::string& fileName, const std::function<std::string(const std::string&)>& write)
{
  std::error_code error;
  fs::path file = fs::weakly_canonical(fileName, error); // a link stays a link
  file = error ? fs::path(fileName) : file;
  const fs::path beside = nameBeside(file);
  std::string problem = replacementProblem(file);
  problem = problem.empty() ? write(beside.string()) : problem;
  problem = problem.empty() ? sync(beside) : problem;
  problem = problem.empty() ? replace(file, beside) : problem;
  if (!problem.empty())
  {
    fs::remove(beside, error);
    return "File " + fileName + " cannot be written: " + problem;
  }
  return {};
}
}
