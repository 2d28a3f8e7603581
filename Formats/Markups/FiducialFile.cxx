// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Slicer's fiducials (.fcsv): comment lines name version, axes and columns, and a line for each
/// point follows. A file without the line "# columns" has those of version 4. A file without the
/// line "# CoordinateSystem" is RAS, as files were before that line. Points that Slicer 5 marks as
/// not placed are left out and noted.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/CoordinateWords.h"
#include "Formats/Landmarks/Records.h"

#include <algorithm>
#include <array>
#include <optional>

namespace brainshift
{
namespace
{
using Values = std::vector<std::string>;

constexpr const char* FiducialColumns =
  "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";
constexpr std::size_t StatusColumn = 14;   // Slicer 5 appends it without a name
constexpr std::size_t CountOfSlicer5 = 16; // with it and the number of measurements
constexpr const char* Placed = "2";

// What the comment lines say.
struct FiducialHeader
{
  SaidOfPositions said;
  std::array<std::size_t, 3> position{ 1, 2, 3 };
  std::size_t label = 11;
  std::size_t count = StatusColumn; // of the columns that have a name
  std::string columns;              // as the file names them

  bool hasStatus() const { return this->count == StatusColumn; }
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
  header.count = columns.size();
  if (!(*std::max_element(header.position.begin(), header.position.end()) < columns.size()))
  {
    throw Problem("has no columns x, y and z; it names " + shownWords(names));
  }
}

// A comment "# key = value" or "# key: value", and others, whose words may say axes and units.
void readComment(
  const CommentEntry& entry, bool isBelow, FiducialHeader& header, LandmarkList& list)
{
  if (entry.key == "coordinatesystem")
  {
    header.said = agreed(header.said, { axesFrom(entry.value), std::nullopt });
  }
  else if (saysUnit(entry.key))
  {
    throwIfAny(lowerCase(entry.value) != "mm"
        ? "has " + entry.key + " " + shownWords(entry.value) + "; they must be mm"
        : "");
  }
  else if (entry.key != "columns")
  {
    const SaidOfPositions said = saidByWords(entry.words, isBelow, list);
    throwIfAny(said.mm.value_or(1.0) != 1.0
        ? "has the comment \"" + shownWords(entry.words) + "\"; its units must be mm"
        : "");
    header.said = agreed(header.said, said);
  }
  else
  {
    if (!header.columns.empty() && header.columns != entry.value)
    {
      throw Problem(twice("line # columns"));
    }
    header.columns = entry.value;
    readColumns(entry.value, header);
  }
}

// What the comments say, above the points or below them.
FiducialHeader headerOf(const std::string& text, LandmarkList& list)
{
  FiducialHeader header;
  bool isBelow = false;
  Values values;
  RecordReader records(text, ',');
  while (records.next(values))
  {
    isBelow = isBelow || !isComment(values);
    if (isComment(values))
    {
      readComment(commentEntry(values, ','), isBelow, header, list);
    }
  }
  return header;
}

// Decimals after a comma are values of their own. Rows that end early have id, x, y and z, or the
// orientation, too.
void requireCount(const Values& values, const FiducialHeader& header)
{
  constexpr std::array<const char*, 4> Statuses{ "0", "1", "2", "3" };
  constexpr std::size_t Shortest = 4;
  constexpr std::size_t Oriented = 8;
  const std::size_t count = values.size();
  const std::string status = count == CountOfSlicer5 ? trimmed(values[StatusColumn]) : "";
  const bool isOfSlicer5 =
    header.hasStatus() && std::find(Statuses.begin(), Statuses.end(), status) != Statuses.end();
  const bool isBroken = header.hasStatus() && count > Shortest && count < Oriented;
  throwIfAny(isBroken || (count > header.count && !isOfSlicer5)
      ? joined("has ", count, " values for ", header.count,
          " columns; write a point, not a comma, before decimals, and words with commas in quotes")
      : "");
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
  point.position = inAxes(header.said.axes.value_or(FileAxes::RAS), position);
  point.label = header.label < values.size() ? validUtf8(trimmed(values[header.label])) : "";
}

void readFiducials(const std::string& text, const LandmarkChoice& /*choice*/, LandmarkList& list)
{
  const FiducialHeader header = headerOf(text, list);
  std::size_t read = 0;
  std::size_t skipped = 0;
  Values values;
  RecordReader records(text, ',');
  while (records.next(values))
  {
    throwIfAny(records.endedInQuotes() ? "ends inside quotes" : "");
    if (isComment(values))
    {
      continue;
    }
    const std::string where = "line " + std::to_string(records.line());
    Landmark point;
    point.number = static_cast<double>(++read);
    withBeginning(beginningAt(where), [&] { requireCount(values, header); });
    const bool isPlaced = values.size() <= header.count || trimmed(values[StatusColumn]) == Placed;
    skipped += isPlaced ? 0 : 1;
    if (isPlaced)
    {
      withBeginning(beginningAt(where), [&] { readFiducial(values, header, point); });
      addLandmark(list, point, where);
    }
  }
  noteSkipped(list, skipped);
}

bool looksLikeFiducials(const std::string& beginning)
{
  const std::string text = lowerCase(trimmed(beginning));
  return !text.empty() && text[0] == '#' &&
    (text.find("markups fiducial file") != std::string::npos ||
      text.find("coordinatesystem") != std::string::npos ||
      text.find("# columns") != std::string::npos);
}

// As Slicer 5 writes them.
void writeFiducials(std::ostream& file, FileAxes axes, LandmarkList& list)
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

extern const LandmarkFormat LandmarksOfFiducials{ []() -> std::vector<std::string> {
                                                   return { ".fcsv" };
                                                 },
  looksLikeFiducials, readFiducials, writeFiducials, FileAxes::LPS, /*hasOneFrame=*/false,
  /*isUtf8=*/false, /*holdsNumbers=*/false };
}
