// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads and writes points with labels. The ending of a file's name chooses the format.
 *
 * | ending           | format                  | axes in the file                        |
 * |------------------|-------------------------|-----------------------------------------|
 * | .mrk.json, .json | markups of Slicer       | the file names them                     |
 * | .fcsv            | fiducials of Slicer     | the file names them                     |
 * | .tag             | MNI Tag Point File      | RAS                                     |
 * | .csv, .tsv       | table (PointTable.h)    | the names of columns may tell, or not   |
 *
 * In memory points are RAS, mm.
 */
#ifndef BrainShift_LandmarkFile_h
#define BrainShift_LandmarkFile_h

#include "Formats/Landmarks/Landmarks.h"

#include <optional>
#include <string>

namespace brainshift
{
/** Whether a file has one of the endings and begins as its format does. */
bool isLandmarkFile(const std::string& fileName);

/**
 * Reads a file.
 *
 * @param volume      of a .tag file, whose points are read: 1 or 2
 * @param tableAxes   of a table whose columns are called x, y and z
 * @return one sentence, without a full stop, on what went wrong; empty if nothing did
 */
std::string readLandmarkFile(
  const std::string& fileName, int volume, FileAxes tableAxes, LandmarkList& list);

/**
 * Writes a file whole, or leaves the old one as it was. What the format cannot keep becomes a note
 * of `list`.
 *
 * @param axes   in which to write. None: LPS for markups and fiducials, as Slicer does; else RAS
 * @return one sentence, without a full stop, on what went wrong; empty if nothing did
 */
std::string writeLandmarkFile(
  const std::string& fileName, std::optional<FileAxes> axes, LandmarkList& list);
}

#endif
