// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Displacement fields in MetaImage and NRRD files: a header of lines, then the numbers or the name
/// of the file that holds them.

#include "Common/Bytes.h"
#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Formats/Fields/FieldFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/TextHeaders/TextHeader.h"
#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/VolumeFile.h"

#include <cmath>

namespace brainshift
{
namespace
{
// The Comment of a MetaImage names the direction.
constexpr const char* ForwardComment = "displacement field, mm, forward";
constexpr const char* BackwardComment = "displacement field, mm, backward";

constexpr const char* DirectionKey = "displacement field type"; // of NRRD

constexpr double LargestSkew = 1e-3; // cosine between two axes
constexpr int LongestFieldSide = 65535;

// Whether the components of a vector are along the last axis, not along the first.
bool areLast(const TextHeader& header)
{
  return header.axes.size() == 4 && header.axes[0].step.has_value();
}

// LPS from the space of a header.
glm::dvec3 lpsSigns(HeaderSpace space)
{
  switch (space)
  {
    case HeaderSpace::RAS:
      return glm::dvec3(-1.0, -1.0, 1.0);
    case HeaderSpace::LAS:
      return glm::dvec3(1.0, -1.0, 1.0);
    default:
      return glm::dvec3(1.0);
  }
}

// Sides, and the steps from one point to the next, in LPS.
void place(const TextHeader& header, Grid& grid)
{
  const glm::dvec3 signs = lpsSigns(header.space);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t first = areLast(header) ? 0 : 1;
    const HeaderAxis& along = header.axes[static_cast<std::size_t>(axis) + first];
    if (along.count > LongestFieldSide)
    {
      throw Problem("has a side of " + std::to_string(along.count) +
        " points; it must have at most " + std::to_string(LongestFieldSide));
    }
    grid.dimensions[axis] = static_cast<int>(along.count);
    grid.origin[axis] = signs[axis] * header.origin[axis];
    const glm::dvec3 step = signs * along.step.value_or(glm::dvec3(0.0));
    grid.spacing[axis] = glm::length(step);
    grid.direction[axis] = step / grid.spacing[axis];
    if (!std::isfinite(grid.origin[axis]) || !(grid.spacing[axis] > 0.0) ||
      !std::isfinite(grid.spacing[axis]))
    {
      throw Problem("has an origin that is not finite, or a spacing that is 0 or not finite");
    }
  }
  withBeginning(
    "has a position that a field cannot have: its ", [&] { throwIfAny(problemOfGrid(grid)); });
  for (int axis = 0; axis < 3; ++axis)
  {
    const double skew = glm::dot(grid.direction[axis], grid.direction[(axis + 1) % 3]);
    if (std::abs(skew) > LargestSkew)
    {
      throw Problem("has axes that are not at right angles: the cosine between two is " +
        roundedText(skew) + "; the limit is " + numberText(LargestSkew));
    }
  }
}

// Words that change what vectors mean: their unit, their axes, and what they are.
void requirePlainVectors(const HeaderText& text)
{
  for (const char* name : { "space units", "sample units", "sampleunits", "DistanceUnits" })
  {
    std::string unit = text.valueOf({ name });
    std::replace(unit.begin(), unit.end(), '"', ' ');
    const std::vector<std::string> units = wordsIn(unit);
    if (!std::all_of(units.begin(), units.end(),
          [](const auto& one) { return one == "?" || mmPerUnit(one) == 1.0; }))
    {
      throw Problem(
        joined("has the ", name, " ", text.valueOf({ name }), "; a field must be in mm"));
    }
  }
  std::string frame = text.valueOf({ "measurement frame" });
  std::replace_if(
    frame.begin(), frame.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  if (!frame.empty() &&
    numbersIn(frame) != std::vector<double>{ 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 })
  {
    throw Problem("has the measurement frame " + text.valueOf({ "measurement frame" }) +
      "; that of a field must be (1,0,0) (0,1,0) (0,0,1)");
  }
  const std::string type = text.keyed(DirectionKey);
  if (!type.empty() && type != "modeling" && type != "resampling")
  {
    throw Problem(joined("has the ", DirectionKey, " ", type,
      "; it must be modeling (forward) or resampling (backward)"));
  }
}

// Why the numbers of a header are no field; empty if they are one.
void requireField(const TextHeader& header)
{
  const bool isLast = areLast(header);
  const bool areVectors = header.axes.size() == 4 && (!header.axes[0].step || isLast);
  const HeaderAxis& components = isLast ? header.axes.back() : header.axes.front();
  if (!areVectors || components.count != 3)
  {
    throw Problem("holds " + std::to_string(areVectors ? components.count : 1) +
      " components per point; a field must have 3");
  }
  const std::string& kind = components.kind;
  const bool isNamed = kind == "vector" || kind == "3-vector";
  const bool isVector = isNamed || kind.empty() || kind == "???" || kind == "none";
  if (isLast && !isNamed && header.text.keyed(DirectionKey).empty())
  {
    throw Problem("has 3 numbers along its last axis, which may be 3 times: kinds must say that "
                  "they are a vector");
  }
  // 3D Slicer names the direction of each field.
  if (!isVector && header.text.keyed(DirectionKey).empty())
  {
    throw Problem("has components of the kind " + kind + "; those of a field must be a vector");
  }
  if (!header.text.isNRRD &&
    header.text.valueOf({ "Comment" }).find(NoFieldNote) != std::string::npos)
  {
    throw Problem("says that it holds " + std::string(NoFieldNote) + " (Comment)");
  }
  if (header.spatialAxes() != 3 || !header.hasOrigin)
  {
    throw Problem("does not place points in 3 dimensions");
  }
  if (header.numberType != VTK_FLOAT && header.numberType != VTK_DOUBLE)
  {
    throw Problem("has the type " + header.typeName + "; a field must have float or double");
  }
  if (header.encoding == Encoding::Text)
  {
    throw Problem("holds its numbers as text; those of a field must be binary");
  }
  if (header.slope != 1.0 || header.intercept != 0.0)
  {
    throw Problem("rescales its numbers; a field must hold mm");
  }
  if (header.text.isNRRD && !header.knowsSides && header.space != HeaderSpace::LPS)
  {
    throw Problem("does not say where the sides of the patient are; a field must be in the space "
                  "left-posterior-superior, or another that names them");
  }
  if (header.space != HeaderSpace::LPS && !header.text.has("measurement frame"))
  {
    throw Problem("is in the space " + header.text.valueOf({ "space" }) +
      ", and ITK would take its vectors for LPS; if they are along the axes of the space, add the "
      "line measurement frame: (1,0,0) (0,1,0) (0,0,1)");
  }
  requirePlainVectors(header.text);
}

std::optional<Direction> directionOf(const HeaderText& text)
{
  const std::string said = text.isNRRD ? text.keyed(DirectionKey) : text.valueOf({ "Comment" });
  if (said == (text.isNRRD ? "modeling" : ForwardComment))
  {
    return Direction::Forward;
  }
  return said == (text.isNRRD ? "resampling" : BackwardComment)
    ? std::optional<Direction>(Direction::Backward)
    : std::nullopt;
}

void readFieldHeader(const std::string& fileName, TextHeader& header, Grid& grid)
{
  readTextHeader(fileName, header);
  throwIfAny(shownWords(problemOf([&] {
    requireField(header);
    place(header, grid);
  })));
}

std::vector<char> readData(const TextHeader& header, const Grid& grid)
{
  requireNumbers(header);
  withBeginning("cannot be read: ", [&] {
    requireHostMemory("a field of " + sizeText(glm::dvec3(grid.dimensions)) + " points",
      header.dataBytes() + static_cast<double>(grid.count() * sizeof(glm::vec3)));
  });
  std::vector<char> data(static_cast<std::size_t>(header.dataBytes()));
  readNumbers(header, data.data(), [](double) { return true; });
  return data;
}

// To LPS.
template <typename Number>
void copyNumbers(
  const TextHeader& header, const std::vector<char>& data, std::vector<glm::vec3>& vectors)
{
  const glm::dvec3 signs = lpsSigns(header.space);
  const std::size_t points = vectors.size();
  const std::size_t ofPoint = areLast(header) ? 1 : 3; // numbers from one point to the next
  const std::size_t ofComponent = areLast(header) ? points : 1;
  for (std::size_t i = 0; i < points; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::size_t at = i * ofPoint + static_cast<std::size_t>(axis) * ofComponent;
      Number number;
      std::memcpy(&number, data.data() + at * sizeof(Number), sizeof(Number));
      vectors[i][axis] = static_cast<float>(signs[axis] * number);
    }
  }
}

const char* byteOrder()
{
  return thisMachineIsBigEndian() ? "big" : "little";
}

void write(const std::string& fileName, const std::string& header, const DirectedField& field)
{
  writeWholeStream(fileName, [&](std::ostream& file) {
    file << header;
    file.write(reinterpret_cast<const char*>(field.displacements.data()),
      static_cast<std::streamsize>(field.displacements.size() * sizeof(glm::vec3)));
  });
}
}

