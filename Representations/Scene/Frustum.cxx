// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/Frustum.h"

namespace brainshift
{
namespace
{
FrustumPlane planeOf(const glm::dmat4& clipFromSpace, const glm::dmat4& spaceFromClip, double depth)
{
  const auto unproject = [&](double x, double y) {
    const glm::dvec4 position = spaceFromClip * glm::dvec4(x, y, depth, 1.0);
    return glm::dvec3(position) / position.w;
  };
  FrustumPlane plane;
  plane.origin = unproject(0.0, 0.0);
  plane.right = unproject(1.0, 0.0) - plane.origin;
  plane.up = unproject(0.0, 1.0) - plane.origin;
  plane.w = (clipFromSpace * glm::dvec4(plane.origin, 1.0)).w;
  return plane;
}
}

Frustum frustumOf(const glm::dmat4& clipFromSpace)
{
  const glm::dmat4 spaceFromClip = glm::inverse(clipFromSpace);
  return { planeOf(clipFromSpace, spaceFromClip, -1.0),
    planeOf(clipFromSpace, spaceFromClip, 1.0) };
}

glm::dvec2 fractionFromFraction(const Frustum& to, const Frustum& from)
{
  const glm::dvec3 way = to.far.origin - to.near.origin;
  const glm::dvec3 unit = way / glm::dot(way, way);
  return { glm::dot(from.far.origin - from.near.origin, unit),
    glm::dot(from.near.origin - to.near.origin, unit) };
}
}
