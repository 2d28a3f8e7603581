// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The attributes of a derived series: patient, study and frame of reference of an image of
 *        the scanner, and a series of its own.
 */
#ifndef BrainShift_DerivedHeader_h
#define BrainShift_DerivedHeader_h

#include "Filters/DICOM/DICOMDataSet.h"
#include "Filters/DICOM/DerivedPixels.h"
#include "Filters/DICOM/DerivedSet.h"

#include <string>

namespace brainshift
{
/** What stands in the description of each series that is written. */
constexpr const char* NotForClinicalUse = "research, not for clinical use";

/**
 * Reads the attributes of an image of the scanner, without its pixels.
 *
 * @param like   a DICOM file, or a folder whose first DICOM file is taken
 * @return one sentence, without a full stop, on why there is none; empty if it was read
 */
std::string readLike(const std::string& like, DICOMDataSet& source);

/** What all slices share. The series gets a new number of its own (UID). */
DerivedSet sharedHeader(const DICOMDataSet& source, const DerivedPixels& pixels);

/** Sets what belongs to one slice: its place, its number, its own UID. */
void setSlice(const DerivedPixels& pixels, int slice, DerivedSet& header);
}

#endif
