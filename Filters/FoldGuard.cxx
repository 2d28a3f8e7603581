// SPDX-License-Identifier: BSD-3-Clause
#include "FoldGuard.h"

#include "FieldChange.h"
#include "JacobianBound.h"
#include "Kernels.h"
#include "Parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>

namespace brainshift
{
namespace
{
constexpr vtkIdType CellsAtLeast = 64; // for a thread
// Shares of a stroke are told apart to half a percent of themselves; below the last one nothing
// of the stroke is left.
constexpr double ShareStep = 0.005;
constexpr double SmallestShare = 1e-6;
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
    : Kernel(before.kernel)
    , Mask(after.mask.get())
    , Dimensions(before.grid.dimensions)
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

  CellTaps tapsAround(const glm::ivec3& cell, float share) const
  {
    CellTaps taps;
    int tap = 0;
    for (int k = -1; k < 3; ++k)
    {
      for (int j = -1; j < 3; ++j)
      {
        for (int i = -1; i < 3; ++i, ++tap)
        {
          const glm::ivec3 at =
            glm::clamp(cell + glm::ivec3(i, j, k), glm::ivec3(0), this->Dimensions - 1) -
            this->First;
          const std::size_t point =
            (static_cast<std::size_t>(at.z) * this->Size.y + at.y) * this->Size.x + at.x;
          for (int component = 0; component < 3; ++component)
          {
            taps.component[component][tap] =
              this->From[point][component] + share * this->Change[point][component];
          }
        }
      }
    }
    return taps;
  }

  int kernel() const { return this->Kernel; }
  const NodeWeights* mask() const { return this->Mask; }

  // The mask's weights on the nodes of a cell, x fastest.
  std::vector<float> weightsIn(const glm::ivec3& cell) const
  {
    const int perCell = this->Mask->perCell;
    const glm::ivec3 count = (this->Dimensions - 1) * perCell + 1;
    std::vector<float> weights;
    for (int k = cell.z * perCell; k <= (cell.z + 1) * perCell; ++k)
    {
      for (int j = cell.y * perCell; j <= (cell.y + 1) * perCell; ++j)
      {
        const float* row = this->Mask->values.data() +
          (static_cast<std::size_t>(k) * count.y + j) * count.x + cell.x * perCell;
        weights.insert(weights.end(), row, row + perCell + 1);
      }
    }
    return weights;
  }

  // Which side of the lattice's border a cell lies at along an axis: 0 low, 1 high, -1 neither.
  int borderSide(const glm::ivec3& cell, int axis) const
  {
    return cell[axis] == 0 ? 0 : cell[axis] == this->Dimensions[axis] - 2 ? 1 : -1;
  }

private:
  int Kernel;
  const NodeWeights* Mask;
  glm::ivec3 Dimensions;
  glm::ivec3 First;
  glm::ivec3 Size;
  std::vector<glm::vec3> From;
  std::vector<glm::vec3> Change;
};

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
  return leastDeterminantOfAny(boundsOf(taps, kernel)) >= limit ||
    (cubicHolds(taps, kernel, limit) && nodesHold(nodesIn(taps, kernel, perCell), perCell, limit));
}

// With a mask there is one map, that of the nodes; beyond the lattice nothing moves.
bool maskedHold(
  const CellTaps& taps, int kernel, const std::vector<float>& weights, int perCell, float limit)
{
  const auto range = std::minmax_element(weights.begin(), weights.end());
  if (*range.second == 0.0f ||
    (*range.first == 1.0f && leastDeterminantOfAny(boundsOf(taps, kernel)) >= limit))
  {
    return true;
  }
  std::vector<glm::vec3> nodes = nodesIn(taps, kernel, perCell);
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    nodes[node] *= weights[node];
  }
  return nodesHold(nodes, perCell, limit);
}

