// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief MNI Tag Point Files (.tag): homologous points in one or two volumes, RAS, mm.
 *
 * After the coordinates a point may have three numbers (weight, structure, patient), which are
 * passed over, and a label in quotes. A label cannot hold the quotes around it, nor a new line.
 */
#ifndef BrainShift_TagFile_h
#define BrainShift_TagFile_h

#include "Formats/Landmarks/Landmarks.h"

#include <ostream>
#include <string>

namespace brainshift
{
/**
 * Reads the text of a file. Returns the end of a sentence on what is wrong; else empty.
 *
 * @param volume   whose points are read: 1 or 2
 */
std::string readTags(const std::string& text, int volume, LandmarkList& list);

/** Whether a text begins like such a file. */
bool looksLikeTags(const std::string& beginning);

/** Writes points of one volume. Quotes in labels become apostrophes, new lines spaces. */
void writeTags(std::ostream& file, const LandmarkList& list);

/** Whether a label changes when it is written. */
bool isChangedInTags(const std::string& label);
}

#endif
