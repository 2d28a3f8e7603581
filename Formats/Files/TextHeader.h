// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What the header of a MetaImage or NRRD file says about its numbers: how many there are,
 *        where they are stored, and where they lie.
 */
#ifndef BrainShift_TextHeader_h
#define BrainShift_TextHeader_h

#include "Formats/Files/HeaderText.h"

#include "vtkType.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/** How numbers are stored. */
enum class Encoding
{
  Raw,
  Packed, ///< with zlib or gzip
  Text,   ///< as decimal numbers between spaces or commas
};

/** Where x and y of the header's space point. z points to the head. */
enum class HeaderSpace
{
  RAS, ///< to the right and to the front
  LAS, ///< to the left and to the front
  LPS, ///< to the left and to the back
};

/** One axis of the numbers. */
struct HeaderAxis
{
  std::int64_t count = 0;         ///< numbers along it
  std::optional<glm::dvec3> step; ///< mm, header's space; none: it is no axis of space
  std::string kind;               ///< NRRD's word for what it is; may be empty
  double spacing = 0.0;           ///< of an axis that is none of space; 0: not known
};

/** A header. */
struct TextHeader
{
  HeaderText text;
  std::vector<HeaderAxis> axes; ///< the fastest first
  int numberType = VTK_VOID;    ///< VTK's number of the type of a number
  std::string typeName;         ///< as the file spells it
  Encoding encoding = Encoding::Raw;
  bool isBigEndian = false; ///< the order of the bytes of a number
  double slope = 1.0;       ///< value = slope * number + intercept
  double intercept = 0.0;

  HeaderSpace space = HeaderSpace::LPS;
  bool knowsSides = false;  ///< the file says where the axes of its space point
  glm::dvec3 origin{ 0.0 }; ///< of the first number, mm, header's space
  bool hasOrigin = false;   ///< the file says so

  std::vector<std::string> dataFiles; ///< the files with the numbers, in equal parts
  bool isLocal = false;               ///< they follow the header, in its own file
  std::uint64_t lineSkip = 0;         ///< lines of a data file before its numbers
  std::uint64_t fileSkip = 0;         ///< bytes after these lines
  std::uint64_t unpackedSkip = 0;     ///< unpacked bytes before them
  bool isAtEnd = false;               ///< the numbers end with the file; nothing else is skipped

  std::vector<std::string> warnings; ///< ends of sentences, after the name of the file

  /** All numbers. It may be more than any file has. */
  double numberCount() const;

  /** Bytes of all numbers, unpacked and not as text. */
  double dataBytes() const;

  /** Axes of space. */
  int spatialAxes() const;
};

/**
 * Files with numbers, from the words that name them: "LOCAL", one name, a pattern such as
 * "slice%03d.raw 1 90 1", or "LIST", after which lines name them. A name is relative to the folder
 * of the header. Returns the end of a sentence on what is wrong, or nothing.
 */
std::string nameDataFiles(
  const std::string& fileName, const std::string& words, TextHeader& header);
}

#endif
