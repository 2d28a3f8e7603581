// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/LatticeExtremes.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/JacobianBound.h"
#include "Filters/Deformation/OffsetField.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
// Displacements (lattice cells) of the control points around a cell; false if none moves.
bool tapsAround(const Lattice& lattice, const glm::ivec3& cell, CellTapsOf<double>& taps)
{
  bool moves = false;
  for (int tap = 0; tap < 64; ++tap)
  {
    const glm::ivec3 at = glm::clamp(cell + glm::ivec3(tap & 3, tap >> 2 & 3, tap >> 4) - 1,
      glm::ivec3(0), lattice.grid.dimensions - 1);
    const glm::vec3& displacement = lattice.displacements[lattice.grid.offset(at.x, at.y, at.z)];
    moves = moves || displacement != glm::vec3(0.0f);
    const glm::dvec3 inCells = lattice.grid.gridVectorFromWorld(glm::dvec3(displacement));
    for (int component = 0; component < 3; ++component)
    {
      taps.component[component][tap] = inCells[component];
    }
  }
  return moves;
}

// Displacements (lattice cells) of the nodes around a cell of nodes; false if none moves.
bool nodesAround(const NodeField& field, const glm::ivec3& low, std::array<glm::dvec3, 8>& corners)
{
  const glm::ivec3& count = field.nodes.count;
  bool moves = false;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 at = low + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::vec3& value =
      field.values[(static_cast<std::size_t>(at.z) * count.y + at.y) * count.x + at.x];
    moves = moves || value != glm::vec3(0.0f);
    corners[corner] = value;
  }
  return moves;
}

// The index along each axis of the cell with that number, x fastest.
glm::ivec3 cellOf(std::int64_t number, const glm::ivec3& cells)
{
  const std::int64_t row = number / cells.x;
  return glm::ivec3(number % cells.x, row % cells.y, row / cells.y);
}

std::int64_t countOf(const glm::ivec3& cells)
{
  return static_cast<std::int64_t>(cells.x) * cells.y * cells.z;
}
constexpr std::size_t MostHalvings = 20000; // of all cells together: some 0.1 s
constexpr std::int64_t CellsInPiece = 512;  // for a thread
constexpr std::size_t PartsAtOnce = 256;    // halved before the lowest ones are chosen anew
constexpr std::int64_t PartsForThread = 32;

using Part = std::unique_ptr<DeterminantPart>;

// The cell of a number; null if nothing moves there and the determinant is 1.
using PartOfCell = std::function<Part(std::int64_t)>;

bool isAbove(const Part& a, const Part& b)
{
  return a->least > b->least; // for a heap with the lowest on top
}

// The limit below which a part must be halved.
double enoughFor(double found)
{
  return found - DeterminantTolerance * std::max(1.0, std::abs(found));
}

// of(first, last) for each piece of the cells, in order: equal on any number of threads.
template <typename Result, typename Of>
std::vector<Result> ofPieces(std::int64_t count, const Of& of)
{
  std::vector<Result> results((count + CellsInPiece - 1) / CellsInPiece);
  parallelFor(
    0, static_cast<std::int64_t>(results.size()), 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t piece = first; piece < last; ++piece)
      {
        results[piece] = of(piece * CellsInPiece, std::min((piece + 1) * CellsInPiece, count));
      }
    });
  return results;
}

double leastFound(std::int64_t count, const PartOfCell& partOf)
{
  const std::vector<double> found =
    ofPieces<double>(count, [&](std::int64_t first, std::int64_t last) {
      double least = std::numeric_limits<double>::max();
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        const Part part = partOf(cell);
        least = std::min(least, part ? part->found : 1.0);
      }
      return least;
    });
  return *std::min_element(found.begin(), found.end());
}

// What is known of a cell.
struct CellBound
{
  double least = 0.0;
  std::int64_t cell = 0;
};

// The cells that are worth halving, and the lowest bound of all others.
struct Bounds
{
  std::vector<CellBound> cells;
  double others = std::numeric_limits<double>::max();
};

