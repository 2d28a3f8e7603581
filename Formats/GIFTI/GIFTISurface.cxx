// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Surfaces in GIFTI files: an array of points, one of triangles, and numbers of the points.
///
/// Which frame points are in, the first that holds: 1. They are in the scanner's: they stay. 2. A
/// matrix leads to the scanner's space, or else to that of an aligned anatomy: it counts. 3. Their
/// space has a name: they stay. 4. FreeSurfer left the geometry of its volume: they are in tkRAS
/// (SurfaceFile.h). 5. Nobody knows. They stay, and it is noted.
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/GIFTI/GIFTIFile.h"
#include "Formats/Volumes/RasGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* PointIntent = "NIFTI_INTENT_POINTSET";
constexpr const char* TriangleIntent = "NIFTI_INTENT_TRIANGLE";
constexpr const char* IndexIntent = "NIFTI_INTENT_NODE_INDEX";
constexpr const char* Scanner = "NIFTI_XFORM_SCANNER_ANAT";
constexpr const char* Aligned = "NIFTI_XFORM_ALIGNED_ANAT";
constexpr const char* Unknown = "NIFTI_XFORM_UNKNOWN";
// In which points stay where no matrix leads on.
const std::map<std::string, Template> NamedSpaces{ { Aligned, Template::None },
  { "NIFTI_XFORM_TALAIRACH", Template::Talairach }, { "NIFTI_XFORM_MNI_152", Template::MNI152 } };

template <typename T>
T numberIn(const GIFTIArray& array, std::size_t index)
{
  T number;
  std::memcpy(&number, &array.bytes[index * sizeof(T)], sizeof(T));
  return number;
}

double realIn(const GIFTIArray& array, std::size_t index)
{
  return array.type == NumberType::Float64 ? numberIn<double>(array, index)
                                           : numberIn<float>(array, index);
}

void requireShape(const GIFTIArray& array, const std::string& what, bool isWhole)
{
  if (array.bytes.empty())
  {
    throw Problem("has " + what + " without an element Data");
  }
  const bool hasType = isWhole
    ? array.type == NumberType::Int32
    : array.type == NumberType::Float32 || array.type == NumberType::Float64;
  if (!(hasType && array.columns == 3))
  {
    throw Problem("has " + what + " of " + std::to_string(array.columns) + " columns of " +
      array.attribute("DataType") + "; it must be 3 columns of NIFTI_TYPE_" +
      (isWhole ? "INT32" : "FLOAT32 or FLOAT64"));
  }
}

// FreeSurfer's geometry of the volume, which its mris_convert keeps as text.
std::optional<VolumeFrame> keptFrame(const GIFTIArray& points)
{
  VolumeFrame frame;
  const std::array<std::pair<char, glm::dvec3*>, 4> vectors{ { { 'X', &frame.xRas },
    { 'Y', &frame.yRas }, { 'Z', &frame.zRas }, { 'C', &frame.cRas } } };
  for (const auto& [letter, vector] : vectors)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto found = points.meta.find(std::string("VolGeom") + letter + "_" + "RAS"[axis]);
      const std::vector<double> number =
        found == points.meta.end() ? std::vector<double>() : numbersIn(found->second);
      if (number.size() != 1)
      {
        return std::nullopt;
      }
      (*vector)[axis] = number[0];
    }
  }
  return frame;
}

glm::dmat4 matrixOf(const GIFTITransform& transform)
{
  glm::dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i)
  {
    matrix[i % 4][i / 4] = transform.numbers[static_cast<std::size_t>(i)];
  }
  return matrix;
}

const GIFTITransform* transformTo(const std::string& space, const GIFTIArray& points)
{
  const auto found = std::find_if(points.transforms.begin(), points.transforms.end(),
    [&](const GIFTITransform& transform) { return transform.to == space; });
  return found == points.transforms.end() ? nullptr : &*found;
}

void noteUnknown(const GIFTIArray& points, Surface& surface)
{
  surface.knowsWorld = false;
  std::string note = "does not name the space of its points; they are shown as they are";
  const GIFTITransform none;
  const GIFTITransform& first = points.transforms.empty() ? none : points.transforms[0];
  const std::string to = first.to.empty() ? Unknown : first.to;
  const bool moves =
    !first.numbers.empty() && (first.numbers.size() != 16 || matrixOf(first) != glm::dmat4(1.0));
  note +=
    moves || to != Unknown ? ", and the file's matrix to " + shownWords(to) + " is not used" : "";
  surface.notes.push_back(note);
}