bool isTextHeaderField(const std::string& fileName)
{
  TextHeader header;
  Grid grid;
  return problemOf([&] { readFieldHeader(fileName, header, grid); }).empty();
}

namespace
{
void readField(const std::string& fileName, DirectedField& field)
{
  TextHeader header;
  std::vector<char> data;
  withBeginning("File " + fileName + " ", [&] {
    readFieldHeader(fileName, header, field.grid);
    data = readData(header, field.grid);
  });
  field.direction = directionOf(header.text);
  field.knowsSides = header.saysSides();
  if (!field.knowsSides)
  {
    warn(nullptr, "File " + fileName + " " + UnknownSidesWarning);
  }
  field.displacements.resize(field.grid.count());
  if (header.numberType == VTK_DOUBLE)
  {
    copyNumbers<double>(header, data, field.displacements);
  }
  else
  {
    copyNumbers<float>(header, data, field.displacements);
  }
  reverseXY(field);
}

void writeMetaImageField(const std::string& fileName, const DirectedField& ras)
{
  DirectedField field = ras;
  reverseXY(field);
  const Grid& grid = field.grid;
  std::ostringstream header;
  header << "ObjectType = Image\nNDims = 3\n"
         << "Comment = "
         << (field.direction == Direction::Forward ? ForwardComment : BackwardComment) << "\n"
         << "BinaryData = True\nBinaryDataByteOrderMSB = "
         << (thisMachineIsBigEndian() ? "True" : "False") << "\nCompressedData = False\n"
         << "TransformMatrix = " << listText(grid.direction[0], " ") << " "
         << listText(grid.direction[1], " ") << " " << listText(grid.direction[2], " ") << "\n"
         << "Offset = " << listText(grid.origin, " ") << "\nCenterOfRotation = 0 0 0\n"
         << "ElementSpacing = " << listText(grid.spacing, " ") << "\n"
         << (field.knowsSides ? "" : "AnatomicalOrientation = ???\n") // the comment is taken
         << "DimSize = " << listText(glm::dvec3(grid.dimensions), " ") << "\n"
         << "ElementNumberOfChannels = 3\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
  write(fileName, header.str(), field);
}

void writeNRRDField(const std::string& fileName, const DirectedField& ras)
{
  DirectedField field = ras;
  reverseXY(field);
  const Grid& grid = field.grid;
  std::ostringstream header;
  header << "NRRD0005\n"
         << (field.knowsSides ? std::string() : std::string("# ") + UnknownSidesNote + "\n")
         << "type: float\ndimension: 4\nspace: left-posterior-superior\n"
         << "sizes: 3 " << listText(glm::dvec3(grid.dimensions), " ") << "\nspace directions: none";
  for (int axis = 0; axis < 3; ++axis)
  {
    header << " (" << listText(grid.direction[axis] * grid.spacing[axis], ",") << ")";
  }
  header << "\nkinds: vector domain domain domain\nendian: " << byteOrder()
         << "\nencoding: raw\nspace origin: (" << listText(grid.origin, ",") << ")\n"
         << "displacement field type:="
         << (field.direction == Direction::Forward ? "modeling" : "resampling") << "\n\n";
  write(fileName, header.str(), field);
}

}

extern const FieldFormat FieldsOfMetaImage{ []() -> std::vector<std::string> {
                                             return { ".mha", ".mhd" };
                                           },
  isTextHeaderField, readField, writeMetaImageField };

extern const FieldFormat FieldsOfNRRD{ []() -> std::vector<std::string> {
                                        return { ".nrrd", ".nhdr" };
                                      },
  isTextHeaderField, readField, writeNRRDField };
}
