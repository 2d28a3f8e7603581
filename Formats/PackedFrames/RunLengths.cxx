// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Unpacks frames in RLE, DICOM's run-length encoding (part 5, annex G).
#include "Common/Bytes.h"
#include "Formats/PackedFrames/PackedFrame.h"

namespace brainshift
{
namespace
{
constexpr std::size_t HeaderBytes = 64; // number of segments, and 15 offsets

std::size_t headerNumber(const std::string& packed, std::size_t index)
{
  return storedNumber<std::uint32_t>(packed.data() + 4 * index, false);
}

// A segment holds one byte of each number. Its bytes go to `first`, `first + step`, ...
bool unpackSegment(const std::string& packed, std::size_t offset, std::string& plain,
  std::size_t first, std::size_t step)
{
  std::size_t to = first;
  while (to < plain.size())
  {
    if (offset + 1 >= packed.size())
    {
      return false;
    }
    const int code = static_cast<unsigned char>(packed[offset++]);
    if (code == 128)
    {
      continue; // means nothing
    }
    const bool isRun = code > 128;
    const std::size_t length = static_cast<std::size_t>(isRun ? 257 - code : 1 + code);
    if (!isRun && offset + length > packed.size())
    {
      return false;
    }
    for (std::size_t i = 0; i < length && to < plain.size(); ++i, to += step)
    {
      plain[to] = packed[offset + (isRun ? 0 : i)];
    }
    offset += isRun ? 1 : length;
  }
  return true;
}
}

UnpackedFrame unpackRunLengths(const std::string& packed, const FrameShape& shape)
{
  const std::size_t bytesOfNumber = shape.bytesOfNumber();
  if (packed.size() < HeaderBytes || headerNumber(packed, 0) != bytesOfNumber)
  {
    throw Problem("an RLE frame is damaged: its header does not announce " +
      std::to_string(bytesOfNumber) + " segments, one for each byte of a number");
  }
  std::string plain(shape.count() * bytesOfNumber, '\0');
  for (std::size_t segment = 0; segment < bytesOfNumber; ++segment)
  {
    const std::size_t offset = headerNumber(packed, 1 + segment);
    // The first segment holds the highest bytes.
    if (offset < HeaderBytes ||
      !unpackSegment(packed, offset, plain, bytesOfNumber - 1 - segment, bytesOfNumber))
    {
      throw Problem("an RLE frame is damaged: its data ends before the last pixel");
    }
  }
  return { plain };
}
}
