// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/PointTransform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double Stretch = 1e-4;           // of a rigid map: 0.01 mm in 100 mm
constexpr double EdgeOfSpline = 1e-6;      // cells; ITK's own rounding is smaller
constexpr double MissOfInverse = 1e-6;     // mm
constexpr int StepsOfInverse = 60;         // Newton needs 4 to 6 where nothing folds
constexpr double DifferenceOfSlope = 0.01; // mm
constexpr int SamplesOfCell = 4;
constexpr int LongestSide = 256;

glm::dvec4 splineWeights(double t)
{
  const double s = 1.0 - t;
  return glm::dvec4(
           s * s * s, 4.0 + t * t * (3.0 * t - 6.0), 4.0 + s * s * (3.0 * s - 6.0), t * t * t) /
    6.0;
}

glm::dvec3 mappedBy(const AffineLink& link, const glm::dvec3& from)
{
  return link.linear * from + link.offset;
}

/** The first of the four coefficients along an axis whose splines reach a point; none outside. */
std::optional<int> firstAround(double at, int side, bool fades)
{
  if (fades)
  {
    const bool isNear = at > -2.0 && at < side + 1.0; // also rejects NaN
    return isNear ? std::optional(static_cast<int>(std::floor(at)) - 1) : std::nullopt;
  }
  const bool isInside = at >= 1.0 - EdgeOfSpline && at <= side - 2.0 + EdgeOfSpline;
  return isInside ? std::optional(std::clamp(static_cast<int>(std::floor(at)), 1, side - 3) - 1)
                  : std::nullopt;
}

// The sum of cubic B-splines; 0 outside.
glm::dvec3 bendOf(const SplineLink& link, const glm::dvec3& from)
{
  const glm::ivec3& sides = link.grid.dimensions;
  const glm::dvec3 at = link.grid.at(from);
  glm::ivec3 first;
  glm::dvec4 weights[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::optional<int> found = firstAround(at[axis], sides[axis], link.fades);
    if (!found)
    {
      return glm::dvec3(0.0);
    }
    first[axis] = *found;
    weights[axis] = splineWeights(at[axis] - (*found + 1));
  }
  const glm::ivec3 begin = glm::max(-first, 0); // of the four, those that the grid has
  const glm::ivec3 end = glm::min(sides - first, 4);
  glm::dvec3 sum(0.0);
  for (int k = begin.z; k < end.z; ++k)
  {
    for (int j = begin.y; j < end.y; ++j)
    {
      const std::size_t row =
        (static_cast<std::size_t>(first.z + k) * sides.y + first.y + j) * sides.x;
      const double weight = weights[2][k] * weights[1][j];
      for (int i = begin.x; i < end.x; ++i)
      {
        sum += weight * weights[0][i] * link.coefficients[row + (first.x + i)];
      }
    }
  }
  return sum;
}

glm::dvec3 mappedBy(const SplineLink& link, const glm::dvec3& from)
{
  return mappedBy(link.base, from) + bendOf(link, from);
}

// Catmull-Rom's weights of the points before, at, after and behind a place between two points.
glm::dvec4 cubicWeights(double t)
{
  return 0.5 *
    glm::dvec4(t * (t * (2.0 - t) - 1.0), t * t * (3.0 * t - 5.0) + 2.0,
      t * (t * (4.0 - 3.0 * t) + 1.0), t * t * (t - 1.0));
}

// Displacement at grid coordinates from 1 to the sides less 2.
glm::dvec3 cubicDisplacement(const FieldLink& link, const glm::dvec3& at)
{
  const glm::ivec3& sides = link.grid.dimensions;
  const glm::ivec3 cell = glm::min(glm::ivec3(at), sides - 3);
  const glm::dvec3 within = at - glm::dvec3(cell);
  const glm::dvec4 weights[3] = { cubicWeights(within.x), cubicWeights(within.y),
    cubicWeights(within.z) };
  glm::dvec3 sum(0.0);
  for (int i = 0; i < 64; ++i)
  {
    const glm::ivec3 step(i & 3, i >> 2 & 3, i >> 4);
    const double weight = weights[0][step.x] * weights[1][step.y] * weights[2][step.z];
    const glm::ivec3 point = cell - 1 + step;
    if (weight != 0.0) // a neighbour without a number does not count where it has no weight
    {
      const std::size_t row = static_cast<std::size_t>(point.z) * sides.y + point.y;
      sum += weight * glm::dvec3(link.displacements[row * sides.x + point.x]);
    }
  }
  return sum;
}

// The weights of four points in a row, of which the second is `first + 1`.
struct HeldAxis
{
  int first;
  glm::dvec4 weights;
};

