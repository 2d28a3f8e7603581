// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/SurfaceFile.h"

#include "Common/HostMemory.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"
#include "Formats/MGH/MGHVolume.h"
#include "Formats/NIFTI/NIFTIHeader.h"
#include "Formats/NIFTI/NIFTIVolume.h"
#include "Formats/Volumes/RasGrid.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

namespace brainshift
{
namespace
{
VolumeGrid readGrid(VolumeFile& file, const std::string& fileName)
{
  return withBeginning(file.noun() + " " + fileName + " ", [&] {
    VolumeHeader header;
    file.readHeader(fileName, header);
    withBeginning("places nothing: ", [&] { requireAffine(header.worldFromVoxel); });
    if (!header.knowsSides)
    {
      throw Problem("has no positions of its voxels");
    }
    return VolumeGrid{ header.worldFromVoxel, header.dimensions };
  });
}
}

glm::dmat4 scannerFromSurface(const VolumeFrame& frame)
{
  return glm::dmat4(glm::dvec4(-frame.xRas, 0.0), glm::dvec4(frame.zRas, 0.0),
    glm::dvec4(-frame.yRas, 0.0), glm::dvec4(frame.cRas, 1.0));
}

VolumeGrid readVolumeGrid(const std::string& fileName)
{
  if (isMGHFile(fileName))
  {
    MGHVolume volume;
    return readGrid(volume, fileName);
  }
  if (!isNIFTIFile(fileName))
  {
    throw Problem("Volume " + fileName + " is no FreeSurfer volume (.mgz, .mgh) and no NIfTI file");
  }
  NIFTIVolume volume;
  VolumeGrid grid = readGrid(volume, fileName);
  grid.worldFromVoxel = volume.inFileOrder(grid.worldFromVoxel, grid.dimensions);
  return grid;
}

VolumeFrame frameOf(const VolumeGrid& grid)
{
  const glm::dmat4& world = grid.worldFromVoxel;
  return { glm::normalize(glm::dvec3(world[0])), glm::normalize(glm::dvec3(world[1])),
    glm::normalize(glm::dvec3(world[2])),
    glm::dvec3(world * glm::dvec4(0.5 * glm::dvec3(grid.dimensions), 1.0)) };
}

namespace
{
// Bytes in memory for each byte of a file. In a packed GIFTI file, a byte may become many more,
// which its reader asks for when it knows how many.
constexpr double TimesOfSurface = 4.0;
constexpr const char* OtherSurface =
  "copy it again, or convert it to GIFTI (.gii), as mris_convert of FreeSurfer does";
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

// "is no map of values of FreeSurfer, such as lh.thickness, and no GIFTI file of values"
std::string noValues()
{
  std::string kinds;
  for (const SurfaceFormat* format : surfaceFormats())
  {
    kinds.append(kinds.empty() ? "is no " : ", and no ").append(format->values);
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

// The bytes of a file; none if it was told to stop. The reader will hold `timesInMemory` bytes in
// all for each byte of the file.
std::optional<std::vector<char>> readFileBytes(
  const std::string& fileName, double timesInMemory, const FractionDone& fractionDone)
{
  requirePlainFile(fileName);

  std::error_code error;
  const auto size = std::filesystem::file_size(fileName, error);
  if (error)
  {
    throw Problem("has an unknown size");
  }
  withBeginning("cannot be read: ",
    [&] { requireHostMemory("it", static_cast<double>(size) * timesInMemory); });
  std::vector<char> bytes(static_cast<std::size_t>(size));
  bool isStopped = false;
  readBytes({ fileName }, bytes.data(), bytes.size(), [&](double fraction) {
    isStopped = !fractionDone(fraction);
    return !isStopped;
  });
  return isStopped ? std::nullopt : std::optional(std::move(bytes));
}

// The hemisphere of a file: what its content says, or else its name, such as lh.pial,
// sub-01_hemi-R_white.surf.gii and 100307.L.midthickness.32k_fs_LR.surf.gii.
Hemisphere hemisphereOfFile(Hemisphere inFile, const std::string& fileName)
{
  std::string name = std::filesystem::path(fileName).filename().string();
  std::replace_if(
    name.begin(), name.end(), [](char c) { return c == '.' || c == '_' || c == '-'; }, ' ');
  return inFile == Hemisphere::Unknown ? hemisphereOf(wordsIn(name)) : inFile;
}

// Points of two hemispheres may be as many and mean other places: all of fsaverage are. They are
// shown, as those of symmetric templates are alike and people compare both halves there.
void noteOtherHemisphere(
  const std::string& surfaceName, const std::string& fileName, Surface& surface)
{
  const Hemisphere points = hemisphereOfFile(surface.ofPoints, surfaceName);
  const Hemisphere values = hemisphereOfFile(surface.ofValues, fileName);
  if (points == Hemisphere::Unknown || values == Hemisphere::Unknown || points == values)
  {
    return;
  }
  const auto word = [](Hemisphere one) { return one == Hemisphere::Left ? "left" : "right"; };
  surface.notes.push_back(joined("is of the ", word(values), " hemisphere, but the surface ",
    surfaceName, " of the ", word(points),
    ", by their names or their AnatomicalStructurePrimary; its values are at the right places only "
    "on a template whose halves have the same points (fsaverage_sym, fs_LR). Otherwise name the "
    "file of the ",
    word(points), " hemisphere"));
}

// Adds the numbers of a file to a surface that is not placed yet.
void addValues(const std::string& surfaceName, const std::string& fileName, Surface& surface,
  std::vector<std::string>& warnings)
{
  const std::string name = "File of values " + fileName;
  const std::size_t notes = surface.notes.size();
  const std::size_t arrays = surface.numbers.size();
  surface.ofValues = Hemisphere::Unknown;
  withWayOut(name + " ", OtherSurface, [&] {
    const auto bytes = readFileBytes(fileName, TimesOfSurface, [](double) { return true; });
    const SurfaceFormat* format = formatOfValues(*bytes);
    if (!format)
    {
      throw Problem(noValues());
    }
    format->addValues(*bytes, nameOfValues(fileName), surface);
  });
  if (surface.numbers.size() > arrays)
  {
    noteOtherHemisphere(surfaceName, fileName, surface);
  }
  const std::vector<std::string> found(
    surface.notes.begin() + static_cast<std::ptrdiff_t>(notes), surface.notes.end());
  surface.notes.resize(notes);
  const std::vector<std::string> more = sentences(name, found);
  warnings.insert(warnings.end(), more.begin(), more.end());
}
}

std::size_t bytesOf(NumberType type)
{
  switch (type)
  {
    case NumberType::Int8:
    case NumberType::UInt8:
      return 1;
    case NumberType::Int16:
    case NumberType::UInt16:
      return 2;
    case NumberType::Int64:
    case NumberType::UInt64:
    case NumberType::Float64:
      return 8;
    default:
      return 4;
  }
}

Hemisphere hemisphereOf(const std::vector<std::string>& words)
{
  const auto isOf = [&](const char* sign, const char* letter, const std::string& word) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& one) {
      return lowerCase(one) == sign || one == letter || endsWith(one, word);
    });
  };
  const bool isLeft = isOf("lh", "L", "left");
  const bool isRight = isOf("rh", "R", "right");
  return isLeft == isRight ? Hemisphere::Unknown : isLeft ? Hemisphere::Left : Hemisphere::Right;
}

