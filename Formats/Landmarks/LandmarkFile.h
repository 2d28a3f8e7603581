// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads and writes points with labels. The ending of a file's name chooses the format.
///
/// | ending           | format                  | axes in the file                        |
/// |------------------|-------------------------|-----------------------------------------|
/// | .mrk.json, .json | markups of Slicer       | the file names them                     |
/// | .fcsv            | fiducials of Slicer     | the file names them                     |
/// | .tag             | MNI Tag Point File      | RAS                                     |
/// | .csv, .tsv       | table (PointTable.cxx)  | the names of columns may tell, or not   |
///
/// In memory points are RAS, mm.
#ifndef BrainShift_LandmarkFile_h
#define BrainShift_LandmarkFile_h

#include "Common/Problem.h"
#include "Formats/Landmarks/LandmarkFormats.h"

#include <optional>

namespace brainshift
{
/** Whether a file has one of the endings and begins as its format does. */
bool isLandmarkFile(const std::string& fileName);

/**
 * Reads a file, or throws one sentence, without a full stop.
 *
 * @param volume   of a .tag file, whose points are read: 1 or 2; 0: the first, with a note if there
 *                 are two
 * @param table    what a table does not tell; its unit comes from the coordsystem.json of BIDS
 */
LandmarkList readLandmarkFile(const std::string& fileName, int volume, const TableRule& table);

/**
 * Writes a file whole, or leaves the old one as it was and throws one sentence, without a full
 * stop. What the format cannot keep becomes a note of `list`.
 *
 * @param axes   in which to write. None: LPS for markups and fiducials, as Slicer does; else RAS
 */
void writeLandmarkFile(
  const std::string& fileName, std::optional<FileAxes> axes, LandmarkList& list);
}

#endif
