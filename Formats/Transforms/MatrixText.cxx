// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/MatrixText.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Volumes/PlacedVolume.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double FarthestCorner = 0.01; // mm, of two images of one geometry
constexpr double RoundingOfLast = 1e-5; // of the last row of a matrix in float32
constexpr std::size_t MostMaps = 100;   // of an XFM

using Entries = std::map<std::string, std::string>;

const std::string& valueOf(const Entries& entries, const std::string& key)
{
  const auto found = entries.find(key);
  if (found == entries.end())
  {
    throw Problem("has no entry " + key);
  }
  return found->second;
}

glm::dvec3 threeOf(const Entries& entries, const std::string& key)
{
  const std::vector<double> numbers = numbersIn(valueOf(entries, key));
  const glm::dvec3 three =
    numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2]) : glm::dvec3(std::nan(""));
  if (!std::isfinite(glm::length(three)))
  {
    throw Problem(
      "has the " + key + " " + shownWords(valueOf(entries, key)) + "; it must be 3 finite numbers");
  }
  return three;
}

// Rows of 3 or 4 times 4 numbers. The last row may be rounded.
glm::dmat4 checkedMatrix(const std::vector<double>& rows)
{
  glm::dmat4 matrix(1.0);
  for (std::size_t i = 0; i < rows.size() && i < 12; ++i)
  {
    matrix[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = rows[i];
  }
  for (std::size_t i = 12; i < rows.size(); ++i)
  {
    if (!(std::abs(rows[i] - (i == 15 ? 1.0 : 0.0)) <= RoundingOfLast))
    {
      throw Problem("holds a 4 x 4 matrix whose last row is not 0 0 0 1");
    }
  }
  const double volume = std::abs(glm::determinant(glm::dmat3(matrix)));
  if (!(volume > SmallestVolume) || !std::isfinite(volume + glm::length(glm::dvec3(matrix[3]))))
  {
    throw Problem("holds a matrix without an inverse");
  }
  return matrix;
}

AffineLink linkOf(const glm::dmat4& matrix)
{
  return { glm::dmat3(matrix), glm::dvec3(matrix[3]) };
}

// One of the two images of an LTA. The names are FreeSurfer's.
struct Geometry
{
  bool isValid = false;
  glm::ivec3 volume{ 0 };
  glm::dmat4 rasFromVoxel{ 1.0 };
};

// What an LTA says.
struct LTA
{
  Entries entries; // before the images; `rows` has the matrix
  std::vector<double> rows;
  std::map<std::string, Entries> images; // src, dst
  bool isOfNiTransforms = false;
};

void addEntry(const std::string& line, Entries& entries)
{
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos)
  {
    return; // subject, fscale, of which the map does not depend
  }
  const std::string key = trimmed(line.substr(0, equals));
  if (!entries.emplace(key, trimmed(line.substr(equals + 1))).second)
  {
    throw Problem(twice("entry " + shownWords(key)));
  }
}

// Takes the line that follows `1 4 4`. False behind the last one.
bool takeRow(const std::string& line, std::vector<double>& rows)
{
  constexpr std::size_t All = 16;
  if (rows.size() >= All)
  {
    return false;
  }
  const std::vector<double> numbers = numbersIn(line);
  if (numbers.size() != 4)
  {
    throw Problem("has the row '" + shownWords(line) + "' of its matrix; it must have 4 numbers");
  }
  rows.insert(rows.end(), numbers.begin(), numbers.end());
  return true;
}

LTA ltaOf(const std::string& text)
{
  LTA lta;
  std::istringstream lines(text);
  bool isMatrix = false;
  Entries* entries = &lta.entries;
  for (std::string whole; std::getline(lines, whole);)
  {
    lta.isOfNiTransforms =
      lta.isOfNiTransforms || (whole[0] == '#' && whole.find("NiTransforms") != std::string::npos);
    const std::string line = trimmed(whole.substr(0, whole.find('#')));
    if (line.empty() || (isMatrix && takeRow(line, lta.rows)))
    {
      continue;
    }
    if (wordsIn(line) == std::vector<std::string>{ "1", "4", "4" })
    {
      throwIfAny(isMatrix ? twice("matrix (1 4 4)") : "");
      isMatrix = true;
      continue;
    }
    if (line == "src volume info" || line == "dst volume info")
    {
      const auto added = lta.images.emplace(line.substr(0, 3), Entries());
      throwIfAny(added.second ? "" : twice(line));
      entries = &added.first->second;
      continue;
    }
    addEntry(line, *entries);
  }
  if (lta.rows.size() != 16)
  {
    throw Problem("has no whole matrix (1 4 4, then 4 rows of 4 numbers)");
  }
  return lta;
}

