// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/RestCortex.h"

#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Filters/Attached/DeformableVolume.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

namespace brainshift
{
namespace
{
constexpr int Smoothings = 10;     // about three voxels far
constexpr std::size_t Asked = 500; // points that say which side is out
constexpr double SpreadMm = 3.0;   // anchors are further apart
constexpr double AsideVoxels = 0.5;

// Weights of the corners a, b and c in the point of a triangle that is nearest to a position: walks
// through the regions of the corners, then the edges, then the face. A triangle may have no area,
// and edges without length: where a voxel has just the level, corners meet. Source: Ericson,
// Real-Time Collision Detection (2005), section 5.1.5.
glm::dvec3 weightsOfNearest(
  const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double abA = glm::dot(ab, position - a);
  const double acA = glm::dot(ac, position - a);
  const double abB = glm::dot(ab, position - b);
  const double acB = glm::dot(ac, position - b);
  const double abC = glm::dot(ab, position - c);
  const double acC = glm::dot(ac, position - c);
  if (abA <= 0.0 && acA <= 0.0)
  {
    return { 1.0, 0.0, 0.0 };
  }
  if (abB >= 0.0 && acB <= abB)
  {
    return { 0.0, 1.0, 0.0 };
  }
  if (acC >= 0.0 && abC <= acC)
  {
    return { 0.0, 0.0, 1.0 };
  }
  // Areas of the triangles between the foot and each edge, times a factor.
  const double ofC = abA * acB - abB * acA;
  const double ofB = abC * acA - abA * acC;
  const double ofA = abB * acC - abC * acB;
  if (ofC <= 0.0 && abA >= 0.0 && abB <= 0.0 && abA > abB)
  {
    const double along = abA / (abA - abB);
    return { 1.0 - along, along, 0.0 };
  }
  if (ofB <= 0.0 && acA >= 0.0 && acC <= 0.0 && acA > acC)
  {
    const double along = acA / (acA - acC);
    return { 1.0 - along, 0.0, along };
  }
  const double bc = (acB - abB) + (abC - acC); // length, squared
  if (ofA <= 0.0 && bc > 0.0)
  {
    const double along = (acB - abB) / bc;
    return { 0.0, 1.0 - along, along };
  }
  const double area = ofA + ofB + ofC; // with the same factor
  return area > 0.0 ? glm::dvec3(ofA, ofB, ofC) / area : glm::dvec3(1.0, 0.0, 0.0);
}

glm::dvec3 unit(const glm::dvec3& vector)
{
  const double length = glm::length(vector);
  return length > 0.0 ? vector / length : glm::dvec3(0.0, 0.0, 1.0);
}
}

RestCortex::RestCortex(const TissueRegion& tissue)
  : Mesh(surfaceOf(tissue))
  , Tree(this->Mesh)
{
  this->findNormals();
  // Which way triangles turn depends on the grid's axes and on the tissue's side of the level.
  const std::vector<glm::dvec3>& points = this->Mesh.points;
  const glm::dvec3& spacing = tissue.grid.spacing;
  const double aside = AsideVoxels * glm::min(spacing.x, glm::min(spacing.y, spacing.z));
  int inwards = 0;
  for (std::size_t i = 0; i < points.size(); i += points.size() / Asked + 1)
  {
    inwards += tissue.contains(points[i] + aside * this->Normals[i]) ? 1 : -1;
    inwards += tissue.contains(points[i] - aside * this->Normals[i]) ? -1 : 1;
  }
  this->turnOutwards(inwards);
  this->spread();
}

RestCortex::RestCortex(TriangleMesh mesh)
  : Mesh(std::move(mesh))
  , Tree(this->Mesh)
{
  this->findNormals();
  const std::vector<glm::dvec3>& points = this->Mesh.points;
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& point : points)
  {
    middle += point / static_cast<double>(points.size());
  }
  int inwards = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    inwards += glm::dot(this->Normals[i], points[i] - middle) < 0.0 ? 1 : -1;
  }
  this->turnOutwards(inwards);
  this->spread();
}

RestCortex RestCortex::smoothed() const
{
  constexpr int Rounds = 20;
  TriangleMesh mesh = this->Mesh;
  std::vector<glm::dvec3>& points = mesh.points;
  for (int i = 0; i < 2 * Rounds; ++i)
  {
    const double fraction = i % 2 == 0 ? 0.6 : -0.62; // inwards, then outwards
    std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0.0));
    std::vector<double> counts(points.size(), 0.0);
    for (const glm::ivec3& t : mesh.triangles)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        sums[t[corner]] += points[t[(corner + 1) % 3]] + points[t[(corner + 2) % 3]];
        counts[t[corner]] += 2.0;
      }
    }
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      points[k] += counts[k] > 0.0 ? fraction * (sums[k] / counts[k] - points[k]) : glm::dvec3(0.0);
    }
  }
  return RestCortex(std::move(mesh));
}

