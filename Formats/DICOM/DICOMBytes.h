// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The bytes of a file, or what its deflated part unpacks to.
 */
#ifndef BrainShift_DICOMBytes_h
#define BrainShift_DICOMBytes_h

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace brainshift
{
/** Reads anywhere in a file. Nothing is read behind its end. */
class DICOMBytes
{
public:
  /** What is inflated is kept up to `mostInflated` bytes; bytes behind them cannot be read. */
  explicit DICOMBytes(const std::string& path, std::uint64_t mostInflated = MostInflated);

  /** More than any file has, and what a header has. */
  static constexpr std::uint64_t MostInflated = std::uint64_t(1) << 31;
  static constexpr std::uint64_t MostOfHeader = std::uint64_t(1) << 26;

  /** Bytes that there are; MostInflated if more is deflated than is kept. */
  std::uint64_t size() const { return this->Size; }

  /** Copies bytes. False if there are not as many. */
  bool read(std::uint64_t offset, std::uint64_t count, void* to);

  /** A few bytes, kept until the next call; null if there are not as many. */
  const unsigned char* at(std::uint64_t offset, std::size_t count);

  /**
   * Unpacks what is kept from an offset on, which then follows what is before it. False if it
   * cannot.
   */
  bool inflateFrom(std::uint64_t offset);

private:
  std::ifstream Stream;
  std::uint64_t Size = 0;
  std::uint64_t Kept = MostInflated;
  std::string Inflated; // all bytes, if some were deflated
  bool IsInflated = false;
  std::vector<unsigned char> Window;
  std::uint64_t WindowOffset = 0;
};
}

#endif