Geometry geometryOf(const LTA& lta, const std::string& end)
{
  const auto found = lta.images.find(end);
  Geometry geometry;
  if (found == lta.images.end() || found->second.count("valid") == 0 ||
    numbersIn(found->second.at("valid")) != std::vector<double>{ 1.0 })
  {
    return geometry;
  }
  const Entries& entries = found->second;
  const glm::dvec3 sides = threeOf(entries, "volume");
  const glm::dvec3 sizes = threeOf(entries, "voxelsize");
  const glm::dmat3 axes(
    threeOf(entries, "xras"), threeOf(entries, "yras"), threeOf(entries, "zras"));
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!isWhole(sides[axis], 1.0, 65535.0))
    {
      throw Problem(joined("has the volume ", shownWords(entries.at("volume")), " of its ", end,
        "; it must be 3 whole numbers from 1 to 65535"));
    }
    geometry.rasFromVoxel[axis] = glm::dvec4(sizes[axis] * axes[axis], 0.0);
  }
  geometry.isValid = true;
  geometry.volume = glm::ivec3(sides);
  geometry.rasFromVoxel[3] =
    glm::dvec4(threeOf(entries, "cras") - glm::dmat3(geometry.rasFromVoxel) * (0.5 * sides), 1.0);
  withBeginning("places its " + end + " nowhere: ", [&] { requireAffine(geometry.rasFromVoxel); });
  return geometry;
}

// Whether two images have their corners at the same places.
bool isSame(const Geometry& geometry, const RasGrid& image)
{
  if (!geometry.isValid)
  {
    return false;
  }
  const Grid grid = nearestRasGrid(geometry.rasFromVoxel, geometry.volume).grid;
  bool isEqual = grid.dimensions == image.grid.dimensions;
  for (int corner = 0; corner < 8 && isEqual; ++corner)
  {
    const glm::dvec3 at =
      glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) * glm::dvec3(grid.dimensions - 1);
    isEqual = glm::distance(grid.worldFromGrid(at), image.grid.worldFromGrid(at)) <= FarthestCorner;
  }
  return isEqual;
}

// Lets an image that is named say which end it is. `isSrc` is what it was until now.
void choose(const LTA& lta, const std::string& what, const std::string& image, bool& isSrc)
{
  if (image.empty())
  {
    return;
  }
  PlacedVolume volume = withBeginning(
    "names the " + what + " image, which cannot be read: ", [&] { return openVolume(image); });
  const bool matches[2] = { isSame(geometryOf(lta, "dst"), volume.geometry()),
    isSame(geometryOf(lta, "src"), volume.geometry()) };
  if (!matches[0] && !matches[1])
  {
    throw Problem("leads from its src to its dst, and neither has the voxels of the " + what +
      " image " + image + "; name the image that the registration was given");
  }
  isSrc = matches[0] && matches[1] ? isSrc : matches[1];
}

// The first bytes without lines of comments and empty ones.
std::string firstLine(const std::string& text)
{
  constexpr std::size_t Most = 65536;
  std::istringstream lines(text.substr(0, Most));
  for (std::string line; std::getline(lines, line);)
  {
    const std::string found = trimmed(line);
    if (!found.empty() && found.front() != '#')
    {
      return found;
    }
  }
  return {};
}
}

bool isLTAText(const std::string& text)
{
  const std::string line = firstLine(text);
  const std::vector<std::string> words = wordsIn(line.substr(0, line.find('=')));
  return words == std::vector<std::string>{ "type" } && text.find("nxforms") != std::string::npos;
}

