// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Colours of DICOM images: red, green and blue, or one number of their brightness.
#ifndef BrainShift_DICOMColors_h
#define BrainShift_DICOMColors_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/**
 * Reads how a file stores colours, and its palette. Throws the end of a sentence if they are not
 * read. Images in grey, and segmentations, have none; the palette of a map of labels colours its
 * labels.
 */
void readColors(const DICOMContent& content, DICOMFile& file);

/** Bytes of a pixel in a frame that is not packed. */
int bytesOfPixel(const DICOMPixelFormat& pixels);

/** Numbers of a pixel that are handed out: 3 of colours, or 1. */
int componentsOf(const DICOMPixelFormat& pixels);

/**
 * Makes colours of a frame: three bytes a pixel, or one if `asLuminance` of the file is set.
 *
 * @param stored   pixels as plain frames have them, in the order of bytes of this machine
 */
void paintColors(const DICOMFile& file, const unsigned char* stored, void* colors);
}

#endif
