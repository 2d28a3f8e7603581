// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/TransformRecord.h"

#include "Common/HostMemory.h"
#include "Formats/Files/Text.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace brainshift
{
namespace
{
constexpr double LargestSide = 32768.0; // points of a grid along an axis
constexpr double LargestNumber = 1e12;  // of mm, rad and voxels alike: no file needs it
constexpr double SmallestVolume = 1e-9; // determinant of a map that can be turned round

using Numbers = std::vector<double>;

Problem countProblem(const std::string& what, std::size_t found, const std::string& wanted)
{
  return Problem("has " + std::to_string(found) + " " + what + "; it must have " + wanted);
}

// Also rejects NaN, and numbers whose products are none.
bool areFinite(const Numbers& numbers)
{
  return std::all_of(
    numbers.begin(), numbers.end(), [](double n) { return std::abs(n) <= LargestNumber; });
}

glm::dvec3 threeOf(const Numbers& numbers, std::size_t first)
{
  return { numbers[first], numbers[first + 1], numbers[first + 2] };
}

glm::dmat3 rowsOf(const Numbers& numbers, std::size_t first)
{
  return glm::transpose(
    glm::dmat3(threeOf(numbers, first), threeOf(numbers, first + 3), threeOf(numbers, first + 6)));
}

// The rotation of a versor: the vector part of a unit quaternion.
glm::dmat3 versorRotation(const glm::dvec3& vector)
{
  const double real = std::sqrt(std::max(0.0, 1.0 - glm::dot(vector, vector)));
  return glm::mat3_cast(glm::normalize(glm::dquat(real, vector.x, vector.y, vector.z)));
}

glm::dmat3 eulerRotation(const TransformRecord& record)
{
  const glm::dmat3 x = turnedAbout(0, record.parameters[0]);
  const glm::dmat3 y = turnedAbout(1, record.parameters[1]);
  const glm::dmat3 z = turnedAbout(2, record.parameters[2]);
  const bool xLast = record.fixed.size() > 3 && record.fixed[3] != 0.0; // ITK's ComputeZYX
  return xLast ? z * y * x : z * x * y;
}

// How a type of ITK makes a linear map and a translation of its parameters.
struct LinearType
{
  std::size_t parameters;
  std::size_t translation; // its first parameter
  glm::dmat3 (*linear)(const TransformRecord&);
  bool hasCentre = true; // must be given: without it the map is another one
};

const std::map<std::string, LinearType>& linearTypes()
{
  const auto matrix = [](const TransformRecord& record) { return rowsOf(record.parameters, 0); };
  const auto versor = [](const TransformRecord& record) {
    return versorRotation(threeOf(record.parameters, 0));
  };
  const auto similar = [](const TransformRecord& record) {
    return versorRotation(threeOf(record.parameters, 0)) * record.parameters[6];
  };
  static const std::map<std::string, LinearType> types{
    { "AffineTransform", { 12, 9, matrix } },
    { "MatrixOffsetTransformBase", { 12, 9, matrix } },
    { "Euler3DTransform", { 6, 3, eulerRotation } },
    { "VersorRigid3DTransform", { 6, 3, versor } },
    { "Similarity3DTransform", { 7, 3, similar } },
    { "TranslationTransform",
      { 3, 0, [](const TransformRecord&) { return glm::dmat3(1.0); }, false } },
  };
  return types;
}

void addAffine(const AffineLink& link, PointTransform& transform)
{
  const double volume = std::abs(glm::determinant(link.linear));
  if (!(volume > SmallestVolume) || !std::isfinite(volume))
  {
    throw Problem("holds a matrix without an inverse");
  }
  transform.links.emplace_back(link);
}

void addLinear(const LinearType& type, const TransformRecord& record, PointTransform& transform)
{
  if (record.parameters.size() != type.parameters)
  {
    throw countProblem(
      "parameters of " + record.type, record.parameters.size(), std::to_string(type.parameters));
  }
  const std::size_t found = record.fixed.size();
  const bool saysOrder = found == 4 && type.linear == eulerRotation; // ITK's ComputeZYX
  if (found != 3 && !saysOrder && !(found == 0 && !type.hasCentre))
  {
    throw countProblem("fixed parameters of " + record.type, found,
      type.hasCentre ? "3, the centre (mm)" : "3 or none");
  }
  const glm::dvec3 centre = found > 0 ? threeOf(record.fixed, 0) : glm::dvec3(0.0);
  const glm::dmat3 linear = type.linear(record);
  const glm::dvec3 shift = threeOf(record.parameters, type.translation);
  addAffine({ linear, shift + centre - linear * centre }, transform);
}

// The grid in the fixed parameters: sizes, origin, spacing, direction by rows.
void readGrid(const TransformRecord& record, int smallestSide, LinkGrid& grid)
{
  constexpr std::size_t Wanted = 18;
  if (record.fixed.size() != Wanted)
  {
    throw countProblem("fixed parameters of " + record.type, record.fixed.size(), "18");
  }
  const glm::dvec3 sides = threeOf(record.fixed, 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(sides[axis] >= smallestSide && sides[axis] <= LargestSide))
    {
      throw Problem("has a grid of " + sizeText(sides) + " points; each side must have from " +
        std::to_string(smallestSide) + " to 32768");
    }
  }
  grid.dimensions = glm::ivec3(sides);
  grid.origin = threeOf(record.fixed, 3);
  const glm::dvec3 spacing = threeOf(record.fixed, 6);
  grid.worldFromGrid = rowsOf(record.fixed, 9);
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.worldFromGrid[axis] *= spacing[axis];
  }
  const double volume = std::abs(glm::determinant(grid.worldFromGrid));
  if (!(volume > SmallestVolume) || !std::isfinite(volume))
  {
    throw Problem("has a grid whose axes span no volume");
  }
  grid.gridFromWorld = glm::inverse(grid.worldFromGrid);
  if (record.parameters.size() != 3 * grid.count())
  {
    throw countProblem("parameters of " + record.type, record.parameters.size(),
      std::to_string(3 * grid.count()) + ", 3 for each point of its grid");
  }
}

