// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A case as a file or as a folder of files, in a folder of this process.
#ifndef BrainShift_CaseFile_h
#define BrainShift_CaseFile_h

#include <string>

namespace brainshift::fuzz
{
using Bytes = std::string;

/** The path of a file with these bytes. */
std::string fileOf(const Bytes& bytes, const std::string& ending);

/**
 * The path of a folder with files, without the checksums of a zip file, behind which no changed
 * byte would be read. Each is the length of its name (1 byte), the name with slashes, the number of
 * its bytes (2 bytes), and these.
 */
std::string folderOf(const Bytes& bytes, const std::string& ending);

/** A number of two bytes, the lower first. */
std::size_t shortAt(const Bytes& bytes, std::size_t at);
}

#endif
