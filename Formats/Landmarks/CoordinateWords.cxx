// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/CoordinateWords.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace brainshift
{
std::optional<double> lengthOfUnit(const std::string& word)
{
  static const std::map<std::string, double> lengths{ { "mm", 1.0 }, { "millimeter", 1.0 },
    { "millimeters", 1.0 }, { "millimetre", 1.0 }, { "millimetres", 1.0 }, { "cm", 10.0 },
    { "centimeter", 10.0 }, { "centimeters", 10.0 }, { "centimetre", 10.0 },
    { "centimetres", 10.0 }, { "m", 1000.0 }, { "meter", 1000.0 }, { "meters", 1000.0 },
    { "metre", 1000.0 }, { "metres", 1000.0 }, { "um", 1e-3 }, { "\xc2\xb5m", 1e-3 },
    { "\xce\xbcm", 1e-3 }, { "micrometer", 1e-3 }, { "micrometers", 1e-3 }, { "micrometre", 1e-3 },
    { "micrometres", 1e-3 }, { "inch", 25.4 }, { "inches", 25.4 } };
  const auto found = lengths.find(word);
  return found == lengths.end() ? std::nullopt : std::optional<double>(found->second);
}

bool isNoLength(const std::string& word)
{
  constexpr const char* Words[] = { "vox", "voxel", "voxels", "px", "pixel", "pixels", "ijk",
    "index", "indices", "slice", "row", "column", "deg", "degrees", "km", "ft", "feet", "foot" };
  return std::find(std::begin(Words), std::end(Words), word) != std::end(Words);
}
}
