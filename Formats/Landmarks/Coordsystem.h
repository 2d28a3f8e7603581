// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What BIDS says about a table of electrodes in the coordsystem.json beside it.
#ifndef BrainShift_Coordsystem_h
#define BrainShift_Coordsystem_h

#include "Formats/Landmarks/LandmarkFormats.h"

#include <optional>

namespace brainshift
{
/** What is known about a table of electrodes or optodes. */
struct ElectrodeFrame
{
  double mm = 1.0;              ///< of one unit
  std::optional<FileAxes> axes; ///< none: not said, or not known
  bool isSaid = false;          ///< a coordsystem.json says so
};

/**
 * The unit and the axes of a BIDS table of electrodes or optodes; none for any other file. Without
 * a coordsystem.json the unit is mm, with a note. A system that is not the scanner's gets a note.
 * Throws the end of a sentence, after the name of the table, if the positions are not along right,
 * front and head, or have no known unit.
 */
std::optional<ElectrodeFrame> electrodeFrame(const std::string& tableName, LandmarkList& list);
}

#endif
