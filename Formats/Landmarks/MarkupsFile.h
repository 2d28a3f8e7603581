// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Slicer's markups (.mrk.json): lists of control points that name their axes.
 *
 * Points that Slicer has not placed ("positionStatus" other than "defined", no "position") are left
 * out and noted. Of the schema only the control points are read. A list that names no coordinate
 * system is LPS, the schema's default.
 */
#ifndef BrainShift_MarkupsFile_h
#define BrainShift_MarkupsFile_h

#include "Formats/Landmarks/Landmarks.h"

#include <ostream>
#include <string>

namespace brainshift
{
/** Reads the text of a file. Returns the end of a sentence on what is wrong; else empty. */
std::string readMarkups(const std::string& text, LandmarkList& list);

/** Whether a text begins like such a file. */
bool looksLikeMarkups(const std::string& beginning);

/** Writes one list of the type Fiducial. */
void writeMarkups(std::ostream& file, FileAxes axes, const LandmarkList& list);
}

#endif
