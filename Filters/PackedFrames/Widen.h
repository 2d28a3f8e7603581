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
/** Numbers of 1, 2 or 4 bytes with the lower bits of the samples; signs are kept. */
template <typename Sample>
std::string widened(const std::vector<Sample>& samples, std::size_t bytesOfNumber)
{
  const auto as = [&samples](auto none) {
    const std::vector<decltype(none)> numbers(samples.begin(), samples.end());
    std::string bytes(numbers.size() * sizeof(none), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
  };
  return bytesOfNumber == 1 ? as(std::uint8_t())
    : bytesOfNumber == 2    ? as(std::uint16_t())
                            : as(std::uint32_t());
}
}

#endif
