// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/LandmarkFile.h"

#include "Common/Numbers.h"
#include "Formats/Files/Endings.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Landmarks/Coordsystem.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::size_t Beginning = 1 << 16;     // bytes by which a format is known
constexpr std::size_t LongestText = 512 << 20; // bytes

const LandmarkFormat& knownFormatOf(const std::string& fileName)
{
  if (const LandmarkFormat* format = formatByEnding(landmarkFormats(), fileName))
  {
    return *format;
  }
  throw Problem("The extension of the landmark file " + fileName + " must be " +
    endingsInWords(landmarkFormats()));
}

// Text in UTF-8. What is none counts as Latin-1, of which each byte is a letter, with a note,
// unless the format is UTF-8.
std::string utf8Of(std::string text, const LandmarkFormat& format, LandmarkList& list)
{
  if (format.isUtf8 || validUtf8(text) == text)
  {
    return text;
  }
  list.notes.emplace_back("is no UTF-8; its names are read as Latin-1");
  return utf8OfLatin1(text);
}

bool hasNumbers(const LandmarkList& list)
{
  return std::any_of(list.points.begin(), list.points.end(),
    [](const Landmark& point) { return !std::isnan(point.time) || !std::isnan(point.deviation); });
}

// Throws if a point has no finite position, which no format can hold.
void requirePositions(const std::string& fileName, const LandmarkList& list)
{
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    const Landmark& point = list.points[i];
    if (!std::isfinite(point.position.x + point.position.y + point.position.z))
    {
      const std::string name = point.label.empty() ? "" : " (" + shownWords(point.label) + ")";
      throw Problem(joined("File ", fileName, " cannot be written: point ", i + 1, name,
        " has no finite position; a transform may have no number there"));
    }
  }
}
}

FileAxes axesFrom(const std::string& word)
{
  const std::string lower = lowerCase(trimmed(word));
  if (lower == "ras" || lower == "0")
  {
    return FileAxes::RAS;
  }
  if (lower == "lps" || lower == "1")
  {
    return FileAxes::LPS;
  }
  throw Problem(
    "names the coordinate system " + shownWords(word) + "; it must be RAS (0) or LPS (1)");
}

void addLandmark(LandmarkList& list, Landmark point, const std::string& where)
{
  if (list.points.size() == MostLandmarks)
  {
    throw Problem("has more than " + std::to_string(MostLandmarks) + " points");
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(point.position[axis]) <= FarthestLandmark))
    {
      throw Problem("has a coordinate of " + numberText(point.position[axis]) + " mm in " + where +
        "; the limit is " + numberText(FarthestLandmark) + " mm");
    }
  }
  list.points.push_back(std::move(point));
}

std::string beginningAt(const std::string& where)
{
  return "has a " + where + " that ";
}

void noteOnce(LandmarkList& list, const std::string& note)
{
  if (std::find(list.notes.begin(), list.notes.end(), note) == list.notes.end())
  {
    list.notes.push_back(note);
  }
}

void noteSkipped(LandmarkList& list, std::size_t skipped)
{
  if (skipped > 0)
  {
    list.notes.push_back("has " + std::to_string(skipped) + (skipped == 1 ? " point" : " points") +
      " without a position, left out");
  }
}

namespace
{
// Positions of a head in metres are as near to each other as no landmarks in mm are.
void noteSmall(LandmarkList& list)
{
  constexpr std::size_t Few = 3; // the fiducials of a head
  constexpr double SmallMm = 1.0;
  glm::dvec3 low(HUGE_VAL);
  glm::dvec3 high(-HUGE_VAL);
  for (const Landmark& point : list.points)
  {
    low = glm::min(low, point.position);
    high = glm::max(high, point.position);
  }
  const double sizeMm = list.points.size() < Few ? HUGE_VAL : glm::length(high - low);
  if (sizeMm > 0.0 && sizeMm < SmallMm)
  {
    list.notes.push_back(joined("has ", list.points.size(), " points within ", roundedText(sizeMm),
      " mm; check whether they are in metres"));
  }
}
}

bool isLandmarkFile(const std::string& fileName)
{
  const LandmarkFormat* format = formatByEnding(landmarkFormats(), fileName);
  return format &&
    format->looksLike(withLineFeeds(withoutMark(readBeginning(fileName, Beginning))));
}

LandmarkList readLandmarkFile(const std::string& fileName, int volume, const TableRule& table)
{
  const LandmarkFormat& format = knownFormatOf(fileName);
  LandmarkList list;
  constexpr const char* OtherFile =
    "save it again in the program that made it, or as a table (.csv) with columns r, a, s";
  withWayOut("Landmark file " + fileName + " ", OtherFile, [&] {
    const std::string text =
      utf8Of(withLineFeeds(readPlainText(fileName, LongestText)), format, list);
    LandmarkChoice choice{ volume, table };
    const std::optional<ElectrodeFrame> beside = electrodeFrame(fileName, list);
    choice.table.mm = beside ? beside->mm : table.mm;
    choice.table.axes = beside && beside->axes ? *beside->axes : table.axes;
    choice.table.isSaidBeside = beside && beside->isSaid;
    choice.table.hasAxesBeside = beside && beside->axes;
    format.read(text, choice, list);
    noteSmall(list);
  });
  return list;
}

void writeLandmarkFile(
  const std::string& fileName, std::optional<FileAxes> axes, LandmarkList& list)
{
  const LandmarkFormat& format = knownFormatOf(fileName);
  if (format.hasOneFrame && axes.value_or(format.axes) != format.axes)
  {
    const std::string own = format.axes == FileAxes::RAS ? "RAS" : "LPS";
    throw Problem("File " + fileName + " cannot be written: a file " + format.endings().front() +
      " always has " + own + " axes; choose " + own);
  }
  requirePositions(fileName, list);
  if (hasNumbers(list) && !format.holdsNumbers)
  {
    list.notes.emplace_back("cannot hold times and deviations, which are left out; .csv can");
  }
  writeWholeStream(
    fileName, [&](std::ostream& file) { format.write(file, axes.value_or(format.axes), list); });
}
}
