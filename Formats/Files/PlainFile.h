// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Asks whether a name leads to a file that can be read at any place: no folder, and no pipe
 *        or device, on which a reader would wait for ever.
 */
#ifndef BrainShift_PlainFile_h
#define BrainShift_PlainFile_h

#include <string>

namespace brainshift
{
/**
 * Why a name is not that of a plain file: the end of a sentence, after the name. Empty if it is.
 * It opens nothing.
 */
std::string plainFileProblem(const std::string& fileName);
}

#endif
