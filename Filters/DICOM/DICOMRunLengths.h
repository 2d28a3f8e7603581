// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Unpacks frames in RLE, DICOM's run lengths. GDCM's decoder writes behind its buffer if a
 *        frame is damaged.
 */
#ifndef BrainShift_DICOMRunLengths_h
#define BrainShift_DICOMRunLengths_h

#include <cstddef>
#include <string>

namespace brainshift
{
/**
 * The bytes of `count` numbers, each little-endian, or an empty text if the frame is damaged.
 *
 * @param bytesOfNumber   1, 2 or 4
 */
std::string unpackRunLengths(
  const std::string& packed, std::size_t count, std::size_t bytesOfNumber);
}

#endif
