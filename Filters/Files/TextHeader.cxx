// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Files/TextHeader.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Files/PlainFile.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
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

// All numbers in a text. What is no number ends the list with one that no place takes: half of a
// number must not count as a number.
std::vector<double> numbersIn(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string word; stream >> word;)
  {
    const std::size_t plus = word[0] == '+' ? 1 : 0;
    double number = 0.0;
    const char* const end = word.data() + word.size();
    const std::from_chars_result found = std::from_chars(word.data() + plus, end, number);
    if (found.ec != std::errc() || found.ptr != end)
    {
      numbers.push_back(std::numeric_limits<double>::quiet_NaN());
      break;
    }
    numbers.push_back(number);
  }
  return numbers;
}

// All numbers of vectors such as "(1,0,0) (0,1,0)". None if anything else stands there.
std::vector<double> vectorsIn(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (char open = 0; stream >> open;)
  {
    double number[3];
    char after[3];
    for (int i = 0; i < 3; ++i)
    {
      stream >> number[i] >> after[i];
    }
    if (!stream || open != '(' || after[0] != ',' || after[1] != ',' || after[2] != ')')
    {
      return {};
    }
    numbers.insert(numbers.end(), number, number + 3);
  }
  return numbers;
}

// As in ITK, the first letter decides.
bool isTrue(const std::string& value)
{
  return !value.empty() && (value[0] == 'T' || value[0] == 't' || value[0] == '1');
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
    if (!(sides[axis] >= 1.0 && sides[axis] <= 65535.0) || sides[axis] != std::floor(sides[axis]))
    {
      return "has a side of " + std::to_string(sides[axis]) +
        " points; it must have a whole number from 1 to 65535";
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
  const std::string wrong = problemOfGrid(grid);
  if (!wrong.empty())
  {
    return "lies where no field can: its " + wrong;
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
  // Without a spacing, the size of a voxel is the spacing; without both, it is 1 mm.
  const std::string spacingText = valueOf(lines, { "ElementSpacing", "ElementSize" });
  std::vector<double> spacing = numbersIn(spacingText);
  spacing = spacingText.empty() ? std::vector<double>{ 1, 1, 1 } : spacing;
  if (spacing.size() != 3)
  {
    return "has the spacing " + spacingText + "; it must have 3 numbers (mm)";
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
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
  const std::string endian = valueOf(lines, { "endian" });
  header.isBigEndian = endian == "big";
  if (!header.isBigEndian && endian != "little")
  {
    return "has the endian '" + endian + "'; it must be little or big";
  }
  const std::string directions = valueOf(lines, { "space directions" });
  const std::string none = "none"; // the numbers of a point have no direction
  const bool isOfPoints = directions.compare(0, none.size(), none) == 0;
  const std::vector<double> steps =
    vectorsIn(isOfPoints ? directions.substr(none.size()) : directions);
  const std::vector<double> origin = vectorsIn(valueOf(lines, { "space origin" }));
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

// The bytes of a file in which a header must end.
std::string readStart(const std::string& fileName, std::string& text)
{
  std::ifstream file(fileName, std::ios::binary);
  if (!file)
  {
    return "cannot be opened";
  }
  text.resize(LongestHeader);
  file.read(&text[0], static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return {};
}

// Puts the lines of a header under their keys; `end` is the byte after it. False if the text ends
// before the header does.
bool splitLines(const std::string& text, bool isNRRD, Lines& lines, std::size_t& end)
{
  for (std::size_t begin = 0; begin < text.size(); begin = end)
  {
    const std::size_t newLine = text.find('\n', begin);
    if (newLine == std::string::npos && text.size() == LongestHeader)
    {
      return false;
    }
    const std::string line = text.substr(begin, newLine - begin);
    end = newLine == std::string::npos ? text.size() : newLine + 1;
    if (isNRRD && trimmed(line).empty())
    {
      return true; // the numbers follow
    }
    const std::size_t mark = line.find(isNRRD ? ':' : '=');
    if (mark == std::string::npos || line[0] == '#')
    {
      continue;
    }
    const std::size_t value = line.compare(mark, 2, ":=") == 0 ? mark + 2 : mark + 1;
    lines[trimmed(line.substr(0, mark))] = trimmed(line.substr(value));
    if (!isNRRD && lines.count("ElementDataFile"))
    {
      return true;
    }
  }
  return text.size() < LongestHeader;
}

std::string controlProblem(const std::string& header)
{
  const auto isControl = [](char c) {
    return (c >= 0 && c < ' ' && c != '\t' && c != '\r' && c != '\n') || c == '\x7f';
  };
  const auto found = std::find_if(header.begin(), header.end(), isControl);
  return found == header.end() ? std::string()
                               : "has a header with the control character " +
      std::to_string(static_cast<int>(*found)) + "; a header must be text";
}

std::string skipProblem(const Lines& lines)
{
  for (const char* key : { "HeaderSize", "byte skip", "byteskip", "line skip", "lineskip" })
  {
    const std::string skip = valueOf(lines, { key });
    if (!skip.empty() && skip != "0")
    {
      return std::string("has ") + key + " " + skip +
        " before its numbers; nothing must be skipped";
    }
  }
  return {};
}
}

std::string shownWords(const std::string& words)
{
  constexpr std::size_t MostLetters = 200;
  std::string shown = words.substr(0, MostLetters);
  std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return words.size() > MostLetters ? shown + "..." : shown;
}

std::string readTextHeader(const std::string& fileName, TextHeader& header)
{
  std::string problem = plainFileProblem(fileName);
  std::string text;
  problem = problem.empty() ? readStart(fileName, text) : problem;
  Lines lines;
  std::size_t end = 0;
  const bool isNRRD = text.compare(0, 4, "NRRD") == 0;
  if (problem.empty() && !splitLines(text, isNRRD, lines, end))
  {
    problem = "has no end of a header in its first " + std::to_string(LongestHeader) + " bytes";
  }
  problem = problem.empty() ? controlProblem(text.substr(0, end)) : problem;
  problem = problem.empty() ? skipProblem(lines) : problem;
  if (!problem.empty())
  {
    return shownWords(problem);
  }
  header = TextHeader();
  problem = isNRRD ? fromNRRD(lines, header) : fromMetaImage(lines, header);
  header.headerBytes = header.dataFile.empty() ? end : 0;
  return shownWords(problem);
}
}
