// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Numbers at places of bytes, in either order of bytes.
 */
#ifndef BrainShift_StoredNumbers_h
#define BrainShift_StoredNumbers_h

#include "Formats/Files/PackedBytes.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace brainshift
{
/** The number whose first byte is `from`. */
template <typename T>
T storedNumber(const char* from, bool isBigEndian)
{
  std::array<char, sizeof(T)> raw;
  std::copy_n(from, sizeof(T), raw.begin());
  if (isBigEndian != thisMachineIsBigEndian())
  {
    std::reverse(raw.begin(), raw.end());
  }
  T number;
  std::memcpy(&number, raw.data(), sizeof(T));
  return number;
}
}

#endif
