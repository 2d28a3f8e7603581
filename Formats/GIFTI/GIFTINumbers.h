// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The numbers of an array of a GIFTI file, from the text of its element Data.
 */
#ifndef BrainShift_GIFTINumbers_h
#define BrainShift_GIFTINumbers_h

#include "Formats/GIFTI/GIFTIArray.h"

#include <string>

namespace brainshift
{
/**
 * Reads type, dimensions and numbers of an array, whose attributes are there. Returns the end of a
 * sentence on what is wrong; else empty.
 */
std::string readGIFTINumbers(const std::string& text, GIFTIArray& array);
}

#endif
