// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SlicePick.h"

#include "Representations/Scene/SceneGeometry.h"

#include "vtkRenderer.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
glm::dvec3 placed(const glm::dmat4& matrix, const glm::dvec3& position)
{
  const glm::dvec4 result = matrix * glm::dvec4(position, 1.0);
  return glm::dvec3(result) / result.w;
}

glm::dvec3 turned(const glm::dmat4& matrix, const glm::dvec3& vector)
{
  return glm::dvec3(matrix * glm::dvec4(vector, 0.0));
}

// Share of the way from one end to the other at which a rectangle is met; below 0: it is not met.
double shareAtQuad(const SliceQuad& quad, const glm::dvec3& from, const glm::dvec3& to)
{
  constexpr double missed = -1.0;
  const glm::dvec3 normal = glm::cross(quad.right, quad.up);
  const double across = glm::dot(to - from, normal);
  if (across == 0.0)
  {
    return missed;
  }
  const double share = glm::dot(quad.corner - from, normal) / across;
  const glm::dvec3 place = from + share * (to - from) - quad.corner;
  const double right = glm::dot(place, quad.right) / glm::dot(quad.right, quad.right);
  const double up = glm::dot(place, quad.up) / glm::dot(quad.up, quad.up);
  const bool inside = right >= 0.0 && right <= 1.0 && up >= 0.0 && up <= 1.0;
  return inside && share <= 1.0 ? share : missed;
}
}

std::vector<SliceHit> hitsAlong(
  const DrawnSlices& slices, const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dmat4 textureFromWorld = glm::inverse(slices.worldFromTexture);
  const glm::dvec3 start = placed(textureFromWorld, from);
  const glm::dvec3 end = placed(textureFromWorld, to);
  std::vector<std::pair<double, SliceHit>> hits;
  for (const SliceQuad& quad : wholeQuads(slices.planes))
  {
    const double share = shareAtQuad(quad, start, end);
    if (share >= 0.0)
    {
      SliceHit hit;
      hit.texture = start + share * (end - start);
      hit.world = placed(slices.worldFromTexture, hit.texture);
      hit.normal = glm::normalize(glm::cross(
        turned(slices.worldFromTexture, quad.right), turned(slices.worldFromTexture, quad.up)));
      hits.emplace_back(share, hit);
    }
  }
  std::sort(hits.begin(), hits.end(),
    [](const auto& first, const auto& second) { return first.first < second.first; });
  std::vector<SliceHit> sorted;
  sorted.reserve(hits.size());
  for (const auto& [share, hit] : hits)
  {
    sorted.push_back(hit);
  }
  return sorted;
}

std::vector<SliceHit> hitsUnderPixel(const DrawnSlices& slices, vtkRenderer* renderer, int x, int y)
{
  const int* size = renderer->GetSize();
  if (x < 0 || y < 0 || x >= size[0] || y >= size[1])
  {
    return {};
  }
  const glm::dmat4 worldFromClip = glm::inverse(clipFromWorld(renderer));
  const double right = 2.0 * (x + 0.5) / size[0] - 1.0;
  const double up = 2.0 * (y + 0.5) / size[1] - 1.0;
  return hitsAlong(
    slices, placed(worldFromClip, { right, up, -1.0 }), placed(worldFromClip, { right, up, 1.0 }));
}
}
