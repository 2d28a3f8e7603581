// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/LandmarkFile.h"

#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Landmarks/FiducialFile.h"
#include "Formats/Landmarks/MarkupsFile.h"
#include "Formats/Landmarks/PlainText.h"
#include "Formats/Landmarks/PointTable.h"
#include "Formats/Landmarks/TagFile.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <ios>
#include <locale>

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

std::string unknownFormat(const std::string& fileName)
{
  return "The extension of the landmark file " + fileName +
    " must be .mrk.json, .json, .fcsv, .tag, .csv or .tsv";
}

std::string parse(
  const std::string& text, Format format, int volume, FileAxes tableAxes, LandmarkList& list)
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
      return readPointTable(text, tableAxes, list);
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
    list.notes.emplace_back("has no place for times and deviations, left out; .csv has");
  }
  const auto changed = std::count_if(list.points.begin(), list.points.end(),
    [](const Landmark& point) { return isChangedInTags(point.label); });
  if (changed > 0 && format == Format::Tags)
  {
    list.notes.push_back("has " + std::to_string(changed) +
      " labels with quotes or new lines, which became apostrophes and spaces");
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

bool isLandmarkFile(const std::string& fileName)
{
  const Format format = formatOf(fileName);
  const std::string text =
    format == Format::Unknown ? std::string() : readBeginning(fileName, Beginning);
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

std::string readLandmarkFile(
  const std::string& fileName, int volume, FileAxes tableAxes, LandmarkList& list)
{
  list = LandmarkList();
  const Format format = formatOf(fileName);
  if (format == Format::Unknown)
  {
    return unknownFormat(fileName);
  }
  std::string text;
  std::string problem = readPlainText(fileName, LongestText, text);
  problem = problem.empty() ? parse(text, format, volume, tableAxes, list) : problem;
  return problem.empty() ? problem : "Landmark file " + fileName + " " + problem;
}

std::string writeLandmarkFile(
  const std::string& fileName, std::optional<FileAxes> axes, LandmarkList& list)
{
  const Format format = formatOf(fileName);
  if (format == Format::Unknown)
  {
    return unknownFormat(fileName);
  }
  if (format == Format::Tags && axes == FileAxes::LPS)
  {
    return "File " + fileName + " cannot be written: an MNI tag file has RAS axes, not LPS";
  }
  const bool isOfSlicer = format == Format::Markups || format == Format::Fiducials;
  const FileAxes written = axes.value_or(isOfSlicer ? FileAxes::LPS : FileAxes::RAS);
  noteLosses(format, list);
  return writeWhole(fileName, [&](const std::string& beside) {
    errno = 0;
    std::ofstream file(beside, std::ios::binary);
    file.imbue(std::locale::classic());
    write(file, format, written, list);
    file.close();
    return file ? std::string() : lastSystemError();
  });
}
}
