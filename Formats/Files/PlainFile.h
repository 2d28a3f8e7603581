// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Files that can be read at any byte: no folders, and no pipes or devices, on which a reader would
/// wait for ever.
#ifndef BrainShift_PlainFile_h
#define BrainShift_PlainFile_h

#include "Common/Problem.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace brainshift
{
/** Throws unless a name is that of a plain file: the end of a sentence. It opens nothing. */
void requirePlainFile(const std::string& fileName);

/** Whether a name is that of a plain file. */
bool isPlainFile(const std::string& fileName);

/** The first bytes of a plain file; fewer if it is shorter, none if it cannot be read. */
std::string readBeginning(const std::string& fileName, std::size_t bytes);

/** Bytes of a file that must be there, or throws the end of a sentence. */
std::string fileBytes(const std::string& fileName, std::uint64_t offset, std::uint64_t count);

/** Text without the mark of UTF-8 at its beginning. */
std::string withoutMark(std::string text);

/** A whole text in UTF-8, of up to `limit` bytes. Throws the end of a sentence. */
std::string readPlainText(const std::string& fileName, std::size_t limit);
}

#endif
