// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Words by which tables and their neighbours say units and frames of positions.
#ifndef BrainShift_CoordinateWords_h
#define BrainShift_CoordinateWords_h

#include "Formats/Landmarks/LandmarkFormats.h"

#include <optional>

namespace brainshift
{
/** The length (mm) of a unit: mm, cm, m, um, inch and their long names, in small letters. */
std::optional<double> lengthOfUnit(const std::string& word);

/** Whether a word, in small letters, says that positions are counted, such as voxels. */
bool isNoLength(const std::string& word);

/**
 * The length (mm) of the unit in words under a key, such as "cm" or "mm, as in the scan". Throws
 * the end of a sentence if it is none, or several. Under "unit" and "units" it may be that of
 * something else, such as kOhm: none, with a note.
 */
std::optional<double> lengthUnder(
  const std::string& key, const std::string& words, LandmarkList& list);

/** Whether words have the unit of a length among them. */
bool namesLength(const std::string& words);

/** What the name of a frame says. */
struct FrameMeaning
{
  std::optional<FileAxes> axes; ///< none: the frame is not known
  std::string doubt;            ///< end of a sentence, "whose ..."; empty: the scanner's frame
};

/**
 * The frame that words of a file name, such as LPS, ScanRAS, MNI152NLin2009cAsym or CapTrak. Throws
 * the end of a sentence if its positions are voxels or pixels, or if its x points to the front.
 */
FrameMeaning frameIn(const std::string& words);

/** Notes a doubt about a frame once. */
void noteDoubt(const std::string& words, const FrameMeaning& frame, LandmarkList& list);

/** What comments or columns say about positions. */
struct SaidOfPositions
{
  std::optional<FileAxes> axes;
  std::optional<double> mm; ///< of one unit
};

/** Two statements about the same positions. Throws the end of a sentence if they differ. */
SaidOfPositions agreed(const SaidOfPositions& one, const SaidOfPositions& other);

/**
 * What the words of a comment without a known key say, such as "LPS, cm" or "coordinates: LPS". If
 * other words are among them, they may be about something else: none, with a note.
 *
 * @param isBelow   the points, where one word alone may be a heading, such as that of a group
 */
SaidOfPositions saidByWords(const std::string& comment, bool isBelow, LandmarkList& list);

///@{
/** Whether a key or a column says the unit or the frame: small letters and digits only. */
bool saysUnit(const std::string& key);
bool saysFrame(const std::string& key);
///@}

/** Small letters and digits of a name: "Coordinate_Units" is coordinateunits. */
std::string keyOf(const std::string& name);
}

#endif
