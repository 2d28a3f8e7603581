// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The XML of GIFTI files: arrays with their attributes, and a table of labels. Expat parses it.
///
/// Numbers may be ASCII, base64, or base64 of what zlib packed. Files with the numbers beside the
/// XML are refused, and so are entities that a file declares.
#ifndef BrainShift_GIFTIFile_h
#define BrainShift_GIFTIFile_h

#include "Formats/Surfaces/SurfaceFile.h"

namespace brainshift
{
/** A matrix that takes points from one space to another. The spaces are GIFTI's words. */
struct GIFTITransform
{
  std::string from;
  std::string to;
  std::vector<double> numbers; ///< 16, row by row
};

/** One DataArray. */
struct GIFTIArray
{
  std::map<std::string, std::string> attributes; ///< of the element, such as Intent
  std::map<std::string, std::string> meta;       ///< names and values of its MetaData
  std::vector<GIFTITransform> transforms;
  NumberType type = NumberType::Float32;
  std::size_t rows = 0;    ///< Dim0
  std::size_t columns = 1; ///< the product of the other dimensions
  std::vector<char> bytes; ///< row by row, in the order of this machine

  /** The value of an attribute; empty if there is none. */
  std::string attribute(const std::string& name) const
  {
    const auto found = this->attributes.find(name);
    return found == this->attributes.end() ? std::string() : found->second;
  }
};

/** A whole file. */
struct GIFTIFile
{
  std::map<std::string, std::string> attributes; ///< of the first element
  std::map<std::string, std::string> meta;       ///< names and values of its own MetaData
  std::vector<GIFTIArray> arrays;
  std::vector<Label> labels;
  std::size_t colorless = 0;      ///< labels that say no colour
  std::vector<std::string> notes; ///< what may be wrong: ends of sentences
};

/** Whether the first bytes of a file, or a file, begin like one of GIFTI. */
bool beginsLikeGIFTI(const std::vector<char>& text);
bool isGIFTIFile(const std::string& fileName);

/** Reads the text of a file, or throws the end of a sentence. */
GIFTIFile readGIFTIFile(const std::vector<char>& text);

/**
 * Reads type, dimensions and numbers of an array, whose attributes are there, from the text of its
 * element Data. Throws the end of a sentence.
 */
void readGIFTINumbers(const std::string& text, GIFTIArray& array);
}

#endif
