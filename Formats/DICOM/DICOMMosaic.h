// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Mosaics of Siemens and of United Imaging: pictures whose tiles are the slices of a volume.
#ifndef BrainShift_DICOMMosaic_h
#define BrainShift_DICOMMosaic_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/**
 * Divides a mosaic: rows, columns and frames of the file become those of its tiles. The private
 * attributes of Siemens give their number and the direction from tile to tile, those of United
 * Imaging the position of each. Throws the end of a
 * sentence if the file is a mosaic and lacks one of them. Adds a note if it may be one.
 */
void cutMosaic(const DICOMDataSet& set, DICOMFile& file);
}

#endif
