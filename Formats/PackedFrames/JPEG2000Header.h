// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What stands before the numbers of a JPEG 2000 frame (ISO 15444-1), and which tiles it has.
 */
#ifndef BrainShift_JPEG2000Header_h
#define BrainShift_JPEG2000Header_h

#include "Formats/PackedFrames/FrameShape.h"

namespace brainshift
{
/**
 * Why a frame, of any bytes, is not one of this shape with all its tiles. OpenJPEG would take
 * memory for any size that a header announces, and fill missing tiles with zeros. Empty if it is.
 */
std::string jpeg2000Problem(const std::string& packed, const FrameShape& shape);
}

#endif
