// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which columns of a table hold positions: their names tell axes, unit and space. README.md lists
/// the words.
#ifndef BrainShift_PointColumns_h
#define BrainShift_PointColumns_h

#include "Formats/Landmarks/LandmarkFormats.h"

#include <array>
#include <optional>

namespace brainshift
{
/** Three columns of a table: of x, y, z, or of right, front, head and so on. */
struct PointColumns
{
  std::array<std::size_t, 3> at{};
  std::array<std::string, 3> names;
  std::array<double, 3> signs{ 1.0, 1.0, 1.0 }; ///< -1 where a column counts the other way
  std::array<std::optional<double>, 3> mm;      ///< of one unit; none if the names do not tell
  std::optional<FileAxes> axes;                 ///< none if the names do not tell
  std::string space;                            ///< such as mni; empty: the scanner's, or unknown
  std::string unknown; ///< words of the caller's columns that mean nothing here
};

/**
 * Finds the columns. None if no names mean a position.
 *
 * @param header   the names of all columns
 * @param wanted   names of three columns, or none: then what the names mean decides. Words of the
 *                 names count, too: columns L, A and S are in this order along left, front, head.
 *
 * Throws the end of a sentence, after the name of the file, if a wanted name is not there or twice,
 * if wanted names contradict each other, and if several sets of columns are positions.
 */
std::optional<PointColumns> pointColumnsIn(
  const std::vector<std::string>& header, const std::vector<std::string>& wanted);
}

#endif
