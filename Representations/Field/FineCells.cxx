// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/FineCells.h"

#include "Common/Grid.h"
#include "Common/Parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstdlib>

namespace brainshift
{
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

// The most slots a side with which all cells find place.
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
