// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Replaces a file whole or not at all: a full disk or a crash leaves the old file.
 */
#ifndef BrainShift_WholeFile_h
#define BrainShift_WholeFile_h

#include <functional>
#include <string>

namespace brainshift
{
/**
 * Writes a new file beside `fileName`, waits until the disk holds it, and gives it that name. If
 * anything fails, the new file is removed and the old one stays as it was.
 *
 * @param write   fills the file whose name it gets, which has the same ending. Returns the reason
 *                of a failure; empty if there is none
 * @return one sentence, without a full stop, on what went wrong; empty if nothing did
 */
std::string writeWhole(
  const std::string& fileName, const std::function<std::string(const std::string& beside)>& write);

/** What the system says about the last call that failed, or a general reason. */
std::string lastSystemError();
}

#endif
