// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Unpacks JPEG frames: baseline, extended to 12 bits, and lossless, with Huffman codes
 *        (ITU-T T.81).
 */
#ifndef BrainShift_JPEGFrame_h
#define BrainShift_JPEGFrame_h

#include "Filters/PackedFrames/FrameShape.h"

namespace brainshift
{
/**
 * Unpacks one frame, of any bytes: a damaged frame gives a problem or wrong numbers, and nothing is
 * read or written elsewhere. What follows the last pixel is not looked at.
 */
UnpackedFrame unpackJPEG(const std::string& packed, const FrameShape& shape);
}

#endif
