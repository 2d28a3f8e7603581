// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/FoldGuard.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/FieldChange.h"
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

constexpr std::int64_t CellsAtLeast = 64; // for a thread
// Fractions of a stroke are found to half a percent of themselves; below the last one nothing
// of the stroke is left.
constexpr double FractionStep = 0.005;
constexpr double SmallestFraction = 1e-6;
// Above the limit by more than single precision can lose. What an earlier stroke brought to the
// first one may not be proved for it again, rounded otherwise; the second is left for that.
constexpr float ProvedLimit = SmallestGuardedJacobian + 2e-4f;
constexpr float ProvedAgainLimit = SmallestGuardedJacobian + 1e-4f;

struct GuardedCell
{
  glm::ivec3 at;
  float limit = ProvedLimit;
};
using Cells = std::vector<GuardedCell>;

// The way from one lattice to another, in lattice cells, for all that depends on a box of points.
class Way
{
public:
  Way(const Lattice& before, const Lattice& after, const IndexBox& changed)
    : Dimensions(before.grid.dimensions)
    , First(glm::max(changed.first - 3, glm::ivec3(0)))
    , Size(glm::min(changed.last + 3, before.grid.dimensions - 1) - First + 1)
  {
    for (int k = 0; k < this->Size.z; ++k)
    {
      for (int j = 0; j < this->Size.y; ++j)
      {
        for (int i = 0; i < this->Size.x; ++i)
        {
          const glm::ivec3 at = this->First + glm::ivec3(i, j, k);
          const std::size_t point = before.grid.offset(at.x, at.y, at.z);
          const glm::dvec3 from(before.displacements[point]);
          const glm::dvec3 to(after.displacements[point]);
          this->From.emplace_back(before.grid.gridVectorFromWorld(from));
          this->Change.emplace_back(before.grid.gridVectorFromWorld(to - from));
        }
      }
    }
  }

  CellTaps tapsAround(const glm::ivec3& cell, double part) const
  {
    const auto fraction = static_cast<float>(part);
    CellTaps taps;
    int tap = 0;
    for (int k = -1; k < 3; ++k)
    {
      for (int j = -1; j < 3; ++j)
      {
        for (int i = -1; i < 3; ++i, ++tap)
        {
          const std::size_t point = this->pointOf(cell + glm::ivec3(i, j, k));
          for (int component = 0; component < 3; ++component)
          {
            taps.component[component][tap] =
              this->From[point][component] + fraction * this->Change[point][component];
          }
        }
      }
    }
    return taps;
  }

  // Whether any control point around a cell differs.
  bool changes(const glm::ivec3& cell) const
  {
    for (int tap = 0; tap < 64; ++tap)
    {
      const glm::ivec3 at = cell + glm::ivec3(tap & 3, tap >> 2 & 3, tap >> 4) - 1;
      if (this->Change[this->pointOf(at)] != glm::vec3(0.0f))
      {
        return true;
      }
    }
    return false;
  }

private:
  std::size_t pointOf(const glm::ivec3& index) const
  {
    const glm::ivec3 at = glm::clamp(index, glm::ivec3(0), this->Dimensions - 1) - this->First;
    return (static_cast<std::size_t>(at.z) * this->Size.y + at.y) * this->Size.x + at.x;
  }

  glm::ivec3 Dimensions;
  glm::ivec3 First;
  glm::ivec3 Size;
  std::vector<glm::vec3> From;
  std::vector<glm::vec3> Change;
};

// Takes those cells out of a list that do not hold.
Cells takeFailing(const CellProof& proof, const Way& way, Cells& cells, double fraction)
{
  std::vector<char> failed(cells.size());
  const auto count = static_cast<std::int64_t>(cells.size());
  parallelFor(0, count, CellsAtLeast, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      failed[i] = !proof.holds(way.tapsAround(cells[i].at, fraction), cells[i].at, cells[i].limit);
    }
  });
  Cells kept;
  Cells failing;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    (failed[i] ? failing : kept).push_back(cells[i]);
  }
  cells.swap(kept);
  return failing;
}

// The largest fraction at which one cell holds. It does at 0, and not at `high`.
double fractionOf(const CellProof& proof, const Way& way, const GuardedCell& cell, double high)
{
  double low = 0.0;
  while (high - low > FractionStep * high && high > SmallestFraction)
  {
    const double middle = 0.5 * (low + high);
    (proof.holds(way.tapsAround(cell.at, middle), cell.at, cell.limit) ? low : high) = middle;
  }
  return low;
}

