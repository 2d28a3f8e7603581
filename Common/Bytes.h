// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers in the bytes of a file or a message, in either order of bytes. No VTK.
#ifndef BrainShift_Bytes_h
#define BrainShift_Bytes_h

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>

namespace brainshift
{
/** Whether this machine stores the highest byte of a number first. */
inline bool thisMachineIsBigEndian()
{
  const int one = 1;
  char first;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

/** The number whose first byte is at `from`. All its bytes must be there. */
template <typename Number>
Number storedNumber(const void* from, bool isBigEndian)
{
  char bytes[sizeof(Number)];
  std::memcpy(bytes, from, sizeof(Number));
  if (isBigEndian != thisMachineIsBigEndian())
  {
    std::reverse(bytes, bytes + sizeof(Number));
  }
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return number;
}

/** The number at an offset of some bytes; none if the bytes end before the number does. */
template <typename Number>
std::optional<Number> storedNumberAt(std::string_view bytes, std::size_t offset, bool isBigEndian)
{
  const bool isThere = offset <= bytes.size() && sizeof(Number) <= bytes.size() - offset;
  return isThere ? std::optional<Number>(storedNumber<Number>(bytes.data() + offset, isBigEndian))
                 : std::nullopt;
}

/** Brings `count` numbers of `size` bytes from a file's order of bytes to that of this machine. */
inline void toMachineOrder(char* numbers, std::size_t count, std::size_t size, bool isBigEndian)
{
  if (isBigEndian == thisMachineIsBigEndian() || size < 2)
  {
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    std::reverse(numbers + i * size, numbers + (i + 1) * size);
  }
}
}

#endif
