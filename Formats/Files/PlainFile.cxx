// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/PlainFile.h"

#include "Formats/Files/SystemPath.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace brainshift
{
void requirePlainFile(const std::string& fileName)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(systemPath(fileName), error);
  if (!std::filesystem::exists(status))
  {
    throw Problem("does not exist");
  }
  if (std::filesystem::is_directory(status))
  {
    throw Problem("is a folder; it must be a file");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw Problem("is a pipe or a device; it must be a file on a disk");
  }
}

bool isPlainFile(const std::string& fileName)
{
  std::error_code error;
  return std::filesystem::is_regular_file(systemPath(fileName), error);
}

std::string readBeginning(const std::string& fileName, std::size_t bytes)
{
  std::string text;
  if (isPlainFile(fileName))
  {
    std::ifstream file(systemPath(fileName), std::ios::binary);
    text.resize(bytes);
    file.read(text.data(), static_cast<std::streamsize>(bytes));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  }
  return text;
}

std::string fileBytes(const std::string& fileName, std::uint64_t offset, std::uint64_t count)
{
  std::ifstream stream(systemPath(fileName), std::ios::binary);
  std::string bytes(count, '\0');
  if (!stream.seekg(static_cast<std::streamoff>(offset)) ||
    !stream.read(bytes.data(), static_cast<std::streamsize>(count)))
  {
    throw Problem("cannot be read: no " + std::to_string(count) + " bytes from byte " +
      std::to_string(offset) + " on");
  }
  return bytes;
}

std::string withoutMark(std::string text)
{
  constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";
  const bool hasMark = text.compare(0, ByteOrderMark.size(), ByteOrderMark) == 0;
  text.erase(0, hasMark ? ByteOrderMark.size() : 0);
  return text;
}

std::string readPlainText(const std::string& fileName, std::size_t limit)
{
  requirePlainFile(fileName);
  std::ifstream file(systemPath(fileName), std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (size >= 0 && static_cast<std::size_t>(size) > limit)
  {
    throw Problem("has " + std::to_string(size) + " bytes; the limit is " + std::to_string(limit));
  }
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(size, 0)), '\0');
  file.seekg(0);
  if (size < 0 || !file.read(text.data(), size))
  {
    throw Problem("cannot be read");
  }
  text = withoutMark(std::move(text));
  if (text.find('\0') != std::string::npos)
  {
    throw Problem("has a byte 0; it must be text in UTF-8");
  }
  return text;
}
}
