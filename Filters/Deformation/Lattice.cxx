// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Lattice.h"

#include "Filters/Deformation/IndexLoop.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr std::int64_t PointsAtLeast = 32768; // for a thread: about 0.2 ms

// The four control points around a position along one axis and their weights.
struct Taps
{
  int index[4];
  glm::vec4 weight;
  glm::vec4 slope;
};

Taps tapsAt(int kernel, int points, double position)
{
  const double inside = std::clamp(position, 0.0, points - 1.0);
  const int cell = std::min(static_cast<int>(inside), points - 2);
  const float t = static_cast<float>(inside - cell);
  Taps taps;
  for (int tap = 0; tap < 4; ++tap)
  {
    taps.index[tap] = std::clamp(cell - 1 + tap, 0, points - 1);
  }
  taps.weight = kernelWeights(kernel, t);
  taps.slope = position == inside ? kernelSlopes(kernel, t) : glm::vec4(0.0f);
  return taps;
}

// Those along each axis.
using TapsOfAxes = std::array<Taps, 3>;

TapsOfAxes tapsAround(const glm::ivec3& dimensions, int kernel, const glm::dvec3& position)
{
  return { tapsAt(kernel, dimensions.x, position.x), tapsAt(kernel, dimensions.y, position.y),
    tapsAt(kernel, dimensions.z, position.z) };
}

// The four control points of one row around a position.
struct RowOfTaps
{
  const glm::vec3* tap[4];

  RowOfTaps(
    const glm::ivec3& dimensions, const glm::vec3* values, const TapsOfAxes& taps, int j, int k)
  {
    const glm::vec3* row = values +
      (static_cast<std::size_t>(taps[2].index[k]) * dimensions.y + taps[1].index[j]) * dimensions.x;
    for (int i = 0; i < 4; ++i)
    {
      this->tap[i] = row + taps[0].index[i];
    }
  }

  glm::vec3 sum(const glm::vec4& weight) const
  {
    return weight[0] * *this->tap[0] + weight[1] * *this->tap[1] + weight[2] * *this->tap[2] +
      weight[3] * *this->tap[3];
  }
};

// The control point of a lattice `ratio` times as dense, `distance` points of the coarser one away
// from a point of that, whose basis function the denser lattice is to repeat. With Catmull-Rom it
// is the function's value there. B-splines do not pass through their control points; this is the
// coefficient that makes the denser ones add up to a cubic, and to the coarser B-spline exactly
// where every knot of it is one of theirs.
double basisFunction(int kernel, double distance, double ratio)
{
  const double away = std::abs(distance);
  if (away >= 2.0)
  {
    return 0.0;
  }
  const int cell = static_cast<int>(away);
  // At t in the cell right of the point, the point is the second of the four taps; one cell
  // further it is the first.
  const double value = kernelWeights(kernel, static_cast<float>(away - cell))[1 - cell];
  const double curvature = cell == 0 ? 3.0 * away - 2.0 : 2.0 - away; // of a B-spline
  return kernel == KernelBSpline ? value - curvature / (6.0 * ratio * ratio) : value;
}

void applyMove(Lattice& lattice, const Stroke& stroke)
{
  const Grid& grid = lattice.grid;
  glm::dvec3 madeAt = stroke.axis;
  if (glm::any(glm::lessThanEqual(madeAt, glm::dvec3(0.0))))
  {
    madeAt = stroke.major > 0.0 ? glm::dvec3(stroke.major) : grid.spacing;
  }
  const glm::dvec3 ratio = glm::max(madeAt / grid.spacing, glm::dvec3(1.0));
  const glm::dvec3 last = glm::dvec3(grid.dimensions - 1) / ratio;
  // The control point, in the coordinates of the lattice the stroke was made at.
  const glm::dvec3 point =
    glm::clamp(glm::round(grid.gridFromWorld(stroke.anchor) / ratio), glm::dvec3(0.0), last);
  const glm::dvec3 end(grid.dimensions - 1);
  // Clamped first: a far position is no integer.
  const glm::ivec3 low(glm::clamp(glm::ceil((point - 2.0) * ratio), glm::dvec3(0.0), end));
  const glm::ivec3 high(glm::clamp(glm::floor((point + 2.0) * ratio), glm::dvec3(0.0), end));
  const auto weightAlong = [&](int axis, int index) {
    const double distance = index / ratio[axis] - point[axis];
    // On the lattice it was made at the stroke moves one control point, whatever the kernel.
    if (ratio[axis] == 1.0)
    {
      return double(std::abs(distance) < 0.5);
    }
    // A point at the border stands for its missing neighbour too.
    const double below = point[axis] < 0.5 ? distance + 1.0 : 2.0;
    const double above = point[axis] > last[axis] - 0.5 ? distance - 1.0 : 2.0;
    return basisFunction(lattice.kernel, distance, ratio[axis]) +
      basisFunction(lattice.kernel, below, ratio[axis]) +
      basisFunction(lattice.kernel, above, ratio[axis]);
  };
  forEachIndex(low, high, [&](const glm::ivec3& at) {
    const double weight = weightAlong(0, at.x) * weightAlong(1, at.y) * weightAlong(2, at.z);
    lattice.displacements[grid.offset(at.x, at.y, at.z)] += glm::vec3(weight * stroke.vector);
  });
}

