// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The attributes of a derived series: patient, study and frame of reference of an image of the
/// scanner, and a series of its own. And the bytes of its files: DICOM part 10 with explicit types
/// (VR) and the low byte first.
#ifndef BrainShift_DerivedHeader_h
#define BrainShift_DerivedHeader_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DerivedPixels.h"

namespace brainshift
{
/** Bytes of a value whose length is stored in 16 bits; values have an even length. */
constexpr std::uint32_t MostTextBytes = 65534;

/** A value of one of the types with a length of 16 bits, or a sequence. */
struct DerivedElement
{
  std::string type;  ///< two letters (VR)
  std::string bytes; ///< at most MostTextBytes; of a sequence, SQ, those of its items
};

/** Attributes in the order of a file, without its pixels and without the group of the file. */
using DerivedSet = std::map<DICOMTag, DerivedElement>;

/** What stands in the description of each series that is written. */
constexpr const char* NotForClinicalUse = "research, not for clinical use";

/**
 * Reads the attributes of an image of the scanner, without its pixels. Throws one sentence, without
 * a full stop, if there is none. A segmentation is none.
 *
 * @param like   a DICOM image, or a folder whose first DICOM image is taken
 */
void readLike(const std::string& like, DICOMDataSet& source);

///@{
/** Sets a value: letters, whole numbers (VR US, UL), tags (VR AT), the items of a sequence. */
void setText(DerivedSet& set, DICOMTag tag, const std::string& type, const std::string& text);
void setWhole(DerivedSet& set, DICOMTag tag, int number);
void setWholes(
  DerivedSet& set, DICOMTag tag, const std::string& type, const std::vector<std::uint32_t>& all);
void setSequence(DerivedSet& set, DICOMTag tag, const std::vector<DerivedSet>& items);
///@}

/** A unique identifier made of a random UUID (DICOM part 5, B.2). */
std::string newUID();

/** Patient, study and frame of reference of an image of the scanner, and the date of now. */
DerivedSet studyHeader(const DICOMDataSet& source);

/** Sets description, number and UID of a series of its own. */
void setNewSeries(const DICOMDataSet& source, DerivedSet& set);

/** What all slices share. The series gets a new number of its own (UID). */
DerivedSet sharedHeader(const DICOMDataSet& source, const DerivedPixels& pixels);

/** Sets what belongs to one slice: its place, its number, its own UID. */
void setSlice(const DerivedPixels& pixels, int slice, DerivedSet& header);

///@{
/** All bytes of a file. `set` must name its class (0008,0016) and its instance (0008,0018). */
std::string fileOf(const DerivedSet& set, const std::vector<std::uint16_t>& pixels);
std::string fileOf(const DerivedSet& set, const std::string& pixelBytes);
///@}
}

#endif
