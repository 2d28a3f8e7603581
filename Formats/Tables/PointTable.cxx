// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tables of points (.csv, .tsv) whose first line names the columns. README.md lists their names.
///
/// Separators are commas, semicolons or tabs. Lines before the names that begin with # are
/// comments; above a table that begins with numbers the last of them has the names. The value n/a
/// is an empty one. Slicer's tables of markups are such tables.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/CoordinateWords.h"
#include "Formats/Landmarks/Records.h"
#include "Formats/Tables/ColumnOfNames.h"
#include "Formats/Tables/PointColumns.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace brainshift
{
namespace
{
using Values = std::vector<std::string>;
using AxisNames = std::array<const char*, 3>;

constexpr char Separators[] = { ',', ';', '\t' };
constexpr AxisNames RASNames{ "r", "a", "s" };
constexpr AxisNames LPSNames{ "l", "p", "s" };

constexpr std::array<std::pair<const char*, double Landmark::*>, 3> NumberColumns{ {
  { "number", &Landmark::number },
  { "time", &Landmark::time },
  { "deviation", &Landmark::deviation },
} };

// What the name of a column says of the unit of its numbers, such as ms; empty: nothing.
struct NamedUnit
{
  std::string name; // of the column, in small letters
  std::string unit;
};

// Where the columns are. One that the table lacks is beyond its end.
struct Columns
{
  PointColumns position;
  std::size_t label = 0;
  std::size_t time = 0;
  std::size_t deviation = 0;
  std::size_t number = 0;
  std::size_t defined = 0;
  std::size_t unit = 0;
  std::size_t frame = 0;
  std::string unitName;
  std::string frameName;
  NamedUnit timeUnit;
  NamedUnit deviationUnit;
  std::optional<double> deviationMm; // of its own unit
  std::size_t count = 0;
  std::size_t named = 0; // without columns at the end that have no name
};

constexpr const char* UnitEnds[] = { "_mm", "_cm", "_m", "_um", "_inch", "_s", "_sec", "_ms", "_us",
  "_min" };

// A column's name without capitals and without its unit: "Time (ms)" and "time_ms" are time.
std::string nameOf(const std::string& written)
{
  std::string name = lowerCase(trimmed(written));
  const std::size_t bracket = name.find_first_of("([");
  name = bracket == std::string::npos || bracket == 0 ? name : trimmed(name.substr(0, bracket));
  for (const char* unit : UnitEnds)
  {
    if (endsWith(name, unit))
    {
      return trimmed(name.substr(0, name.size() - std::string(unit).size()));
    }
  }
  return name;
}

// The unit that nameOf leaves out.
NamedUnit unitOf(const std::string& written)
{
  NamedUnit found{ lowerCase(trimmed(written)), "" };
  const std::size_t bracket = found.name.find_first_of("([");
  if (bracket != std::string::npos)
  {
    const std::string rest = found.name.substr(bracket + 1);
    found.unit = trimmed(rest.substr(0, rest.find_first_of(")]")));
    return found;
  }
  for (const std::string unit : UnitEnds)
  {
    found.unit = endsWith(found.name, unit) ? unit.substr(1) : found.unit;
  }
  return found;
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
  const auto lastNamed = std::find_if(
    header.rbegin(), header.rend(), [](const std::string& name) { return !trimmed(name).empty(); });
  columns.named = static_cast<std::size_t>(header.rend() - lastNamed);
  columns.label = header.size();
  columns.time = placeOf("time");
  columns.deviation = placeOf("deviation");
  columns.number = placeOf("number");
  columns.defined = placeOf("defined");
  const auto placeBy = [&](bool (*saysIt)(const std::string&)) {
    const auto isIt = [&](const std::string& name) { return saysIt(keyOf(name)); };
    return static_cast<std::size_t>(
      std::find_if(header.begin(), header.end(), isIt) - header.begin());
  };
  columns.unit = placeBy(saysUnit);
  columns.frame = placeBy(saysFrame);
  columns.unitName = columns.unit < header.size() ? header[columns.unit] : "";
  columns.frameName = columns.frame < header.size() ? header[columns.frame] : "";
  columns.timeUnit = columns.time < header.size() ? unitOf(header[columns.time]) : NamedUnit();
  columns.deviationUnit =
    columns.deviation < header.size() ? unitOf(header[columns.deviation]) : NamedUnit();
  return columns;
}

// The names of a table's columns.
struct Header
{
  Values names;
  bool isComment = false; // then the first line that is none is a point
};

// The names in a comment.
Values namesIn(Values comment)
{
  comment[0] = trimmed(comment[0]);
  comment[0].erase(0, comment[0].find_first_not_of('#'));
  return comment;
}

bool areNumbers(const Values& values)
{
  return std::all_of(values.begin(), values.end(),
    [](const std::string& value) { return numberIn(trimmed(value)).has_value(); });
}

// The first line that is no comment. If it has only numbers, the comment before it has the names,
// as numpy.savetxt writes them, if it has as many.
Header headerIn(const std::string& text, char separator)
{
  RecordReader records(text, separator);
  Values values;
  Values comment;
  while (records.next(values))
  {
    if (isComment(values))
    {
      comment = values;
      continue;
    }
    if (comment.size() != values.size() || !areNumbers(values))
    {
      return { values };
    }
    return { namesIn(comment), true };
  }
  return {};
}

Values headerOf(const std::string& text, char separator)
{
  return headerIn(text, separator).names;
}

// Calls visit(values, "line 12") for each record below the names of columns that is no comment.
template <typename Visit>
void forEachPoint(const std::string& text, char separator, const Visit& visit)
{
  const bool isFirstAPoint = headerIn(text, separator).isComment;
  RecordReader records(text, separator);
  Values values;
  bool isBelow = false;
  while (records.next(values))
  {
    const bool isOther = isBelow && !(isComment(values) && values.size() == 1);
    if (isOther || (!isBelow && isFirstAPoint && !isComment(values)))
    {
      visit(values, "line " + std::to_string(records.line()));
    }
    isBelow = isBelow || !isComment(values);
  }
  throwIfAny(records.endedInQuotes() ? "ends inside quotes" : "");
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

// Finds the column of names by its values, too.
void findNames(const std::string& text, char separator, Columns& columns, LandmarkList& list)
{
  const Values header = headerOf(text, separator);
  std::vector<std::size_t> taken(columns.position.at.begin(), columns.position.at.end());
  taken.insert(
    taken.end(), { columns.time, columns.deviation, columns.defined, columns.unit, columns.frame });
  const bool isPlain = std::any_of(header.begin(), header.end(),
    [](const std::string& name) { return nameOf(name) == "label" || nameOf(name) == "name"; });
  taken.push_back(isPlain ? columns.number : header.size()); // else it is all that tells points
  ColumnOfNames names(header, taken);
  forEachPoint(
    text, separator, [&](const Values& values, const std::string&) { names.add(values); });
  const std::optional<ColumnOfNames::Found> found = names.find();
  columns.label = found ? found->at : header.size();
  if (found && found->isGuessed)
  {
    const std::string name = trimmed(header[found->at]);
    list.notes.push_back("takes the names of its points from column " +
      std::to_string(found->at + 1) + (name.empty() ? "" : " (" + shownWords(name) + ")"));
  }
}

// The axes that a word under a key names, with a note about a frame that is not the scanner's.
std::optional<FileAxes> axesUnder(
  const std::string& key, const std::string& word, LandmarkList& list)
{
  if (keyOf(key) == "coordinatesystem" && (word == "0" || word == "1")) // as in Slicer
  {
    return axesFrom(word);
  }
  if (word.empty() || numberIn(word)) // a frame with a number is a time
  {
    return std::nullopt;
  }
  const FrameMeaning frame = frameIn(word);
  noteDoubt(word, frame, list);
  return frame.axes;
}

// A line may say both, such as "# units: cm, CoordinateSystem: LPS" and "# axes = LPS (mm)".
SaidOfPositions saidByComment(const CommentEntry& entry, bool isBelow, LandmarkList& list)
{
  const std::string& words = entry.value;
  if (saysUnit(entry.key))
  {
    const std::optional<double> mm = lengthUnder(entry.key, words, list);
    const FrameMeaning frame = frameIn(words);
    return { frame.doubt.empty() ? frame.axes : std::nullopt, mm };
  }
  if (saysFrame(entry.key))
  {
    return { axesUnder(entry.key, words, list),
      namesLength(words) ? lengthUnder("unit", words, list) : std::nullopt };
  }
  return saidByWords(entry.words, isBelow, list);
}

// What comments say of positions: "# CoordinateSystem = LPS", "# LPS, cm", above or below. One that
// has the names of columns says no more than they do.
SaidOfPositions saidByComments(const std::string& text, char separator, LandmarkList& list)
{
  SaidOfPositions said;
  const Header header = headerIn(text, separator);
  RecordReader records(text, separator);
  Values values;
  bool isBelow = false;
  while (records.next(values))
  {
    const bool isOne = isComment(values) && (!isBelow || values.size() == 1);
    const bool hasNames = isOne && header.isComment && namesIn(values) == header.names;
    if (isOne && !hasNames)
    {
      said = agreed(said, saidByComment(commentEntry(values, separator), isBelow, list));
    }
    isBelow = isBelow || !isOne;
  }
  return said;
}

// What the columns of a record say of its position.
SaidOfPositions saidByRecord(const Values& values, const Columns& columns, LandmarkList& list)
{
  SaidOfPositions said;
  const auto wordIn = [&](std::size_t column) {
    const std::string word = column < values.size() ? trimmed(values[column]) : "";
    return lowerCase(word) == "n/a" ? std::string() : word;
  };
  const std::string unit = wordIn(columns.unit);
  if (!unit.empty())
  {
    said.mm = lengthUnder(columns.unitName, unit, list);
  }
  said.axes = axesUnder(columns.frameName, wordIn(columns.frame), list);
  return said;
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

// A position (mm, RAS) as a record writes it.
glm::dvec3 placed(const glm::dvec3& written, const PointColumns& columns,
  const SaidOfPositions& said, const TableRule& rule)
{
  glm::dvec3 position(0.0);
  FileAxes axes = rule.axes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const SaidOfPositions all = agreed({ columns.axes, columns.mm[axis] }, said);
    axes = all.axes.value_or(rule.axes);
    position[axis] = written[axis] * columns.signs[axis] * all.mm.value_or(rule.mm);
  }
  return inAxes(axes, position);
}

// What a table says of its positions counts before the coordsystem.json beside it, which may be
// about another version of the table.
void noteContradiction(const SaidOfPositions& said, const PointColumns& columns,
  const TableRule& rule, LandmarkList& list)
{
  bool isOtherUnit = false;
  bool areOtherAxes = false;
  double mm = rule.mm;
  for (int axis = 0; axis < 3; ++axis)
  {
    const SaidOfPositions all = agreed({ columns.axes, columns.mm[axis] }, said);
    isOtherUnit = isOtherUnit || (rule.isSaidBeside && all.mm && *all.mm != rule.mm);
    mm = isOtherUnit && mm == rule.mm ? *all.mm : mm;
    areOtherAxes = areOtherAxes || (rule.hasAxesBeside && all.axes && *all.axes != rule.axes);
  }
  const std::string end = " by its coordsystem.json; what the table says counts. Correct the one "
                          "that is wrong";
  const std::string unit =
    joined("has positions in units of ", mm, " mm by its own words, and of ", rule.mm, " mm", end);
  const bool isRAS = rule.axes == FileAxes::RAS;
  const std::string axes = joined("has positions along ", isRAS ? "LPS" : "RAS",
    " by its own words, and along ", isRAS ? "RAS" : "LPS", end);
  for (const auto& [isOther, note] : { std::pair{ isOtherUnit, unit }, { areOtherAxes, axes } })
  {
    if (isOther)
    {
      noteOnce(list, note);
    }
  }
}

// What the name of the column of deviations says of their unit. Without one they have that of the
// positions, from which they are.
std::optional<double> unitOfDeviations(const Columns& columns, LandmarkList& list)
{
  const NamedUnit& own = columns.deviationUnit;
  if (!own.unit.empty())
  {
    LandmarkList unused; // its note is on positions
    const std::optional<double> mm = lengthUnder("unit", own.unit, unused);
    if (!mm)
    {
      list.notes.push_back("has the column " + shownWords(own.name) +
        ", whose unit is no length; its deviations count in that of the positions");
    }
    return mm;
  }
  const auto& mm = columns.position.mm;
  const bool isOfSeveral = !(mm[0] == mm[1] && mm[1] == mm[2]);
  throwIfAny(isOfSeveral && !own.name.empty()
      ? "has a column deviation without a unit, and its positions have several; name it with its "
        "own, such as deviation_mm"
      : "");
  return std::nullopt;
}

// Millimetres in the unit of the deviation of a record.
double mmOfDeviation(const Columns& columns, const SaidOfPositions& said, const TableRule& rule)
{
  const SaidOfPositions position = agreed({ std::nullopt, columns.position.mm[0] }, said);
  return columns.deviationMm.value_or(position.mm.value_or(rule.mm));
}

// Whether words of columns say no more than which of two positions of a landmark they have. Who
// chose the columns knows that.
bool sayWhichPosition(const std::string& words)
{
  static const std::set<std::string> Known{ "rest", "measured", "meas", "pre", "preop", "post",
    "postop", "intraop", "before", "after", "fixed", "moving" };
  std::istringstream each(words);
  return std::all_of(std::istream_iterator<std::string>(each), {},
    [](const std::string& word) { return Known.count(word) > 0; });
}

// What the names of the columns of the position leave open.
void notePosition(const PointColumns& columns, LandmarkList& list)
{
  const std::string names = "takes its positions from " + columns.names[0] + ", " +
    columns.names[1] + " and " + columns.names[2];
  if (!columns.space.empty())
  {
    list.notes.push_back(names + ", which are those of a template, not of the scanner");
  }
  if (!sayWhichPosition(columns.unknown))
  {
    list.notes.push_back(
      names + "; it is not known what \"" + shownWords(columns.unknown) + "\" says of them");
  }
}

// The columns of a table, with notes.
Columns requiredColumns(
  const std::string& text, const Values& wanted, char& separator, LandmarkList& list)
{
  std::optional<Columns> columns = findColumns(text, wanted, separator);
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
  notePosition(columns->position, list);
  columns->deviationMm = unitOfDeviations(*columns, list);
  list.timeUnit = columns->timeUnit.unit;
  findNames(text, separator, *columns, list);
  return *columns;
}

// Decimals after a comma are values of their own. A column of words needs no name.
void requireCount(
  const Values& values, const Columns& columns, const std::string& where, LandmarkList& list)
{
  throwIfAny(values.size() > columns.count ? "has " + std::to_string(values.size()) +
        " values in " + where + "; its first line names " + std::to_string(columns.count) +
        " columns, and a number has a point, not a comma, before its decimals"
                                           : "");
  for (std::size_t i = columns.named; i < values.size(); ++i)
  {
    if (numberIn(trimmed(values[i])))
    {
      noteOnce(list,
        "has numbers in columns without a name; check whether its numbers have a comma "
        "before their decimals, which must be a point");
    }
  }
}

// Programs that are known by the columns that they write, and whose axes these do not name.
void noteProgram(
  const Values& header, const PointColumns& columns, const TableRule& rule, LandmarkList& list)
{
  Values names(header.size());
  std::transform(header.begin(), header.end(), names.begin(),
    [](const std::string& name) { return lowerCase(trimmed(name)); });
  const std::string position = lowerCase(columns.names[0] + columns.names[1] + columns.names[2]);
  const bool isANTs =
    names.size() > 3 && names[0] == "x" && names[1] == "y" && names[2] == "z" && names[3] == "t";
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (isANTs && position == "xyz" && rule.axes == FileAxes::RAS)
  {
    list.notes.emplace_back("begins with the columns x, y, z, t of points of ANTs, which are LPS; "
                            "its positions count as RAS. If ANTs wrote them, choose LPS (Table "
                            "Axes); if not, call the columns r, a, s");
  }
  if (has("electrode") && position == "coord_xcoord_ycoord_z")
  {
    list.notes.emplace_back("has the columns Electrode and Coord_x of RAVE, whose positions are "
                            "those of a surface of FreeSurfer, not of the scanner; if RAVE wrote "
                            "them, choose T1R, T1A and T1S (Position Columns)");
  }
  if (has("sph_theta") && position == "xyz")
  {
    list.notes.emplace_back("has the column sph_theta of EEGLAB, whose x points to the front and y "
                            "to the left; its positions count as they are. If EEGLAB wrote them, "
                            "call them A, L, S and choose these (Position Columns)");
  }
}

void readPointTable(const std::string& text, const LandmarkChoice& choice, LandmarkList& list)
{
  const TableRule& rule = choice.table;
  char separator = ',';
  const Columns columns = requiredColumns(text, rule.columns, separator, list);
  const SaidOfPositions comments = saidByComments(text, separator, list);
  std::size_t skipped = 0;
  bool isOpen = false; // of a point nothing says the axes
  forEachPoint(text, separator, [&](const Values& values, const std::string& where) {
    requireCount(values, columns, where, list);
    Landmark point;
    bool hasPlace = false;
    withBeginning(beginningAt(where), [&] {
      hasPlace = readPoint(values, columns, point);
      const SaidOfPositions said = agreed(comments, saidByRecord(values, columns, list));
      noteContradiction(said, columns.position, rule, list);
      isOpen = isOpen || !(said.axes || columns.position.axes || rule.hasAxesBeside);
      point.position = placed(point.position, columns.position, said, rule);
      point.deviation *= mmOfDeviation(columns, said, rule);
    });
    skipped += hasPlace ? 0 : 1;
    if (hasPlace)
    {
      addLandmark(list, point, where);
    }
  });
  noteSkipped(list, skipped);
  if (isOpen)
  {
    noteProgram(headerOf(text, separator), columns.position, rule, list);
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

// How a column of times is called, in a unit as the table says it that was read.
std::string nameOfTimes(const std::string& unit)
{
  const bool isEnd = std::any_of(std::begin(UnitEnds), std::end(UnitEnds),
    [&](const std::string& end) { return end.substr(1) == unit; });
  return "time" + (unit.empty() ? "" : isEnd ? "_" + unit : " (" + unit + ")");
}

// Columns are called r, a, s or l, p, s. Deviations are in mm, as positions are.
template <char separator>
void writePointTable(std::ostream& file, FileAxes axes, LandmarkList& list)
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
      file << separator
           << (number == &Landmark::time ? recordValue(nameOfTimes(list.timeUnit), separator)
                                         : std::string(name));
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

extern const LandmarkFormat LandmarksOfCSV{ []() -> std::vector<std::string> { return { ".csv" }; },
  looksLikePointTable, readPointTable, writePointTable<','>, FileAxes::RAS, /*hasOneFrame=*/false,
  /*isUtf8=*/false, /*holdsNumbers=*/true };

extern const LandmarkFormat LandmarksOfTSV{ []() -> std::vector<std::string> { return { ".tsv" }; },
  looksLikePointTable, readPointTable, writePointTable<'\t'>, FileAxes::RAS, /*hasOneFrame=*/false,
  /*isUtf8=*/false, /*holdsNumbers=*/true };
}
