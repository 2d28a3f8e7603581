// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMFile.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace brainshift
{
namespace
{
constexpr int PreambleBytes = 128; // before the letters DICM
}

bool isDICOMFile(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) // a pipe would wait for ever
  {
    return false;
  }
  std::array<char, PreambleBytes + 4> begin{};
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(begin.data(), 8))
  {
    return false;
  }
  // Old files begin at once with an element of group 8 whose length follows.
  const bool isOld = begin[0] == 8 && begin[1] == 0 && begin[3] == 0 &&
    (begin[2] == 0 || begin[2] == 5 || begin[2] == 8 || begin[2] == 0x16);
  stream.read(begin.data() + 8, PreambleBytes - 4);
  return (stream && std::memcmp(begin.data() + PreambleBytes, "DICM", 4) == 0) || isOld;
}
}
