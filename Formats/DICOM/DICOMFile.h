// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads the header of one DICOM file.
#ifndef BrainShift_DICOMFile_h
#define BrainShift_DICOMFile_h

#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** Whether a file exists and begins as DICOM does. */
bool isDICOMFile(const std::string& path);

/**
 * Reads the header of a file, up to its pixels: the image of a slice file, or the frames of a
 * multi-frame file with their functional groups. It has no frames if the file is damaged or holds
 * no image.
 */
DICOMFile readDICOMHeader(const std::string& path);
}

#endif
