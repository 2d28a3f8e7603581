// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The XML of GIFTI files: arrays with their attributes, and a table of labels. Expat parses
 *        it.
 *
 * Numbers may be ASCII, base64, or base64 of what zlib packed. Files with the numbers beside the
 * XML are refused, and so are entities that a file declares.
 */
#ifndef BrainShift_GIFTIFile_h
#define BrainShift_GIFTIFile_h

#include "Formats/GIFTI/GIFTIArray.h"

#include <string>
#include <vector>

namespace brainshift
{
/** A whole file. */
struct GIFTIFile
{
  std::vector<GIFTIArray> arrays;
  std::vector<Label> labels;
};

/** Whether the first bytes of a file, or a file, begin like one of GIFTI. */
bool beginsLikeGIFTI(const std::vector<char>& text);
bool isGIFTIFile(const std::string& fileName);

/** Reads the text of a file. Returns the end of a sentence on what is wrong; else empty. */
std::string readGIFTIFile(const std::vector<char>& text, GIFTIFile& file);
}

#endif