// Both maps keep the limit in a cell, and beyond the lattice's faces and edges that it lies at.
bool cellHolds(const Way& way, const GuardedCell& cell, float share, int perCell)
{
  const CellTaps inside = way.tapsAround(cell.at, share);
  if (way.mask())
  {
    return maskedHold(inside, way.kernel(), way.weightsIn(cell.at), perCell, cell.limit);
  }
  for (int beyond = 0; beyond < 7; ++beyond) // bit a: beyond the border along axis a
  {
    CellTaps taps = inside;
    bool reached = true;
    for (int axis = 0; axis < 3 && reached; ++axis)
    {
      if (beyond >> axis & 1)
      {
        const int side = way.borderSide(cell.at, axis);
        reached = side >= 0;
        if (reached)
        {
          holdFace(taps, way.kernel(), axis, side);
        }
      }
    }
    if (reached && !bothHold(taps, way.kernel(), perCell, cell.limit))
    {
      return false;
    }
  }
  return true;
}

// Takes those cells out of a list that do not hold.
Cells takeFailing(const Way& way, Cells& cells, float share, int perCell)
{
  std::vector<char> failed(cells.size());
  const auto count = static_cast<vtkIdType>(cells.size());
  parallelFor(0, count, CellsAtLeast, [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType i = first; i < last; ++i)
    {
      failed[i] = !cellHolds(way, cells[i], share, perCell);
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

bool allHold(const Way& way, const Cells& cells, float share, int perCell)
{
  std::atomic<bool> hold{ true };
  const auto count = static_cast<vtkIdType>(cells.size());
  parallelFor(0, count, CellsAtLeast / 8, [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType i = first; i < last && hold; ++i)
    {
      if (!cellHolds(way, cells[i], share, perCell))
      {
        hold = false;
      }
    }
  });
  return hold;
}

// The largest share up to `high` at which all cells hold; they do at 0.
double largestShare(const Way& way, const Cells& cells, double high, int perCell)
{
  if (allHold(way, cells, static_cast<float>(high), perCell))
  {
    return high;
  }
  double low = 0.0;
  while (high - low > ShareStep * high && high > SmallestShare)
  {
    const double middle = 0.5 * (low + high);
    (allHold(way, cells, static_cast<float>(middle), perCell) ? low : high) = middle;
  }
  return low;
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

void FoldGuard::setBase(const Lattice& base, int samples)
{
  this->Samples = samples;
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
  const Cells folded = takeFailing(Way(still, base, moved), cells, 1.0f, samples + 1);
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

double FoldGuard::share(const Lattice& before, const Lattice& after) const
{
  const glm::ivec3& dimensions = before.grid.dimensions;
  const IndexBox changed = changedPoints(dimensions, before.displacements, after.displacements);
  if (changed.empty())
  {
    return 1.0;
  }
  const Way way(before, after, changed);
  const int perCell = this->Samples + 1;
  Cells reached;
  addCells(cellsAround(changed, dimensions), reached);
  if (!this->Folded.empty())
  {
    const auto isFolded = [&](const GuardedCell& cell) {
      return this->Folded[before.grid.offset(cell.at.x, cell.at.y, cell.at.z)] != 0;
    };
    reached.erase(std::remove_if(reached.begin(), reached.end(), isFolded), reached.end());
  }
  Cells critical;
  double share = 1.0;
  // A cell that holds at the whole stroke need not hold at a part of it, so all are asked again.
  Cells more = takeFailing(way, reached, 1.0f, perCell);
  while (!more.empty() && share > 0.0)
  {
    for (GuardedCell cell : takeFailing(way, more, 0.0f, perCell))
    {
      cell.limit = ProvedAgainLimit;
      more.push_back(cell);
    }
    critical.insert(critical.end(), more.begin(), more.end());
    share = largestShare(way, critical, share, perCell);
    more = takeFailing(way, reached, static_cast<float>(share), perCell);
  }
  return share;
}

Lattice between(const Lattice& before, const Lattice& after, double share)
{
  Lattice lattice = after;
  const auto part = static_cast<float>(share);
  for (std::size_t point = 0; point < lattice.displacements.size(); ++point)
  {
    const glm::vec3& from = before.displacements[point];
    lattice.displacements[point] = from + part * (after.displacements[point] - from);
  }
  return lattice;
}
}
