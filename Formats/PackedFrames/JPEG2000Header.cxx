// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/PackedFrames/JPEG2000Header.h"

#include "Common/Bytes.h"

#include <cstdint>
#include <set>

namespace brainshift
{
namespace
{
const std::string Damaged = "a JPEG 2000 frame is damaged: ";
constexpr std::uint64_t StartOfCodes = 0xff4f;
constexpr std::uint64_t Size = 0xff51; // the marker of the size
constexpr std::uint64_t StartOfTile = 0xff90;
constexpr std::uint64_t CodesBox = 0x6a703263; // "jp2c"
constexpr std::size_t SizeBytes = 45;          // with the first marker, and one component
constexpr std::uint64_t MostTiles = 4096;

// A big-endian number; 0 behind the end.
template <typename Number>
std::uint64_t numberAt(const std::string& packed, std::size_t offset)
{
  return storedNumberAt<Number>(packed, offset, true).value_or(0);
}

// Where the stream of codes begins: at once, or in a box of the format JP2. The end without one.
std::size_t beginOfCodes(const std::string& packed)
{
  std::size_t offset = 0;
  while (offset < packed.size() && numberAt<std::uint16_t>(packed, offset) != StartOfCodes)
  {
    const bool isLong = numberAt<std::uint32_t>(packed, offset) == 1;
    const std::uint64_t length = isLong ? numberAt<std::uint64_t>(packed, offset + 8)
                                        : numberAt<std::uint32_t>(packed, offset);
    const std::size_t head = isLong ? 16 : 8;
    if (numberAt<std::uint32_t>(packed, offset + 4) == CodesBox)
    {
      return offset + head;
    }
    if (length < head || length > packed.size() - offset)
    {
      return packed.size();
    }
    offset += length;
  }
  return offset;
}

// How many tiles lie side by side; 0 if they cannot cover the picture.
std::uint64_t tilesAlong(const std::string& packed, std::size_t codes, std::size_t axis)
{
  const std::uint64_t end = numberAt<std::uint32_t>(packed, codes + 8 + 4 * axis);
  const std::uint64_t side = numberAt<std::uint32_t>(packed, codes + 24 + 4 * axis);
  const std::uint64_t begin = numberAt<std::uint32_t>(packed, codes + 32 + 4 * axis);
  return side == 0 || begin >= end ? 0 : (end - begin + side - 1) / side;
}

// The tiles that have a part.
std::set<std::uint64_t> tilesIn(const std::string& packed, std::size_t codes)
{
  std::size_t offset = codes + 2;
  while (offset + 4 <= packed.size() && numberAt<std::uint16_t>(packed, offset) != StartOfTile)
  {
    offset += 2 + numberAt<std::uint16_t>(packed, offset + 2);
  }
  std::set<std::uint64_t> tiles;
  while (offset + 12 <= packed.size() && numberAt<std::uint16_t>(packed, offset) == StartOfTile)
  {
    tiles.insert(numberAt<std::uint16_t>(packed, offset + 4));
    const std::uint64_t length = numberAt<std::uint32_t>(packed, offset + 6);
    if (length < 12) // 0: up to the end
    {
      break;
    }
    offset += length;
  }
  return tiles;
}
}

std::string jpeg2000Problem(const std::string& packed, const FrameShape& shape)
{
  const std::size_t codes = beginOfCodes(packed);
  if (codes + SizeBytes > packed.size() || numberAt<std::uint16_t>(packed, codes) != StartOfCodes ||
    numberAt<std::uint16_t>(packed, codes + 2) != Size)
  {
    return Damaged + "it does not begin with its size";
  }
  const std::uint64_t components = numberAt<std::uint16_t>(packed, codes + 40);
  const std::uint64_t bits = 1 + (numberAt<std::uint8_t>(packed, codes + 42) & 127);
  std::uint64_t sides[2] = { 0, 0 };
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const std::uint64_t end = numberAt<std::uint32_t>(packed, codes + 8 + 4 * axis);
    const std::uint64_t begin = numberAt<std::uint32_t>(packed, codes + 16 + 4 * axis);
    sides[axis] = end > begin ? end - begin : 0;
  }
  if (sides[0] != static_cast<std::uint64_t>(shape.columns) ||
    sides[1] != static_cast<std::uint64_t>(shape.rows) || components != 1 ||
    bits > static_cast<std::uint64_t>(shape.bitsAllocated))
  {
    return otherShape(shape,
      std::to_string(sides[0]) + " x " + std::to_string(sides[1]) + " pixels of " +
        std::to_string(components) + " samples in " + std::to_string(bits) + " bits")
      .problem;
  }
  const std::uint64_t across = tilesAlong(packed, codes, 0);
  const std::uint64_t down = tilesAlong(packed, codes, 1);
  if (across == 0 || down == 0 || across > MostTiles || down > MostTiles ||
    across * down > MostTiles)
  {
    return Damaged + "it announces " + std::to_string(across) + " x " + std::to_string(down) +
      " tiles; it must be 1 to 4096 in all";
  }
  const std::set<std::uint64_t> tiles = tilesIn(packed, codes);
  if (tiles.size() != across * down || *tiles.rbegin() >= across * down)
  {
    return Damaged + "it has " + std::to_string(tiles.size()) + " of its " +
      std::to_string(across * down) + " tiles";
  }
  return {};
}
}
