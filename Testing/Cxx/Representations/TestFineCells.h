// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An offset field with its corrections, evaluated as the shaders do (Shaders/Field/field.glsl),
/// and strokes that bend it much.
#ifndef BrainShift_TestFineCells_h
#define BrainShift_TestFineCells_h

#include "Common/Grid.h"
#include "Filters/Deformation/FieldChange.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/PointMap.h"
#include "Representations/Field/FineCells.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace brainshift::testing
{
constexpr int FineSamples = 4;
constexpr float AllowedMm = 0.05f;

// The reference grid: 256 x 256 x 150 voxels of 1 mm.
inline Grid referenceLatticeGrid()
{
  return withDimensions(plainGrid({ 256, 256, 150 }, glm::dvec3(1.0)), glm::ivec3(19));
}

// Strokes that squeeze, stretch, shear and reach beyond the lattice.
inline std::vector<std::pair<std::string, Stroke>> bendingStrokes()
{
  const glm::dvec3 middle(128.0, 128.0, 80.0);
  const auto stamp = [&](const glm::dvec3& vector, double major, double minor) {
    Stroke stroke = strokeAt(Tool::Stamp, middle, vector);
    stroke.major = major;
    stroke.minor = minor;
    return stroke;
  };
  return { { "a wide stamp", stamp({ 0.0, 0.0, 20.0 }, 60.0, 40.0) },
    { "a narrow stamp", stamp({ 0.0, 14.0, 14.0 }, 20.0, 12.0) },
    { "a dent", stamp({ 0.0, 0.0, -8.0 }, 40.0, 25.0) },
    { "a soft pull", strokeAt(Tool::Soft, middle, { 10.0, -11.0, 3.0 }) },
    { "a move", strokeAt(Tool::Move, middle, { 4.0, 8.0, 4.0 }) },
    { "a move at the border", strokeAt(Tool::Move, { 128.0, 128.0, 149.0 }, { 0.0, 3.0, -5.0 }) } };
}

// A guarded lattice: no tissue folds.
inline Lattice latticeAfter(const Grid& grid, int kernel, const std::vector<Stroke>& strokes,
  const std::shared_ptr<const NodeWeights>& mask = nullptr)
{
  Lattice lattice = makeLattice(grid, kernel);
  lattice.mask = mask;
  for (const Stroke& stroke : strokes)
  {
    Stroke shorter = stroke;
    Lattice bent = lattice;
    applyStroke(bent, shorter);
    while (minimumJacobian(bent) < 0.1)
    {
      shorter.vector *= 0.9;
      bent = lattice;
      applyStroke(bent, shorter);
    }
    lattice = bent;
  }
  return lattice;
}

// An offset field and the corrections that were found for it.
struct CorrectedField
{
  explicit CorrectedField(const Lattice& lattice, Inverse inverse = Inverse::Exact)
    : map(lattice, inverse)
    , field(offsetField(lattice, FineSamples, inverse))
    , spacing(lattice.grid.spacing)
  {
    const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
    const std::vector<glm::vec3> still(inCells.size(), glm::vec3(0.0f));
    const glm::ivec3& points = lattice.grid.dimensions;
    this->moved = changedBackwardNodes(
      changedPoints(points, still, inCells), points, still, inCells, this->field.nodes);
    this->cells.reset(this->field.nodes);
  }

  // Finds the corrections around some nodes.
  void correct(const IndexBox& nodes)
  {
    Accuracy accuracy;
    accuracy.map = &this->map;
    accuracy.mmFromCell = this->spacing;
    accuracy.allowedMm = AllowedMm;
    const IndexBox all{ glm::ivec3(0), this->field.nodes.count - 1 };
    this->cells.find(this->cells.cellsAround(nodes), { all, this->field.values }, accuracy);
  }

  // At a place that is counted in nodes.
  glm::vec3 correctionAt(const glm::vec3& node) const
  {
    const glm::ivec3 cell =
      glm::clamp(glm::ivec3(glm::floor(node)), glm::ivec3(0), this->field.nodes.count - 2);
    const int code = static_cast<int>(this->cells.code(cell));
    if (code == 0)
    {
      return glm::vec3(0.0f);
    }
    const int side = code % CodeOfSlot;
    const glm::vec3 place = (node - glm::vec3(cell)) * static_cast<float>(side);
    const glm::ivec3 part = glm::min(glm::ivec3(place), glm::ivec3(side - 1));
    const int slot = code / CodeOfSlot + part.x + side * (part.y + side * part.z);
    const glm::ivec3 corner = SlotSide *
      glm::ivec3(slot % SlotsInRow, slot / SlotsInRow % RowsInLayer, slot / SlotsInLayer);
    const glm::vec3 within = 2.0f * (place - glm::vec3(part));
    const glm::ivec3 low = glm::min(glm::ivec3(within), glm::ivec3(1));
    NodeField fine;
    fine.nodes.count = glm::ivec3(2);
    const glm::ivec3 first = corner + low;
    for (const std::uint64_t texel : this->cells.texels({ first, first + 1 }))
    {
      fine.values.emplace_back(glm::unpackHalf4x16(texel));
    }
    return fine.displacement(within - glm::vec3(low));
  }

  glm::vec3 drawnAt(const glm::vec3& node) const
  {
    return this->field.displacement(this->field.nodes.latticeFromNode(node)) +
      this->correctionAt(node);
  }

  // mm between where tissue is drawn and where the cubic puts it.
  double missAt(const glm::vec3& node, const glm::vec3& drawn) const
  {
    const FieldNodes& nodes = this->field.nodes;
    const glm::dvec3 lattice =
      glm::dvec3(nodes.first) + glm::dvec3(node) / static_cast<double>(nodes.perCell);
    return glm::length((this->map.offsetInCells(lattice, drawn) - drawn) * this->spacing);
  }

  PointMap map;
  NodeField field;
  glm::vec3 spacing; // mm
  IndexBox moved;    // nodes that may differ from those at rest
  FineCells cells;
};
}

#endif
