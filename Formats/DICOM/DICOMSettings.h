// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Images of one stack that differ in a setting of the scanner and in their time: several echoes
/// of a series of times, for example.
#ifndef BrainShift_DICOMSettings_h
#define BrainShift_DICOMSettings_h

#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** Images of one setting. */
struct DICOMSettingPart
{
  std::vector<DICOMFrame> frames;
  std::string setting; ///< what parts them from the others, such as "EchoTime 20 ms"; may be empty
};

/**
 * Parts images of one stack that have every setting (echo, diffusion weighting, inversion time,
 * flip angle, voltage) at several times, so that those of one setting are a series of times. Others
 * stay together: volumes that differ in settings alone are one after the other.
 */
std::vector<DICOMSettingPart> partedBySetting(std::vector<DICOMFrame> images);
}

#endif
