// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Finds the cells of an offset field that need corrections, and the corrections; see
 *        FineCells.h.
 */
#ifndef BrainShift_FineSearch_h
#define BrainShift_FineSearch_h

#include "Filters/Deformation/FieldChange.h"
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/PointMap.h"
#include "Representations/Gpu/ShaderSource.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace brainshift
{
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
}

#endif
