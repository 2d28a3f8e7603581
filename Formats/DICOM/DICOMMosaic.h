// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Siemens' mosaics: pictures whose tiles are the slices of a volume.
#ifndef BrainShift_DICOMMosaic_h
#define BrainShift_DICOMMosaic_h

#include "Formats/DICOM/DICOMDataSet.h"

namespace brainshift
{
/** Throws the end of a sentence if a file says that it is one, in its ImageType or privately. */
void requireNoMosaic(const DICOMDataSet& set);

/**
 * The end of a sentence if an image of Siemens is so much larger than what was measured that it may
 * be a mosaic, although nothing in it says so, as after private attributes were removed. Empty: no.
 */
std::string noteOfMosaic(const DICOMDataSet& set);
}

#endif
