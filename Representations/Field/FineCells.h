// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Corrections of the offset field in the cells where a straight line between its nodes is not
/// exact enough.
///
/// A *cell* is the space between eight neighbouring nodes of the offset field. A *correction* is
/// the exact offset minus the offset of the field at the same position. A cell that needs
/// corrections has them on nodes 2, 4, 6, 8 or 16 times as dense; between these they are trilinear.
#ifndef BrainShift_FineCells_h
#define BrainShift_FineCells_h

#include "Filters/Deformation/FieldChange.h"
#include "Representations/Gpu/ShaderSource.h"

#include <cstdint>
#include <functional>

namespace brainshift
{
class PointMap;

/// A *slot* holds the corrections on SlotSide fine nodes a side: two steps. A cell has one of
/// SlotsASide. In the texture of corrections slots follow each other in rows along x, then y,
/// then z.
constexpr int SlotTexels = SlotSide * SlotSide * SlotSide;
constexpr std::array<int, 5> SlotsASide = { 1, 2, 3, 4, 8 };
constexpr int SlotsInLayer = SlotsInRow * RowsInLayer;
constexpr int MostLayers = 32; ///< 27 MiB.

/// How exact the field is to be.
struct Accuracy
{
  const PointMap* map = nullptr; ///< Gives the exact offsets.
  glm::vec3 mmFromCell{ 1.0f };  ///< mm along the axes for one lattice cell.
  float allowedMm = 0.05f;       ///< The most that the field may miss by.
};

/// Offsets in a box of nodes.
struct NodeBlock
{
  IndexBox nodes;
  std::vector<glm::vec3> offsets; ///< Lattice cells, one for each node, x fastest.

  glm::vec3 at(const glm::ivec3& node) const;

  /// Between nodes, trilinear. `node`: within the box.
  glm::vec3 between(const glm::vec3& node) const;
};

/// A cell that needs corrections.
struct NeedingCell
{
  glm::ivec3 cell{ 0 };
  int side = 1;                               ///< Slots that make it exact enough, a side.
  std::array<glm::vec3, SlotTexels> halves{}; ///< Corrections on two steps a side, lattice cells.
};

/// What the slots of a cell hold.
struct FilledSlots
{
  std::vector<std::uint64_t> texels; ///< Lattice cells, as four half floats each.
  float reach = 0.0f;                ///< No correction is larger along any axis, lattice cells.
  bool exact = true;                 ///< Else even the most slots leave more than is allowed.
};

/// Searches one field. It keeps what neighbours share, so each thread has its own.
class FineSearch
{
public:
  /// `block`: offsets of the field `nodes`, at least on all that enclose the cells that are looked
  /// at and on those beside them.
  FineSearch(const FieldNodes& nodes, const NodeBlock& block, const Accuracy& accuracy);

  /// Appends the cells of a tile that need corrections. Corrections halfway between nodes are found
  /// once for all cells around.
  void look(const IndexBox& cells, std::vector<NeedingCell>& needing);

  /// The corrections of a cell on `side` slots a side.
  FilledSlots fill(const NeedingCell& needing, int side) const;

private:
  struct Half
  {
    bool known = false;
    glm::vec3 correction;
  };

  void findCurvature(const IndexBox& cells);
  float curvatureAt(const glm::ivec3& node) const;
  bool mayMiss(const glm::ivec3& from, const glm::ivec3& nodes);
  glm::vec3 correctionAt(const glm::vec3& node, const glm::vec3& guess) const;
  const glm::vec3& correctionAtHalf(const glm::ivec3& half);
  void lookInto(const glm::ivec3& cell, std::vector<NeedingCell>& needing);
  static glm::vec3 betweenHalves(
    const std::array<glm::vec3, SlotTexels>& halves, const glm::vec3& place);
  bool hasKink(const glm::ivec3& cell) const;
  int sideFor(const NeedingCell& needing) const;
  float missOf(const NeedingCell& needing, const std::vector<glm::vec3>& fine) const;

