// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SliceGeometry.h"

#include "Representations/Scene/SceneGeometry.h"

#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int Axes = 3;

SliceQuad quadAcross(int axis, const SlicePlanes& box)
{
  const int right = (axis + 1) % Axes;
  const int up = (axis + 2) % Axes;
  SliceQuad quad;
  quad.axis = axis;
  quad.corner = box.low;
  quad.corner[axis] = box.position[axis];
  quad.right[right] = box.high[right] - box.low[right];
  quad.up[up] = box.high[up] - box.low[up];
  return quad;
}

bool isCut(int axis, const SlicePlanes& box)
{
  return box.shown[axis] && box.position[axis] >= box.low[axis] &&
    box.position[axis] <= box.high[axis];
}

// Whether the eye looks from the side of greater coordinates, across each axis.
glm::bvec3 eyeAbove(const glm::dvec3& position, const glm::dmat4& clipFromTexture)
{
  // The camera maps the eye to (0, 0, z, 0). If w is 0, the eye is infinitely far away and this is
  // the direction in which it looks.
  glm::dvec4 eye = glm::inverse(clipFromTexture) * glm::dvec4(0.0, 0.0, 1.0, 0.0);
  constexpr double nearlyNone = 1e-9;
  const bool parallel = std::abs(eye.w) < nearlyNone * glm::length(glm::dvec3(eye));
  const glm::dvec3 towardsEye = parallel ? -glm::dvec3(eye) : glm::dvec3(eye) / eye.w - position;
  return { towardsEye.x > 0.0, towardsEye.y > 0.0, towardsEye.z > 0.0 };
}

// Appends the planes behind the one across `axis`, then that plane, then the planes in front of it.
void appendBackToFront(
  int axis, const SlicePlanes& box, const glm::bvec3& above, std::vector<SliceQuad>& quads)
{
  if (axis == Axes)
  {
    return;
  }
  if (!isCut(axis, box))
  {
    appendBackToFront(axis + 1, box, above, quads);
    return;
  }
  SlicePlanes lower = box;
  SlicePlanes upper = box;
  lower.high[axis] = upper.low[axis] = box.position[axis];
  appendBackToFront(axis + 1, above[axis] ? lower : upper, above, quads);
  quads.push_back(quadAcross(axis, box));
  appendBackToFront(axis + 1, above[axis] ? upper : lower, above, quads);
}
}

glm::ivec3 axesAcrossPlanes(const glm::dmat3& direction)
{
  constexpr std::array<std::array<int, Axes>, 6> orders{ { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 },
    { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } } };
  glm::ivec3 best(0);
  double most = -1.0;
  for (const auto& order : orders)
  {
    double agreement = 0.0;
    for (int world = 0; world < Axes; ++world)
    {
      agreement += std::abs(direction[order[world]][world]);
    }
    if (agreement > most)
    {
      most = agreement;
      best = { order[0], order[1], order[2] };
    }
  }
  return best;
}

std::vector<SliceQuad> wholeQuads(const SlicePlanes& planes)
{
  std::vector<SliceQuad> quads;
  for (int axis = 0; axis < Axes; ++axis)
  {
    if (isCut(axis, planes))
    {
      quads.push_back(quadAcross(axis, planes));
    }
  }
  return quads;
}

std::vector<SliceQuad> quadsBackToFront(
  const SlicePlanes& planes, const glm::dmat4& clipFromTexture)
{
  std::vector<SliceQuad> quads;
  appendBackToFront(0, planes, eyeAbove(planes.position, clipFromTexture), quads);
  return quads;
}

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

// Fraction of the distance between both ends at which a rectangle is met; below 0: it is not met.
double fractionAtQuad(const SliceQuad& quad, const glm::dvec3& from, const glm::dvec3& to)
{
  constexpr double missed = -1.0;
  const glm::dvec3 normal = glm::cross(quad.right, quad.up);
  const double across = glm::dot(to - from, normal);
  if (across == 0.0)
  {
    return missed;
  }
  const double fraction = glm::dot(quad.corner - from, normal) / across;
  const glm::dvec3 place = from + fraction * (to - from) - quad.corner;
  const double right = glm::dot(place, quad.right) / glm::dot(quad.right, quad.right);
  const double up = glm::dot(place, quad.up) / glm::dot(quad.up, quad.up);
  const bool inside = right >= 0.0 && right <= 1.0 && up >= 0.0 && up <= 1.0;
  return inside && fraction <= 1.0 ? fraction : missed;
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
    const double fraction = fractionAtQuad(quad, start, end);
    if (fraction >= 0.0)
    {
      SliceHit hit;
      hit.texture = start + fraction * (end - start);
      hit.world = placed(slices.worldFromTexture, hit.texture);
      hit.normal = glm::normalize(glm::cross(
        turned(slices.worldFromTexture, quad.right), turned(slices.worldFromTexture, quad.up)));
      hits.emplace_back(fraction, hit);
    }
  }
  std::sort(hits.begin(), hits.end(),
    [](const auto& first, const auto& second) { return first.first < second.first; });
  std::vector<SliceHit> sorted;
  sorted.reserve(hits.size());
  for (const auto& [fraction, hit] : hits)
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
