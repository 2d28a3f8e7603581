// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/FineSearch.h"

#include "Common/Grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cstddef>

namespace brainshift
{
namespace
{
// Shares of the allowed miss. A straight line can miss by more elsewhere in a cell than where it is
// looked at, and neighbours with other corrections do not quite meet.
constexpr float LookAtMiddle = 0.35f; // what curvature alone seems to miss by
constexpr float LookCloser = 0.75f;   // the same, if the middle of the cell is near enough
constexpr float MiddleIsNear = 0.3f;  // what the field misses by there
constexpr float NeedsFine = 0.8f;     // what the field misses by between its nodes
constexpr float NeedsLittle = 1.2f;   // what one slot surely is enough for
constexpr float FineEnough = 0.6f;    // what the corrections miss by between theirs
constexpr float Expected = 0.4f;      // what denser ones are expected to miss by

constexpr float Rounding = 1.01f; // of half floats

float mmOf(const glm::vec3& cells, const Accuracy& accuracy)
{
  return glm::length(cells * accuracy.mmFromCell);
}
}

glm::vec3 NodeBlock::at(const glm::ivec3& node) const
{
  const glm::ivec3 from = node - this->nodes.first;
  const glm::ivec3 size = this->nodes.size();
  return this->offsets[(static_cast<std::size_t>(from.z) * size.y + from.y) * size.x + from.x];
}

glm::vec3 NodeBlock::between(const glm::vec3& node) const
{
  const glm::ivec3 low = glm::min(glm::ivec3(glm::floor(node)), this->nodes.last - 1);
  const glm::vec3 way = node - glm::vec3(low);
  const glm::ivec3 size = this->nodes.size();
  const glm::ivec3 from = low - this->nodes.first;
  const std::size_t row = size.x;
  const std::size_t layer = row * size.y;
  const glm::vec3* first = &this->offsets[from.z * layer + from.y * row + from.x];
  const auto face = [&](const glm::vec3* corner) {
    return glm::mix(
      glm::mix(corner[0], corner[1], way.x), glm::mix(corner[row], corner[row + 1], way.x), way.y);
  };
  return glm::mix(face(first), face(first + layer), way.z);
}

FineSearch::FineSearch(const FieldNodes& nodes, const NodeBlock& block, const Accuracy& accuracy)
  : Field(nodes)
  , Block(block)
  , Exact(accuracy)
{
}

void FineSearch::look(const IndexBox& cells, std::vector<NeedingCell>& needing)
{
  this->First = cells.first;
  this->HalfCount = 2 * cells.size() + 1;
  this->Halves.assign(
    static_cast<std::size_t>(this->HalfCount.x) * this->HalfCount.y * this->HalfCount.z, Half());
  this->findCurvature(cells);
  forEachIndex(cells.first, cells.last, [&](const glm::ivec3& cell) {
    if (this->mayMiss(cell - cells.first, cells.size() + 1))
    {
      this->lookInto(cell, needing);
    }
  });
}

FilledSlots FineSearch::fill(const NeedingCell& needing, int side) const
{
  const int count = 2 * side + 1; // fine nodes a side
  std::vector<glm::vec3> fine;
  FilledSlots filled;
  forEachIndex(glm::ivec3(0), glm::ivec3(count - 1), [&](const glm::ivec3& at) {
    const glm::vec3 place = glm::vec3(at) / static_cast<float>(side);
    const glm::vec3 guess = betweenHalves(needing.halves, place);
    const bool known = glm::fract(place) == glm::vec3(0.0f);
    fine.push_back(
      known ? guess : this->correctionAt(glm::vec3(needing.cell) + 0.5f * place, guess));
    const glm::vec3 far = glm::abs(fine.back()) * Rounding;
    filled.reach = std::max({ filled.reach, far.x, far.y, far.z });
  });
  forEachIndex(glm::ivec3(0), glm::ivec3(side - 1), [&](const glm::ivec3& slot) {
    forEachIndex(2 * slot, 2 * slot + (SlotSide - 1), [&](const glm::ivec3& at) {
      const glm::vec3& correction = fine[(at.z * count + at.y) * count + at.x];
      filled.texels.push_back(glm::packHalf4x16(glm::vec4(correction, 0.0f)));
    });
  });
  filled.exact = side < SlotsASide.back() || this->missOf(needing, fine) < this->Exact.allowedMm;
  return filled;
}

// The largest miss (mm) of corrections on the most slots, at one place in each slot. `fine`: the
// corrections, x fastest.
float FineSearch::missOf(const NeedingCell& needing, const std::vector<glm::vec3>& fine) const
{
  constexpr int side = SlotsASide.back();
  NodeBlock block;
  block.nodes = { glm::ivec3(0), glm::ivec3(2 * side) };
  block.offsets = fine;
  float miss = 0.0f;
  forEachIndex(glm::ivec3(0), glm::ivec3(side - 1), [&](const glm::ivec3& slot) {
    const glm::vec3 place = 2.0f * glm::vec3(slot) + 0.5f;
    const glm::vec3 drawn = block.between(place);
    const glm::vec3 node = glm::vec3(needing.cell) + place / (2.0f * side);
    miss = std::max(miss, mmOf(this->correctionAt(node, drawn) - drawn, this->Exact));
  });
  return miss;
}

// Finds how much the field is curved around the nodes of a tile.
void FineSearch::findCurvature(const IndexBox& cells)
{
  this->Curvature.clear();
  forEachIndex(cells.first, cells.last + 1,
    [&](const glm::ivec3& node) { this->Curvature.push_back(this->curvatureAt(node)); });
}

// What a straight line misses by halfway between nodes, if the field is a parabola there; in
// shares of the allowed miss, the sum over the axes. Small sums are only bounded.
float FineSearch::curvatureAt(const glm::ivec3& node) const
{
  const float scale = 1.0f / (8.0f * this->Exact.allowedMm);
  const glm::vec3 middle = this->Block.at(node);
  glm::vec3 squares(0.0f);
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::ivec3 low = node;
    glm::ivec3 high = node;
    low[axis] = std::max(node[axis] - 1, this->Block.nodes.first[axis]);
    high[axis] = std::min(node[axis] + 1, this->Block.nodes.last[axis]);
    const glm::vec3 second =
      (this->Block.at(low) - 2.0f * middle + this->Block.at(high)) * this->Exact.mmFromCell;
    squares[axis] = glm::dot(second, second) * scale * scale;
  }
  const float bound = 3.0f * (squares.x + squares.y + squares.z); // of the squared sum
  if (bound < LookAtMiddle * LookAtMiddle)
  {
    return 0.0f;
  }
  const glm::vec3 lengths = glm::sqrt(squares);
  return lengths.x + lengths.y + lengths.z;
}