// Connectome Workbench keeps FreeSurfer's geometry where it moves the points, and says what it ran.
void noteOtherProgram(const GIFTIFile& file, Surface& surface)
{
  const bool isOfWorkbench = std::any_of(file.meta.begin(), file.meta.end(),
    [](const auto& meta) { return meta.first.find("Provenance") != std::string::npos; });
  if (isOfWorkbench && surface.worldFromStored != glm::dmat4(1.0))
  {
    surface.notes.emplace_back(
      "does not name the space of its points; they are placed by the geometry of FreeSurfer's "
      "volume that it keeps (VolGeom). Another program wrote the file; if that one moved the "
      "points (wb_command -surface-apply-affine), they are in the wrong place: open the surface "
      "that FreeSurfer wrote, or one that mris_convert --to-scanner writes");
  }
}

// The rule of the opening comment.
void findPlace(const GIFTIFile& file, const GIFTIArray& points, Surface& surface)
{
  const std::string from = points.transforms.empty() ? Unknown : points.transforms[0].from;
  if (from == Scanner)
  {
    return;
  }
  const GIFTITransform* transform = transformTo(Scanner, points);
  transform = transform || from == Aligned ? transform : transformTo(Aligned, points);
  const std::optional<VolumeFrame> frame = keptFrame(points);
  if (transform)
  {
    const bool isAffine = transform->numbers.size() == 16 && transform->numbers[12] == 0.0 &&
      transform->numbers[13] == 0.0 && transform->numbers[14] == 0.0 &&
      transform->numbers[15] == 1.0;
    if (!isAffine)
    {
      throw Problem("has a matrix to " + shownWords(transform->to) +
        " that is not 16 numbers with the last row 0 0 0 1");
    }
    surface.worldFromStored = matrixOf(*transform);
  }
  else if (!from.empty() && from != Unknown)
  {
    const auto named = NamedSpaces.find(from);
    surface.space = named == NamedSpaces.end() ? Template::None : named->second;
    if (named == NamedSpaces.end())
    {
      surface.notes.push_back("names the space " + shownWords(from) +
        " of its points, which GIFTI does not define; they are shown as they are");
    }
    return;
  }
  else if (frame)
  {
    surface.worldFromStored = scannerFromSurface(*frame);
    noteOtherProgram(file, surface);
  }
  else
  {
    noteUnknown(points, surface);
  }
  withBeginning("cannot be placed: ", [&] { requireAffine(surface.worldFromStored); });
}

std::string nameOf(const GIFTIArray& array)
{
  const auto named = array.meta.find("Name");
  if (named != array.meta.end() && !named->second.empty())
  {
    return named->second;
  }
  const std::string intent = array.attribute("Intent");
  constexpr const char* Prefix = "NIFTI_INTENT_";
  return intent.rfind(Prefix, 0) == 0 ? intent.substr(std::strlen(Prefix)) : intent;
}

