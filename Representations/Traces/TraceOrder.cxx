// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Traces/TraceOrder.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>

namespace brainshift
{
namespace
{
constexpr int Bits = 5; // 2^5 cells a side
constexpr int CellsASide = 1 << Bits;
constexpr std::size_t CellCount = std::size_t(1) << (3 * Bits);

glm::vec3 placeOf(const TraceVertex& vertex)
{
  return { vertex.position[0], vertex.position[1], vertex.position[2] };
}

// Number of a cell along the Z-curve: the bits of its three coordinates in turn.
std::size_t numberOf(const glm::ivec3& cell)
{
  std::size_t number = 0;
  for (int bit = Bits - 1; bit >= 0; --bit)
  {
    for (int axis = 2; axis >= 0; --axis)
    {
      number = 2 * number + ((cell[axis] >> bit) & 1);
    }
  }
  return number;
}

std::vector<std::size_t> cellsOf(const std::vector<TraceVertex>& vertices)
{
  glm::vec3 low = placeOf(vertices.front());
  glm::vec3 high = low;
  for (const TraceVertex& vertex : vertices)
  {
    low = glm::min(low, placeOf(vertex));
    high = glm::max(high, placeOf(vertex));
  }
  const glm::vec3 extent = high - low;
  const float side = glm::max(glm::max(extent.x, extent.y), extent.z);
  const float cellsForMm = side > 0.0f ? CellsASide / side : 0.0f;
  std::vector<std::size_t> cells;
  cells.reserve(vertices.size());
  for (const TraceVertex& vertex : vertices)
  {
    const glm::ivec3 cell((placeOf(vertex) - low) * cellsForMm);
    cells.push_back(numberOf(glm::min(cell, glm::ivec3(CellsASide - 1))));
  }
  return cells;
}
}

std::vector<TraceVertex> sortedBySpace(const std::vector<TraceVertex>& vertices)
{
  if (vertices.empty())
  {
    return {};
  }
  const std::vector<std::size_t> cells = cellsOf(vertices);
  std::vector<std::size_t> places(CellCount + 1, 0); // of each cell's next point
  for (const std::size_t cell : cells)
  {
    ++places[cell + 1];
  }
  for (std::size_t cell = 0; cell < CellCount; ++cell)
  {
    places[cell + 1] += places[cell];
  }
  std::vector<TraceVertex> sorted(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    sorted[places[cells[i]]++] = vertices[i];
  }
  return sorted;
}
}
