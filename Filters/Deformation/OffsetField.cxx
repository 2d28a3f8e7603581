// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/OffsetField.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/Inversion.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr std::int64_t NodesAtLeast = 65536; // for a thread

std::size_t nodeOffset(const glm::ivec3& count, int i, int j, int k)
{
  return (static_cast<std::size_t>(k) * count.y + j) * count.x + i;
}

// The cell of nodes a position lies in, and how far along it.
struct NodeCell
{
  glm::ivec3 low;
  glm::ivec3 high;
  glm::vec3 within;
  glm::vec3 inside; // 1 along an axis on which the position lies within the nodes, else 0

  NodeCell(const FieldNodes& nodes, const glm::vec3& lattice)
  {
    const glm::vec3 anywhere =
      (lattice - glm::vec3(nodes.first)) * static_cast<float>(nodes.perCell);
    // In this order, a number that is none (NaN) becomes 0, not a cell beyond the nodes.
    const glm::vec3 node =
      glm::min(glm::max(glm::vec3(0.0f), anywhere), glm::vec3(nodes.count - 1));
    this->inside = glm::vec3(glm::equal(anywhere, node));
    this->low = glm::min(glm::ivec3(node), glm::max(nodes.count - 2, glm::ivec3(0)));
    this->high = glm::min(this->low + 1, nodes.count - 1);
    this->within = node - glm::vec3(this->low);
  }

  glm::vec3 corner(const NodeField& field, int index) const
  {
    return field.values[nodeOffset(field.nodes.count, index & 1 ? this->high.x : this->low.x,
      index & 2 ? this->high.y : this->low.y, index & 4 ? this->high.z : this->low.z)];
  }
};

// The kernel's weights at each of the perCell positions in a cell.
std::vector<glm::vec4> weightsInCell(int kernel, int perCell)
{
  std::vector<glm::vec4> weights(perCell);
  for (int sample = 0; sample < perCell; ++sample)
  {
    weights[sample] = kernelWeights(kernel, static_cast<float>(sample) / perCell);
  }
  return weights;
}

// Refines one axis: `from` has `points` rows of `stride` consecutive values in each of `blocks`
// blocks; the result has (points - 1) * perCell + 1 rows in each. `weights`: of the perCell
// positions in a cell.
std::vector<glm::vec3> refineAxis(const std::vector<glm::vec3>& from, int points,
  std::size_t stride, std::size_t blocks, const std::vector<glm::vec4>& weights)
{
  const int perCell = static_cast<int>(weights.size());
  const int rows = (points - 1) * perCell + 1;
  std::vector<glm::vec3> to(blocks * rows * stride);
  const std::int64_t grain = NodesAtLeast / static_cast<std::int64_t>(stride);
  parallelFor(
    0, static_cast<std::int64_t>(blocks) * rows, grain, [&](std::int64_t first, std::int64_t end) {
      for (std::int64_t outRow = first; outRow < end; ++outRow)
      {
        const std::size_t block = outRow / rows;
        const int row = static_cast<int>(outRow % rows);
        const int cell = row / perCell;
        const glm::vec4& weight = weights[row % perCell];
        const glm::vec3* tap[4];
        for (int i = 0; i < 4; ++i)
        {
          tap[i] = &from[(block * points + std::clamp(cell - 1 + i, 0, points - 1)) * stride];
        }
        glm::vec3* out = &to[outRow * stride];
        for (std::size_t s = 0; s < stride; ++s)
        {
          out[s] = weight[0] * tap[0][s] + weight[1] * tap[1][s] + weight[2] * tap[2][s] +
            weight[3] * tap[3][s];
        }
      }
    });
  return to;
}

// How many whole cells tissue may leave the lattice by, below and above, along one axis.
struct Overhang
{
  int below = 0;
  int above = 0;
};

Overhang overhangAlong(const Grid& grid, const std::vector<glm::vec3>& inCells, int axis)
{
  // Per layer of control points across the axis: range of the displacement along it.
  const int layers = grid.dimensions[axis];
  std::vector<float> low(layers, 0.0f);
  std::vector<float> high(layers, 0.0f);
  std::size_t point = 0;
  for (int k = 0; k < grid.dimensions.z; ++k)
  {
    for (int j = 0; j < grid.dimensions.y; ++j)
    {
      for (int i = 0; i < grid.dimensions.x; ++i, ++point)
      {
        const int layer = axis == 0 ? i : axis == 1 ? j : k;
        low[layer] = std::min(low[layer], inCells[point][axis]);
        high[layer] = std::max(high[layer], inCells[point][axis]);
      }
    }
  }
  float lowest = 0.0f;
  float highest = static_cast<float>(layers - 1);
  for (int cell = 0; cell < layers - 1; ++cell)
  {
    const int from = std::max(cell - 1, 0);
    const int to = std::min(cell + 2, layers - 1) + 1;
    const float least = *std::min_element(low.begin() + from, low.begin() + to);
    const float most = *std::max_element(high.begin() + from, high.begin() + to);
    const float middle = 0.5f * (least + most);
    const float half = 0.5f * (most - least) * KernelOvershoot;
    lowest = std::min(lowest, static_cast<float>(cell) + middle - half);
    highest = std::max(highest, static_cast<float>(cell + 1) + middle + half);
  }
  constexpr auto farthest = static_cast<float>(2.0 * LongestDisplacementCells); // fits an integer
  Overhang overhang;
  overhang.below = static_cast<int>(std::ceil(std::min(-lowest, farthest)));
  overhang.above =
    static_cast<int>(std::ceil(std::min(highest - static_cast<float>(layers - 1), farthest)));
  return overhang;
}
}

