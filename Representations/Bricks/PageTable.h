// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which bricks of a finer level are on the GPU, and in which slots of their texture.
#ifndef BrainShift_PageTable_h
#define BrainShift_PageTable_h

#include "Representations/Gpu/ShaderSource.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace brainshift
{
constexpr int SlotSideVoxels = StreamedSide + 2 * SlotBorder; ///< Of a slot of the texture.

/// One texel for each brick, for the shader: the slot's place, and 255 if the brick is there.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT PageTable
{
public:
  static constexpr int None = -1;
  static constexpr std::int64_t Unseen = -1; ///< Before any view.
  static constexpr int MostSlotsASide = 255; ///< A place is three bytes.

  /// Forgets all bricks. `bricks`, `slots`: a side.
  void reset(const glm::ivec3& bricks, const glm::ivec3& slots);

  /// The slot of a brick; None: it is not there. Bricks and slots are numbered, x fastest.
  int slotOf(int brick) const { return this->Slots[brick]; }

  /// A brick that is there was seen in a view. Views are numbered in ascending order.
  void use(int brick, std::int64_t view);

  /// A slot for a brick that is not there yet: a free one, or that of the brick that was not seen
  /// for longest, which is forgotten. None: all bricks are of this view.
  int take(int brick, std::int64_t view);

  /// How many bricks a view can still take.
  int room(std::int64_t view) const;

  /// Bricks that are there.
  int count() const { return this->Taken; }

  /// Slots in all.
  int capacity() const { return static_cast<int>(this->Bricks.size()); }

  /// The place of a slot.
  glm::ivec3 positionOf(int slot) const;

  ///@{
  /// A side.
  const glm::ivec3& bricks() const { return this->Size; }
  const glm::ivec3& slots() const { return this->SlotCount; }
  ///@}

  /// Four bytes for each brick.
  const std::vector<std::uint8_t>& texels() const { return this->Texels; }

  /// Layers of bricks (z) whose texels changed since the last call: the first, and one past the
  /// last; none if they are equal. After reset all of them did.
  glm::ivec2 takeChangedLayers();

private:
  void setTexel(int brick, int slot);

  glm::ivec3 Size{ 0 };
  glm::ivec3 SlotCount{ 0 };
  std::vector<int> Slots;          // of each brick
  std::vector<int> Bricks;         // of each slot
  std::vector<std::int64_t> Views; // in which the brick of each slot was seen last
  std::vector<std::uint8_t> Texels;
  int Taken = 0;
  glm::ivec2 ChangedLayers{ 0 };
};
}

#endif
