// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What the lines of a MetaImage header mean. Names such as `ElementType` are those of the
 *        format.
 */
#ifndef BrainShift_MetaImageHeader_h
#define BrainShift_MetaImageHeader_h

#include "Formats/Files/TextHeader.h"

#include <string>

namespace brainshift
{
/**
 * Fills `header` from its text. The world is LPS, as in ITK. Returns the end of a sentence, after
 * the name of the file, on what is wrong; empty if nothing is.
 */
std::string fromMetaImage(const std::string& fileName, TextHeader& header);
}

#endif
