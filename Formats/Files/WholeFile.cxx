// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/WholeFile.h"

#include "Common/Problem.h"
#include "Formats/Files/SystemPath.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
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
  fs::path name = ".part-" + number + "-";
  return file.parent_path() / (name += file.filename());
}

// An existing file must be one that can be replaced.
void requireReplaceable(const fs::path& file)
{
  std::error_code error;
  if (!fs::exists(file, error))
  {
    return;
  }
  if (!fs::is_regular_file(file, error))
  {
    throw Problem("it exists and is not a file");
  }
  errno = 0;
  if (!std::ofstream(file, std::ios::app))
  {
    throw Problem(lastSystemError());
  }
}

// Waits until the disk holds a file: some disks say only then that they are full.
void sync(const fs::path& file)
{
  errno = 0;
#ifdef _WIN32
  std::FILE* opened = _wfopen(file.c_str(), L"r+b");
#else
  std::FILE* opened = std::fopen(file.c_str(), "r+b");
#endif
  if (!opened)
  {
    throw Problem(lastSystemError());
  }
#ifdef _WIN32
  const bool good = _commit(_fileno(opened)) == 0;
#else
  const bool good = fsync(fileno(opened)) == 0;
#endif
  const std::string reason = lastSystemError();
  std::fclose(opened);
  throwIfAny(good ? std::string() : reason);
}

// The new file takes the name, and the rights, of the old one.
void replace(const fs::path& file, const fs::path& beside)
{
  std::error_code error;
  const fs::file_status old = fs::status(file, error);
  if (fs::is_regular_file(old))
  {
    fs::permissions(beside, old.permissions(), error);
  }
  fs::rename(beside, file, error);
  throwIfAny(error ? error.message() : std::string());
}
}

std::string lastSystemError()
{
  return errno ? std::generic_category().message(errno) : "the disk does not accept it";
}

void writeWhole(const std::string& fileName, const std::function<void(const std::string&)>& write)
{
  std::error_code error;
  fs::path file = systemPath(fileName);
  if (fs::is_symlink(file, error)) // a link stays a link
  {
    const fs::path target = fs::weakly_canonical(file, error);
    file = error ? file : target;
  }
  const fs::path beside = nameBeside(file);
  try
  {
    withBeginning("File " + fileName + " cannot be written: ", [&] {
      requireReplaceable(file);
      write(nameOfPath(beside));
      sync(beside);
      replace(file, beside);
    });
  }
  catch (...)
  {
    fs::remove(beside, error);
    throw;
  }
}

void writeWholeStream(const std::string& fileName, const std::function<void(std::ostream&)>& write)
{
  writeWhole(fileName, [&](const std::string& beside) {
    errno = 0;
    std::ofstream file(systemPath(beside), std::ios::binary);
    file.imbue(std::locale::classic());
    write(file);
    file.close();
    if (!file)
    {
      throw Problem(lastSystemError());
    }
  });
}
}
