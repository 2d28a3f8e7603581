// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Bricks/PageTable.h"

#include <algorithm>
#include <utility>

namespace brainshift
{
void PageTable::reset(const glm::ivec3& bricks, const glm::ivec3& slots)
{
  this->Size = bricks;
  this->SlotCount = slots;
  const std::size_t count = static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z;
  const std::size_t room = static_cast<std::size_t>(slots.x) * slots.y * slots.z;
  this->Slots.assign(count, None);
  this->Texels.assign(4 * count, 0);
  this->Bricks.assign(room, None);
  this->Views.assign(room, Unseen);
  this->Taken = 0;
  this->ChangedLayers = { 0, bricks.z };
}

void PageTable::use(int brick, std::int64_t view)
{
  const int slot = this->Slots[brick];
  if (slot != None)
  {
    this->Views[slot] = std::max(this->Views[slot], view);
  }
}

int PageTable::take(int brick, std::int64_t view)
{
  int slot = this->Taken;
  if (slot < this->capacity())
  {
    this->Taken += 1;
  }
  else
  {
    const auto oldest = std::min_element(this->Views.begin(), this->Views.end());
    if (oldest == this->Views.end() || *oldest >= view)
    {
      return None;
    }
    slot = static_cast<int>(oldest - this->Views.begin());
    this->setTexel(this->Bricks[slot], None);
  }
  this->Bricks[slot] = brick;
  this->Views[slot] = view;
  this->setTexel(brick, slot);
  return slot;
}

int PageTable::room(std::int64_t view) const
{
  return static_cast<int>(std::count_if(
    this->Views.begin(), this->Views.end(), [view](std::int64_t seen) { return seen < view; }));
}

glm::ivec3 PageTable::positionOf(int slot) const
{
  const glm::ivec3& side = this->SlotCount;
  return { slot % side.x, slot / side.x % side.y, slot / (side.x * side.y) };
}

void PageTable::setTexel(int brick, int slot)
{
  this->Slots[brick] = slot;
  const glm::ivec3 place = slot == None ? glm::ivec3(0) : this->positionOf(slot);
  std::uint8_t* texel = &this->Texels[4 * static_cast<std::size_t>(brick)];
  for (int axis = 0; axis < 3; ++axis)
  {
    texel[axis] = static_cast<std::uint8_t>(place[axis]);
  }
  texel[3] = slot == None ? 0 : 255;
  const int layer = brick / (this->Size.x * this->Size.y);
  glm::ivec2& changed = this->ChangedLayers;
  changed = changed.x == changed.y
    ? glm::ivec2(layer, layer + 1)
    : glm::ivec2(std::min(changed.x, layer), std::max(changed.y, layer + 1));
}

glm::ivec2 PageTable::takeChangedLayers()
{
  return std::exchange(this->ChangedLayers, glm::ivec2(0));
}
}
