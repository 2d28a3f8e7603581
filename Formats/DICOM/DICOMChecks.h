// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Attributes of a DICOM file that change what its numbers mean, and that BrainShift does not
/// honour.
#ifndef BrainShift_DICOMChecks_h
#define BrainShift_DICOMChecks_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** Throws the end of a sentence if there is an attribute that occurs twice. */
void requireOnce(const std::vector<DICOMTag>& repeated);

/** Throws the end of a sentence that names the attribute if pixels cannot be read rightly. */
void requirePixels(const DICOMDataSet& set, const DICOMPixelFormat& pixels, SegmentKind segments);

/** What is shown although an attribute may give it another meaning: ends of sentences. */
std::vector<std::string> notesOf(const DICOMDataSet& set, const DICOMFile& file);
}

#endif
