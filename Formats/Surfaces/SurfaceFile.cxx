// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/SurfaceFile.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace brainshift
{
namespace
{
// Bytes in memory for each byte of a file. In a packed GIFTI file, a byte may become many more,
// which its reader asks for when it knows how many.
constexpr double TimesOfSurface = 4.0;
constexpr double TimesOfTracts = 3.5; // the file, its points in ours and in VTK's order, indices

std::vector<std::string> sentences(const std::string& name, const std::vector<std::string>& notes)
{
  std::vector<std::string> whole;
  whole.reserve(notes.size());
  for (const std::string& note : notes)
  {
    whole.push_back(name);
    whole.back().append(" ").append(note);
  }
  return whole;
}

// "thickness" of lh.thickness.
std::string nameOfValues(const std::string& fileName)
{
  std::string name = std::filesystem::path(fileName).filename().string();
  const std::string side = name.substr(0, 3);
  return (side == "lh." || side == "rh.") && name.size() > 3 ? name.substr(3) : name;
}

// The format of a map of values. Null: none.
const SurfaceFormat* formatOfValues(const std::vector<char>& bytes)
{
  for (const SurfaceFormat* format : surfaceFormats())
  {
    if (format->isOfValues(bytes))
    {
      return format;
    }
  }
  return nullptr;
}

// "is no map of values of FreeSurfer, such as lh.thickness, and no GIFTI file"
std::string noValues()
{
  std::string kinds;
  for (const SurfaceFormat* format : surfaceFormats())
  {
    kinds.append(kinds.empty() ? "is no " : " and no ").append(format->values);
  }
  return kinds;
}

template <typename Format>
bool isOneOf(const std::vector<const Format*>& formats, const std::string& fileName)
{
  return std::any_of(
    formats.begin(), formats.end(), [&](const Format* format) { return format->isOne(fileName); });
}

// The first of the formats whose file this is. Of a file that none recognises, the last one says
// what is wrong with its first bytes.
template <typename Format>
const Format* formatOf(const std::string& fileName, const std::vector<const Format*>& formats)
{
  const auto found = std::find_if(
    formats.begin(), formats.end(), [&](const Format* format) { return format->isOne(fileName); });
  return found == formats.end() ? formats.back() : *found;
}

// Adds the numbers of a file to a surface that is not placed yet.
std::string addValues(
  const std::string& fileName, Surface& surface, std::vector<std::string>& warnings)
{
  FileBytes file;
  const std::string name = "File of values " + fileName;
  std::string problem = readFileBytes(fileName, TimesOfSurface, [](double) { return true; }, file);
  if (!problem.empty())
  {
    return name + " " + problem;
  }
  const std::size_t notes = surface.notes.size();
  const SurfaceFormat* format = formatOfValues(file.bytes);
  problem = format ? format->addValues(file.bytes, nameOfValues(fileName), surface) : noValues();
  const std::vector<std::string> found(
    surface.notes.begin() + static_cast<std::ptrdiff_t>(notes), surface.notes.end());
  surface.notes.resize(notes);
  const std::vector<std::string> more = sentences(name, found);
  warnings.insert(warnings.end(), more.begin(), more.end());
  return problem.empty() ? problem : name + " " + problem;
}
}

bool isSurfaceFile(const std::string& fileName)
{
  return isOneOf(surfaceFormats(), fileName);
}

bool isTractFile(const std::string& fileName)
{
  return isOneOf(tractFormats(), fileName);
}

std::string readSurfaceFiles(const SurfaceFiles& files, const ShareDone& shareDone,
  Surface& surface, std::vector<std::string>& warnings)
{
  surface = Surface();
  FileBytes file;
  std::string problem = readFileBytes(files.fileName, TimesOfSurface, shareDone, file);
  if (problem.empty() && !file.isStopped)
  {
    problem = formatOf(files.fileName, surfaceFormats())->read(file.bytes, files.volume, surface);
  }
  const std::string name = "Surface " + files.fileName;
  if (!problem.empty() || file.isStopped)
  {
    return problem.empty() ? problem : name + " " + problem;
  }
  for (const std::string& values : files.valueFileNames)
  {
    problem = values.empty() ? problem : addValues(values, surface, warnings);
    if (!problem.empty())
    {
      return problem;
    }
  }
  problem = placeSurface(surface);
  const std::vector<std::string> notes = sentences(name, surface.notes);
  warnings.insert(warnings.end(), notes.begin(), notes.end());
  return problem.empty() ? problem : name + " " + problem;
}

std::string readTractFile(const std::string& fileName, const std::string& volumeName,
  const ShareDone& shareDone, Tracts& tracts, std::vector<std::string>& warnings)
{
  tracts = Tracts();
  FileBytes file;
  std::string problem = readFileBytes(
    fileName, TimesOfTracts, [&](double share) { return shareDone(0.4 * share); }, file);
  if (problem.empty() && !file.isStopped)
  {
    const auto rest = [&](double share) { return shareDone(0.4 + 0.6 * share); };
    problem = formatOf(fileName, tractFormats())->read(file.bytes, volumeName, rest, tracts);
  }
  const std::string name = "Tract file " + fileName;
  warnings = sentences(name, tracts.notes);
  return problem.empty() ? problem : name + " " + problem;
}
}
