// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/MaskWeights.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/Lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr float Far = std::numeric_limits<float>::max();
constexpr double Touching = 1e-6; // nodes: a voxel that ends at a cell's face is not in it

// Numbers on the nodes of a refined field, or in its cells.
template <typename T>
struct NodeImage
{
  glm::ivec3 count;
  std::vector<T> values;

  NodeImage(const glm::ivec3& size, T value)
    : count(size)
    , values(static_cast<std::size_t>(size.x) * size.y * size.z, value)
  {
  }
  std::size_t offset(const glm::ivec3& at) const
  {
    return (static_cast<std::size_t>(at.z) * this->count.y + at.y) * this->count.x + at.x;
  }
};

// Cells of nodes that hold a point outside the mask: in a voxel that is outside ...
void markVoxels(const Mask& mask, const Grid& nodes, NodeImage<char>& outside)
{
  glm::dvec3 half(0.0); // of a voxel's box, along the axes of the nodes
  glm::dmat3 step;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    step[axis] = nodes.gridVectorFromWorld(mask.grid.worldVectorFromGrid(unit));
    half += 0.5 * glm::abs(step[axis]);
  }
  half -= Touching;
  const glm::dvec3 origin = nodes.gridFromWorld(mask.grid.origin);
  std::size_t voxel = 0;
  forEachIndex(glm::ivec3(0), mask.grid.dimensions - 1, [&](const glm::ivec3& at) {
    if (!mask.inside[voxel++])
    {
      const glm::dvec3 middle = origin + step * glm::dvec3(at);
      const glm::ivec3 first(glm::max(glm::floor(middle - half), glm::dvec3(0.0)));
      const glm::ivec3 last(glm::min(glm::floor(middle + half), glm::dvec3(outside.count) - 1.0));
      forEachIndex(
        first, last, [&](const glm::ivec3& cell) { outside.values[outside.offset(cell)] = 1; });
    }
  });
}

// ... or beyond all voxels. Their box is convex: a cell is in it if its corners are.
void markBeyond(const Mask& mask, const Grid& nodes, NodeImage<char>& outside)
{
  const glm::dvec3 low(-0.5 - Touching);
  const glm::dvec3 high = glm::dvec3(mask.grid.dimensions) - 0.5 + Touching;
  const glm::ivec3 lastCell = outside.count - 1;
  forEachIndex(glm::ivec3(0), nodes.dimensions - 1, [&](const glm::ivec3& node) {
    const glm::dvec3 at = mask.grid.gridFromWorld(nodes.worldFromGrid(glm::dvec3(node)));
    if (glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high)))
    {
      forEachIndex(glm::max(node - 1, glm::ivec3(0)), glm::min(node, lastCell),
        [&](const glm::ivec3& cell) { outside.values[outside.offset(cell)] = 1; });
    }
  });
}

// Turns values that are 0 at sources and Far elsewhere into squared distances (mm) to the nearest
// source, where they are below the radius. Source: Saito and Toriwaki, "New algorithms for
// Euclidean distance transformation of an n-dimensional digitized picture with applications",
// Pattern Recognition 27 (1994).
void spread(NodeImage<float>& squared, const glm::dvec3& spacing, double radiusMm)
{
  const glm::ivec3 last = squared.count - 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Squared distances add up axis by axis, so each looks along its own rows only.
    const NodeImage<float> before = squared;
    const double steps = std::ceil(radiusMm / spacing[axis]);
    const int radius = static_cast<int>(std::min(steps, static_cast<double>(last[axis])));
    parallelFor(0, squared.count.z, 1, [&](std::int64_t begin, std::int64_t end) {
      forEachIndex({ 0, 0, static_cast<int>(begin) }, { last.x, last.y, static_cast<int>(end) - 1 },
        [&](const glm::ivec3& at) {
          float& nearest = squared.values[squared.offset(at)];
          glm::ivec3 other = at;
          const int furthest = std::min(at[axis] + radius, last[axis]);
          for (other[axis] = std::max(at[axis] - radius, 0); other[axis] <= furthest; ++other[axis])
          {
            const float away = static_cast<float>((other[axis] - at[axis]) * spacing[axis]);
            nearest = std::min(nearest, before.values[before.offset(other)] + away * away);
          }
        });
    });
  }
}

// Squared distance (mm) to the nearest node that cannot move, if below the radius.
NodeImage<float> squaredDistances(
  const NodeImage<char>& outside, const Grid& nodes, double radiusMm)
{
  NodeImage<float> squared(nodes.dimensions, Far);
  const glm::ivec3 lastNode = nodes.dimensions - 1;
  forEachIndex(glm::ivec3(0), lastNode, [&](const glm::ivec3& node) {
    bool still = glm::any(glm::equal(node, glm::ivec3(0))) || glm::any(glm::equal(node, lastNode));
    if (!still)
    {
      forEachIndex(node - 1, node,
        [&](const glm::ivec3& cell) { still = still || outside.values[outside.offset(cell)]; });
    }
    if (still)
    {
      squared.values[squared.offset(node)] = 0.0f;
    }
  });
  spread(squared, nodes.spacing, radiusMm);
  return squared;
}
}

void growMask(Mask& mask, double byMm)
{
  if (byMm <= 0.0)
  {
    return;
  }
  NodeImage<float> squared(mask.grid.dimensions, Far);
  std::transform(mask.inside.begin(), mask.inside.end(), squared.values.begin(),
    [](char inside) { return inside ? 0.0f : Far; });
  spread(squared, mask.grid.spacing, byMm);
  const auto reached = static_cast<float>(byMm * byMm);
  std::transform(squared.values.begin(), squared.values.end(), mask.inside.begin(),
    [&](float distance) { return static_cast<char>(distance <= reached); });
}

std::shared_ptr<const NodeWeights> maskWeights(
  const Grid& lattice, int samples, const Mask& mask, double featherMm)
{
  auto weights = std::make_shared<NodeWeights>();
  weights->perCell = samples + 1;
  const Grid nodes = withDimensions(lattice, (lattice.dimensions - 1) * weights->perCell + 1);
  NodeImage<char> outside(nodes.dimensions - 1, 0);
  markVoxels(mask, nodes, outside);
  markBeyond(mask, nodes, outside);
  weights->values = squaredDistances(outside, nodes, featherMm).values;
  for (float& value : weights->values)
  {
    const double fraction =
      value == 0.0f ? 0.0 : std::sqrt(static_cast<double>(value)) / std::max(featherMm, 1e-9);
    const double t = std::min(fraction, 1.0);
    value = static_cast<float>(t * t * (3.0 - 2.0 * t));
  }
  return weights;
}
}
