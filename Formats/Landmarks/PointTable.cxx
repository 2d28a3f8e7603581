// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/PointTable.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/PlainText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace brainshift
{
namespace
{
using Values = std::vector<std::string>;
using Names = std::array<const char*, 3>;

constexpr char Separators[] = { ',', ';', '\t' };
constexpr Names PlainNames{ "x", "y", "z" };
constexpr Names RASNames{ "r", "a", "s" };
constexpr Names LPSNames{ "l", "p", "s" };
constexpr Names OwnNames{ "points:0", "points:1", "points:2" }; // ParaView's own CSV Writer

constexpr std::array<std::pair<const char*, double Landmark::*>, 3> NumberColumns{ {
  { "number", &Landmark::number },
  { "time", &Landmark::time },
  { "deviation", &Landmark::deviation },
} };

// Where the columns are. One that the table lacks is beyond its end.
struct Columns
{
  std::array<std::size_t, 3> position{};
  Names names = PlainNames;
  std::optional<FileAxes> axes; // none if the names do not tell
  std::size_t label = 0;
  std::size_t time = 0;
  std::size_t deviation = 0;
  std::size_t number = 0;
  std::size_t defined = 0;
  std::size_t count = 0;
};

// A column's name without capitals and without its unit, if that is mm.
std::string nameOf(const std::string& written)
{
  std::string name = lowerCase(trimmed(written));
  for (const char* unit : { "(mm)", "[mm]", "_mm" })
  {
    if (endsWith(name, unit))
    {
      name = trimmed(name.substr(0, name.size() - std::string(unit).size()));
    }
  }
  return name;
}

std::optional<Columns> columnsIn(const Values& header)
{
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < header.size(); ++i)
  {
    places.emplace(nameOf(header[i]), i);
  }
  const auto placeOf = [&](const char* name) {
    const auto found = places.find(name);
    return found == places.end() ? header.size() : found->second;
  };
  Columns columns;
  columns.count = header.size();
  columns.label = std::min(placeOf("label"), placeOf("name"));
  columns.time = placeOf("time");
  columns.deviation = placeOf("deviation");
  columns.number = placeOf("number");
  columns.defined = placeOf("defined");
  for (const Names& names : { PlainNames, RASNames, LPSNames, OwnNames })
  {
    columns.names = names;
    columns.position = { placeOf(names[0]), placeOf(names[1]), placeOf(names[2]) };
    if (*std::max_element(columns.position.begin(), columns.position.end()) < header.size())
    {
      columns.axes = names == RASNames ? std::optional(FileAxes::RAS)
        : names == LPSNames            ? std::optional(FileAxes::LPS)
                                       : std::nullopt;
      return columns;
    }
  }
  return std::nullopt;
}

bool isComment(const Values& values)
{
  return trimmed(values[0]).compare(0, 1, "#") == 0;
}

// The first line that is no comment, as columns between one of the separators.
std::optional<Columns> findColumns(const std::string& text, char& separator)
{
  for (const char candidate : Separators)
  {
    RecordReader records(text, candidate);
    Values header;
    bool isFound = records.next(header);
    while (isFound && isComment(header))
    {
      isFound = records.next(header);
    }
    const std::optional<Columns> columns = isFound ? columnsIn(header) : std::nullopt;
    if (columns)
    {
      separator = candidate;
      return columns;
    }
  }
  return std::nullopt;
}

// The number in a column. NaN if the table lacks the column or the value is empty.
std::string readNumber(
  const Values& values, std::size_t column, const std::string& name, double& number)
{
  number = std::numeric_limits<double>::quiet_NaN();
  const std::string word = column < values.size() ? trimmed(values[column]) : std::string();
  if (word.empty())
  {
    return {};
  }
  const std::optional<double> found = numberIn(word);
  number = found.value_or(number);
  if (found)
  {
    return {};
  }
  const bool hasComma = word.find(',') != std::string::npos;
  return "has " + name + " = " + shownWords(word) +
    (hasComma ? "; a number has a point, not a comma, before its decimals" : "; it is no number");
}

std::string readPoint(const Values& values, const Columns& columns, Landmark& point, bool& hasPlace)
{
  std::string problem;
  for (int axis = 0; problem.empty() && axis < 3; ++axis)
  {
    const std::size_t column = columns.position[axis];
    problem = readNumber(values, column, columns.names[axis], point.position[axis]);
  }
  problem = problem.empty() ? readNumber(values, columns.time, "time", point.time) : problem;
  problem =
    problem.empty() ? readNumber(values, columns.deviation, "deviation", point.deviation) : problem;
  problem = problem.empty() ? readNumber(values, columns.number, "number", point.number) : problem;
  const int missing = static_cast<int>(std::isnan(point.position.x)) +
    static_cast<int>(std::isnan(point.position.y)) + static_cast<int>(std::isnan(point.position.z));
  const bool isDefined =
    columns.defined >= values.size() || trimmed(values[columns.defined]) != "0";
  hasPlace = missing == 0 && isDefined;
  if (problem.empty() && isDefined && missing > 0 && missing < 3)
  {
    problem = "has " + std::to_string(3 - missing) + " of 3 coordinates";
  }
  point.label = columns.label < values.size() ? validUtf8(trimmed(values[columns.label])) : "";
  return problem;
}
}

