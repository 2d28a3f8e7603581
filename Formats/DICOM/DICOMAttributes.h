// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Attributes of a DICOM data set as numbers and text. A missing attribute is empty.
#ifndef BrainShift_DICOMAttributes_h
#define BrainShift_DICOMAttributes_h

#include "Formats/DICOM/DICOMDataSet.h"

#include <optional>

namespace brainshift
{
/** Letters that a long string (VR LO) may have. */
constexpr std::size_t LongestText = 64;

constexpr double DayS = 86400.0; ///< seconds of a day

/** How many letters a text in UTF-8 has. */
std::size_t lettersOf(const std::string& text);

/** The first letters of a text in UTF-8, at most LongestText. */
std::string firstLettersOf(const std::string& text);

/** Text of an attribute, without the blanks at its ends. */
std::string textOf(const DICOMDataSet& set, DICOMTag tag);

/** Text of an attribute for the eye: UTF-8, one line, at most 64 characters. */
std::string shownTextOf(const DICOMDataSet& set, DICOMTag tag);

/** Likewise of an item, with the characters (SpecificCharacterSet) of its file. */
std::string shownTextOf(const DICOMDataSet& set, DICOMTag tag, const std::string& characters);

/** The characters of a file (SpecificCharacterSet). */
std::string charactersOf(const DICOMDataSet& set);

/** A text with a question mark for each byte that is no printable letter of ASCII. */
std::string plainText(const std::string& text);

/** Numbers written as text (VR DS, IS). Empty if one of them is no finite number. */
std::vector<double> decimalsOf(const DICOMDataSet& set, DICOMTag tag);

/** An attribute and its keyword in the standard, for sentences. */
struct DICOMName
{
  DICOMTag tag;
  const char* keyword;
};

/**
 * Numbers written as text that count: `count` of them, or any number if it is 0. Empty if the
 * attribute is missing or empty. Throws the end of a sentence that names it if it holds other text
 * or other numbers than so many.
 */
std::vector<double> requiredDecimals(
  const DICOMDataSet& set, const DICOMName& name, std::size_t count);

/** One number written as text, or `missing`. */
double decimalOf(const DICOMDataSet& set, DICOMTag tag, double missing);

/** The first number of 8 bytes in floating point (VR FD), or `missing`. */
double doubleOf(const DICOMDataSet& set, DICOMTag tag, double missing);

/** The first number of 2 bytes (VR US) or of 4 bytes (VR UL), or `missing`. */
double wholeOf(const DICOMDataSet& set, DICOMTag tag, double missing);

/** All numbers of 2 bytes (VR US). */
std::vector<int> wholesOf(const DICOMDataSet& set, DICOMTag tag);

/** The tags that an attribute names (VR AT). */
std::vector<DICOMTag> tagsOf(const DICOMDataSet& set, DICOMTag tag);

/** A date (VR DA) as 2026-11-23; empty if it is none. */
std::string dateOf(const DICOMDataSet& set, DICOMTag tag);

/** Seconds since 1970 of a date (VR DA) and a time (VR TM), since midnight where no date is said.
 * Also as older files have them: 2026.11.23 and 10:15:30. Nothing if one is none. */
std::optional<double> secondsOf(const std::string& date, const std::string& time);

/** Seconds since 1970 of a date and time in one (VR DT), in UTC if it has its offset from UTC. */
std::optional<double> secondsOf(const std::string& moment);

/** Whether two data sets have the same attributes with the same values. */
bool isSame(const DICOMDataSet& a, const DICOMDataSet& b);

/** The items of a sequence; none if it is missing. */
const std::vector<DICOMDataSet>& itemsOf(const DICOMDataSet& set, DICOMTag tag);
}

#endif