  const FieldNodes& Field;
  const NodeBlock& Block;
  const Accuracy& Exact;
  glm::ivec3 First{ 0 };     // node of the tile
  glm::ivec3 HalfCount{ 0 }; // of Halves, a side
  std::vector<Half> Halves;
  std::vector<float> Curvature; // around each node of the tile
};

/// The corrections of one field.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT FineCells
{
public:
  /// Forgets everything. `nodes`: those of the offset field.
  void reset(const FieldNodes& nodes);

  /// Forgets the corrections in a box of cells.
  void leaveOut(const IndexBox& cells);

  /// Finds the corrections in a box of cells anew. `block`: offsets of the field, at least on
  /// nodesToRead.
  void find(const IndexBox& cells, const NodeBlock& block, const Accuracy& accuracy);

  /// Cells that may have other corrections if the offsets of some nodes change.
  IndexBox cellsAround(const IndexBox& changedNodes) const;

  /// Nodes whose offsets `find` reads for a box of cells.
  IndexBox nodesToRead(const IndexBox& cells) const;

  /// Whether any cell has corrections.
  bool any() const { return this->CellsWith > 0; }

  /// Whether the last search left out corrections that are needed: the field bends too much in too
  /// many cells.
  bool leftOut() const { return this->LeftOut; }

  /// Whether many slots are free in places that may be too small.
  bool isScattered() const;

  /// Tells shaders where the corrections of a cell are: CodeOfSlot times its first slot, plus its
  /// slots a side; 0: there are none. The cell's slots follow each other, x fastest.
  float code(const glm::ivec3& cell) const
  {
    return this->Codes.empty() ? 0.0f : this->Codes[this->index(cell)];
  }

  /// Those of a box of cells, x fastest.
  std::vector<float> codes(const IndexBox& cells) const;

  /// For each node of a box, x fastest: the largest correction along any axis in the cells around
  /// the node, lattice cells.
  std::vector<float> reaches(const IndexBox& nodes) const;

  /// Layers of the texture of corrections that are in use.
  int layers() const { return (this->SlotsUsed + SlotsInLayer - 1) / SlotsInLayer; }

  /// Corrections in a box of texels of their texture, x fastest; lattice cells, as four half floats
  /// each. Where there is no slot they are 0.
  std::vector<std::uint64_t> texels(const IndexBox& box) const;

  /// First and last slot that were written since the last call; none: last below first.
  std::array<int, 2> takeWritten();

private:
  std::size_t index(const glm::ivec3& cell) const
  {
    return (static_cast<std::size_t>(cell.z) * this->Nodes.count.y + cell.y) * this->Nodes.count.x +
      cell.x;
  }
  void release(const glm::ivec3& cell);
  int takeSlots(int side);
  int slotsLeft() const;
  bool keep(const glm::ivec3& cell, int side, const FilledSlots& filled);
  std::vector<NeedingCell> look(
    const IndexBox& cells, const NodeBlock& block, const Accuracy& accuracy);
  int mostSlotsASide(const std::vector<NeedingCell>& needing) const;
  std::size_t fillSome(const std::vector<NeedingCell>& needing, std::size_t first, int most,
    const std::function<FilledSlots(const NeedingCell&, int side)>& fill);

  FieldNodes Nodes;
  // One for each node: that of the cell above it along all axes. Empty before the first correction.
  std::vector<float> Codes;
  std::vector<float> Reaches;                               // of these cells, lattice cells
  std::vector<std::uint64_t> Corrections;                   // SlotTexels for each slot, x fastest
  int SlotsUsed = 0;                                        // those in the free lists, too
  std::array<std::vector<int>, SlotsASide.back() + 1> Free; // [a side]: first slots of free places
  std::array<int, 2> Written{ 0, -1 };                      // slots
  int CellsWith = 0;
  bool LeftOut = false; // by the last search
};
}

#endif
