// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Surfaces/SurfaceFile.h"

#include "Filters/Surfaces/GIFTIFile.h"
#include "Filters/Surfaces/GIFTISurface.h"
#include "Filters/Surfaces/MRtrixFile.h"
#include "Filters/Surfaces/TrackVisFile.h"

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
  if (beginsLikeFreeSurferValues(file.bytes))
  {
    NamedNumbers numbers;
    problem = readFreeSurferValues(file.bytes, numbers);
    const std::size_t tuples = numbers.bytes.size() / (4 * numbers.components);
    if (problem.empty() && tuples != surface.points.size())
    {
      surface.notes.push_back("has values of " + counted(tuples, "point") + "; the surface has " +
        std::to_string(surface.points.size()) + ", so they are left out");
    }
    else if (problem.empty())
    {
      numbers.name = surface.names.own(nameOfValues(fileName));
      surface.numbers.push_back(std::move(numbers));
    }
  }
  else
  {
    problem = isGIFTIFile(fileName)
      ? addGIFTINumbers(file.bytes, surface)
      : "is no map of values of FreeSurfer, such as lh.thickness, and no GIFTI file";
  }
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
  return isFreeSurferSurface(fileName) || isGIFTIFile(fileName);
}

bool isTractFile(const std::string& fileName)
{
  return isTrackVisFile(fileName) || isMRtrixFile(fileName);
}

std::string readSurfaceFiles(const SurfaceFiles& files, const ShareDone& shareDone,
  Surface& surface, std::vector<std::string>& warnings)
{
  surface = Surface();
  FileBytes file;
  std::string problem = readFileBytes(files.fileName, TimesOfSurface, shareDone, file);
  if (problem.empty() && !file.isStopped)
  {
    problem = isGIFTIFile(files.fileName)
      ? readGIFTISurface(file.bytes, surface)
      : readFreeSurferSurface(file.bytes, files.volume, surface);
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
    problem = isTrackVisFile(fileName) ? readTrackVis(file.bytes, volumeName, rest, tracts)
                                       : readMRtrix(file.bytes, rest, tracts);
  }
  const std::string name = "Tract file " + fileName;
  warnings = sentences(name, tracts.notes);
  return problem.empty() ? problem : name + " " + problem;
}
}