void RestCortex::spread()
{
  // Beside voxels that are no number, points are left that no triangle has.
  std::vector<char> isUsed(this->Mesh.points.size(), 0);
  for (const glm::ivec3& t : this->Mesh.triangles)
  {
    isUsed[t.x] = isUsed[t.y] = isUsed[t.z] = 1;
  }
  std::vector<SurfacePoint> all;
  all.reserve(this->Mesh.points.size());
  for (std::size_t i = 0; i < this->Mesh.points.size(); ++i)
  {
    if (isUsed[i])
    {
      all.push_back({ this->Mesh.points[i], this->Normals[i] });
    }
  }
  this->Spread = thinnedPoints(all, SpreadMm);
}

void RestCortex::findNormals()
{
  const std::vector<glm::dvec3>& points = this->Mesh.points;
  this->Normals.assign(points.size(), glm::dvec3(0.0));
  for (const glm::ivec3& t : this->Mesh.triangles)
  {
    const glm::dvec3 area =
      glm::cross(points[t.y] - points[t.x], points[t.z] - points[t.x]); // twice
    this->Normals[t.x] += area;
    this->Normals[t.y] += area;
    this->Normals[t.z] += area;
  }
  std::transform(this->Normals.begin(), this->Normals.end(), this->Normals.begin(), unit);
  for (int i = 0; i < Smoothings; ++i)
  {
    std::vector<glm::dvec3> sums = this->Normals;
    for (const glm::ivec3& t : this->Mesh.triangles)
    {
      const glm::dvec3 sum = this->Normals[t.x] + this->Normals[t.y] + this->Normals[t.z];
      sums[t.x] += sum;
      sums[t.y] += sum;
      sums[t.z] += sum;
    }
    std::transform(sums.begin(), sums.end(), this->Normals.begin(), unit);
  }
}

void RestCortex::turnOutwards(int inwards)
{
  if (inwards > 0)
  {
    std::transform(this->Normals.begin(), this->Normals.end(), this->Normals.begin(),
      [](const glm::dvec3& normal) { return -normal; });
  }
}

std::optional<SurfacePoint> RestCortex::nearest(const glm::dvec3& rest, int& hint) const
{
  hint = this->Tree.nearest(rest, hint).triangle;
  if (hint < 0)
  {
    return {};
  }
  const glm::ivec3& corners = this->Tree.corners(hint);
  const std::vector<glm::dvec3>& points = this->Mesh.points;
  const glm::dvec3 weight =
    weightsOfNearest(rest, points[corners.x], points[corners.y], points[corners.z]);
  const auto mixed = [&](const std::vector<glm::dvec3>& values) {
    return weight.x * values[corners.x] + weight.y * values[corners.y] +
      weight.z * values[corners.z];
  };
  return SurfacePoint{ mixed(points), unit(mixed(this->Normals)) };
}

void CortexSource::find(const Request& request)
{
  if (request.mustHaveArray && !request.array.empty() &&
    !request.image->GetPointData()->HasArray(request.array.c_str()))
  {
    throw Problem("The " + request.where + " has no point array " + request.array);
  }
  vtkDataArray* scalars = scalarsOf(request.image, request.array);
  if (!scalars || scalars->GetNumberOfComponents() != 1)
  {
    throw Problem(
      "The " + request.where + " has no point array of one component to find the cortex in");
  }
  if (this->Tissue.find(scalars, gridOf(request.image), request.isLabel, request.level) ||
    this->Cortex.isEmpty()) // memory ran out the last time
  {
    ++this->Version;
    this->Cortex = RestCortex();
    this->Cortex = RestCortex(this->Tissue.region());
  }
  if (this->Cortex.isEmpty())
  {
    const double* range = scalars->GetRange(0);
    throw Problem((request.isLabel ? "Label is " : "Threshold is ") + numberText(request.level) +
      " and gives no cortex; the scalars of the " + request.where + " go from " +
      roundedText(range[0]) + " to " + numberText(range[1]));
  }
}

bool AnchorChoice::Key::operator==(const Key& other) const
{
  return this->cortex == other.cortex && this->maskTime == other.maskTime &&
    this->ball.centre == other.ball.centre && this->ball.radiusMm == other.ball.radiusMm;
}

const std::vector<SurfacePoint>& AnchorChoice::beside(
  const OpeningBall& ball, const CortexSource& cortex)
{
  const auto makeIsOpen = [&ball]() -> IsOpen {
    return [&ball](const glm::dvec3& rest) {
      return glm::distance(rest, ball.centre) < ball.radiusMm + AnchorMarginMm;
    };
  };
  return this->find({ cortex.version(), 0, ball }, makeIsOpen, cortex);
}

const std::vector<SurfacePoint>& AnchorChoice::beside(
  std::uint64_t maskTime, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex)
{
  return this->find({ cortex.version(), maskTime, {} }, makeIsOpen, cortex);
}

const std::vector<SurfacePoint>& AnchorChoice::find(
  const Key& key, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex)
{
  if (!(this->Known == key))
  {
    this->Known.reset(); // if memory runs out
    this->Anchors = chooseAnchors(cortex.cortex().points(), makeIsOpen());
    this->Known = key;
  }
  return this->Anchors;
}
}
