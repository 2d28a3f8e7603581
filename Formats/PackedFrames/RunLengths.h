// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Unpacks frames in RLE, DICOM's run lengths. GDCM's decoder writes behind its buffer if a
 *        frame is damaged.
 */
#ifndef BrainShift_RunLengths_h
#define BrainShift_RunLengths_h

#include "Formats/PackedFrames/FrameShape.h"

namespace brainshift
{
/** Unpacks one frame, of any bytes. */
UnpackedFrame unpackRunLengths(const std::string& packed, const FrameShape& shape);
}

#endif