Bounds boundsBelow(double limit, std::int64_t count, const PartOfCell& partOf)
{
  const auto pieces = ofPieces<Bounds>(count, [&](std::int64_t first, std::int64_t last) {
    Bounds bounds;
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      const Part part = partOf(cell);
      const double least = part ? part->least : 1.0;
      if (least < limit)
      {
        bounds.cells.push_back({ least, cell });
      }
      else
      {
        bounds.others = std::min(bounds.others, least);
      }
    }
    return bounds;
  });
  Bounds all;
  for (const Bounds& piece : pieces)
  {
    all.cells.insert(all.cells.end(), piece.cells.begin(), piece.cells.end());
    all.others = std::min(all.others, piece.others);
  }
  if (all.cells.size() > MostHalvings)
  {
    const auto first = all.cells.begin() + MostHalvings; // that no halving would reach
    std::nth_element(all.cells.begin(), first, all.cells.end(),
      [](const CellBound& a, const CellBound& b) { return a.least < b.least; });
    all.others = std::min(all.others, first->least);
    all.cells.erase(first, all.cells.end());
  }
  return all;
}

// Takes the lowest parts below a limit out of a heap, halves them and returns all halves.
std::vector<Part> halveLowest(std::vector<Part>& heap, double limit)
{
  std::vector<Part> parts;
  while (!heap.empty() && heap.front()->least < limit && parts.size() < PartsAtOnce)
  {
    std::pop_heap(heap.begin(), heap.end(), isAbove);
    parts.push_back(std::move(heap.back()));
    heap.pop_back();
  }
  const auto count = static_cast<std::int64_t>(parts.size());
  parts.resize(2 * parts.size());
  parallelFor(0, count, PartsForThread, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      parts[count + i] = parts[i]->halve();
    }
  });
  return parts;
}

// A number that no determinant in the cells is below.
double leastDeterminantOf(std::int64_t count, const PartOfCell& partOf)
{
  double found = leastFound(count, partOf);
  const Bounds bounds = boundsBelow(enoughFor(found), count, partOf);
  std::vector<Part> heap;
  heap.reserve(bounds.cells.size());
  for (const CellBound& bound : bounds.cells)
  {
    heap.push_back(partOf(bound.cell));
  }
  std::make_heap(heap.begin(), heap.end(), isAbove);
  for (std::size_t halvings = 0; halvings < MostHalvings;)
  {
    std::vector<Part> halves = halveLowest(heap, enoughFor(found));
    if (halves.empty())
    {
      break;
    }
    halvings += halves.size() / 2;
    for (Part& half : halves)
    {
      found = std::min(found, half->found);
      heap.push_back(std::move(half));
      std::push_heap(heap.begin(), heap.end(), isAbove);
    }
  }
  return heap.empty() ? bounds.others : std::min(bounds.others, heap.front()->least);
}
}

double maximumDisplacement(const Lattice& lattice)
{
  float largest = 0.0f;
  if (lattice.mask)
  {
    for (const glm::vec3& inCells : refine(lattice, lattice.mask->perCell - 1).values)
    {
      const glm::vec3 mm(lattice.grid.spacing * glm::dvec3(inCells)); // axes do not matter
      largest = std::max(largest, glm::dot(mm, mm));
    }
    return std::sqrt(static_cast<double>(largest));
  }
  for (const glm::vec3& displacement : lattice.displacements)
  {
    largest = std::max(largest, glm::dot(displacement, displacement));
  }
  return std::sqrt(static_cast<double>(largest));
}

double minimumJacobian(const Lattice& lattice)
{
  if (lattice.mask)
  {
    const NodeField field = refine(lattice, lattice.mask->perCell - 1);
    const glm::ivec3 cells = field.nodes.count - 1;
    return leastDeterminantOf(countOf(cells), [&](std::int64_t number) {
      std::array<glm::dvec3, 8> corners;
      return nodesAround(field, cellOf(number, cells), corners)
        ? trilinearPart(corners, field.nodes.perCell)
        : nullptr;
    });
  }
  const glm::ivec3 cells = lattice.grid.dimensions - 1;
  return leastDeterminantOf(countOf(cells), [&](std::int64_t number) {
    CellTapsOf<double> taps;
    return tapsAround(lattice, cellOf(number, cells), taps) ? cubicPart(taps, lattice.kernel)
                                                            : nullptr;
  });
}
}
