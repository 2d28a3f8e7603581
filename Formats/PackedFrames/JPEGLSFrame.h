// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Unpacks JPEG-LS frames (ISO 14495-1) by CharLS.
 */
#ifndef BrainShift_JPEGLSFrame_h
#define BrainShift_JPEGLSFrame_h

#include "Formats/PackedFrames/FrameShape.h"

namespace brainshift
{
/** Unpacks one frame, of any bytes. */
UnpackedFrame unpackJPEGLS(const std::string& packed, const FrameShape& shape);
}

#endif
