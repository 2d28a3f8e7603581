// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Attributes of a DICOM data set as numbers and text. A missing attribute is empty.
#ifndef BrainShift_DICOMAttributes_h
#define BrainShift_DICOMAttributes_h

#include "Formats/DICOM/DICOMDataSet.h"

namespace brainshift
{
/** Text of an attribute, without the blanks at its ends. */
std::string textOf(const DICOMDataSet& set, DICOMTag tag);

/** Text of an attribute for the eye: UTF-8, one line, at most 64 characters. */
std::string shownTextOf(const DICOMDataSet& set, DICOMTag tag);

/** A text with a question mark for each byte that is no printable letter of ASCII. */
std::string plainText(const std::string& text);

/** Numbers written as text (VR DS, IS). Empty if one of them is no finite number. */
std::vector<double> decimalsOf(const DICOMDataSet& set, DICOMTag tag);

/** One number written as text, or `missing`. */
double decimalOf(const DICOMDataSet& set, DICOMTag tag, double missing);

/** The first number of 8 bytes in floating point (VR FD), or `missing`. */
double doubleOf(const DICOMDataSet& set, DICOMTag tag, double missing);

/** The first number of 2 bytes (VR US) or of 4 bytes (VR UL), or `missing`. */
double wholeOf(const DICOMDataSet& set, DICOMTag tag, double missing);

/** The tags that an attribute names (VR AT). */
std::vector<DICOMTag> tagsOf(const DICOMDataSet& set, DICOMTag tag);

/** A date (VR DA) as 2026-11-23; empty if it is none. */
std::string dateOf(const DICOMDataSet& set, DICOMTag tag);

/** Seconds since 1970 of a date (VR DA) and a time (VR TM), or `missing`. */
double secondsOf(const std::string& date, const std::string& time, double missing);

/** The items of a sequence; none if it is missing. */
const std::vector<DICOMDataSet>& itemsOf(const DICOMDataSet& set, DICOMTag tag);
}

#endif