// At a grid coordinate of an axis, whose last point has the number `last`.
HeldAxis heldAxis(double at, int last)
{
  at = glm::clamp(at, 0.0, static_cast<double>(last));
  const int low = glm::clamp(static_cast<int>(at), 0, glm::max(last - 1, 0));
  const double t = at - low;
  const bool hasBefore = low > 0;
  const bool hasBehind = low + 1 < last;
  glm::dvec4 weights(0.0, 1.0 - t, t, 0.0);
  if (hasBefore && hasBehind)
  {
    weights = cubicWeights(t);
  }
  else if (hasBehind)
  {
    weights = glm::dvec4(0.0, (t - 1.0) * (t - 2.0) / 2.0, t * (2.0 - t), t * (t - 1.0) / 2.0);
  }
  else if (hasBefore)
  {
    weights = glm::dvec4(t * (t - 1.0) / 2.0, 1.0 - t * t, t * (t + 1.0) / 2.0, 0.0);
  }
  return { low - 1, weights };
}

glm::dvec3 heldDisplacement(const FieldLink& link, const glm::dvec3& at)
{
  const glm::ivec3& sides = link.grid.dimensions;
  const HeldAxis axes[3] = { heldAxis(at.x, sides.x - 1), heldAxis(at.y, sides.y - 1),
    heldAxis(at.z, sides.z - 1) };
  glm::dvec3 sum(0.0);
  for (int i = 0; i < 64; ++i)
  {
    const glm::ivec3 step(i & 3, i >> 2 & 3, i >> 4);
    const double weight =
      axes[0].weights[step.x] * axes[1].weights[step.y] * axes[2].weights[step.z];
    if (weight != 0.0) // a neighbour without a number does not count where it has no weight
    {
      const glm::ivec3 point(
        axes[0].first + step.x, axes[1].first + step.y, axes[2].first + step.z);
      const std::size_t row = static_cast<std::size_t>(point.z) * sides.y + point.y;
      sum += weight * glm::dvec3(link.displacements[row * sides.x + point.x]);
    }
  }
  return sum;
}

bool isWithin(const glm::dvec3& at, const glm::dvec3& low, const glm::dvec3& high)
{
  return glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high));
}

glm::dvec3 mappedBy(const FieldLink& link, const glm::dvec3& from)
{
  const glm::ivec3 last = link.grid.dimensions - 1;
  glm::dvec3 at = link.grid.at(from);
  if (link.between == Between::Held)
  {
    return from + heldDisplacement(link, at);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(at[axis] >= -0.5 && at[axis] < last[axis] + 0.5))
    {
      return from;
    }
  }
  const bool isCubic = link.between == Between::Cubic;
  if (isCubic && glm::all(glm::greaterThan(last, glm::ivec3(2))) &&
    isWithin(at, glm::dvec3(1.0), glm::dvec3(last - 1)))
  {
    return from + cubicDisplacement(link, at);
  }
  const bool isNearest = link.between == Between::Nearest ||
    (isCubic && !isWithin(at, glm::dvec3(0.0), glm::dvec3(last)));
  at = glm::clamp(isNearest ? glm::floor(at + 0.5) : at, glm::dvec3(0.0), glm::dvec3(last));
  const glm::ivec3 low(at);
  const glm::dvec3 within = at - glm::dvec3(low);
  glm::dvec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weight = glm::mix(1.0 - within, within, glm::dvec3(side));
    const glm::ivec3 point = glm::min(low + side, last);
    const std::size_t offset =
      (static_cast<std::size_t>(point.z) * link.grid.dimensions.y + point.y) *
        link.grid.dimensions.x +
      point.x;
    const double share = weight.x * weight.y * weight.z;
    if (share > 0.0) // a neighbour without a number does not count where it has no weight
    {
      sum += share * glm::dvec3(link.displacements[offset]);
    }
  }
  return from + sum;
}

glm::dvec3 mappedBy(const ThinPlateLink& link, const glm::dvec3& from)
{
  glm::dvec3 to = mappedBy(link.base, from);
  for (std::size_t i = 0; i < link.sources.size(); ++i)
  {
    to += glm::distance(from, link.sources[i]) * link.weights[i];
  }
  return to;
}

glm::dvec3 mappedBy(const InverseLink& link, const glm::dvec3& from)
{
  return mappedBack(*link.of, from);
}

// Derivatives of a link that bends: column a is d(to) / d(from_a).
template <typename Link>
glm::dmat3 slopesOf(const Link& link, const glm::dvec3& from)
{
  glm::dmat3 slopes;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 step(0.0);
    step[axis] = DifferenceOfSlope;
    slopes[axis] =
      (mappedBy(link, from + step) - mappedBy(link, from - step)) / (2.0 * DifferenceOfSlope);
  }
  return slopes;
}

