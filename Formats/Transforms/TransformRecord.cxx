// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/TransformRecord.h"

#include "Common/HostMemory.h"
#include "Formats/Files/Text.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

namespace brainshift
{
namespace
{
constexpr double LargestSide = 32768.0; // points of a grid along an axis
constexpr double LargestNumber = 1e12;  // of mm, rad and voxels alike: no file needs it
constexpr const char* OldSpline = "BSplineDeformableTransform"; // before ITK 4

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

// Of a unit quaternion: requireRotation refuses others.
glm::dmat3 quaternionRotation(const TransformRecord& record)
{
  const Numbers& q = record.parameters;
  return glm::mat3_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
}

// ITK adds what scales and skews differ from the identity to the rotation.
glm::dmat3 scaledVersor(const TransformRecord& record)
{
  glm::dmat3 linear = versorRotation(threeOf(record.parameters, 0));
  for (int axis = 0; axis < 3; ++axis)
  {
    linear[axis][axis] += threeOf(record.parameters, 6)[axis] - 1.0;
  }
  return linear;
}

glm::dmat3 skewedVersor(const TransformRecord& record)
{
  const Numbers& p = record.parameters;
  glm::dmat3 linear = scaledVersor(record);
  linear[1][0] += p[9];
  linear[2][0] += p[10];
  linear[0][1] += p[11];
  linear[2][1] += p[12];
  linear[0][2] += p[13];
  linear[1][2] += p[14];
  return linear;
}

// The later type multiplies: a rotation after scales after skews.
glm::dmat3 composedVersor(const TransformRecord& record)
{
  const Numbers& p = record.parameters;
  const glm::dmat3 scales(
    glm::dvec3(p[6], 0.0, 0.0), glm::dvec3(0.0, p[7], 0.0), glm::dvec3(0.0, 0.0, p[8]));
  const glm::dmat3 skews(
    glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(p[9], 1.0, 0.0), glm::dvec3(p[10], p[11], 1.0));
  return versorRotation(threeOf(p, 0)) * scales * skews;
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
    { "Rigid3DTransform", { 12, 9, matrix } },
    { "Euler3DTransform", { 6, 3, eulerRotation } },
    { "QuaternionRigidTransform", { 7, 4, quaternionRotation } },
    { "VersorRigid3DTransform", { 6, 3, versor } },
    { "ScaleVersor3DTransform", { 9, 3, scaledVersor } },
    { "ScaleSkewVersor3DTransform", { 15, 3, skewedVersor } },
    { "ComposeScaleSkewVersor3DTransform", { 12, 3, composedVersor } },
    { "Similarity3DTransform", { 7, 3, similar } },
    { "TranslationTransform",
      { 3, 0, [](const TransformRecord&) { return glm::dmat3(1.0); }, false } },
  };
  return types;
}

AffineLink requiredAffine(const AffineLink& link)
{
  const double volume = std::abs(glm::determinant(link.linear));
  if (!(volume > SmallestVolume) || !std::isfinite(volume))
  {
    throw Problem("holds a matrix without an inverse");
  }
  return link;
}

// Throws unless a rotation is one: ITK refuses some of these, and would scale by others.
void requireRotation(const TransformRecord& record, const glm::dmat3& linear)
{
  constexpr double LargestOfNorm = 1e-5; // 0.001 mm in 100 mm
  constexpr double Largest = 1e-4;       // of a cosine, and of a length from 1
  const bool isQuaternion = record.type.rfind("Quaternion", 0) == 0;
  const bool isRigid = record.type.rfind("Rigid3D", 0) == 0;
  double norm = 0.0;
  for (int i = 0; i < 4 && isQuaternion; ++i)
  {
    norm += record.parameters[i] * record.parameters[i];
  }
  if (isQuaternion && !(std::abs(norm - 1.0) <= LargestOfNorm))
  {
    throw Problem(joined("has a quaternion of length ", std::sqrt(norm),
      ", which ITK would scale by; it must be 1. Write it again as an AffineTransform"));
  }
  const glm::dmat3 square = glm::transpose(linear) * linear - glm::dmat3(1.0);
  for (int i = 0; i < 9 && isRigid; ++i)
  {
    if (!(std::abs(square[i / 3][i % 3]) <= Largest))
    {
      throw Problem("has a matrix of Rigid3DTransform that is no rotation, which ITK does not "
                    "read; write it again as an AffineTransform");
    }
  }
}

AffineLink linearOf(const LinearType& type, const TransformRecord& record)
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
  requireRotation(record, linear);
  const glm::dvec3 shift = threeOf(record.parameters, type.translation);
  return requiredAffine({ linear, shift + centre - linear * centre });
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
SplineLink splineOf(const TransformRecord& record)
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
  return link;
}

