// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tables of points (.csv, .tsv) whose first line names the columns, and Slicer's fiducials.
///
/// README.md lists the names of columns. "(mm)" or "[mm]" may follow a name. The value n/a is an
/// empty one. Columns r, a, s and l, p, s name their axes themselves.
///
/// Separators are commas, semicolons or tabs. Lines before the names that begin with # are passed
/// over. Slicer's tables of markups are such tables.
///
/// Slicer's fiducials (.fcsv) are tables, too: comment lines name version, axes and columns, then a
/// line for each point follows. A file without the line "# columns" has those of version 4. A file
/// without the line "# CoordinateSystem" is RAS, as files were before that line. Points that Slicer
/// 5 marks as not placed are left out and noted.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/PointColumns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace brainshift
{
namespace
{
using Values = std::vector<std::string>;
using Names = std::array<const char*, 3>;

// Records of values between separators. Quoted values may hold separators, quotes and lines.
class RecordReader
{
public:
  RecordReader(std::string_view text, char separator)
    : Text(text)
    , Separator(separator)
  {
  }

  // Takes the next record that has anything in it. False at the end.
  bool next(std::vector<std::string>& values);

  // The line on which the last record began, from 1 on.
  std::size_t line() const { return this->Line; }

  // Whether the text ended inside quotes.
  bool endedInQuotes() const { return this->IsOpen; }

private:
  std::string_view Text;
  char Separator;
  std::size_t Place = 0;
  std::size_t Line = 0;
  std::size_t NextLine = 1;
  bool IsOpen = false;

  void take(std::vector<std::string>& values);
  void takeQuoted(std::string& value);
};

void RecordReader::takeQuoted(std::string& value)
{
  this->IsOpen = true;
  for (++this->Place; this->Place < this->Text.size(); ++this->Place)
  {
    const char letter = this->Text[this->Place];
    if (letter == '"' && this->Text.substr(this->Place + 1, 1) != "\"")
    {
      ++this->Place;
      this->IsOpen = false;
      return;
    }
    this->Place += letter == '"' ? 1 : 0; // two quotes stand for one
    this->NextLine += letter == '\n' ? 1 : 0;
    value += letter;
  }
}

void RecordReader::take(std::vector<std::string>& values)
{
  values.assign(1, {});
  this->Line = this->NextLine;
  while (this->Place < this->Text.size())
  {
    const char letter = this->Text[this->Place];
    if (letter == '"' && trimmed(values.back()).empty())
    {
      values.back().clear();
      this->takeQuoted(values.back());
      continue;
    }
    ++this->Place;
    if (letter == '\n')
    {
      ++this->NextLine;
      return;
    }
    if (letter == this->Separator)
    {
      values.emplace_back();
    }
    else if (letter != '\r')
    {
      values.back() += letter;
    }
  }
}

bool RecordReader::next(std::vector<std::string>& values)
{
  while (this->Place < this->Text.size())
  {
    this->take(values);
    if (std::any_of(values.begin(), values.end(),
          [](const std::string& value) { return !trimmed(value).empty(); }))
    {
      return true;
    }
  }
  return false;
}

// A value of a record, in quotes where it needs them.
std::string recordValue(const std::string& value, char separator)
{
  const std::string special = std::string("\"\r\n") + separator;
  if (value.find_first_of(special) == std::string::npos && trimmed(value) == value)
  {
    return value;
  }
  std::string quoted = "\"";
  for (const char letter : value)
  {
    quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return quoted + '"';
}

constexpr char Separators[] = { ',', ';', '\t' };
constexpr Names RASNames{ "r", "a", "s" };
constexpr Names LPSNames{ "l", "p", "s" };

constexpr std::array<std::pair<const char*, double Landmark::*>, 3> NumberColumns{ {
  { "number", &Landmark::number },
  { "time", &Landmark::time },
  { "deviation", &Landmark::deviation },
} };

// Where the columns are. One that the table lacks is beyond its end.
struct Columns
{
  PointColumns position;
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

std::optional<Columns> columnsIn(const Values& header, const Values& wanted)
{
  const std::optional<PointColumns> position = pointColumnsIn(header, wanted);
  if (!position)
  {
    return std::nullopt;
  }
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
  columns.position = *position;
  columns.count = header.size();
  columns.label = std::min(placeOf("label"), placeOf("name"));
  columns.time = placeOf("time");
  columns.deviation = placeOf("deviation");
  columns.number = placeOf("number");
  columns.defined = placeOf("defined");
  return columns;
}

bool isComment(const Values& values)
{
  return trimmed(values[0]).compare(0, 1, "#") == 0;
}

// The first line that is no comment.
Values headerOf(const std::string& text, char separator)
{
  RecordReader records(text, separator);
  Values header;
  bool isFound = records.next(header);
  while (isFound && isComment(header))
  {
    isFound = records.next(header);
  }
  return isFound ? header : Values();
}

// The columns between one of the separators. Wanted names must be between the one that the header
// has most of.
std::optional<Columns> findColumns(const std::string& text, const Values& wanted, char& separator)
{
  std::size_t most = 0;
  for (const char candidate : Separators)
  {
    const Values header = headerOf(text, candidate);
    const std::optional<Columns> columns =
      wanted.empty() && !header.empty() ? columnsIn(header, {}) : std::nullopt;
    if (columns)
    {
      separator = candidate;
      return columns;
    }
    separator = header.size() > most ? candidate : separator;
    most = std::max(most, header.size());
  }
  return wanted.empty() ? std::nullopt : columnsIn(headerOf(text, separator), wanted);
}

// The number in a column. NaN if the table lacks the column or the value is empty.
double readNumber(const Values& values, std::size_t column, const std::string& name)
{
  const std::string word = column < values.size() ? trimmed(values[column]) : std::string();
  if (word.empty() || lowerCase(word) == "n/a") // as BIDS writes what is missing
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (const std::optional<double> number = numberIn(word))
  {
    return *number;
  }
  const bool hasComma = word.find(',') != std::string::npos;
  throw Problem("has " + name + " = " + shownWords(word) +
    (hasComma ? "; a number has a point, not a comma, before its decimals" : "; it is no number"));
}

// False if the point has no position.
bool readPoint(const Values& values, const Columns& columns, Landmark& point)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t column = columns.position.at[axis];
    point.position[axis] = readNumber(values, column, columns.position.names[axis]);
  }
  point.time = readNumber(values, columns.time, "time");
  point.deviation = readNumber(values, columns.deviation, "deviation");
  point.number = readNumber(values, columns.number, "number");
  const int missing = static_cast<int>(std::isnan(point.position.x)) +
    static_cast<int>(std::isnan(point.position.y)) + static_cast<int>(std::isnan(point.position.z));
  const bool isDefined =
    columns.defined >= values.size() || trimmed(values[columns.defined]) != "0";
  if (isDefined && missing > 0 && missing < 3)
  {
    throw Problem("has " + std::to_string(3 - missing) + " of 3 coordinates");
  }
  point.label = columns.label < values.size() ? validUtf8(trimmed(values[columns.label])) : "";
  return missing == 0 && isDefined;
}

constexpr const char* FiducialColumns =
  "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";
constexpr std::size_t StatusColumn = 14; // Slicer 5 appends it without a name
constexpr const char* Placed = "2";

// What the comment lines say.
struct FiducialHeader
{
  FileAxes axes = FileAxes::RAS;
  std::array<std::size_t, 3> position{ 1, 2, 3 };
  std::size_t label = 11;
  bool hasStatus = true;
  std::map<std::string, std::string> said; // values by the keys that count
};

void readColumns(const std::string& names, FiducialHeader& header)
{
  Values columns;
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
  if (!(*std::max_element(header.position.begin(), header.position.end()) < columns.size()))
  {
    throw Problem("has no columns x, y and z; it names " + shownWords(names));
  }
}

// A comment "# key = value", and others, which say nothing.
void readComment(const std::string& line, FiducialHeader& header)
{
  const std::size_t mark = line.find('=');
  if (mark == std::string::npos)
  {
    return;
  }
  std::string key = lowerCase(trimmed(line.substr(1, mark - 1)));
  key.erase(std::remove_if(key.begin(), key.end(),
              [](char letter) { return letter == ' ' || letter == '_' || letter == '-'; }),
    key.end());
  const std::string value = trimmed(line.substr(mark + 1));
  const bool counts = key == "coordinatesystem" || key == "coordinateunits" || key == "columns";
  if (counts && header.said.emplace(key, value).first->second != value)
  {
    throw Problem("has the line # " + trimmed(line.substr(1, mark - 1)) + " twice");
  }
  if (key == "coordinatesystem")
  {
    header.axes = axesFrom(value);
    return;
  }
  if (key == "coordinateunits" && lowerCase(value) != "mm")
  {
    throw Problem("has coordinateUnits " + shownWords(value) + "; they must be mm");
  }
  if (key == "columns")
  {
    readColumns(value, header);
  }
}

void readFiducial(const Values& values, const FiducialHeader& header, Landmark& point)
{
  glm::dvec3 position(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t column = header.position[axis];
    const std::string word = column < values.size() ? values[column] : "";
    const std::optional<double> number = numberIn(trimmed(word));
    if (!number)
    {
      throw Problem(
        std::string("has no number ") + "xyz"[axis] + ", but \"" + shownWords(word) + "\"");
    }
    position[axis] = *number;
  }
  point.position = inAxes(header.axes, position);
  point.label = header.label < values.size() ? validUtf8(trimmed(values[header.label])) : "";
}
}

void readPointTable(const std::string& text, const TableRule& rule, LandmarkList& list)
{
  char separator = ',';
  const std::optional<Columns> columns = findColumns(text, rule.columns, separator);
  if (!columns)
  {
    std::string names;
    for (const std::string& name : headerOf(text, separator))
    {
      names += (names.empty() ? "" : ", ") + trimmed(name);
    }
    throw Problem("has no first line that names the columns x, y and z, or r, a, s, or l, p, s; it "
                  "names " +
      shownWords(names) + "; name three of its columns (Position Columns)");
  }
  const PointColumns& columnsOfPosition = columns->position;
  if (!columnsOfPosition.space.empty())
  {
    list.notes.push_back("takes its positions from " + columnsOfPosition.names[0] + ", " +
      columnsOfPosition.names[1] + " and " + columnsOfPosition.names[2] +
      ", which are those of a template, not of the scanner");
  }
  const FileAxes axes = columnsOfPosition.axes.value_or(rule.axes);
  const double mm = columnsOfPosition.mm.value_or(rule.mm);
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
      throw Problem("has " + std::to_string(values.size()) + " values in " + where +
        "; its first line names " + std::to_string(columns->count) +
        " columns, and a number has a point, not a comma, before its decimals");
    }
    Landmark point;
    bool hasPlace = false;
    withBeginning(beginningAt(where), [&] { hasPlace = readPoint(values, *columns, point); });
    point.position = mm * inAxes(axes, point.position);
    skipped += hasPlace ? 0 : 1;
    if (hasPlace)
    {
      addLandmark(list, point, where);
    }
  }
  noteSkipped(list, skipped);
  if (records.endedInQuotes())
  {
    throw Problem("ends inside quotes");
  }
}

