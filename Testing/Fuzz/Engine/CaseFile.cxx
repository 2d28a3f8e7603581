// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzz/Engine/CaseFile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

namespace brainshift::fuzz
{
namespace
{
/** The folder of this process, which engine.py removes with that of all temporary files. */
const std::filesystem::path& ownFolder()
{
  static const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("case-" + std::to_string(std::random_device()()));
  std::filesystem::create_directories(folder);
  return folder;
}

void write(const std::filesystem::path& path, const char* from, std::size_t count)
{
  std::ofstream(path, std::ios::binary).write(from, static_cast<std::streamsize>(count));
}

}

std::string fileOf(const Bytes& bytes, const std::string& ending)
{
  const std::filesystem::path path = ownFolder() / ("case" + ending);
  write(path, bytes.data(), bytes.size());
  return path.string();
}

std::size_t shortAt(const Bytes& bytes, std::size_t at)
{
  return static_cast<unsigned char>(bytes[at]) + 256U * static_cast<unsigned char>(bytes[at + 1]);
}

std::string folderOf(const Bytes& bytes, const std::string& ending)
{
  const std::filesystem::path folder = ownFolder() / ("case" + ending);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::size_t at = 0;
  while (at + 3 <= bytes.size())
  {
    const std::size_t length = static_cast<unsigned char>(bytes[at]);
    const std::string name = bytes.substr(at + 1, length);
    at += 1 + length;
    if (at + 2 > bytes.size())
    {
      break;
    }
    const std::size_t count = std::min(shortAt(bytes, at), bytes.size() - at - 2);
    const std::filesystem::path path = (folder / name).lexically_normal();
    std::error_code refused; // whatever is no name of a file
    const bool isWithin = path.string().rfind(folder.string() + "/", 0) == 0;
    if (isWithin && name.find('\0') == std::string::npos &&
      (std::filesystem::create_directories(path.parent_path(), refused), !refused))
    {
      write(path, bytes.data() + at + 2, count);
    }
    at += 2 + count;
  }
  return folder.string();
}
}
