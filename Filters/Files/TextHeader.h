// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads the headers of MetaImage ("key = value") and NRRD ("key: value") files, as far as
 *        they describe a field of three numbers at each point.
 */
#ifndef BrainShift_TextHeader_h
#define BrainShift_TextHeader_h

#include "Filters/Attached/DirectedMap.h"
#include "Filters/Deformation/Grid.h"

#include <cstddef>
#include <optional>
#include <string>

namespace brainshift
{
/** The Comment of a MetaImage whose field leads forward. */
constexpr const char* ForwardComment = "displacement field, mm, forward";

/** The Comment of a MetaImage whose field leads backward. */
constexpr const char* BackwardComment = "displacement field, mm, backward";

/** What a header says. */
struct TextHeader
{
  Grid grid;                          ///< mm, LPS
  bool isDouble = false;              ///< true: 8 bytes a number; false: 4
  bool isBigEndian = false;           ///< the order of the bytes of a number
  bool isPacked = false;              ///< with zlib or gzip
  std::optional<Direction> direction; ///< none if the header does not name it
  std::string dataFile;               ///< the file with the numbers; empty: they follow the header
  std::size_t headerBytes = 0;        ///< of the file with the numbers: where they begin

  /** Bytes of one number. */
  std::size_t numberBytes() const { return this->isDouble ? 8 : 4; }

  /** Bytes of all numbers, unpacked. */
  std::size_t dataBytes() const { return this->grid.count() * 3 * this->numberBytes(); }
};

/** Words of a file as an error may show them: printable, and not too many. */
std::string shownWords(const std::string& words);

/**
 * Reads the header of a file. Returns the end of a sentence, after the name of the file, on why the
 * file is no field; empty if it is one.
 */
std::string readTextHeader(const std::string& fileName, TextHeader& header);
}

#endif