std::string OwnNames::own(const std::string& name)
{
  std::string found = name;
  while (!this->Taken.insert(found).second)
  {
    int& next = this->Next.emplace(name, 2).first->second;
    found = name + " " + std::to_string(next);
    ++next;
  }
  return found;
}

void requirePoint(const glm::dvec3& point, const std::string& what)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(point[axis]) <= FarthestPoint))
    {
      throw Problem(joined("has ", what, " at a coordinate of ", point[axis], " mm; the limit is ",
        FarthestPoint, " mm"));
    }
  }
}

void placeSurface(Surface& surface)
{
  const auto count =
    static_cast<int>(std::min<std::size_t>(surface.points.size(), std::numeric_limits<int>::max()));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
  {
    glm::dvec3& point = surface.points[i];
    const std::string what = "point " + std::to_string(i);
    requirePoint(point, what);
    point = glm::dvec3(surface.worldFromStored * glm::dvec4(point, 1.0));
    requirePoint(point, what);
  }
  const bool isMirrored = glm::determinant(glm::dmat3(surface.worldFromStored)) < 0.0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    glm::ivec3& triangle = surface.triangles[i];
    for (int corner = 0; corner < 3; ++corner)
    {
      if (triangle[corner] < 0 || triangle[corner] >= count)
      {
        throw Problem("has the point " + std::to_string(triangle[corner]) + " in triangle " +
          std::to_string(i) + "; it has the points 0 to " + std::to_string(count - 1));
      }
    }
    if (isMirrored)
    {
      std::swap(triangle.y, triangle.z); // what was outside stays outside
    }
  }
}