bool addLTAText(const std::string& text, const NamedImages& images, PointTransform& transform)
{
  const LTA lta = ltaOf(text);
  const std::vector<double> type = numbersIn(valueOf(lta.entries, "type"));
  const bool isOfVoxels = type == std::vector<double>{ 0.0 };
  if (!isOfVoxels && type != std::vector<double>{ 1.0 })
  {
    throw Problem("is an LTA of type " + shownWords(valueOf(lta.entries, "type")) +
      "; BrainShift reads 0 (LINEAR_VOX_TO_VOX) and 1 (LINEAR_RAS_TO_RAS), which lta_convert makes "
      "of others");
  }
  if (numbersIn(valueOf(lta.entries, "nxforms")) != std::vector<double>{ 1.0 })
  {
    throw Problem("holds " + shownWords(valueOf(lta.entries, "nxforms")) +
      " transforms (nxforms); it must hold 1");
  }
  glm::dmat4 dstFromSrc = checkedMatrix(lta.rows); // RAS, mm
  if (isOfVoxels)
  {
    const Geometry src = geometryOf(lta, "src");
    const Geometry dst = geometryOf(lta, "dst");
    if (!src.isValid || !dst.isValid)
    {
      throw Problem("leads from voxels to voxels and has no valid src or dst volume info, which "
                    "says where they are; lta_convert with the images makes RAS to RAS of it");
    }
    dstFromSrc = dst.rasFromVoxel * dstFromSrc * glm::inverse(src.rasFromVoxel);
  }
  if (lta.isOfNiTransforms) // its matrix leads from dst, the moving image, to src
  {
    dstFromSrc = glm::inverse(dstFromSrc);
  }
  bool isSrcFixed = lta.isOfNiTransforms;
  bool isSrcMoving = !isSrcFixed;
  choose(lta, "fixed", images.fixed, isSrcFixed);
  isSrcMoving = images.fixed.empty() ? isSrcMoving : !isSrcFixed;
  choose(lta, "moving", images.moving, isSrcMoving);
  if (!images.fixed.empty() && isSrcFixed == isSrcMoving)
  {
    throw Problem("has one end with the voxels of both the fixed image " + images.fixed +
      " and the moving image " + images.moving + "; name the two that it was made of");
  }
  transform.links.emplace_back(linkOf(isSrcMoving ? glm::inverse(dstFromSrc) : dstFromSrc));
  return isSrcMoving != lta.isOfNiTransforms;
}

namespace
{
constexpr const char* XFMBegin = "MNI Transform File";

// "Key = value" of each statement between semicolons.
std::vector<std::pair<std::string, std::string>> statementsOf(const std::string& text)
{
  std::string plain;
  std::istringstream lines(text);
  std::getline(lines, plain); // the format's name
  plain.clear();
  for (std::string line; std::getline(lines, line);)
  {
    plain += line.substr(0, line.find('%')) + "\n";
  }
  std::vector<std::pair<std::string, std::string>> statements;
  std::istringstream parts(plain);
  for (std::string part; std::getline(parts, part, ';');)
  {
    const std::size_t equals = part.find('=');
    const std::string shown = trimmed(part);
    if (equals != std::string::npos)
    {
      statements.emplace_back(trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 1)));
    }
    else if (!shown.empty())
    {
      throw Problem("has '" + shownWords(shown) +
        "' where an entry such as Transform_Type = Linear; "
        "must stand");
    }
  }
  return statements;
}

// A displacement volume of an XFM.
FieldLink gridOf(const std::string& fileName)
{
  PlacedVolume volume = openVolume(fileName);
  for (const std::string& warning : volume.warnings()) // a step that counts as 1 mm moves points
  {
    warn(nullptr, warning);
  }
  const Grid& grid = volume.geometry().grid;
  const VolumeHeader& header = volume.header();
  const bool isWide = glm::all(glm::greaterThan(grid.dimensions, glm::ivec3(1)));
  if (header.components != 3 || header.times.size() != 1 || !isWide)
  {
    throw Problem(joined("Volume ", fileName, " has ", header.components, " components and ",
      header.times.size(), " times on ", sizeText(glm::dvec3(grid.dimensions)),
      " points; a displacement volume must have 3 components, one time and 2 points or more along "
      "each axis"));
  }
  if (volume.geometry().shear > LargestUnreportedShear)
  {
    throw Problem(joined("Volume ", fileName, " is sheared: the cosine between two of its axes is ",
      volume.geometry().shear, "; that of a displacement volume must be below ",
      LargestUnreportedShear));
  }
  const glm::ivec3 last = grid.dimensions - 1;
  const int extent[6] = { 0, last.x, 0, last.y, 0, last.z };
  vtkNew<vtkImageData> image;
  volume.read(0, extent, [](double) { return true; }, image);
  FieldLink link;
  link.between = Between::Cubic;
  link.grid.dimensions = grid.dimensions;
  link.grid.origin = grid.origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    link.grid.worldFromGrid[axis] = grid.direction[axis] * grid.spacing[axis];
  }
  link.grid.gridFromWorld = glm::inverse(link.grid.worldFromGrid);
  vtkDataArray* numbers = image->GetPointData()->GetScalars();
  link.displacements.resize(link.grid.count());
  for (std::size_t i = 0; i < link.displacements.size(); ++i)
  {
    double vector[3];
    numbers->GetTuple(static_cast<vtkIdType>(i), vector);
    link.displacements[i] = glm::vec3(vector[0], vector[1], vector[2]);
  }
  return link;
}