// Vectors of points turn with them.
template <typename T>
void turnVectors(const glm::dmat4& worldFromStored, GIFTIArray& vectors)
{
  const glm::dmat3 turn(worldFromStored);
  for (std::size_t row = 0; row < vectors.rows; ++row)
  {
    T* const at = reinterpret_cast<T*>(vectors.bytes.data()) + 3 * row;
    const glm::dvec3 turned = turn * glm::dvec3(at[0], at[1], at[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      at[axis] = static_cast<T>(turned[axis]);
    }
  }
}

// Adds names of values, unless a file before gave one of the values another name.
void takeLabels(const std::vector<Label>& labels, Surface& surface)
{
  std::map<int, std::string> known;
  for (const Label& label : surface.labels)
  {
    known.emplace(label.value, label.name);
  }
  std::vector<Label> added;
  for (const Label& label : labels)
  {
    const auto found = known.find(label.value);
    if (found == known.end())
    {
      added.push_back(label);
    }
    else if (found->second != label.name)
    {
      surface.notes.push_back("names the label " + std::to_string(label.value) + " \"" +
        shownWords(label.name) + "\", which is \"" + shownWords(found->second) +
        "\" in a file before; its names of labels are left out");
      return;
    }
  }
  surface.labels.insert(surface.labels.end(), added.begin(), added.end());
}

// The points that the rows of arrays belong to, where an array of a file names them. Empty: all, in
// their order.
std::vector<std::size_t> indexOf(const GIFTIFile& file, std::size_t points)
{
  std::vector<std::size_t> index;
  std::set<std::int32_t> seen;
  bool isThere = false;
  for (const GIFTIArray& array : file.arrays)
  {
    if (array.attribute("Intent") != IndexIntent)
    {
      continue;
    }
    if (isThere || array.bytes.empty() || array.type != NumberType::Int32 || array.columns != 1)
    {
      throw Problem(joined("has ", IndexIntent, isThere ? " twice; it may have one" : " of ",
        isThere ? "" : array.attribute("DataType"),
        isThere ? "" : "; it must be one INT32 column"));
    }
    isThere = true;
    for (std::size_t row = 0; row < array.rows; ++row)
    {
      const auto point = numberIn<std::int32_t>(array, row);
      if (point < 0 || static_cast<std::size_t>(point) >= points || !seen.insert(point).second)
      {
        throw Problem(joined("has ", IndexIntent, " with the point ", point,
          "; it must have each point once, from 0 to ", points - 1));
      }
      index.push_back(static_cast<std::size_t>(point));
    }
  }
  return index;
}

// Gives each row to its point. Points without a row get NaN; whole numbers have none.
void spread(const std::vector<std::size_t>& index, std::size_t points, GIFTIArray& array)
{
  const bool isDouble = array.type == NumberType::Float64;
  const bool isFloat = array.type == NumberType::Float32;
  if (index.size() < points && !isDouble && !isFloat)
  {
    throw Problem(joined("has ", IndexIntent, " of ", index.size(), " of ", points,
      " points for an array of whole numbers, which the others would not have"));
  }
  const std::size_t numberBytes = array.bytes.size() / (array.rows * array.columns);
  const std::size_t rowBytes = numberBytes * array.columns;
  withBeginning("cannot be read: ", [&] {
    requireHostMemory("an array of " + std::to_string(points) + " points",
      static_cast<double>(points) * static_cast<double>(rowBytes));
  });
  std::vector<char> all(points * rowBytes);
  for (std::size_t i = 0; i < points * array.columns && (isDouble || isFloat); ++i)
  {
    const double wide = std::nan("");
    const float narrow = std::nanf("");
    std::memcpy(&all[i * numberBytes],
      isDouble ? static_cast<const void*>(&wide) : static_cast<const void*>(&narrow), numberBytes);
  }
  for (std::size_t row = 0; row < index.size(); ++row)
  {
    std::memcpy(&all[index[row] * rowBytes], &array.bytes[row * rowBytes], rowBytes);
  }
  array.bytes = std::move(all);
  array.rows = points;
}

// Takes the arrays that belong to the points.
void takeNumbers(GIFTIFile& file, Surface& surface)
{
  const std::vector<std::size_t> index = indexOf(file, surface.points.size());
  std::size_t others = 0;
  std::size_t taken = 0;
  for (GIFTIArray& array : file.arrays)
  {
    const std::string intent = array.attribute("Intent");
    if (intent == PointIntent || intent == TriangleIntent || intent == IndexIntent)
    {
      continue;
    }
    if (array.bytes.empty())
    {
      surface.notes.push_back(
        "has the array " + shownWords(nameOf(array)) + " without an element Data; left out");
      continue;
    }
    if (!index.empty() && array.rows == index.size())
    {
      spread(index, surface.points.size(), array);
    }
    else if (!index.empty())
    {
      throw Problem(joined("has an array of ", array.rows, " rows beside ", IndexIntent, " of ",
        index.size(), "; both must have as many"));
    }
    if (array.rows != surface.points.size())
    {
      ++others;
      continue;
    }
    const bool isVector = intent == "NIFTI_INTENT_VECTOR" && array.columns == 3;
    if (isVector && array.type == NumberType::Float32)
    {
      turnVectors<float>(surface.worldFromStored, array);
    }
    if (isVector && array.type == NumberType::Float64)
    {
      turnVectors<double>(surface.worldFromStored, array);
    }
    surface.numbers.push_back(
      { surface.names.own(nameOf(array)), array.type, array.columns, std::move(array.bytes) });
    ++taken;
  }
  if (others > 0)
  {
    surface.notes.push_back("has " + counted(others, "array") + " with other than " +
      std::to_string(surface.points.size()) + " rows, the number of points; left out");
  }
  if (taken > 0)
  {
    takeLabels(file.labels, surface);
  }
}

void takePoints(const GIFTIArray& array, Surface& surface)
{
  surface.points.resize(array.rows);
  for (std::size_t i = 0; i < array.rows; ++i)
  {
    surface.points[i] =
      glm::dvec3(realIn(array, 3 * i), realIn(array, 3 * i + 1), realIn(array, 3 * i + 2));
  }
}

void takeTriangles(const GIFTIArray& array, Surface& surface)
{
  surface.triangles.resize(array.rows);
  for (std::size_t i = 0; i < array.rows; ++i)
  {
    surface.triangles[i] = glm::ivec3(numberIn<std::int32_t>(array, 3 * i),
      numberIn<std::int32_t>(array, 3 * i + 1), numberIn<std::int32_t>(array, 3 * i + 2));
  }
}

// The first array of an intent; null without one. Notes if there are more.
const GIFTIArray* firstOf(const GIFTIFile& file, const std::string& intent, Surface& surface)
{
  const GIFTIArray* first = nullptr;
  std::size_t count = 0;
  for (const GIFTIArray& array : file.arrays)
  {
    const bool isOne = array.attribute("Intent") == intent;
    first = isOne && !first ? &array : first;
    count += isOne ? 1 : 0;
  }
  if (count > 1)
  {
    surface.notes.push_back(
      "has " + std::to_string(count) + " arrays " + intent + "; the first is shown");
  }
  return first;
}

// The hemisphere that an array or else its file names.
Hemisphere hemisphereIn(const GIFTIFile& file, const GIFTIArray& array)
{
  constexpr const char* Key = "AnatomicalStructurePrimary";
  const auto own = array.meta.find(Key);
  const auto common = file.meta.find(Key);
  return own != array.meta.end() ? hemisphereOf({ own->second })
    : common != file.meta.end()  ? hemisphereOf({ common->second })
                                 : Hemisphere::Unknown;
}

void readGIFTISurface(const std::vector<char>& text, const GivenVolume&, Surface& surface)
{
  GIFTIFile file = readGIFTIFile(text);
  surface.notes = file.notes;
  const GIFTIArray* const points = firstOf(file, PointIntent, surface);
  const GIFTIArray* const triangles = firstOf(file, TriangleIntent, surface);
  if (!points || !triangles)
  {
    throw Problem(std::string("has no array ") + (points ? TriangleIntent : PointIntent) +
      "; open the file of the surface, and name this file as one of its Value File Names");
  }
  requireShape(*points, "points", false);
  requireShape(*triangles, "triangles", true);
  findPlace(file, *points, surface);
  surface.ofPoints = hemisphereIn(file, *points);
  takePoints(*points, surface);
  takeTriangles(*triangles, surface);
  takeNumbers(file, surface);
}

// Adds the numbers and labels of a file to a surface, without its points. Arrays with another
// number of points are left out and noted.
void addGIFTINumbers(const std::vector<char>& text, const std::string&, Surface& surface)
{
  GIFTIFile file = readGIFTIFile(text);
  surface.notes.insert(surface.notes.end(), file.notes.begin(), file.notes.end());
  const std::size_t before = surface.numbers.size() + surface.notes.size();
  surface.ofValues = hemisphereIn(file, file.arrays.empty() ? GIFTIArray() : file.arrays.front());
  takeNumbers(file, surface);
  throwIfAny(surface.numbers.size() + surface.notes.size() > before
      ? ""
      : "has no array of values of the points; name a file that has one");
}
}

extern const SurfaceFormat SurfacesOfGIFTI{ isGIFTIFile, readGIFTISurface, addGIFTINumbers,
  beginsLikeGIFTI, "GIFTI file" };
}
