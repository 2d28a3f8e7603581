// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Brings the samples of a decoder to the numbers of a file.
 */
#ifndef BrainShift_Widen_h
#define BrainShift_Widen_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace brainshift
{
/** The bytes of samples that became numbers of another type. */
template <typename Number, typename Sample>
std::string bytesAs(const std::vector<Sample>& samples)
{
  const std::vector<Number> numbers(samples.begin(), samples.end());
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/** Numbers of 1, 2 or 4 bytes with the lower bits of the samples; signs are kept. */
template <typename Sample>
std::string widened(const std::vector<Sample>& samples, std::size_t bytesOfNumber)
{
  switch (bytesOfNumber)
  {
    case 1:
      return bytesAs<std::uint8_t>(samples);
    case 2:
      return bytesAs<std::uint16_t>(samples);
    default:
      return bytesAs<std::uint32_t>(samples);
  }
}
}

#endif
