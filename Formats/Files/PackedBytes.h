// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Bytes of a file, unpacked on the way if they are packed with zlib or gzip.
 */
#ifndef BrainShift_PackedBytes_h
#define BrainShift_PackedBytes_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace brainshift
{
/** Where bytes are stored. */
struct StoredBytes
{
  std::string fileName;
  std::uint64_t offset = 0;       ///< in the file
  bool isPacked = false;          ///< from there on
  std::uint64_t unpackedSkip = 0; ///< unpacked bytes before those that are wanted
};

/** Hears which share is done, 0 to 1. Returns false if the work is to stop. */
using ShareDone = std::function<bool(double share)>;

/** Whether a file begins like one that is packed with gzip. */
bool beginsLikeGzip(const std::string& fileName);

/**
 * Why the bytes cannot all be there, by the size of the file: the end of a sentence, or nothing. It
 * opens nothing and takes no memory. Packed bytes may still be too few.
 */
std::string bytesProblem(const StoredBytes& from, double count);

/**
 * Fills `to`. Returns the end of a sentence on why it cannot, or nothing; nothing as well if it is
 * told to stop.
 */
std::string readBytes(
  const StoredBytes& from, char* to, std::size_t count, const ShareDone& shareDone);
}

#endif
