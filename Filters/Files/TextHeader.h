// SPDX-License-Identifier: BSD-3-Clause
// Headers of lines "key = value" (MetaImage) or "key: value" (NRRD), as far as they tell a field of
// three numbers a point.
#ifndef BrainShift_TextHeader_h
#define BrainShift_TextHeader_h

#include "Filters/Files/FieldFile.h"

#include <string>

namespace brainshift
{
// What a MetaImage's Comment says of the direction.
constexpr const char* ForwardComment = "displacement field, mm, forward";
constexpr const char* BackwardComment = "displacement field, mm, backward";

struct TextHeader
{
  Grid grid; // LPS
  bool isDouble = false;
  bool isBigEndian = false;
  bool isPacked = false; // zlib or gzip
  std::optional<Direction> direction;
  std::string dataFile;        // empty: the numbers follow the header
  std::size_t headerBytes = 0; // of the file with the numbers

  std::size_t numberBytes() const { return this->isDouble ? 8 : 4; }
  std::size_t dataBytes() const { return this->grid.count() * 3 * this->numberBytes(); }
};

// One sentence on what keeps the header from telling a field; empty if nothing does.
std::string readTextHeader(const std::string& fileName, TextHeader& header);
}

#endif