bool looksLikePointTable(const std::string& beginning)
{
  char separator = ',';
  bool isFound = false;
  const std::string problem =
    problemOf([&] { isFound = findColumns(beginning, {}, separator).has_value(); });
  return isFound || !problem.empty(); // several positions are some
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

void readFiducials(const std::string& text, LandmarkList& list)
{
  FiducialHeader header;
  std::size_t read = 0;
  std::size_t skipped = 0;
  Values values;
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
      readComment(line, header);

      continue;
    }
    Landmark point;
    point.number = static_cast<double>(++read);
    const bool isPlaced =
      !header.hasStatus || values.size() <= StatusColumn || trimmed(values[StatusColumn]) == Placed;
    skipped += isPlaced ? 0 : 1;
    if (isPlaced)
    {
      withBeginning(beginningAt(where), [&] { readFiducial(values, header, point); });
      addLandmark(list, point, where);
    }
  }
  noteSkipped(list, skipped);
  if (records.endedInQuotes())
  {
    throw Problem("ends inside quotes");
  }
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
       << "# columns = " << FiducialColumns << "\n";
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    const glm::dvec3 position = inAxes(axes, list.points[i].position);
    file << std::to_string(i + 1) << "," << numberText(position.x) << "," << numberText(position.y)
         << "," << numberText(position.z) << ",0,0,0,1,1,1,0,"
         << recordValue(validUtf8(list.points[i].label), ',') << ",,," << Placed << ",0\n";
  }
}
}
