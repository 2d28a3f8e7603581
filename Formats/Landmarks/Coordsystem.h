// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What BIDS says about a table of electrodes in the coordsystem.json beside it.
#ifndef BrainShift_Coordsystem_h
#define BrainShift_Coordsystem_h

#include "Formats/Landmarks/LandmarkFormats.h"

#include <optional>

namespace brainshift
{
/**
 * The unit (mm) of a BIDS table of electrodes or optodes; none for any other file. Without a
 * coordsystem.json it is 1, with a note. Throws the end of a sentence, after the name of the table,
 * if the positions are not along right, front and head, or have no known unit.
 */
std::optional<double> electrodeUnit(const std::string& tableName, LandmarkList& list);
}

#endif
