// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/MINC/NetCDFHeader.h"

#include "Common/Bytes.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

namespace brainshift
{
namespace
{
constexpr std::size_t LongestHeader = std::size_t(8) << 20; // those of MINC have some kilobytes

// Reads a header from its beginning. Numbers have 4 bytes, the highest first, and what is shorter
// is filled up to 4.
class Walk
{
public:
  explicit Walk(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  std::size_t at() const { return this->At; }

  std::uint64_t number(std::size_t bytes = 4)
  {
    this->require(bytes);
    const char* from = this->Bytes.data() + this->At;
    const std::uint64_t found = bytes == 8 ? storedNumber<std::uint64_t>(from, true)
                                           : storedNumber<std::uint32_t>(from, true);
    this->At += bytes;
    return found;
  }

  // The number of entries of a list, each of so many bytes or more.
  std::uint64_t count(const char* what, std::uint64_t leastBytes)
  {
    const std::uint64_t found = this->number();
    if (found > (this->Bytes.size() - this->At) / leastBytes)
    {
      throw Problem(joined("announces ", found, " ", what, " in the ",
        this->Bytes.size() - this->At, " bytes that follow"));
    }
    return found;
  }

  void skip(std::uint64_t bytes)
  {
    this->require(bytes);
    this->At += static_cast<std::size_t>((bytes + 3) / 4 * 4);
  }

  void skipName() { this->skip(this->number()); }

private:
  void require(std::uint64_t bytes) const
  {
    if (this->At > this->Bytes.size() || bytes > this->Bytes.size() - this->At)
    {
      throw Problem(joined("ends within its header, after ", this->Bytes.size(), " bytes"));
    }
  }

  const std::string& Bytes;
  std::size_t At = 4; // behind CDF and the version
};

std::uint64_t bytesOfType(std::uint64_t type)
{
  constexpr std::uint64_t Sizes[] = { 1, 1, 2, 4, 4, 8 }; // byte, char, short, int, float, double
  if (type < 1 || type > 6)
  {
    throw Problem(joined("has numbers of the netCDF type ", type, "; it must be from 1 to 6"));
  }
  return Sizes[type - 1];
}

void skipAttributes(Walk& walk)
{
  walk.number(); // says that they are attributes
  const std::uint64_t count = walk.count("attributes", 12);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    walk.skipName();
    const std::uint64_t bytes = bytesOfType(walk.number());
    walk.skip(bytes * walk.number());
  }
}

std::vector<double> readSides(Walk& walk)
{
  walk.number(); // says that they are dimensions
  std::vector<double> sides(walk.count("dimensions", 8));
  for (double& side : sides)
  {
    walk.skipName();
    side = static_cast<double>(walk.number());
    throwIfAny(side > 0.0 ? ""
                          : "has a dimension without an end (UNLIMITED); make a MINC2 file of "
                            "it by mincconvert -2");
  }
  return sides;
}

// Where the data of a variable begin and end, bytes.
struct StoredData
{
  double begin = 0.0;
  double end = 0.0;
};

StoredData readVariable(Walk& walk, const std::vector<double>& sides, bool isLarge)
{
  walk.skipName();
  double size = 1.0;
  const std::uint64_t rank = walk.count("dimensions of a variable", 4);
  for (std::uint64_t i = 0; i < rank; ++i)
  {
    const std::uint64_t axis = walk.number();
    if (axis >= sides.size())
    {
      throw Problem(joined("has a variable along dimension ", axis, "; it has ", sides.size()));
    }
    size *= sides[static_cast<std::size_t>(axis)];
  }
  skipAttributes(walk);
  size *= static_cast<double>(bytesOfType(walk.number()));
  walk.number(); // the size, which is cut off where it is large
  const auto begin = static_cast<double>(walk.number(isLarge ? 8 : 4));
  return { begin, begin + size };
}
}

void requireWholeNetCDF(const std::string& fileName)
{
  const std::string header = readBeginning(fileName, LongestHeader);
  const bool isLarge = header.compare(0, 4, "CDF\x02") == 0;
  Walk walk(header);
  walk.number(); // of records, which MINC has not
  const std::vector<double> sides = readSides(walk);
  skipAttributes(walk);
  walk.number(); // says that they are variables
  std::vector<StoredData> data(walk.count("variables", 28));
  for (StoredData& one : data)
  {
    one = readVariable(walk, sides, isLarge);
  }
  auto need = static_cast<double>(walk.at());
  for (const StoredData& one : data) // in any order, and a gap may be before them
  {
    if (one.begin < static_cast<double>(walk.at()))
    {
      throw Problem(joined("is damaged: data begin at byte ", one.begin, ", within its header of ",
        walk.at(), " bytes"));
    }
    need = std::max(need, one.end);
  }
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(fileName, error);
  if (error || static_cast<double>(size) < need)
  {
    throw Problem(joined("has ", size, " bytes; its header announces ", need));
  }
}
}
