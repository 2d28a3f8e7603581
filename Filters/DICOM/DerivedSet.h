// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The attributes that are written, and the bytes of their file: DICOM part 10 with explicit
 *        types (VR) and the low byte first.
 */
#ifndef BrainShift_DerivedSet_h
#define BrainShift_DerivedSet_h

#include "Filters/DICOM/DICOMDataSet.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace brainshift
{
/** Bytes of a value whose length is stored in 16 bits; values have an even length. */
constexpr std::uint32_t MostTextBytes = 65534;

/** A value of one of the types with a length of 16 bits. */
struct DerivedElement
{
  std::string type;  ///< two letters (VR)
  std::string bytes; ///< at most MostTextBytes
};

/** Attributes in the order of a file, without its pixels and without the group of the file. */
using DerivedSet = std::map<DICOMTag, DerivedElement>;

/** Sets a value of letters. */
void setText(DerivedSet& set, DICOMTag tag, const std::string& type, const std::string& text);

/** Sets a whole number of 16 bits (VR US). */
void setWhole(DerivedSet& set, DICOMTag tag, int number);

/** A unique identifier made of a random UUID (DICOM part 5, B.2). */
std::string newUID();

/** All bytes of a file. `set` must name its class (0008,0016) and its instance (0008,0018). */
std::string fileOf(const DerivedSet& set, const std::vector<std::uint16_t>& pixels);
}

#endif