glm::vec3 NodeField::displacement(const glm::vec3& lattice) const
{
  const NodeCell cell(this->nodes, lattice);
  glm::vec3 face[2];
  for (int z = 0; z < 2; ++z)
  {
    const glm::vec3 near =
      glm::mix(cell.corner(*this, 4 * z), cell.corner(*this, 4 * z + 1), cell.within.x);
    const glm::vec3 far =
      glm::mix(cell.corner(*this, 4 * z + 2), cell.corner(*this, 4 * z + 3), cell.within.x);
    face[z] = glm::mix(near, far, cell.within.y);
  }
  return glm::mix(face[0], face[1], cell.within.z);
}

void NodeField::map(const glm::vec3& lattice, glm::vec3& displacement, glm::mat3& jacobian) const
{
  const NodeCell cell(this->nodes, lattice);
  glm::vec3 c[8];
  for (int index = 0; index < 8; ++index)
  {
    c[index] = cell.corner(*this, index);
  }
  const glm::vec3& w = cell.within;
  displacement = glm::mix(glm::mix(glm::mix(c[0], c[1], w.x), glm::mix(c[2], c[3], w.x), w.y),
    glm::mix(glm::mix(c[4], c[5], w.x), glm::mix(c[6], c[7], w.x), w.y), w.z);
  const glm::vec3 alongX =
    glm::mix(glm::mix(c[1] - c[0], c[3] - c[2], w.y), glm::mix(c[5] - c[4], c[7] - c[6], w.y), w.z);
  const glm::vec3 alongY =
    glm::mix(glm::mix(c[2] - c[0], c[3] - c[1], w.x), glm::mix(c[6] - c[4], c[7] - c[5], w.x), w.z);
  const glm::vec3 alongZ =
    glm::mix(glm::mix(c[4] - c[0], c[5] - c[1], w.x), glm::mix(c[6] - c[2], c[7] - c[3], w.x), w.y);
  const glm::vec3 scale = cell.inside * static_cast<float>(this->nodes.perCell);
  jacobian = glm::mat3(1.0f) + glm::mat3(alongX * scale.x, alongY * scale.y, alongZ * scale.z);
}

FieldNodes forwardNodes(const Grid& lattice, int samples)
{
  FieldNodes nodes;
  nodes.perCell = samples + 1;
  nodes.count = (lattice.dimensions - 1) * nodes.perCell + 1;
  return nodes;
}

FieldNodes backwardNodes(const Grid& lattice, const std::vector<glm::vec3>& inCells, int samples)
{
  FieldNodes nodes = forwardNodes(lattice, samples);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Overhang overhang = overhangAlong(lattice, inCells, axis);
    nodes.first[axis] = -overhang.below;
    nodes.count[axis] += (overhang.below + overhang.above) * nodes.perCell;
  }
  return nodes;
}

NodeField refine(const Grid& grid, int kernel, const std::vector<glm::vec3>& inCells, int samples)
{
  NodeField field;
  field.nodes = forwardNodes(grid, samples);
  const std::vector<glm::vec4> weights = weightsInCell(kernel, field.nodes.perCell);
  const glm::ivec3& points = grid.dimensions;
  const glm::ivec3& count = field.nodes.count;
  const std::size_t rowsYZ = static_cast<std::size_t>(points.y) * points.z;
  std::vector<glm::vec3> alongX = refineAxis(inCells, points.x, 1, rowsYZ, weights);
  std::vector<glm::vec3> alongXY = refineAxis(alongX, points.y, count.x, points.z, weights);
  field.values =
    refineAxis(alongXY, points.z, static_cast<std::size_t>(count.x) * count.y, 1, weights);
  return field;
}

NodeField refine(const Lattice& lattice, int samples)
{
  NodeField field = refine(lattice.grid, lattice.kernel, displacementsInCells(lattice), samples);
  for (std::size_t node = 0; lattice.mask && node < field.values.size(); ++node)
  {
    field.values[node] *= lattice.mask->values[node];
  }
  return field;
}

NodeField invert(const NodeField& forward, const FieldNodes& nodes, Inverse inverse)
{
  NodeField field;
  field.nodes = nodes;
  field.values.resize(static_cast<std::size_t>(nodes.count.x) * nodes.count.y * nodes.count.z);
  parallelFor(0, nodes.count.z, 1, [&](std::int64_t first, std::int64_t end) {
    Inversion<NodeField> inversion{ forward };
    for (int k = static_cast<int>(first); k < end; ++k)
    {
      for (int j = 0; j < nodes.count.y; ++j)
      {
        for (int i = 0; i < nodes.count.x; ++i)
        {
          const glm::vec3 deformed = nodes.latticeFromNode(glm::vec3(i, j, k));
          const glm::vec3 displacement = forward.displacement(deformed);
          const bool known = inverse == Inverse::Negated || displacement == glm::vec3(0.0f);
          field.values[nodeOffset(nodes.count, i, j, k)] =
            known ? -displacement : inversion.inverseOffset(deformed, -displacement);
        }
      }
    }
  });
  return field;
}

NodeField offsetField(const Lattice& lattice, int samples, Inverse inverse)
{
  const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
  const NodeField forward = refine(lattice, samples);
  return invert(forward, backwardNodes(lattice.grid, inCells, samples), inverse);
}
}