std::string counted(std::size_t count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

bool isSurfaceFile(const std::string& fileName)
{
  return isOneOf(surfaceFormats(), fileName);
}

bool isTractFile(const std::string& fileName)
{
  return isOneOf(tractFormats(), fileName);
}

void readSurfaceFiles(const SurfaceFiles& files, const FractionDone& fractionDone, Surface& surface,
  std::vector<std::string>& warnings)
{
  surface = Surface();
  const std::string name = "Surface " + files.fileName;
  const bool isRead = withWayOut(name + " ", OtherSurface, [&] {
    const auto bytes = readFileBytes(files.fileName, TimesOfSurface, fractionDone);
    if (bytes)
    {
      formatOf(files.fileName, surfaceFormats())->read(*bytes, files.volume, surface);
    }
    return bytes.has_value();
  });
  if (!isRead)
  {
    return;
  }
  for (const std::string& values : files.valueFileNames)
  {
    if (!values.empty())
    {
      addValues(files.fileName, values, surface, warnings);
    }
  }
  withWayOut(name + " ", OtherSurface, [&] { placeSurface(surface); });
  const std::vector<std::string> notes = sentences(name, surface.notes);
  warnings.insert(warnings.end(), notes.begin(), notes.end());
}

namespace
{
// The bytes of a file of streamlines; none of a folder. Nothing if it was told to stop.
std::optional<std::vector<char>> tractBytes(
  const std::string& fileName, const FractionDone& fractionDone)
{
  std::error_code error;
  if (std::filesystem::is_directory(fileName, error) && isTractFile(fileName))
  {
    return std::vector<char>();
  }
  auto bytes = readFileBytes(fileName, TimesOfTracts, fractionDone);
  constexpr unsigned char Gzip[] = { 0x1f, 0x8b };
  const bool isPacked = bytes && bytes->size() > 2 &&
    static_cast<unsigned char>((*bytes)[0]) == Gzip[0] &&
    static_cast<unsigned char>((*bytes)[1]) == Gzip[1];
  return isPacked ? std::optional(unpackedGzip(*bytes, TimesOfTracts)) : std::move(bytes);
}

// A box of voxels of 1 mm around points.
TractBox boxAround(const std::vector<glm::vec3>& points)
{
  constexpr float LongestSide = 32767.0f; // of TrackVis
  glm::vec3 low(0.0f);
  glm::vec3 high(0.0f);
  if (!points.empty())
  {
    low = high = points.front();
  }
  for (const glm::vec3& point : points)
  {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  TractBox box;
  const glm::vec3 first = glm::floor(low);
  box.dimensions = glm::ivec3(glm::min(glm::ceil(high) - first + 1.0f, glm::vec3(LongestSide)));
  box.worldFromVoxel[3] = glm::dvec4(first, 1.0);
  return box;
}

TractBox boxOf(const std::string& volumeName)
{
  const VolumeGrid grid =
    withBeginning("Volume cannot be read: ", [&] { return readVolumeGrid(volumeName); });
  return { grid.dimensions, grid.worldFromVoxel };
}
}

void readTractFile(const TractSource& source, const FractionDone& fractionDone, Tracts& tracts,
  std::vector<std::string>& warnings)
{
  tracts = Tracts();
  const std::string name = "Tract file " + source.fileName;
  constexpr const char* OtherTracts =
    "copy it again, or convert it to .trk, .tck or .trx in the program that made it";
  withWayOut(name + " ", OtherTracts, [&] {
    auto bytes =
      tractBytes(source.fileName, [&](double fraction) { return fractionDone(0.4 * fraction); });
    if (bytes)
    {
      const auto rest = [&](double fraction) { return fractionDone(0.4 + 0.6 * fraction); };
      formatOf(source.fileName, tractFormats())->read(*bytes, source, rest, tracts);
    }
  });
  warnings = sentences(name, tracts.notes);
}

void writeTractFile(const std::string& fileName, const std::string& volumeName,
  const Tracts& tracts, std::vector<std::string>& warnings)
{
  std::string endings;
  for (const TractFormat* format : tractFormats())
  {
    endings += (endings.empty() ? "" : ", ") + std::string(format->ending);
    if (endsWith(fileName, format->ending))
    {
      for (std::size_t i = 0; i < tracts.points.size(); ++i)
      {
        withBeginning("Tract file " + fileName + " cannot be written: it ",
          [&] { requirePoint(glm::dvec3(tracts.points[i]), "point " + std::to_string(i)); });
      }
      TractNotes notes = tracts.notes;
      format->write(
        fileName, tracts, volumeName.empty() ? boxAround(tracts.points) : boxOf(volumeName), notes);
      warnings = sentences("Tract file " + fileName, notes);
      return;
    }
  }
  throw Problem("The extension of the tract file " + fileName + " must be one of " + endings);
}
}
