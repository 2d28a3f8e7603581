// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Tables of points (.csv, .tsv) whose first line names the columns.
 *
 * | column                     | names, in capitals or not               |
 * |----------------------------|-----------------------------------------|
 * | position, mm               | x y z; r a s; l p s; Points:0 Points:1 Points:2 |
 * | label                      | label, name                             |
 * | time, deviation, number    | time, deviation, number                 |
 * | 0: the point has no place  | defined                                 |
 *
 * Columns r, a, s and l, p, s name their axes themselves. "(mm)" or "[mm]" may follow a name.
 * Separators are commas, semicolons or tabs. Lines before the names that begin with # are passed
 * over. Slicer's tables of markups are such tables.
 */
#ifndef BrainShift_PointTable_h
#define BrainShift_PointTable_h

#include "Formats/Landmarks/Landmarks.h"

#include <ostream>
#include <string>

namespace brainshift
{
/**
 * Reads the text of a file. Returns the end of a sentence on what is wrong; else empty.
 *
 * @param axes   of columns that are called x, y and z
 */
std::string readPointTable(const std::string& text, FileAxes axes, LandmarkList& list);

/** Whether a text begins with the names of columns. */
bool looksLikePointTable(const std::string& beginning);

/** Writes a table with commas, or tabs. Its columns are called r, a, s or l, p, s. */
void writePointTable(std::ostream& file, FileAxes axes, char separator, const LandmarkList& list);
}

#endif