// The largest fraction up to `high` at which all cells hold; they do at 0. Lowered by one failing
// cell after the other: each spares about half of those that are left.
double largestFraction(const CellProof& proof, const Way& way, const Cells& cells, double high)
{
  double fraction = high;
  while (fraction > 0.0)
  {
    Cells open = cells;
    Cells failing = takeFailing(proof, way, open, fraction);
    if (failing.empty())
    {
      break;
    }
    for (; !failing.empty() && fraction > 0.0; failing = takeFailing(proof, way, open, fraction))
    {
      fraction = fractionOf(proof, way, failing[failing.size() / 2], fraction);
      open = failing;
    }
  }
  return fraction;
}

IndexBox cellsAround(const IndexBox& points, const glm::ivec3& dimensions)
{
  return { glm::max(points.first - 2, glm::ivec3(0)), glm::min(points.last + 1, dimensions - 2) };
}

void addCells(const IndexBox& box, Cells& cells)
{
  glm::ivec3 cell;
  for (cell.z = box.first.z; cell.z <= box.last.z; ++cell.z)
  {
    for (cell.y = box.first.y; cell.y <= box.last.y; ++cell.y)
    {
      for (cell.x = box.first.x; cell.x <= box.last.x; ++cell.x)
      {
        cells.push_back({ cell });
      }
    }
  }
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

void FoldGuard::setBase(const Lattice& base, int samples)
{
  if (!this->Proof.isFor(base, samples))
  {
    this->Proof = CellProof(base, samples);
  }
  this->Folded.clear();
  this->FoldedCount = 0;
  const glm::ivec3& dimensions = base.grid.dimensions;
  const Lattice still = makeLattice(base.grid, base.kernel);
  const IndexBox moved = changedPoints(dimensions, still.displacements, base.displacements);
  if (moved.empty())
  {
    return;
  }
  Cells cells;
  addCells(cellsAround(moved, dimensions), cells);
  const Cells folded = takeFailing(this->Proof, Way(still, base, moved), cells, 1.0);
  if (folded.empty())
  {
    return;
  }
  this->Folded.assign(base.grid.count(), 0);
  this->FoldedCount = static_cast<int>(folded.size());
  for (const GuardedCell& cell : folded)
  {
    this->Folded[base.grid.offset(cell.at.x, cell.at.y, cell.at.z)] = 1;
  }
}

double FoldGuard::fraction(const Lattice& before, const Lattice& after) const
{
  const glm::ivec3& dimensions = before.grid.dimensions;
  const IndexBox changed = changedPoints(dimensions, before.displacements, after.displacements);
  if (changed.empty())
  {
    return 1.0;
  }
  const Way way(before, after, changed);
  Cells reached;
  addCells(cellsAround(changed, dimensions), reached);
  const auto isNotAsked = [&](const GuardedCell& cell) {
    return !way.changes(cell.at) ||
      (!this->Folded.empty() && this->Folded[before.grid.offset(cell.at.x, cell.at.y, cell.at.z)]);
  };
  reached.erase(std::remove_if(reached.begin(), reached.end(), isNotAsked), reached.end());
  Cells critical;
  double fraction = 1.0;
  // A cell that holds at the whole stroke need not hold at a part of it, so all are asked again.
  Cells more = takeFailing(this->Proof, way, reached, 1.0);
  while (!more.empty() && fraction > 0.0)
  {
    for (GuardedCell cell : takeFailing(this->Proof, way, more, 0.0))
    {
      cell.limit = ProvedAgainLimit;
      more.push_back(cell);
    }
    critical.insert(critical.end(), more.begin(), more.end());
    fraction = largestFraction(this->Proof, way, critical, fraction);
    more = takeFailing(this->Proof, way, reached, fraction);
  }
  return fraction;
}

Lattice between(const Lattice& before, const Lattice& after, double fraction)
{
  if (fraction == 0.0)
  {
    return before; // `after` may be so far away that it is no number
  }
  Lattice lattice = after;
  const auto part = static_cast<float>(fraction);
  for (std::size_t point = 0; point < lattice.displacements.size(); ++point)
  {
    const glm::vec3& from = before.displacements[point];
    lattice.displacements[point] = from + part * (after.displacements[point] - from);
  }
  return lattice;
}
}
