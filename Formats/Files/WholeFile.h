// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Replaces a file whole or not at all: a full disk or a crash leaves the old file.
#ifndef BrainShift_WholeFile_h
#define BrainShift_WholeFile_h

#include <functional>
#include <ostream>
#include <string>

namespace brainshift
{
/**
 * Writes a new file beside `fileName`, waits until the disk holds it, and gives it that name. If
 * anything throws, the new file is removed and the old one stays as it was. A Problem gets the
 * beginning "File … cannot be written: ".
 *
 * @param write   fills the file whose name it gets, which has the same ending
 */
void writeWhole(
  const std::string& fileName, const std::function<void(const std::string& beside)>& write);

/** The same through a stream. */
void writeWholeStream(
  const std::string& fileName, const std::function<void(std::ostream& file)>& write);

/** What the system says about the last call that failed, or a general reason. */
std::string lastSystemError();
}

#endif
