// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/FineCells.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/PointMap.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstdlib>

namespace brainshift
{
namespace
{
// Fractions of the allowed miss. Elsewhere in a cell, a straight line can miss by more than at the
// points that are tested, and neighbours with other corrections do not quite meet.
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
// fractions of the allowed miss, the sum over the axes. Small sums are only bounded.
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

// Whether a cell must be tested between its nodes. Where tissue is stretched, nodes miss by more
// than their curvature predicts; then the middle of the cell does, too. `from`: the tile's first
// cell.
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

namespace
{
constexpr int TileSide = 8; // cells: neighbours share what is found between them
constexpr int TilesAtOnce = 256;
constexpr int SlotsAtOnce = 8192;
constexpr int Shuffling = 10007; // a prime: spreads neighbours over the threads
static_assert(Shuffling > SlotsAtOnce && Shuffling > TilesAtOnce, "else it has common factors");
constexpr int MostSlots = MostLayers * SlotsInLayer;

int cube(int side)
{
  return side * side * side;
}
}

void FineCells::reset(const FieldNodes& nodes)
{
  *this = FineCells();
  this->Nodes = nodes;
}

IndexBox FineCells::cellsAround(const IndexBox& changedNodes) const
{
  if (changedNodes.empty())
  {
    return {};
  }
  // A cell reads the nodes beside its own to see whether it bends.
  return { glm::max(changedNodes.first - 2, glm::ivec3(0)),
    glm::min(changedNodes.last + 1, this->Nodes.count - 2) };
}

IndexBox FineCells::nodesToRead(const IndexBox& cells) const
{
  return cells.empty() ? IndexBox()
                       : IndexBox{ glm::max(cells.first - 1, glm::ivec3(0)),
                           glm::min(cells.last + 2, this->Nodes.count - 1) };
}

std::vector<float> FineCells::reaches(const IndexBox& nodes) const
{
  const glm::ivec3 size = nodes.size();
  std::vector<float> reaches(static_cast<std::size_t>(size.x) * size.y * size.z, 0.0f);
  if (this->Reaches.empty())
  {
    return reaches;
  }
  const IndexBox cells{ glm::max(nodes.first - 1, glm::ivec3(0)),
    glm::min(nodes.last, this->Nodes.count - 2) };
  forEachIndex(cells.first, cells.last, [&](const glm::ivec3& cell) {
    const float reach = this->Reaches[this->index(cell)];
    if (reach == 0.0f)
    {
      return;
    }
    forEachIndex(
      glm::max(cell, nodes.first), glm::min(cell + 1, nodes.last), [&](const glm::ivec3& node) {
        const glm::ivec3 at = node - nodes.first;
        float& most = reaches[(static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x];
        most = std::max(most, reach);
      });
  });
  return reaches;
}

std::vector<float> FineCells::codes(const IndexBox& cells) const
{
  const glm::ivec3 size = cells.size();
  std::vector<float> codes;
  if (this->Codes.empty())
  {
    codes.assign(static_cast<std::size_t>(size.x) * size.y * size.z, 0.0f);
    return codes;
  }
  codes.reserve(static_cast<std::size_t>(size.x) * size.y * size.z);
  forEachIndex(
    cells.first, { cells.first.x, cells.last.y, cells.last.z }, [&](const glm::ivec3& row) {
      const float* first = &this->Codes[this->index(row)];
      codes.insert(codes.end(), first, first + size.x);
    });
  return codes;
}

std::array<int, 2> FineCells::takeWritten()
{
  const std::array<int, 2> written = this->Written;
  this->Written = { 0, -1 };
  return written;
}

std::vector<std::uint64_t> FineCells::texels(const IndexBox& box) const
{
  std::vector<std::uint64_t> texels;
  forEachIndex(box.first, box.last, [&](const glm::ivec3& texel) {
    const glm::ivec3 place = texel / SlotSide;
    const glm::ivec3 in = texel % SlotSide;
    const std::size_t slot = (place.z * RowsInLayer + place.y) * SlotsInRow + place.x;
    const std::size_t at = slot * SlotTexels + (in.z * SlotSide + in.y) * SlotSide + in.x;
    texels.push_back(at < this->Corrections.size() ? this->Corrections[at] : 0);
  });
  return texels;
}

void FineCells::release(const glm::ivec3& cell)
{
  float& code = this->Codes[this->index(cell)];
  if (code > 0.0f)
  {
    const std::div_t parts = std::div(static_cast<int>(code), CodeOfSlot);
    this->Free[parts.rem].push_back(parts.quot);
    code = 0.0f;
    this->Reaches[this->index(cell)] = 0.0f;
    this->CellsWith -= 1;
  }
}

void FineCells::leaveOut(const IndexBox& cells)
{
  if (!this->any())
  {
    return;
  }
  forEachIndex(cells.first, cells.last, [&](const glm::ivec3& cell) { this->release(cell); });
}

// The first of as many slots as `side` needs, or -1.
int FineCells::takeSlots(int side)
{
  std::vector<int>& free = this->Free[side];
  if (!free.empty())
  {
    const int first = free.back();
    free.pop_back();
    return first;
  }
  const int first = this->SlotsUsed;
  if (first + cube(side) > MostSlots)
  {
    return -1;
  }
  this->SlotsUsed += cube(side);
  this->Corrections.resize(static_cast<std::size_t>(this->SlotsUsed) * SlotTexels);
  return first;
}

int FineCells::slotsLeft() const
{
  int left = MostSlots - this->SlotsUsed;
  for (const int side : SlotsASide)
  {
    left += static_cast<int>(this->Free[side].size()) * cube(side);
  }
  return left;
}

bool FineCells::isScattered() const
{
  constexpr int many = MostSlots / 8;
  return this->slotsLeft() - (MostSlots - this->SlotsUsed) > many;
}

bool FineCells::keep(const glm::ivec3& cell, int side, const FilledSlots& filled)
{
  const int first = this->takeSlots(side);
  if (first < 0)
  {
    return false;
  }
  if (this->Codes.empty())
  {
    const std::size_t nodes =
      static_cast<std::size_t>(this->Nodes.count.x) * this->Nodes.count.y * this->Nodes.count.z;
    this->Codes.assign(nodes, 0.0f);
    this->Reaches.assign(nodes, 0.0f);
  }
  std::copy(filled.texels.begin(), filled.texels.end(),
    this->Corrections.begin() + static_cast<std::ptrdiff_t>(first) * SlotTexels);
  const int last = first + cube(side) - 1;
  const bool none = this->Written[1] < this->Written[0];
  this->Written = { none ? first : std::min(this->Written[0], first),
    none ? last : std::max(this->Written[1], last) };
  this->Codes[this->index(cell)] = static_cast<float>(CodeOfSlot * first + side);
  this->Reaches[this->index(cell)] = filled.reach;
  this->CellsWith += 1;
  return true;
}

// The cells that need corrections, as many as there are slots for. Whatever the threads do, the
// same cells are found.
std::vector<NeedingCell> FineCells::look(
  const IndexBox& cells, const NodeBlock& block, const Accuracy& accuracy)
{
  std::vector<NeedingCell> needing;
  const glm::ivec3 tiles = (cells.size() + TileSide - 1) / TileSide;
  const int count = tiles.x * tiles.y * tiles.z;
  for (int done = 0; done < count; done += TilesAtOnce)
  {
    const int some = std::min(count - done, TilesAtOnce);
    if (static_cast<int>(needing.size()) > this->slotsLeft())
    {
      this->LeftOut = true;
      break;
    }
    std::vector<std::vector<NeedingCell>> found(some);
    parallelFor(0, some, 1, [&](std::int64_t begin, std::int64_t end) {
      FineSearch search(this->Nodes, block, accuracy);
      for (std::int64_t i = begin; i < end; ++i)
      {
        // Neighbours go to different threads: most of the work lies in a few of them.
        const int tile = done + static_cast<int>(i * Shuffling % some);
        const int row = tile / tiles.x;
        const glm::ivec3 place(tile % tiles.x, row % tiles.y, row / tiles.y);
        const glm::ivec3 first = cells.first + TileSide * place;
        search.look({ first, glm::min(first + TileSide - 1, cells.last) }, found[tile - done]);
      }
    });
    for (const std::vector<NeedingCell>& inTile : found)
    {
      needing.insert(needing.end(), inTile.begin(), inTile.end());
    }
  }
  return needing;
}

// The most slots a side with which all cells find room.
int FineCells::mostSlotsASide(const std::vector<NeedingCell>& needing) const
{
  int most = SlotsASide.back();
  const auto needed = [&] {
    std::int64_t slots = 0;
    for (const NeedingCell& cell : needing)
    {
      slots += cube(std::min(cell.side, most));
    }
    return slots;
  };
  while (most > 1 && needed() > this->slotsLeft())
  {
    most /= 2;
  }
  return most;
}

// Fills the slots of some cells, one after the other from `first` on, and returns the next one.
std::size_t FineCells::fillSome(const std::vector<NeedingCell>& needing, std::size_t first,
  int most, const std::function<FilledSlots(const NeedingCell&, int side)>& fill)
{
  const auto sideOf = [&](std::size_t cell) { return std::min(needing[cell].side, most); };
  std::size_t end = first;
  for (int slots = 0; end < needing.size() && slots < SlotsAtOnce; ++end)
  {
    slots += cube(sideOf(end));
  }
  const auto count = static_cast<std::int64_t>(end - first);
  std::vector<FilledSlots> filled(count);
  parallelFor(0, count, 1, [&](std::int64_t begin, std::int64_t last) {
    for (std::int64_t i = begin; i < last; ++i)
    {
      const std::int64_t shuffled = i * Shuffling % count;
      filled[shuffled] = fill(needing[first + shuffled], sideOf(first + shuffled));
    }
  });
  for (std::int64_t i = 0; i < count; ++i)
  {
    const NeedingCell& cell = needing[first + i];
    const bool kept = this->keep(cell.cell, sideOf(first + i), filled[i]);
    this->LeftOut = this->LeftOut || !kept || cell.side > most || !filled[i].exact;
  }
  return end;
}

void FineCells::find(const IndexBox& cells, const NodeBlock& block, const Accuracy& accuracy)
{
  this->leaveOut(cells);
  this->LeftOut = false;
  const std::vector<NeedingCell> needing = this->look(cells, block, accuracy);
  const int most = this->mostSlotsASide(needing);
  const FineSearch search(this->Nodes, block, accuracy);
  for (std::size_t done = 0; done < needing.size();)
  {
    done = this->fillSome(needing, done, most,
      [&](const NeedingCell& cell, int side) { return search.fill(cell, side); });
  }
}
}
