// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads MetaImage and NRRD files: first the header, then its numbers.
 */
#ifndef BrainShift_TextHeaderFile_h
#define BrainShift_TextHeaderFile_h

#include "Formats/Files/PackedBytes.h"
#include "Formats/Files/TextHeader.h"

#include <string>

namespace brainshift
{
/**
 * Reads the header of a file. Returns the end of a sentence, after the name of the file, on why it
 * cannot; empty if it can. The numbers may not be there.
 */
std::string readTextHeader(const std::string& fileName, TextHeader& header);

/**
 * Why the files of a header cannot hold its numbers, by their sizes: the end of a sentence, or
 * nothing. It takes no memory.
 */
std::string numbersProblem(const TextHeader& header);

/**
 * Fills `to` with all numbers, in the byte order of this machine: header.dataBytes() bytes. Returns
 * the end of a sentence on why it cannot, or nothing; nothing as well if it is told to stop.
 */
std::string readNumbers(const TextHeader& header, char* to, const ShareDone& shareDone);
}

#endif
