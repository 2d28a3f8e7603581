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
  explicit DICOMBytes(const std::string& path);

  /** Bytes that there are. */
  std::uint64_t size() const { return this->Size; }

  /** Copies bytes. False if there are not as many. */
  bool read(std::uint64_t offset, std::uint64_t count, void* to);

  /** A few bytes, kept until the next call; null if there are not as many. */
  const unsigned char* at(std::uint64_t offset, std::size_t count);

  /** Unpacks all from an offset on, which then follows what is before it. False if it cannot. */
  bool inflateFrom(std::uint64_t offset);

private:
  std::ifstream Stream;
  std::uint64_t Size = 0;
  std::string Inflated; // all bytes, if some were deflated
  bool IsInflated = false;
  std::vector<unsigned char> Window;
  std::uint64_t WindowOffset = 0;
};
}

#endif
