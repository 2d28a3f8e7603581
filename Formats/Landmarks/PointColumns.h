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
/** Three columns of a table. */
struct PointColumns
{
  std::array<std::size_t, 3> at{}; ///< of x, y, z, or of right, front, head and so on
  std::array<std::string, 3> names;
  std::optional<FileAxes> axes; ///< none if the names do not tell
  std::optional<double> mm;     ///< of one unit; none if the names do not tell
  std::string space;            ///< such as MNI; empty: that of the scanner, or unknown
};

/**
 * Finds the columns. None if no names mean a position.
 *
 * @param header   the names of all columns
 * @param wanted   names of three columns, or none: then what the names mean decides
 *
 * Throws the end of a sentence, after the name of the file, if a wanted name is not there or twice,
 * and if several sets of columns are positions.
 */
std::optional<PointColumns> pointColumnsIn(
  const std::vector<std::string>& header, const std::vector<std::string>& wanted);
}

#endif
