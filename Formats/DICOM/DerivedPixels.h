// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers of a volume as DICOM stores them: 16 bits, with slope and intercept.
///
/// Positions are LPS: x to the patient's left, y to the back, z to the head, in mm.
#ifndef BrainShift_DerivedPixels_h
#define BrainShift_DerivedPixels_h

#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/VolumeFile.h"

#include <cstdint>

namespace brainshift
{
/** A decimal number as DICOM writes it (VR DS): at most 16 characters. */
std::string decimalText(double number);

/** What becomes of a volume. */
struct DerivedPixels
{
  Grid grid;                  ///< mm, LPS; its first two axes run to the left, the back or the feet
  Rescaling rescaling;        ///< value = slope * stored + intercept
  bool isSigned = true;       ///< the 16 bits
  bool smallIsBright = false; ///< MONOCHROME1
  std::array<bool, 2> reversed{}; ///< whether columns, rows run against the volume's
};

/**
 * Says how a volume is stored. Whole numbers of 1 or 2 bytes keep their values, and so do all
 * others that are whole and fit. The rest are rounded to 65536 steps from the lowest value to the
 * highest. Throws one sentence, without a full stop, if the volume cannot be stored.
 */
void derivedPixels(const OutgoingVolume& volume, DerivedPixels& pixels);

/** The 16 bits of each pixel of a slice, row by row. */
std::vector<std::uint16_t> derivedSlice(
  const OutgoingVolume& volume, const DerivedPixels& pixels, int slice);
}

#endif
