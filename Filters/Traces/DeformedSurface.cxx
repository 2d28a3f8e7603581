// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Traces/DeformedSurface.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/PointMap.h"

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
constexpr vtkIdType PointsAtLeast = 512; // for a thread

// Cells of a lattice: between control points.
Grid cellsOf(const Grid& lattice)
{
  Grid cells = lattice;
  cells.dimensions = lattice.dimensions - 1;
  return cells;
}

// Cells whose displacement, anywhere in them, may differ between two lattices on one grid.
std::vector<char> changedCells(const Lattice& before, const Lattice& after)
{
  const Grid cells = cellsOf(after.grid);
  std::vector<char> changed(cells.count(), 0);
  std::size_t index = 0;
  forEachIndex(glm::ivec3(0), after.grid.dimensions - 1, [&](const glm::ivec3& point) {
    if (before.displacements[index] != after.displacements[index])
    {
      // A cell's kernel spans the control points from one before it to two after it.
      forEachIndex(glm::max(point - 2, glm::ivec3(0)), glm::min(point + 1, cells.dimensions - 1),
        [&](const glm::ivec3& at) { changed[cells.offset(at.x, at.y, at.z)] = 1; });
    }
    ++index;
  });
  return changed;
}
}

DeformedSurface::DeformedSurface(TriangleMesh rest)
  : Rest(std::move(rest))
  , Deformed(this->Rest.points)
  , Tree(this->Rest)
{
}

void DeformedSurface::layOn(const Grid& lattice)
{
  const Grid cells = cellsOf(lattice);
  this->CellOf.resize(this->Rest.points.size());
  for (std::size_t point = 0; point < this->CellOf.size(); ++point)
  {
    const glm::ivec3 cell =
      glm::clamp(glm::ivec3(glm::floor(lattice.gridFromWorld(this->Rest.points[point]))),
        glm::ivec3(0), cells.dimensions - 1);
    this->CellOf[point] = static_cast<int>(cells.offset(cell.x, cell.y, cell.z));
  }
  this->Deformed = this->Rest.points;
  this->FitAll = true;
}

void DeformedSurface::follow(
  const Lattice& lattice, const std::function<bool(const glm::dvec3&)>& isRemoved)
{
  if (this->Followed.grid != lattice.grid || this->Followed.kernel != lattice.kernel ||
    !sameMask(this->Followed.mask, lattice.mask))
  {
    this->layOn(lattice.grid);
    this->Followed = makeLattice(lattice.grid, lattice.kernel);
  }
  const std::vector<char> changed = changedCells(this->Followed, lattice);
  std::vector<char> moved(this->CellOf.size());
  std::transform(this->CellOf.begin(), this->CellOf.end(), moved.begin(),
    [&](int cell) { return changed[cell]; });
  this->Mapped = std::count(moved.begin(), moved.end(), char(1));
  const PointMap map(lattice);
  const auto count = static_cast<vtkIdType>(moved.size());
  parallelFor(0, count, PointsAtLeast, [&](vtkIdType first, vtkIdType end) {
    for (vtkIdType i = first; i < end; ++i)
    {
      if (moved[i])
      {
        this->Deformed[i] = map.deformedFromRest(this->Rest.points[i]);
      }
    }
  });
  // After a cavity was looked at, or points were put back, nothing of the tree is known.
  const bool fitAll = isRemoved || this->FitAll;
  this->FitAll = static_cast<bool>(isRemoved);
  std::vector<char> kept;
  if (isRemoved)
  {
    kept.resize(this->Deformed.size());
    std::transform(this->Deformed.begin(), this->Deformed.end(), kept.begin(),
      [&](const glm::dvec3& point) { return !isRemoved(point); });
  }
  this->Tree.fit(this->Deformed, fitAll ? std::vector<char>() : moved, kept);
  this->Followed = lattice;
}
}