std::string readPointTable(const std::string& text, FileAxes axes, LandmarkList& list)
{
  char separator = ',';
  const std::optional<Columns> columns = findColumns(text, separator);
  if (!columns)
  {
    return "has no first line that names the columns x, y and z, or r, a, s, or l, p, s";
  }
  RecordReader records(text, separator);
  Values values;
  bool isHeader = true;
  std::size_t skipped = 0;
  while (records.next(values))
  {
    if (isHeader)
    {
      isHeader = isComment(values);
      continue;
    }
    const std::string where = "line " + std::to_string(records.line());
    if (values.size() > columns->count)
    {
      return "has " + std::to_string(values.size()) + " values in " + where +
        "; its first line names " + std::to_string(columns->count) +
        " columns, and a number has a point, not a comma, before its decimals";
    }
    Landmark point;
    bool hasPlace = false;
    std::string problem = readPoint(values, *columns, point, hasPlace);
    if (!problem.empty())
    {
      return problemAt(where, problem);
    }
    point.position = inAxes(columns->axes.value_or(axes), point.position);
    skipped += hasPlace ? 0 : 1;
    problem = hasPlace ? addLandmark(list, point, where) : std::string();
    if (!problem.empty())
    {
      return problem;
    }
  }
  noteSkipped(list, skipped);
  return records.endedInQuotes() ? "ends inside quotes" : "";
}

bool looksLikePointTable(const std::string& beginning)
{
  char separator = ',';
  return findColumns(beginning, separator).has_value();
}

void writePointTable(std::ostream& file, FileAxes axes, char separator, const LandmarkList& list)
{
  std::vector<double Landmark::*> written;
  file << "label";
  for (const char* name : axes == FileAxes::RAS ? RASNames : LPSNames)
  {
    file << separator << name;
  }
  for (const auto& [name, number] : NumberColumns)
  {
    const auto hasNumber = [member = number](
                             const Landmark& point) { return !std::isnan(point.*member); };
    if (std::any_of(list.points.begin(), list.points.end(), hasNumber))
    {
      file << separator << name;
      written.push_back(number);
    }
  }
  file << "\n";
  for (const Landmark& point : list.points)
  {
    const glm::dvec3 position = inAxes(axes, point.position);
    file << recordValue(validUtf8(point.label), separator) << separator << numberText(position.x)
         << separator << numberText(position.y) << separator << numberText(position.z);
    for (double Landmark::* number : written)
    {
      file << separator << (std::isnan(point.*number) ? "" : numberText(point.*number));
    }
    file << "\n";
  }
}
}
