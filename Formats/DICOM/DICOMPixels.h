// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The numbers of DICOM images, packed or not.
#ifndef BrainShift_DICOMPixels_h
#define BrainShift_DICOMPixels_h

#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** VTK's number of the type of a stored number. */
int storedTypeOf(const DICOMPixelFormat& pixels);

/** Throws the end of a sentence if a file is too short for the images that its header announces. */
void requirePixelData(const DICOMFile& file);

/** Where the numbers of a frame go. */
struct DICOMTarget
{
  const DICOMFrame* frame = nullptr;
  void* numbers = nullptr; ///< room for rows times columns
};

/**
 * Reads frames of one file, or throws the end of a sentence.
 *
 * @param type     VTK's number of the type that targets have. If it is VTK_FLOAT, numbers are
 *                 rescaled; if not, it is the stored type
 */
void readDICOMPixels(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type);
}

#endif