void applyAround(Lattice& lattice, const Stroke& stroke)
{
  const Grid& grid = lattice.grid;
  const double reach = std::max(stroke.major, stroke.minor);
  const std::int64_t layer = static_cast<std::int64_t>(grid.dimensions.x) * grid.dimensions.y;
  parallelFor(
    0, grid.dimensions.z, PointsAtLeast / layer, [&](std::int64_t first, std::int64_t last) {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < grid.dimensions.y; ++j)
        {
          glm::vec3* displacement = &lattice.displacements[grid.offset(0, j, k)];
          for (int i = 0; i < grid.dimensions.x; ++i, ++displacement)
          {
            const glm::dvec3 deformed =
              grid.worldFromGrid(glm::dvec3(i, j, k)) + glm::dvec3(*displacement);
            const glm::dvec3 fromAnchor = deformed - stroke.anchor;
            if (glm::dot(fromAnchor, fromAnchor) < reach * reach)
            {
              const double weight = falloff(normalisedDistance(stroke, deformed), stroke.sigma);
              *displacement += glm::vec3(weight * stroke.vector);
            }
          }
        }
      }
    });
}
}

bool sameMask(
  const std::shared_ptr<const NodeWeights>& a, const std::shared_ptr<const NodeWeights>& b)
{
  return a == b || (a && b && a->perCell == b->perCell && a->values == b->values);
}

Lattice makeLattice(const Grid& grid, int kernel)
{
  Lattice lattice;
  lattice.grid = grid;
  lattice.kernel = kernel;
  lattice.displacements.assign(grid.count(), glm::vec3(0.0f));
  return lattice;
}

std::string problemOfDisplacements(const Lattice& lattice, const std::string& cause)
{
  const glm::dvec3& spacing = lattice.grid.spacing;
  const double longest = LongestDisplacementCells * std::min({ spacing.x, spacing.y, spacing.z });
  const auto tooLong = std::find_if_not(lattice.displacements.begin(), lattice.displacements.end(),
    [&](const glm::vec3& d) { return glm::length(glm::dvec3(d)) <= longest; });
  if (tooLong == lattice.displacements.end())
  {
    return {};
  }
  std::ostringstream problem;
  problem << "A control point is displaced by " << cause << " by "
          << glm::length(glm::dvec3(*tooLong)) << " mm; it must be at most " << longest << " mm, "
          << LongestDisplacementCells << " cells of the lattice";
  return problem.str();
}

void applyStroke(Lattice& lattice, const Stroke& stroke)
{
  if (!stroke.enabled)
  {
    return;
  }
  if (stroke.tool == Tool::Move)
  {
    applyMove(lattice, stroke);
  }
  else
  {
    applyAround(lattice, stroke);
  }
}

std::vector<glm::vec3> displacementsInCells(const Lattice& lattice)
{
  std::vector<glm::vec3> inCells(lattice.displacements.size());
  std::transform(lattice.displacements.begin(), lattice.displacements.end(), inCells.begin(),
    [&](const glm::vec3& displacement) {
      return glm::vec3(lattice.grid.gridVectorFromWorld(glm::dvec3(displacement)));
    });
  return inCells;
}

glm::vec3 cubicDisplacement(const glm::ivec3& dimensions, int kernel,
  const glm::vec3* displacements, const glm::dvec3& position)
{
  const TapsOfAxes taps = tapsAround(dimensions, kernel, position);
  glm::vec3 sum(0.0f);
  for (int k = 0; k < 4; ++k)
  {
    glm::vec3 plane(0.0f);
    for (int j = 0; j < 4; ++j)
    {
      plane +=
        taps[1].weight[j] * RowOfTaps(dimensions, displacements, taps, j, k).sum(taps[0].weight);
    }
    sum += taps[2].weight[k] * plane;
  }
  return sum;
}

glm::mat3 cubicGradient(const glm::ivec3& dimensions, int kernel, const glm::vec3* displacements,
  const glm::dvec3& position)
{
  const TapsOfAxes taps = tapsAround(dimensions, kernel, position);
  glm::mat3 gradient(0.0f);
  for (int k = 0; k < 4; ++k)
  {
    glm::mat3 plane(0.0f);
    for (int j = 0; j < 4; ++j)
    {
      const RowOfTaps row(dimensions, displacements, taps, j, k);
      const glm::vec3 value = row.sum(taps[0].weight);
      plane[0] += taps[1].weight[j] * row.sum(taps[0].slope);
      plane[1] += taps[1].slope[j] * value;
      plane[2] += taps[1].weight[j] * value;
    }
    gradient[0] += taps[2].weight[k] * plane[0];
    gradient[1] += taps[2].weight[k] * plane[1];
    gradient[2] += taps[2].slope[k] * plane[2];
  }
  return gradient;
}
}
