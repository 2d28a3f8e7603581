// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads the header of one DICOM file, up to its pixels: the image of a slice file, or the
 *        frames of a multi-frame file with their functional groups.
 */
#ifndef BrainShift_DICOMHeader_h
#define BrainShift_DICOMHeader_h

#include "Filters/DICOM/DICOMFile.h"

#include <string>

namespace brainshift
{
/** The header of a file. It has no frames if the file is damaged or holds no image. */
DICOMFile readDICOMHeader(const std::string& path);
}

#endif