// All x, then all y, then all z.
void addSpline(const TransformRecord& record, PointTransform& transform)
{
  SplineLink link;
  readGrid(record, 4, link.grid);
  const std::size_t count = link.grid.count();
  link.coefficients.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Numbers& numbers = record.parameters;
    link.coefficients[i] = { numbers[i], numbers[count + i], numbers[2 * count + i] };
  }
  transform.links.emplace_back(std::move(link));
}

// x, y and z of each point together.
void addField(const TransformRecord& record, PointTransform& transform)
{
  FieldLink link;
  readGrid(record, 1, link.grid);
  link.displacements.resize(link.grid.count());
  for (std::size_t i = 0; i < link.displacements.size(); ++i)
  {
    link.displacements[i] = glm::vec3(threeOf(record.parameters, 3 * i));
  }
  transform.links.emplace_back(std::move(link));
}

void addRecord(const TransformRecord& record, PointTransform& transform)
{
  if (!areFinite(record.parameters) || !areFinite(record.fixed))
  {
    throw Problem("holds a number that is not finite, or beyond 1e12");
  }
  const std::size_t end = record.type.find('_');
  const std::string name = record.type.substr(0, end);
  const std::string kind = end == std::string::npos ? "" : record.type.substr(end);
  const auto linear = linearTypes().find(name);
  const bool isSpace = kind == "_double_3_3" || kind == "_float_3_3";
  if (isSpace && linear != linearTypes().end())
  {
    addLinear(linear->second, record, transform);
  }
  else if (isSpace && name == "BSplineTransform")
  {
    addSpline(record, transform);
  }
  else if (isSpace && name == "DisplacementFieldTransform")
  {
    addField(record, transform);
  }
  else if (!isSpace || name != "IdentityTransform")
  {
    throw Problem("holds the transform " + shownWords(record.type) +
      ", which BrainShift does not know; it knows affine and rigid transforms, cubic B-splines, "
      "displacement fields and composites of these, in three dimensions");
  }
}

bool isComposite(const TransformRecord& record)
{
  return record.type.rfind("CompositeTransform_", 0) == 0;
}
}

glm::dmat3 turnedAbout(int axis, double angle)
{
  const int next = (axis + 1) % 3;
  const int third = (axis + 2) % 3;
  glm::dmat3 rotation(1.0);
  rotation[next][next] = std::cos(angle);
  rotation[next][third] = std::sin(angle);
  rotation[third][next] = -std::sin(angle);
  rotation[third][third] = std::cos(angle);
  return rotation;
}

void addRecords(const std::vector<TransformRecord>& records, PointTransform& transform)
{
  const std::size_t first = !records.empty() && isComposite(records.front()) ? 1 : 0;
  if (records.empty())
  {
    throw Problem("holds no transform");
  }
  for (std::size_t i = records.size(); i > first; --i)
  {
    addRecord(records[i - 1], transform);
  }
}

void addMatrix(const std::vector<double>& rows, PointTransform& transform)
{
  if (rows.size() != 16 || !areFinite(rows))
  {
    throw countProblem("numbers", rows.size(), "16 finite ones, a 4 x 4 matrix");
  }
  if (std::abs(rows[12]) + std::abs(rows[13]) + std::abs(rows[14]) + std::abs(rows[15] - 1.0) >
    1e-9)
  {
    throw Problem("holds a 4 x 4 matrix whose last row is not 0 0 0 1");
  }
  const glm::dmat3 linear = glm::transpose(glm::dmat3(glm::dvec3(rows[0], rows[1], rows[2]),
    glm::dvec3(rows[4], rows[5], rows[6]), glm::dvec3(rows[8], rows[9], rows[10])));
  addAffine({ linear, { rows[3], rows[7], rows[11] } }, transform);
}
}
