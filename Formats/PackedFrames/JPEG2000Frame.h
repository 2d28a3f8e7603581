// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Unpacks JPEG 2000 frames (ISO 15444-1) by OpenJPEG.
 */
#ifndef BrainShift_JPEG2000Frame_h
#define BrainShift_JPEG2000Frame_h

#include "Formats/PackedFrames/FrameShape.h"

namespace brainshift
{
/** Unpacks one frame, of any bytes: a stream of codes, or a file in the format JP2. */
UnpackedFrame unpackJPEG2000(const std::string& packed, const FrameShape& shape);
}

#endif