AffineLink inverted(const AffineLink& link)
{
  const glm::dmat3 linear = glm::inverse(link.linear);
  return { linear, -(linear * link.offset) };
}

glm::dvec3 mappedBackBy(const AffineLink& link, const glm::dvec3& to)
{
  return glm::inverse(link.linear) * (to - link.offset);
}

glm::dvec3 mappedBackBy(const InverseLink& link, const glm::dvec3& to)
{
  return mapped(*link.of, to);
}

// Newton's method. A step that makes the miss longer is halved. NaN where the search meets points
// without a number and finds no other way.
template <typename Link>
glm::dvec3 mappedBackBy(const Link& link, const glm::dvec3& to)
{
  glm::dvec3 best = to;
  glm::dvec3 miss = mappedBy(link, best) - to;
  bool hasGap = std::isnan(glm::length(miss));
  for (int step = 0; step < StepsOfInverse && glm::length(miss) > MissOfInverse; ++step)
  {
    const glm::dmat3 slopes = slopesOf(link, best);
    const bool isSteep = std::abs(glm::determinant(slopes)) > 1e-6;
    const glm::dvec3 move = isSteep ? glm::inverse(slopes) * miss : miss;
    double stepLength = 1.0; // a fraction of the move
    glm::dvec3 tried = best - move;
    glm::dvec3 left = mappedBy(link, tried) - to;
    while (!(glm::length(left) < glm::length(miss)) && stepLength > 1e-3)
    {
      stepLength *= 0.5;
      tried = best - stepLength * move;
      hasGap = hasGap || std::isnan(glm::length(left) + glm::length(move));
      left = mappedBy(link, tried) - to;
    }
    if (!(glm::length(left) < glm::length(miss)))
    {
      break;
    }
    best = tried;
    miss = left;
  }
  const bool isFound = glm::length(miss) <= MissOfInverse;
  return hasGap && !isFound ? glm::dvec3(std::numeric_limits<double>::quiet_NaN()) : best;
}

void reverseGrid(LinkGrid& grid)
{
  const glm::dvec3 signs(-1.0, -1.0, 1.0);
  grid.origin *= signs;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.worldFromGrid[axis] *= signs;
  }
  grid.gridFromWorld = glm::inverse(grid.worldFromGrid);
}

void reverseLink(AffineLink& link)
{
  const glm::dmat3 signs(glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1));
  link.linear = signs * link.linear * signs;
  link.offset = signs * link.offset;
}

void reverseLink(SplineLink& link)
{
  reverseGrid(link.grid);
  reverseLink(link.base);
  for (glm::dvec3& coefficient : link.coefficients)
  {
    coefficient *= glm::dvec3(-1.0, -1.0, 1.0);
  }
}

void reverseLink(FieldLink& link)
{
  reverseGrid(link.grid);
  for (glm::vec3& displacement : link.displacements)
  {
    displacement *= glm::vec3(-1.0f, -1.0f, 1.0f);
  }
}

void reverseLink(ThinPlateLink& link)
{
  reverseLink(link.base);
  for (std::size_t i = 0; i < link.sources.size(); ++i)
  {
    link.sources[i] *= glm::dvec3(-1.0, -1.0, 1.0);
    link.weights[i] *= glm::dvec3(-1.0, -1.0, 1.0);
  }
}

void reverseLink(InverseLink& link)
{
  PointTransform other = *link.of;
  reverseXY(other);
  link.of = std::make_shared<const PointTransform>(std::move(other));
}

bool isIdentity(const AffineLink& link)
{
  return link.linear == glm::dmat3(1.0) && link.offset == glm::dvec3(0.0);
}

bool isRigid(const AffineLink& link)
{
  const glm::dmat3 square = glm::transpose(link.linear) * link.linear - glm::dmat3(1.0);
  double most = 0.0;
  for (int column = 0; column < 3; ++column)
  {
    const glm::dvec3 away = glm::abs(square[column]);
    most = std::max({ most, away.x, away.y, away.z });
  }
  return most <= Stretch && glm::determinant(link.linear) > 0.0;
}

