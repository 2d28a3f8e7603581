// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a file of one volume does not hold of an image.
#ifndef BrainShift_LeftOut_h
#define BrainShift_LeftOut_h

#include "Formats/Volumes/OutgoingVolume.h"

class vtkInformation;

namespace brainshift
{
/**
 * Adds to the warning what is left out of the file: other times of the pipeline, names of labels,
 * and that values are labels. One sentence each, the last one without a full stop.
 */
void noteLeftOut(const std::string& fileName, vtkImageData* image, vtkInformation* pipeline,
  const OutgoingVolume& volume, std::string& warning);

/**
 * Likewise of what its numbers mean: their unit, which no file has, and that small ones are bright,
 * which a DICOM series says.
 */
void noteMeaningLeftOut(const OutgoingVolume& volume, bool isSeries, std::string& warning);
}

#endif
