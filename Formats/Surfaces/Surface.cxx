// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/Surface.h"

#include "Common/HostMemory.h"
#include "Formats/Files/PlainFile.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

namespace brainshift
{
std::size_t bytesOf(NumberType type)
{
  switch (type)
  {
    case NumberType::UInt8:
      return 1;
    case NumberType::Float64:
      return 8;
    default:
      return 4;
  }
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

std::string placeProblem(const glm::dvec3& point, const std::string& what)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(point[axis]) <= FarthestPoint))
    {
      std::ostringstream problem;
      problem << "has " << what << " at a coordinate of " << point[axis] << " mm; the limit is "
              << FarthestPoint << " mm";
      return problem.str();
    }
  }
  return {};
}

std::string placeSurface(Surface& surface)
{
  const auto count =
    static_cast<int>(std::min<std::size_t>(surface.points.size(), std::numeric_limits<int>::max()));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
  {
    glm::dvec3& point = surface.points[i];
    const std::string what = "point " + std::to_string(i);
    std::string problem = placeProblem(point, what);
    point = glm::dvec3(surface.worldFromStored * glm::dvec4(point, 1.0));
    problem = problem.empty() ? placeProblem(point, what) : problem;
    if (!problem.empty())
    {
      return problem;
    }
  }
  const bool isMirrored = glm::determinant(glm::dmat3(surface.worldFromStored)) < 0.0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    glm::ivec3& triangle = surface.triangles[i];
    for (int corner = 0; corner < 3; ++corner)
    {
      if (triangle[corner] < 0 || triangle[corner] >= count)
      {
        return "has the point " + std::to_string(triangle[corner]) + " in triangle " +
          std::to_string(i) + "; it has the points 0 to " + std::to_string(count - 1);
      }
    }
    if (isMirrored)
    {
      std::swap(triangle.y, triangle.z); // what was outside stays outside
    }
  }
  return {};
}

std::string readFileBytes(
  const std::string& fileName, double timesInMemory, const ShareDone& shareDone, FileBytes& file)
{
  const std::string notPlain = plainFileProblem(fileName);
  if (!notPlain.empty())
  {
    return notPlain;
  }
  std::error_code error;
  const auto size = std::filesystem::file_size(fileName, error);
  if (error)
  {
    return "has an unknown size";
  }
  const std::string noMemory = hostMemoryProblem("it", static_cast<double>(size) * timesInMemory);
  if (!noMemory.empty())
  {
    return "cannot be read: " + noMemory;
  }
  file.bytes.resize(static_cast<std::size_t>(size));
  return readBytes({ fileName }, file.bytes.data(), file.bytes.size(), [&](double share) {
    file.isStopped = !shareDone(share);
    return !file.isStopped;
  });
}

std::string counted(std::size_t count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}
}
