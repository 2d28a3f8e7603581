// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/SystemPath.h"

namespace brainshift
{
std::filesystem::path systemPath(const std::string& utf8)
{
  std::filesystem::path path = std::filesystem::u8path(utf8);
#ifdef _WIN32
  constexpr std::size_t Usual = 240; // characters; of the 260, temporary names take some
  constexpr const char* AnyLength = R"(\\?\)";
  if (path.native().size() > Usual && utf8.compare(0, 4, AnyLength) != 0)
  {
    // Windows takes such a path as it is: whole, with its own slashes, without dots.
    const auto whole = std::filesystem::absolute(path).lexically_normal().make_preferred();
    path = std::filesystem::path(AnyLength) += whole;
  }
#endif
  return path;
}

std::string nameOfPath(const std::filesystem::path& path)
{
  return path.u8string();
}
}
