// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Slicer's fiducials (.fcsv): comment lines that name version, axes and columns, then a line
 *        for each point.
 *
 * A file without the line "# columns" has those of version 4. A file without the line
 * "# CoordinateSystem" is RAS, as files were before that line. Points that Slicer 5 marks as not
 * placed are left out and noted.
 */
#ifndef BrainShift_FiducialFile_h
#define BrainShift_FiducialFile_h

#include "Formats/Landmarks/Landmarks.h"

#include <ostream>
#include <string>

namespace brainshift
{
/** Reads the text of a file. Returns the end of a sentence on what is wrong; else empty. */
std::string readFiducials(const std::string& text, LandmarkList& list);

/** Whether a text begins like such a file. */
bool looksLikeFiducials(const std::string& beginning);

/** Writes a file as Slicer 5 does. */
void writeFiducials(std::ostream& file, FileAxes axes, const LandmarkList& list);
}

#endif
