// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Files/TextHeader.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

namespace brainshift
{
namespace
{
constexpr double LargestSkew = 1e-3;           // cosine between two axes
constexpr std::size_t LongestHeader = 1 << 20; // bytes; what is longer is no header

using Lines = std::map<std::string, std::string>;

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  const std::size_t last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

// Value of the first of some keys that the header has; empty if it has none.
std::string valueOf(const Lines& lines, const std::vector<std::string>& keys)
{
  for (const std::string& key : keys)
  {
    const auto line = lines.find(key);
    if (line != lines.end())
    {
      return line->second;
    }
  }
  return {};
}

// All numbers in a text, whatever stands between them.
std::vector<double> numbersIn(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number; stream >> number;)
  {
    numbers.push_back(number);
  }
  return numbers;
}

bool isTrue(const std::string& value)
{
  return value == "True" || value == "true" || value == "1";
}

// Sides and, as columns, the steps from one point to the next.
std::string place(const std::vector<double>& sides, const std::vector<double>& origin,
  const std::vector<double>& steps, Grid& grid)
{
  if (sides.size() != 3 || origin.size() != 3 || steps.size() != 9)
  {
    return "does not place points in 3 dimensions";
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(sides[axis] >= 1.0 && sides[axis] <= 65535.0))
    {
      return "has a side of " + std::to_string(sides[axis]) +
        " points; it must have from 1 to 65535";
    }
    const glm::dvec3 step(steps[3 * axis], steps[3 * axis + 1], steps[3 * axis + 2]);
    grid.dimensions[axis] = static_cast<int>(sides[axis]);
    grid.origin[axis] = origin[axis];
    grid.spacing[axis] = glm::length(step);
    grid.direction[axis] = step / grid.spacing[axis];
    if (!std::isfinite(grid.origin[axis]) || !(grid.spacing[axis] > 0.0) ||
      !std::isfinite(grid.spacing[axis]))
    {
      return "has an origin that is not finite, or a spacing that is 0 or not finite";
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const double skew = glm::dot(grid.direction[axis], grid.direction[(axis + 1) % 3]);
    if (std::abs(skew) > LargestSkew)
    {
      return "has axes that are not at right angles: the cosine between two is " +
        std::to_string(skew) + "; the limit is " + std::to_string(LargestSkew);
    }
  }
  return {};
}

std::string fromMetaImage(const Lines& lines, TextHeader& header)
{
  if (valueOf(lines, { "ElementNumberOfChannels" }) != "3")
  {
    return "holds " + valueOf(lines, { "ElementNumberOfChannels" }) +
      " components per point (ElementNumberOfChannels); a field must have 3";
  }
  const std::string type = valueOf(lines, { "ElementType" });
  header.isDouble = type == "MET_DOUBLE" || type == "MET_DOUBLE_ARRAY";
  if (!header.isDouble && type != "MET_FLOAT" && type != "MET_FLOAT_ARRAY")
  {
    return "has the ElementType " + type + "; a field must have MET_FLOAT or MET_DOUBLE";
  }
  if (!isTrue(valueOf(lines, { "BinaryData" })))
  {
    return "holds its numbers as text (BinaryData); they must be binary";
  }
  header.isBigEndian = isTrue(valueOf(lines, { "BinaryDataByteOrderMSB", "ElementByteOrderMSB" }));
  header.isPacked = isTrue(valueOf(lines, { "CompressedData" }));
  std::vector<double> steps =
    numbersIn(valueOf(lines, { "TransformMatrix", "Rotation", "Orientation" }));
  steps = steps.empty() ? std::vector<double>{ 1, 0, 0, 0, 1, 0, 0, 0, 1 } : steps;
  const std::vector<double> spacing = numbersIn(valueOf(lines, { "ElementSpacing" }));
  for (std::size_t i = 0; i < steps.size() && spacing.size() == 3; ++i)
  {
    steps[i] *= spacing[std::min<std::size_t>(i / 3, 2)];
  }
  const std::string comment = valueOf(lines, { "Comment" });
  if (comment == ForwardComment || comment == BackwardComment)
  {
    header.direction = comment == ForwardComment ? Direction::Forward : Direction::Backward;
  }
  const std::string dataFile = valueOf(lines, { "ElementDataFile" });
  header.dataFile = dataFile == "LOCAL" ? std::string() : dataFile;
  return place(numbersIn(valueOf(lines, { "DimSize" })),
    numbersIn(valueOf(lines, { "Offset", "Position", "Origin" })), steps, header.grid);
}

std::string fromNRRD(const Lines& lines, TextHeader& header)
{
  std::vector<double> sides = numbersIn(valueOf(lines, { "sizes" }));
  if (sides.size() != 4 || sides[0] != 3.0)
  {
    return "has the sizes " + valueOf(lines, { "sizes" }) +
      "; a field must have 4, the first of them 3 numbers per point";
  }
  sides.erase(sides.begin());
  const std::string type = valueOf(lines, { "type" });
  header.isDouble = type == "double";
  if (!header.isDouble && type != "float")
  {
    return "has the type " + type + "; a field must have float or double";
  }
  const std::string encoding = valueOf(lines, { "encoding" });
  header.isPacked = encoding == "gzip" || encoding == "gz";
  if (!header.isPacked && encoding != "raw")
  {
    return "has the encoding " + encoding + "; it must be raw or gzip";
  }
  header.isBigEndian = valueOf(lines, { "endian" }) == "big";
  std::string directions = valueOf(lines, { "space directions" });
  directions.erase(0, directions.find('(') == std::string::npos ? 0 : directions.find('('));
  std::vector<double> steps = numbersIn(directions);
  std::vector<double> origin = numbersIn(valueOf(lines, { "space origin" }));
  const std::string space = valueOf(lines, { "space" });
  if (space == "right-anterior-superior" || space == "RAS")
  {
    return "lies in the space " + space + "; a field must lie in left-posterior-superior";
  }
  if (space != "left-posterior-superior" && space != "LPS")
  {
    return "does not lie in the space left-posterior-superior";
  }
  const std::string kind = valueOf(lines, { "displacement field type" });
  if (kind == "modeling" || kind == "resampling")
  {
    header.direction = kind == "modeling" ? Direction::Forward : Direction::Backward;
  }
  header.dataFile = valueOf(lines, { "data file", "datafile" });
  return place(sides, origin, steps, header.grid);
}
}

