// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Headers of MetaImage ("key = value") and NRRD ("field: value") files, and the numbers that
/// belong to them: how many there are, where they are stored and where they are in space.
#ifndef BrainShift_TextHeader_h
#define BrainShift_TextHeader_h

#include "Common/Problem.h"
#include "Formats/Files/PackedBytes.h"

#include "vtkType.h"

#include <glm/glm.hpp>

#include <map>
#include <optional>
#include <vector>

namespace brainshift
{
/** The most voxels along an axis, of VTK. */
constexpr double LongestAxis = 2147483647.0;

/** The lines of a header. */
struct HeaderText
{
  bool isNRRD = false; ///< the file begins with "NRRD"
  /// What the format defines, by its name in small letters.
  std::map<std::string, std::string> fields;
  std::map<std::string, std::string> keys; ///< NRRD's "key:=value", which anybody may add
  std::vector<std::string> names;          ///< of the fields, as the file spells them
  /// Names of fields that occur twice, and of keys that occur twice with another value.
  std::vector<std::string> repeated;
  std::vector<std::string> listed; ///< the lines after a list of files is announced
  std::string comments;            ///< NRRD's lines that begin with #
  std::size_t bytes = 0;           ///< of the header

  /** Value of the first of some fields that the header has; empty if it has none. */
  std::string valueOf(const std::vector<std::string>& names) const;

  /** Whether the header has a field. */
  bool has(const std::string& name) const;

  /** Value of one of NRRD's keys; empty without it. */
  std::string keyed(const std::string& name) const;
};

/** Reads the lines of a file, or throws the end of a sentence. */
void readHeaderText(const std::string& fileName, HeaderText& text);

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
  std::string kind;               ///< NRRD's word for what it is, in small letters; may be empty
  std::optional<double> spacing;  ///< in `unit`, of an axis that is none of space; none: not known
  double start = 0.0;             ///< likewise: where its first number is
  std::string unit;               ///< of these; empty: s
  std::vector<double> values;     ///< where its numbers are, if the file lists them
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

  /** knowsSides, unless BrainShift wrote the file for data whose sides nobody knew. */
  bool saysSides() const;
};

/**
 * Millimetres in a unit that a word names: as a sign or a word, in capitals or not, with either
 * letter for micro. Empty: mm. None: the word is no unit of length that is known.
 */
std::optional<double> mmPerUnit(const std::string& word);

/**
 * Times of the volumes along an axis, s. `warnings` gets the end of a sentence if its numbers are
 * no times: volumes are numbered then.
 */
std::vector<double> timesOf(const HeaderAxis& axis, std::vector<std::string>& warnings);

/**
 * Files with numbers, from the words that name them: "LOCAL", one name, a pattern such as
 * "slice%03d.raw 1 90 1", or "LIST", after which lines name them. A name is relative to the folder
 * of the header. Throws the end of a sentence.
 */
void nameDataFiles(const std::string& fileName, const std::string& words, TextHeader& header);

///@{
/**
 * Fills a header from its text, or throws the end of a sentence. Names such as `ElementType` and
 * `space directions` are those of the formats (teem.sourceforge.net/nrrd/format.html). The world of
 * MetaImage is LPS, as in ITK. NRRD's measurement frame is ignored: numbers are taken as they are.
 */
void fromMetaImage(const std::string& fileName, TextHeader& header);
void fromNRRD(const std::string& fileName, TextHeader& header);
///@}

/**
 * Reads the header of a file, or throws the end of a sentence; what was read until then is in
 * `header`. The numbers may not be there.
 */
void readTextHeader(const std::string& fileName, TextHeader& header);

/**
 * Throws the end of a sentence if the files of a header cannot hold its numbers, by their sizes. It
 * takes no memory.
 */
void requireNumbers(const TextHeader& header);

/**
 * Adds a warning if a file beside the header has more bytes than the header announces: it may begin
 * with a header of its own, which would be taken for numbers. Raw and gzip alone.
 */
void warnOfSurplus(TextHeader& header);

/**
 * Fills `to` with all numbers, in the byte order of this machine: header.dataBytes() bytes. Throws
 * the end of a sentence. It returns early if `fractionDone` says stop.
 */
void readNumbers(const TextHeader& header, char* to, const FractionDone& fractionDone);

/** Whether all numbers are in one file, and not as text, so that a box of voxels can be read. */
bool hasNumbersInOneFile(const TextHeader& header);

/**
 * The same for a box of voxels, of a header with numbers in one file. `skip`: bytes of numbers
 * before the first of the voxels.
 */
void readNumbers(const TextHeader& header, std::uint64_t skip, const StoredBox& box, char* to,
  const FractionDone& fractionDone);

/** Whether a file has the header of a displacement field. */
bool isTextHeaderField(const std::string& fileName);
}

#endif