// Whether a cell is worth a closer look. Where tissue is stretched, nodes miss by more than their
// curvature says; then the middle of the cell does, too. `from`: the tile's first cell.
bool FineSearch::mayMiss(const glm::ivec3& from, const glm::ivec3& nodes)
{
  float most = 0.0f;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 at = from + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    most = std::max(most, this->Curvature[(at.z * nodes.y + at.y) * nodes.x + at.x]);
  }
  if (most < LookAtMiddle || most > LookCloser)
  {
    return most > LookCloser;
  }
  const glm::vec3& middle = this->correctionAtHalf(2 * from + 1);
  return mmOf(middle, this->Exact) > MiddleIsNear * this->Exact.allowedMm;
}

// `node`: a place, in nodes of the field. `guess`: of the correction.
glm::vec3 FineSearch::correctionAt(const glm::vec3& node, const glm::vec3& guess) const
{
  const glm::vec3 drawn = this->Block.between(node);
  const glm::dvec3 lattice =
    glm::dvec3(this->Field.first) + glm::dvec3(node) / static_cast<double>(this->Field.perCell);
  return this->Exact.map->offsetNear(lattice, drawn + guess) - drawn;
}

// `half`: half nodes from the tile's first node.
const glm::vec3& FineSearch::correctionAtHalf(const glm::ivec3& half)
{
  Half& there =
    this
      ->Halves[(static_cast<std::size_t>(half.z) * this->HalfCount.y + half.y) * this->HalfCount.x +
        half.x];
  if (!there.known)
  {
    there.known = true;
    there.correction =
      this->correctionAt(glm::vec3(this->First) + 0.5f * glm::vec3(half), glm::vec3(0.0f));
  }
  return there.correction;
}

