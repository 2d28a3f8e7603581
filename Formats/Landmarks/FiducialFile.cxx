// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/FiducialFile.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/PlainText.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace brainshift
{
namespace
{
using Words = std::vector<std::string>;

constexpr const char* Columns = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";
constexpr std::size_t StatusColumn = 14; // Slicer 5 appends it without a name
constexpr const char* Placed = "2";

// What the comment lines say.
struct Header
{
  FileAxes axes = FileAxes::RAS;
  std::array<std::size_t, 3> position{ 1, 2, 3 };
  std::size_t label = 11;
  bool hasStatus = true;
};

std::string readColumns(const std::string& names, Header& header)
{
  Words columns;
  RecordReader(names, ',').next(columns);
  std::transform(columns.begin(), columns.end(), columns.begin(),
    [](const std::string& name) { return lowerCase(trimmed(name)); });
  const auto indexOf = [&](const char* name) {
    return static_cast<std::size_t>(
      std::find(columns.begin(), columns.end(), name) - columns.begin());
  };
  header.position = { indexOf("x"), indexOf("y"), indexOf("z") };
  header.label = indexOf("label");
  header.hasStatus = columns.size() <= StatusColumn;
  return *std::max_element(header.position.begin(), header.position.end()) < columns.size()
    ? ""
    : "has no columns x, y and z; it names " + shownWords(names);
}

// A comment "# key = value", and others, which say nothing.
std::string readComment(const std::string& line, Header& header)
{
  const std::size_t mark = line.find('=');
  if (mark == std::string::npos)
  {
    return {};
  }
  const std::string key = lowerCase(trimmed(line.substr(1, mark - 1)));
  const std::string value = trimmed(line.substr(mark + 1));
  if (key == "coordinatesystem")
  {
    return axesFrom(value, header.axes);
  }
  return key == "columns" ? readColumns(value, header) : std::string();
}

std::string readPoint(const Words& values, const Header& header, Landmark& point)
{
  glm::dvec3 position(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t column = header.position[axis];
    const std::string word = column < values.size() ? values[column] : "";
    const std::optional<double> number = numberIn(trimmed(word));
    if (!number)
    {
      return std::string("has no number ") + "xyz"[axis] + ", but \"" + shownWords(word) + "\"";
    }
    position[axis] = *number;
  }
  point.position = inAxes(header.axes, position);
  point.label = header.label < values.size() ? validUtf8(trimmed(values[header.label])) : "";
  return {};
}
}

std::string readFiducials(const std::string& text, LandmarkList& list)
{
  Header header;
  std::size_t read = 0;
  std::size_t skipped = 0;
  Words values;
  RecordReader records(text, ',');
  while (records.next(values))
  {
    const std::string where = "line " + std::to_string(records.line());
    const std::string first = trimmed(values[0]);
    if (first[0] == '#')
    {
      std::string line = first;
      for (std::size_t i = 1; i < values.size(); ++i)
      {
        line += "," + values[i];
      }
      const std::string problem = readComment(line, header);
      if (!problem.empty())
      {
        return problem;
      }
      continue;
    }
    Landmark point;
    point.number = static_cast<double>(++read);
    const bool isPlaced =
      !header.hasStatus || values.size() <= StatusColumn || trimmed(values[StatusColumn]) == Placed;
    skipped += isPlaced ? 0 : 1;
    std::string problem = isPlaced ? readPoint(values, header, point) : std::string();
    if (!problem.empty())
    {
      return problemAt(where, problem);
    }
    problem = isPlaced ? addLandmark(list, point, where) : std::string();
    if (!problem.empty())
    {
      return problem;
    }
  }
  noteSkipped(list, skipped);
  return records.endedInQuotes() ? "ends inside quotes" : "";
}

bool looksLikeFiducials(const std::string& beginning)
{
  const std::string text = lowerCase(trimmed(beginning));
  return !text.empty() && text[0] == '#' &&
    (text.find("markups fiducial file") != std::string::npos ||
      text.find("coordinatesystem") != std::string::npos ||
      text.find("# columns") != std::string::npos);
}

void writeFiducials(std::ostream& file, FileAxes axes, const LandmarkList& list)
{
  file << "# Markups fiducial file version = 5.6\n"
       << "# CoordinateSystem = " << (axes == FileAxes::RAS ? "RAS" : "LPS") << "\n"
       << "# columns = " << Columns << "\n";
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    const glm::dvec3 position = inAxes(axes, list.points[i].position);
    file << std::to_string(i + 1) << "," << numberText(position.x) << "," << numberText(position.y)
         << "," << numberText(position.z) << ",0,0,0,1,1,1,0,"
         << recordValue(validUtf8(list.points[i].label), ',') << ",,," << Placed << ",0\n";
  }
}
}