std::string readTextHeader(const std::string& fileName, TextHeader& header)
{
  std::ifstream file(fileName, std::ios::binary);
  if (!file)
  {
    return "cannot be opened";
  }
  std::string line;
  std::getline(file, line);
  const bool isNRRD = line.compare(0, 4, "NRRD") == 0;
  Lines lines;
  for (bool more = true; more && file && static_cast<std::size_t>(file.tellg()) < LongestHeader;
    more = static_cast<bool>(std::getline(file, line)))
  {
    if (isNRRD && trimmed(line).empty())
    {
      break; // the numbers follow
    }
    const std::size_t mark = line.find(isNRRD ? ':' : '=');
    if (mark == std::string::npos || line[0] == '#')
    {
      continue;
    }
    const std::size_t value = line.compare(mark, 2, ":=") == 0 ? mark + 2 : mark + 1;
    lines[trimmed(line.substr(0, mark))] = trimmed(line.substr(value));
    if (lines.count("ElementDataFile"))
    {
      break;
    }
  }
  const std::string skip = valueOf(lines, { "HeaderSize", "byte skip", "line skip" });
  if (!skip.empty() && skip != "0")
  {
    return "has bytes to skip before its numbers (" + skip + "); there must be none";
  }
  header = TextHeader();
  const std::string problem = isNRRD ? fromNRRD(lines, header) : fromMetaImage(lines, header);
  header.headerBytes = header.dataFile.empty() && file ? static_cast<std::size_t>(file.tellg()) : 0;
  return problem;
}
}
