// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Words by which tables and their neighbours say units and frames of positions.
#ifndef BrainShift_CoordinateWords_h
#define BrainShift_CoordinateWords_h

#include <optional>
#include <string>

namespace brainshift
{
/** The length (mm) of a unit: mm, cm, m, um, inch and their long names, in small letters. */
std::optional<double> lengthOfUnit(const std::string& word);

/** Whether a word, in small letters, says that positions are counted, such as voxels. */
bool isNoLength(const std::string& word);
}

#endif