// One map of an XFM, from its source to its target, and whether it is named by its inverse.
struct StoredMap
{
  std::string type;
  Entries entries;
};

bool isInverted(const StoredMap& map)
{
  const auto flag = map.entries.find("Invert_Flag");
  const std::string word = flag == map.entries.end() ? "false" : lowerCase(flag->second);
  if (word != "true" && word != "false")
  {
    throw Problem("has the Invert_Flag " + shownWords(flag->second) + "; it must be True or False");
  }
  return word == "true";
}

TransformLink linkOf(const StoredMap& map, const std::string& fileName)
{
  if (map.type == "Linear")
  {
    const std::vector<double> numbers = numbersIn(valueOf(map.entries, "Linear_Transform"));
    if (numbers.size() != 12)
    {
      throw Problem("has " + std::to_string(numbers.size()) +
        " numbers in Linear_Transform; it must have 12, in 3 rows");
    }
    return linkOf(checkedMatrix(numbers));
  }
  if (map.type == "Grid_Transform")
  {
    const std::string name = valueOf(map.entries, "Displacement_Volume");
    const std::filesystem::path folder = std::filesystem::path(fileName).parent_path();
    return withBeginning("needs its Displacement_Volume: ",
      [&] { return gridOf((folder / std::filesystem::path(name)).string()); });
  }
  throw Problem("holds the Transform_Type " + shownWords(map.type) +
    "; BrainShift reads Linear and Grid_Transform");
}

std::vector<StoredMap> mapsOf(const std::string& text)
{
  std::vector<StoredMap> maps;
  for (const auto& [key, value] : statementsOf(text))
  {
    if (key == "Transform_Type")
    {
      maps.push_back({ value, {} });
      continue;
    }
    if (maps.empty())
    {
      throw Problem("has the entry " + shownWords(key) + " before its first Transform_Type");
    }
    if (!maps.back().entries.emplace(key, value).second)
    {
      throw Problem(twice("entry " + shownWords(key) + " in one Transform_Type"));
    }
    if (key != "Linear_Transform" && key != "Displacement_Volume" && key != "Invert_Flag" &&
      maps.back().type != "Thin_Plate_Spline_Transform")
    {
      throw Problem("has the entry " + shownWords(key) +
        "; BrainShift knows Transform_Type, Invert_Flag, Linear_Transform and "
        "Displacement_Volume");
    }
  }
  if (maps.empty() || maps.size() > MostMaps)
  {
    throw Problem("holds " + std::to_string(maps.size()) + " transforms; it must hold from 1 to " +
      std::to_string(MostMaps));
  }
  return maps;
}
}

bool isXFMText(const std::string& text)
{
  return text.rfind(XFMBegin, 0) == 0;
}

void addXFMText(const std::string& text, const std::string& fileName, PointTransform& transform)
{
  std::vector<StoredMap> maps = mapsOf(text);
  for (auto map = maps.rbegin(); map != maps.rend(); ++map) // back from the target
  {
    TransformLink link = linkOf(*map, fileName);
    const auto* affine = std::get_if<AffineLink>(&link);
    if (isInverted(*map))
    {
      transform.links.push_back(std::move(link));
    }
    else if (affine)
    {
      const glm::dmat3 linear = glm::inverse(affine->linear);
      transform.links.emplace_back(AffineLink{ linear, -(linear * affine->offset) });
    }
    else
    {
      transform.links.push_back(inverseOf({ { std::move(link) } }));
    }
  }
}
}
