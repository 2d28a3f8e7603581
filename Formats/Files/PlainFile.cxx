// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/PlainFile.h"

#include <filesystem>
#include <system_error>

namespace brainshift
{
std::string plainFileProblem(const std::string& fileName)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(fileName, error);
  if (!std::filesystem::exists(status))
  {
    return "does not exist";
  }
  if (std::filesystem::is_directory(status))
  {
    return "is a folder; it must be a file";
  }
  return std::filesystem::is_regular_file(status)
    ? ""
    : "is a pipe or a device; it must be a file on a disk";
}
}
