// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/LandmarkFile.h"

#include "Common/Numbers.h"
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

enum class Format
{
  Unknown,
  Markups,
  Fiducials,
  Tags,
  Commas,
  Tabs,
};

Format formatOf(const std::string& fileName)
{
  return endsWith(fileName, ".json") ? Format::Markups
    : endsWith(fileName, ".fcsv")    ? Format::Fiducials
    : endsWith(fileName, ".tag")     ? Format::Tags
    : endsWith(fileName, ".csv")     ? Format::Commas
    : endsWith(fileName, ".tsv")     ? Format::Tabs
                                     : Format::Unknown;
}

Format knownFormatOf(const std::string& fileName)
{
  const Format format = formatOf(fileName);
  if (format == Format::Unknown)
  {
    throw Problem("The extension of the landmark file " + fileName +
      " must be .mrk.json, .json, .fcsv, .tag, .csv or .tsv");
  }
  return format;
}

// Text in UTF-8. What is none counts as Latin-1, of which each byte is a letter, with a note. JSON
// is UTF-8 or refused.
std::string utf8Of(std::string text, Format format, LandmarkList& list)
{
  if (format == Format::Markups || validUtf8(text) == text)
  {
    return text;
  }
  list.notes.emplace_back("is no UTF-8; its names are read as Latin-1");
  return utf8OfLatin1(text);
}

void parse(
  const std::string& text, Format format, int volume, const TableRule& table, LandmarkList& list)
{
  switch (format)
  {
    case Format::Markups:
      return readMarkups(text, list);
    case Format::Fiducials:
      return readFiducials(text, list);
    case Format::Tags:
      return readTags(text, volume, list);
    default:
      return readPointTable(text, table, list);
  }
}

// What the format cannot keep of the points.
void noteLosses(Format format, LandmarkList& list)
{
  const bool isTable = format == Format::Commas || format == Format::Tabs;
  const bool hasNumbers = std::any_of(list.points.begin(), list.points.end(),
    [](const Landmark& point) { return !std::isnan(point.time) || !std::isnan(point.deviation); });
  if (hasNumbers && !isTable)
  {
    list.notes.emplace_back("cannot hold times and deviations, which are left out; .csv can");
  }
  const auto changed = std::count_if(list.points.begin(), list.points.end(),
    [](const Landmark& point) { return isChangedInTags(point.label); });
  if (changed > 0 && format == Format::Tags)
  {
    list.notes.push_back("has " + std::to_string(changed) +
      " labels with quotes or new lines, which became apostrophes and spaces");
  }
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

void write(std::ostream& file, Format format, FileAxes axes, const LandmarkList& list)
{
  switch (format)
  {
    case Format::Markups:
      return writeMarkups(file, axes, list);
    case Format::Fiducials:
      return writeFiducials(file, axes, list);
    case Format::Tags:
      return writeTags(file, list);
    default:
      return writePointTable(file, axes, format == Format::Tabs ? '\t' : ',', list);
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

void noteSkipped(LandmarkList& list, std::size_t skipped)
{
  if (skipped > 0)
  {
    list.notes.push_back("has " + std::to_string(skipped) + (skipped == 1 ? " point" : " points") +
      " without a position, left out");
  }
}

bool isLandmarkFile(const std::string& fileName)
{
  const Format format = formatOf(fileName);
  const std::string text =
    format == Format::Unknown ? std::string() : withoutMark(readBeginning(fileName, Beginning));
  switch (format)
  {
    case Format::Unknown:
      return false;
    case Format::Markups:
      return looksLikeMarkups(text);
    case Format::Fiducials:
      return looksLikeFiducials(text);
    case Format::Tags:
      return looksLikeTags(text);
    default:
      return looksLikePointTable(text);
  }
}

LandmarkList readLandmarkFile(const std::string& fileName, int volume, const TableRule& table)
{
  const Format format = knownFormatOf(fileName);
  LandmarkList list;
  constexpr const char* OtherFile =
    "save it again in the program that made it, or as a table (.csv) with columns r, a, s";
  withWayOut("Landmark file " + fileName + " ", OtherFile, [&] {
    const std::string text = utf8Of(readPlainText(fileName, LongestText), format, list);
    TableRule rule = table;
    const std::optional<ElectrodeFrame> beside = electrodeFrame(fileName, list);
    rule.mm = beside ? beside->mm : table.mm;
    rule.axes = beside && beside->axes ? *beside->axes : table.axes;
    parse(text, format, volume, rule, list);
  });
  return list;
}

void writeLandmarkFile(
  const std::string& fileName, std::optional<FileAxes> axes, LandmarkList& list)
{
  const Format format = knownFormatOf(fileName);
  if (format == Format::Tags && axes == FileAxes::LPS)
  {
    throw Problem("File " + fileName + " cannot be written: an MNI tag file has RAS axes, not LPS");
  }
  requirePositions(fileName, list);
  const bool isOfSlicer = format == Format::Markups || format == Format::Fiducials;
  const FileAxes written = axes.value_or(isOfSlicer ? FileAxes::LPS : FileAxes::RAS);
  noteLosses(format, list);
  writeWholeStream(fileName, [&](std::ostream& file) { write(file, format, written, list); });
}
}