// x, y and z of each point together.
FieldLink fieldOf(const TransformRecord& record)
{
  FieldLink link;
  readGrid(record, 1, link.grid);
  link.displacements.resize(link.grid.count());
  for (std::size_t i = 0; i < link.displacements.size(); ++i)
  {
    link.displacements[i] = glm::vec3(threeOf(record.parameters, 3 * i));
  }
  return link;
}

// The parameters are the landmarks that points are mapped from, the fixed ones those they go to.
TransformLink thinPlatesOf(const TransformRecord& record)
{
  if (record.parameters.size() != record.fixed.size() || record.parameters.size() % 3 != 0)
  {
    throw Problem(joined("has ", record.parameters.size(), " parameters and ", record.fixed.size(),
      " fixed parameters of ", record.type,
      "; they must be as many, 3 for each landmark before and after"));
  }
  std::vector<glm::dvec3> sources;
  std::vector<glm::dvec3> targets;
  for (std::size_t i = 0; i < record.fixed.size(); i += 3)
  {
    sources.push_back(threeOf(record.parameters, i));
    targets.push_back(threeOf(record.fixed, i));
  }
  return throughLandmarks(sources, targets);
}

// The name of a type without its numbers: AffineTransform of AffineTransform_double_3_3. Empty if
// these are not of three dimensions.
std::string nameOf(const TransformRecord& record)
{
  const std::size_t end = std::min(record.type.find('_'), record.type.size());
  const std::string kind = record.type.substr(end);
  return kind == "_double_3_3" || kind == "_float_3_3" ? record.type.substr(0, end) : "";
}

// The link of a type that is none of Slicer's inverses. None: the identity.
std::optional<TransformLink> linkOf(const std::string& name, const TransformRecord& record)
{
  if (const auto linear = linearTypes().find(name); linear != linearTypes().end())
  {
    return linearOf(linear->second, record);
  }
  if (name == "BSplineTransform" || name == OldSpline)
  {
    return splineOf(record);
  }
  if (name == "DisplacementFieldTransform")
  {
    return fieldOf(record);
  }
  if (name == "ThinPlateSplineKernelTransform")
  {
    return thinPlatesOf(record);
  }
  if (name != "IdentityTransform")
  {
    throw Problem("holds the transform " + shownWords(record.type) +
      ", which BrainShift does not know; it knows affine and rigid transforms, cubic B-splines, "
      "displacement fields, thin plates and composites of these, in three dimensions");
  }
  return {};
}

void requireNumbers(const TransformRecord& record)
{
  if (!areFinite(record.parameters) || !areFinite(record.fixed))
  {
    throw Problem("holds a number that is not finite, or beyond 1e12");
  }
}

// 3D Slicer puts Inverse before the name of a map of which it only knows the other direction.
void addRecord(const TransformRecord& record, PointTransform& transform)
{
  constexpr std::string_view Inverse = "Inverse";
  requireNumbers(record);
  const std::string name = nameOf(record);
  const bool isInverse = name.rfind(Inverse, 0) == 0;
  std::optional<TransformLink> link =
    linkOf(isInverse ? name.substr(Inverse.size()) : name, record);
  if (link && isInverse)
  {
    link = inverseOf({ { *std::move(link) } });
  }
  if (link)
  {
    transform.links.push_back(*std::move(link));
  }
}

// Before ITK 4, a B-spline and its bulk stood in one file, and the bulk was added to it.
void addOldSpline(const std::vector<TransformRecord>& records, PointTransform& transform)
{
  const auto bulk = linearTypes().find(nameOf(records.back()));
  const bool isIdentity = nameOf(records.back()) == "IdentityTransform";
  const bool isPair = records.size() == 2 && nameOf(records.front()) == OldSpline;
  if (!isPair || (bulk == linearTypes().end() && !isIdentity))
  {
    throw Problem("holds " + std::to_string(records.size()) +
      " transforms, one of them a BSplineDeformableTransform, which may have only its bulk after "
      "it, an affine transform; write it again as a CompositeTransform");
  }
  requireNumbers(records.front());
  requireNumbers(records.back());
  SplineLink spline = splineOf(records.front());
  spline.base = isIdentity ? AffineLink() : linearOf(bulk->second, records.back());
  transform.links.emplace_back(std::move(spline));
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
  const bool hasOldSpline = std::any_of(records.begin(), records.end(),
    [](const TransformRecord& record) { return nameOf(record) == OldSpline; });
  if (first == 0 && records.size() > 1 && hasOldSpline)
  {
    addOldSpline(records, transform);
    return;
  }
  if (first == 0 && records.size() > 1)
  {
    throw Problem("holds " + std::to_string(records.size()) +
      " transforms and does not say how they follow one another: they may be those of the volumes "
      "of a series. Write the one that you want to a file of its own, or all of them as one "
      "CompositeTransform");
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
  transform.links.emplace_back(requiredAffine({ linear, { rows[3], rows[7], rows[11] } }));
}
}
