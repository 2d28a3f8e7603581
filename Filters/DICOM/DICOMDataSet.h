// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The attributes of a DICOM file up to its pixels.
 *
 * Values of private groups are skipped, and those of the patient's group (0010) unless a user asked
 * for them.
 */
#ifndef BrainShift_DICOMDataSet_h
#define BrainShift_DICOMDataSet_h

#include "Filters/DICOM/DICOMBytes.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace brainshift
{
/** Group and element, such as 0x00280010. */
using DICOMTag = std::uint32_t;

struct DICOMElement;

/** Attributes by their tags. */
struct DICOMDataSet
{
  std::map<DICOMTag, DICOMElement> elements;
  bool isBigEndian = false; ///< the numbers in values
};

/** A value as it is stored, or the items of a sequence. */
struct DICOMElement
{
  std::uint32_t length = 0; ///< bytes in the file; of more than 1 MiB none are kept
  std::string bytes;
  std::vector<DICOMDataSet> items;
};

/** What stands before the pixels of a file. */
struct DICOMContent
{
  std::string transferSyntax; ///< its UID
  DICOMDataSet set;
  std::uint64_t end = 0;         ///< offset where the attributes end, or are damaged, bytes
  std::uint64_t pixelOffset = 0; ///< 0: there are no pixels
  std::uint64_t pixelLength = 0; ///< bytes, unless it is packed
  bool isPacked = false;         ///< the pixels come in fragments
};

/** What becomes of the patient's group (0010). */
enum class PatientGroup
{
  Skipped,
  Kept
};

/**
 * Reads up to the pixels. Bytes that are deflated are inflated in `bytes`. False if the file is
 * damaged: if a length leads behind the end of what holds it, for example.
 */
bool parseDICOM(
  DICOMBytes& bytes, DICOMContent& content, PatientGroup patient = PatientGroup::Skipped);

/**
 * The packed frames of a file: each of one fragment, or of several by the offset table. Empty if
 * the fragments are damaged or do not make up so many frames.
 */
std::vector<std::string> packedFrames(
  DICOMBytes& bytes, const DICOMContent& content, std::size_t frames);
}

#endif
