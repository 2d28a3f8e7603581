// SPDX-License-Identifier: BSD-3-Clause
#include "Widgets/LatticeShapes.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace brainshift
{
namespace
{
constexpr int PointsOfCircle = 64;
constexpr double FullCircle = 6.283185307179586; // radians

// A unit vector across a unit vector.
glm::dvec3 across(const glm::dvec3& axis)
{
  const glm::dvec3 other = std::abs(axis.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

// Two half axes, perpendicular.
Polyline ellipse(const glm::dvec3& centre, const glm::dvec3& first, const glm::dvec3& second)
{
  Polyline line;
  for (int i = 0; i <= PointsOfCircle; ++i)
  {
    const double angle = FullCircle * i / PointsOfCircle;
    line.push_back(centre + std::cos(angle) * first + std::sin(angle) * second);
  }
  return line;
}
}

std::vector<std::pair<int, int>> edgesBetween(const std::vector<ControlPoint>& points)
{
  using Key = std::tuple<int, int, int>;
  std::map<Key, int> indexOf;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::ivec3& index = points[i].index;
    indexOf[Key(index.x, index.y, index.z)] = static_cast<int>(i);
  }
  std::vector<std::pair<int, int>> edges;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::ivec3 next = points[i].index;
      ++next[axis];
      const auto found = indexOf.find(Key(next.x, next.y, next.z));
      if (found != indexOf.end())
      {
        edges.emplace_back(static_cast<int>(i), found->second);
      }
    }
  }
  return edges;
}

std::vector<Polyline> outlineOf(const Stroke& stroke, double fraction)
{
  const bool isSphere = shapeOf(stroke.tool) == StrokeShape::Sphere;
  const glm::dvec3 axis = isSphere ? glm::dvec3(0, 0, 1) : glm::normalize(stroke.axis);
  const double along = fraction * stroke.major;
  const double wide = fraction * (isSphere ? stroke.major : stroke.minor);
  const glm::dvec3 first = across(axis);
  const glm::dvec3 second = glm::cross(axis, first);
  return { ellipse(stroke.anchor, wide * first, wide * second),
    ellipse(stroke.anchor, along * axis, wide * first),
    ellipse(stroke.anchor, along * axis, wide * second) };
}

Polyline sectionOf(const Stroke& stroke, double fraction, const glm::dvec3& normal)
{
  const bool isSphere = shapeOf(stroke.tool) == StrokeShape::Sphere;
  const glm::dvec3 axis = isSphere ? normal : glm::normalize(stroke.axis);
  const double minor = isSphere ? stroke.major : stroke.minor;
  const glm::dvec3 inPlane = axis - glm::dot(axis, normal) * normal;
  constexpr double nearlyNone = 1e-9;
  const double cosine = glm::length(inPlane); // between the axis and the section
  const glm::dvec3 first = cosine < nearlyNone ? across(normal) : inPlane / cosine;
  const double along = 1.0 /
    std::hypot(cosine / stroke.major, std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / minor);
  return ellipse(
    stroke.anchor, fraction * along * first, fraction * minor * glm::cross(normal, first));
}

double radiusOfHalfWeight(double sigma)
{
  double low = 0.0;
  double high = 1.0;
  for (int halving = 0; halving < 30; ++halving)
  {
    const double middle = (low + high) / 2.0;
    (falloff(middle, sigma) > 0.5 ? low : high) = middle;
  }
  return low;
}

std::vector<Polyline> cross(const glm::dvec3& centre, double size)
{
  std::vector<Polyline> lines;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 half(0.0);
    half[axis] = size;
    lines.push_back({ centre - half, centre + half });
  }
  return lines;
}

std::vector<Polyline> arrow(
  const glm::dvec3& from, const glm::dvec3& to, double size, const glm::dvec3& ahead)
{
  const double length = glm::distance(from, to);
  if (length == 0.0)
  {
    return {};
  }
  const glm::dvec3 along = (to - from) / length;
  constexpr double leastSine = 1e-6; // between arrow and view
  const glm::dvec3 aside = glm::cross(along, ahead);
  const glm::dvec3 side = glm::length(aside) < leastSine ? across(along) : glm::normalize(aside);
  const double head = std::min(size, length / 2.0);
  constexpr double slim = 0.5; // half the head's width / its length
  const glm::dvec3 behind = to - head * along;
  return { { from, to }, { behind + slim * head * side, to, behind - slim * head * side } };
}

Polyline ring(const glm::dvec3& centre, double radius, const glm::dvec3& ahead)
{
  const glm::dvec3 first = across(ahead);
  return ellipse(centre, radius * first, radius * glm::cross(ahead, first));
}
}