// `perCell` samples in each cell of a part of a grid; the third axis keeps it right-handed.
Grid samplesOf(const LinkGrid& link, const glm::dvec3& first, const glm::dvec3& cells, int perCell)
{
  Grid grid;
  glm::dmat3 steps = link.worldFromGrid;
  glm::dvec3 start = link.origin + steps * first;
  if (glm::determinant(steps) < 0.0)
  {
    start += steps[2] * cells.z;
    steps[2] = -steps[2];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const int fitting = std::clamp(static_cast<int>((LongestSide - 1) / cells[axis]), 1, perCell);
    const double length = glm::length(steps[axis]);
    grid.dimensions[axis] = static_cast<int>(cells[axis]) * fitting + 1;
    grid.spacing[axis] = length / fitting;
    grid.direction[axis] = steps[axis] / length;
  }
  grid.origin = start;
  return grid;
}
}

glm::dvec3 mapped(const PointTransform& transform, const glm::dvec3& from, double* missMm)
{
  glm::dvec3 point = from;
  for (const TransformLink& link : transform.links)
  {
    const glm::dvec3 before = point;
    point = std::visit([&](const auto& kind) { return mappedBy(kind, point); }, link);
    if (missMm && std::holds_alternative<InverseLink>(link)) // which is solved
    {
      const glm::dvec3 back =
        std::visit([&](const auto& kind) { return mappedBackBy(kind, point); }, link);
      *missMm = std::max(*missMm, glm::distance(back, before));
    }
  }
  return point;
}

glm::dvec3 mappedBack(const PointTransform& transform, const glm::dvec3& to, double* missMm)
{
  glm::dvec3 point = to;
  for (auto link = transform.links.rbegin(); link != transform.links.rend(); ++link)
  {
    const glm::dvec3 before = point;
    point = std::visit([&](const auto& kind) { return mappedBackBy(kind, point); }, *link);
    if (missMm && !std::holds_alternative<InverseLink>(*link))
    {
      const glm::dvec3 forth =
        std::visit([&](const auto& kind) { return mappedBy(kind, point); }, *link);
      *missMm = std::max(*missMm, glm::distance(forth, before));
    }
  }
  return point;
}

void reverseXY(PointTransform& transform)
{
  for (TransformLink& link : transform.links)
  {
    std::visit([](auto& kind) { reverseLink(kind); }, link);
  }
}

std::optional<AffineLink> affineOf(const PointTransform& transform)
{
  AffineLink all;
  for (const TransformLink& link : transform.links)
  {
    const auto* affine = std::get_if<AffineLink>(&link);
    const auto* inverse = std::get_if<InverseLink>(&link);
    const std::optional<AffineLink> other =
      inverse ? affineOf(*inverse->of) : std::optional<AffineLink>();
    if (!affine && !other)
    {
      return {};
    }
    const AffineLink turned = other ? inverted(*other) : AffineLink();
    affine = affine ? affine : &turned;
    all = { affine->linear * all.linear, affine->linear * all.offset + affine->offset };
  }
  return all;
}

void holdFields(PointTransform& transform)
{
  for (TransformLink& link : transform.links)
  {
    if (auto* field = std::get_if<FieldLink>(&link); field && field->between == Between::Linear)
    {
      field->between = Between::Held;
    }
    else if (auto* spline = std::get_if<SplineLink>(&link))
    {
      spline->fades = true;
    }
    else if (auto* inverse = std::get_if<InverseLink>(&link))
    {
      PointTransform other = *inverse->of;
      holdFields(other);
      inverse->of = std::make_shared<const PointTransform>(std::move(other));
    }
  }
}

TransformLink inverseOf(PointTransform transform)
{
  return InverseLink{ std::make_shared<const PointTransform>(std::move(transform)) };
}

std::string kindOf(const PointTransform& transform)
{
  const std::optional<AffineLink> affine = affineOf(transform);
  if (!affine)
  {
    return "nonlinear";
  }
  if (isIdentity(*affine))
  {
    return "identity";
  }
  return isRigid(*affine) ? "rigid" : "affine";
}

std::optional<Grid> ownGridOf(const PointTransform& transform)
{
  for (const TransformLink& link : transform.links)
  {
    if (const auto* spline = std::get_if<SplineLink>(&link))
    {
      const int beyond = spline->fades ? 2 : -1; // cells outside of the coefficients
      const glm::dvec3 cells(spline->grid.dimensions - 1 + 2 * beyond);
      return samplesOf(spline->grid, glm::dvec3(-beyond), cells, SamplesOfCell);
    }
    if (const auto* field = std::get_if<FieldLink>(&link))
    {
      return samplesOf(field->grid, glm::dvec3(0.0), glm::dvec3(field->grid.dimensions - 1), 1);
    }
    if (const auto* inverse = std::get_if<InverseLink>(&link))
    {
      if (const std::optional<Grid> grid = ownGridOf(*inverse->of))
      {
        return grid;
      }
    }
  }
  return {};
}
}
