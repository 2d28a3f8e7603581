// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/CellProof.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/Kernels.h"

#include <algorithm>

namespace brainshift
{
namespace
{
// Displacements on the (perCell + 1)^3 nodes of a cell, x fastest.
std::vector<glm::vec3> nodesIn(const CellTaps& taps, int kernel, int perCell)
{
  const int side = perCell + 1;
  std::vector<glm::vec3> values(64);
  for (int tap = 0; tap < 64; ++tap)
  {
    values[tap] = { taps.component[0][tap], taps.component[1][tap], taps.component[2][tap] };
  }
  // Refines the first axis and makes it the last one, three times over.
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t rows = values.size() / 4;
    std::vector<glm::vec3> refined(rows * side);
    for (int node = 0; node < side; ++node)
    {
      const glm::vec4 weight = kernelWeights(kernel, static_cast<float>(node) / perCell);
      for (std::size_t row = 0; row < rows; ++row)
      {
        const glm::vec3* tap = &values[4 * row];
        refined[node * rows + row] =
          weight[0] * tap[0] + weight[1] * tap[1] + weight[2] * tap[2] + weight[3] * tap[3];
      }
    }
    values.swap(refined);
  }
  return values;
}

bool nodesHold(const std::vector<glm::vec3>& nodes, int perCell, float limit)
{
  const int side = perCell + 1;
  for (int k = 0; k < perCell; ++k)
  {
    for (int j = 0; j < perCell; ++j)
    {
      for (int i = 0; i < perCell; ++i)
      {
        std::array<glm::vec3, 8> corners;
        for (int corner = 0; corner < 8; ++corner)
        {
          corners[corner] =
            nodes[((k + (corner >> 2)) * side + j + (corner >> 1 & 1)) * side + i + (corner & 1)];
        }
        if (!trilinearHolds(corners, perCell, limit))
        {
          return false;
        }
      }
    }
  }
  return true;
}

// Both maps keep the limit in one cell.
bool bothHold(const CellTaps& taps, int kernel, int perCell, float limit)
{
  return leastDeterminant(boundsOf(taps, kernel)) >= limit ||
    (cubicHolds(taps, kernel, limit) && nodesHold(nodesIn(taps, kernel, perCell), perCell, limit));
}

// The mask's weights on the nodes of a cell, x fastest.
std::vector<float> weightsIn(
  const NodeWeights& mask, const glm::ivec3& dimensions, const glm::ivec3& cell)
{
  const int perCell = mask.perCell;
  const glm::ivec3 count = (dimensions - 1) * perCell + 1;
  std::vector<float> weights;
  weights.reserve(static_cast<std::size_t>(perCell + 1) * (perCell + 1) * (perCell + 1));
  for (int k = cell.z * perCell; k <= (cell.z + 1) * perCell; ++k)
  {
    for (int j = cell.y * perCell; j <= (cell.y + 1) * perCell; ++j)
    {
      const float* row = mask.values.data() +
        (static_cast<std::size_t>(k) * count.y + j) * count.x + cell.x * perCell;
      weights.insert(weights.end(), row, row + perCell + 1);
    }
  }
  return weights;
}

WeightRange rangeOf(const std::vector<float>& weights, int perCell)
{
  const auto [least, greatest] = std::minmax_element(weights.begin(), weights.end());
  WeightRange range{ *least, *greatest };
  const int side = perCell + 1;
  const int stride[3] = { 1, side, side * side };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int node = 0; node < static_cast<int>(weights.size()); ++node)
    {
      if (node / stride[axis] % side < perCell)
      {
        const float slope = perCell * (weights[node + stride[axis]] - weights[node]);
        range.leastSlope[axis] = std::min(range.leastSlope[axis], slope);
        range.greatestSlope[axis] = std::max(range.greatestSlope[axis], slope);
      }
    }
  }
  return range;
}
}

CellProof::CellProof(const Lattice& lattice, int samples)
  : Points(lattice.grid)
  , Kernel(lattice.kernel)
  , PerCell(samples + 1)
  , Mask(lattice.mask)
{
  if (!this->Mask)
  {
    return;
  }
  this->Ranges.resize(this->Points.count());
  const glm::ivec3& dimensions = this->Points.dimensions;
  parallelFor(0, dimensions.z - 1, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
    {
      for (int j = 0; j < dimensions.y - 1; ++j)
      {
        for (int i = 0; i < dimensions.x - 1; ++i)
        {
          this->Ranges[this->Points.offset(i, j, k)] =
            rangeOf(weightsIn(*this->Mask, dimensions, { i, j, k }), this->PerCell);
        }
      }
    }
  });
}

bool CellProof::isFor(const Lattice& lattice, int samples) const
{
  return this->Points == lattice.grid && this->Kernel == lattice.kernel &&
    this->PerCell == samples + 1 && sameMask(this->Mask, lattice.mask);
}

// Holds the displacements at the border along the axes named by `beyond` (bit a: axis a). False if
// the cell does not lie at all of these.
bool CellProof::isReached(int beyond, const glm::ivec3& cell, CellTaps& taps) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool low = cell[axis] == 0;
    if (beyond >> axis & 1)
    {
      if (!low && cell[axis] != this->Points.dimensions[axis] - 2)
      {
        return false;
      }
      holdFace(taps, this->Kernel, axis, low ? 0 : 1);
    }
  }
  return true;
}

bool CellProof::holds(const CellTaps& taps, const glm::ivec3& cell, float limit) const
{
  if (this->Mask)
  {
    return this->maskedHolds(taps, cell, limit);
  }
  for (int beyond = 0; beyond < 7; ++beyond)
  {
    CellTaps held = taps;
    if (this->isReached(beyond, cell, held) && !bothHold(held, this->Kernel, this->PerCell, limit))
    {
      return false;
    }
  }
  return true;
}

// Beyond the lattice nothing moves.
bool CellProof::maskedHolds(const CellTaps& taps, const glm::ivec3& cell, float limit) const
{
  const WeightRange& range = this->Ranges[this->Points.offset(cell.x, cell.y, cell.z)];
  if (range.greatest == 0.0f ||
    leastDeterminant(maskedBoundsOf(taps, this->Kernel, range)) >= limit)
  {
    return true;
  }
  std::vector<glm::vec3> nodes = nodesIn(taps, this->Kernel, this->PerCell);
  const std::vector<float> weights = weightsIn(*this->Mask, this->Points.dimensions, cell);
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    nodes[node] *= weights[node];
  }
  return nodesHold(nodes, this->PerCell, limit);
}
}
