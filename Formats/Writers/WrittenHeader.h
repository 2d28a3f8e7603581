// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The bytes that stand before the numbers of a volume in each format.
 */
#ifndef BrainShift_WrittenHeader_h
#define BrainShift_WrittenHeader_h

#include "Formats/Volumes/OutgoingVolume.h"

#include <string>

namespace brainshift
{
/** The longest side of a volume in NIfTI-1, voxels. */
constexpr int LongestNIFTISide = 32767;

/** Colours of NIfTI have a type of their own: three or four components of 1 byte. */
bool isNIFTIColour(const OutgoingVolume& volume);

/** A header of NIfTI-1 with its four bytes for extensions. Sides: up to LongestNIFTISide. */
std::string niftiHeader(const OutgoingVolume& volume);

/** A header of MetaImage, up to the numbers. */
std::string metaImageHeader(const OutgoingVolume& volume);

/** A header of NRRD, up to the numbers. */
std::string nrrdHeader(const OutgoingVolume& volume);
}

#endif
