// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Where the images of a file lie and when they were taken: one image of a slice file, or the
 *        frames of a multi-frame file with their functional groups.
 */
#ifndef BrainShift_DICOMFrames_h
#define BrainShift_DICOMFrames_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DICOMFile.h"

#include <string>
#include <vector>

namespace brainshift
{
/**
 * Appends the frames of a file. Returns why they cannot be read: the end of a sentence, empty if
 * they can.
 */
std::string readDICOMFrames(const DICOMDataSet& set, int count, std::vector<DICOMFrame>& frames);
}

#endif
