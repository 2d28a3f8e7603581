// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Unpacks frames in RLE, DICOM's run-length encoding (part 5, annex G).
 */
#ifndef BrainShift_RunLengths_h
#define BrainShift_RunLengths_h

#include "Filters/PackedFrames/FrameShape.h"

namespace brainshift
{
/** Unpacks one frame, of any bytes. */
UnpackedFrame unpackRunLengths(const std::string& packed, const FrameShape& shape);
}

#endif