void FineSearch::lookInto(const glm::ivec3& cell, std::vector<NeedingCell>& needing)
{
  NeedingCell looked;
  looked.cell = cell;
  float miss = 0.0f;
  glm::vec3* correction = looked.halves.data();
  forEachIndex(glm::ivec3(0), glm::ivec3(SlotSide - 1), [&](const glm::ivec3& half) {
    *correction = this->correctionAtHalf(2 * (cell - this->First) + half);
    miss = std::max(miss, mmOf(*correction, this->Exact));
    ++correction;
  });
  if (miss > NeedsFine * this->Exact.allowedMm)
  {
    looked.side = miss < NeedsLittle * this->Exact.allowedMm ? 1 : this->sideFor(looked);
    needing.push_back(looked);
  }
}

// Between the corrections halfway between nodes; `place`: 0 to 2 a side.
glm::vec3 FineSearch::betweenHalves(
  const std::array<glm::vec3, SlotTexels>& halves, const glm::vec3& place)
{
  const glm::ivec3 low = glm::min(glm::ivec3(place), glm::ivec3(SlotSide - 2));
  const glm::vec3 way = place - glm::vec3(low);
  const glm::vec3* first = &halves[(low.z * SlotSide + low.y) * SlotSide + low.x];
  const auto face = [&](const glm::vec3* corner) {
    return glm::mix(glm::mix(corner[0], corner[1], way.x),
      glm::mix(corner[SlotSide], corner[SlotSide + 1], way.x), way.y);
  };
  return glm::mix(face(first), face(first + SlotSide * SlotSide), way.z);
}

// Whether tissue of the lattice's border is seen in a cell. Beyond it displacements are constant,
// so the field has a kink there. Under a mask displacements are trilinear between nodes, and the
// field has kinks in most cells. Across a kink half the length leaves half the miss.
bool FineSearch::hasKink(const glm::ivec3& cell) const
{
  if (this->Exact.map->isTrilinear())
  {
    return true;
  }
  const float offsets = this->Exact.map->inverse() == Inverse::Negated ? 0.0f : 1.0f;
  glm::vec3 low(1e30f);
  glm::vec3 high(-1e30f);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 node = cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::vec3 rest =
      this->Field.latticeFromNode(glm::vec3(node)) + offsets * this->Block.at(node);
    low = glm::min(low, rest);
    high = glm::max(high, rest);
  }
  const glm::vec3 zero(0.0f);
  const glm::vec3 last = glm::vec3(this->Exact.map->grid().dimensions - 1);
  return glm::any(glm::notEqual(glm::lessThan(low, zero), glm::lessThan(high, zero))) ||
    glm::any(glm::notEqual(glm::greaterThan(low, last), glm::greaterThan(high, last)));
}

// The slots a side that corrections need to be exact enough. A straight line that is half as long
// misses by a quarter, unless there is a kink.
int FineSearch::sideFor(const NeedingCell& needing) const
{
  float miss = 0.0f;
  forEachIndex(glm::ivec3(0), glm::ivec3(1), [&](const glm::ivec3& part) {
    const glm::vec3 place = glm::vec3(part) + 0.5f;
    const glm::vec3 guess = betweenHalves(needing.halves, place);
    const glm::vec3 exact = this->correctionAt(glm::vec3(needing.cell) + 0.5f * place, guess);
    miss = std::max(miss, mmOf(exact - guess, this->Exact));
  });
  const float allowed = this->Exact.allowedMm;
  if (miss < FineEnough * allowed)
  {
    return 1;
  }
  const bool kink = this->hasKink(needing.cell);
  const auto gain = [&](int side) { return static_cast<float>(kink ? side : side * side); };
  return *std::find_if(SlotsASide.begin() + 1, SlotsASide.end() - 1,
    [&](int side) { return miss < gain(side) * Expected * allowed; });
}
}
