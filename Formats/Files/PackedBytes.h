// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bytes of a file, unpacked on the way if they are packed with zlib or gzip.
#ifndef BrainShift_PackedBytes_h
#define BrainShift_PackedBytes_h

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

/** Receives the fraction that is done, 0 to 1. Returns false if the work is to stop. */
using FractionDone = std::function<bool(double fraction)>;

/** Whether a file begins like one that is packed with gzip. */
bool beginsLikeGzip(const std::string& fileName);

/** The first bytes of a plain file, unpacked if it is packed with gzip; fewer if it is shorter. */
std::string readUnpackedBeginning(const std::string& fileName, std::size_t bytes);

/**
 * All bytes of a file that is packed with gzip, or throws the end of a sentence. Memory is asked
 * for as they grow, `timesInMemory` bytes in all for each.
 */
std::vector<char> unpackedGzip(const std::vector<char>& packed, double timesInMemory);

/**
 * Throws the end of a sentence if the bytes cannot all be there, by the size of the file. It opens
 * nothing and takes no memory. Packed bytes may still be too few.
 */
void requireBytes(const StoredBytes& from, double count);

/** Some of the voxels that a file has one after another, x fastest. */
struct StoredBox
{
  glm::ivec3 dimensions{ 0 };  ///< of all voxels
  std::array<int, 6> extent{}; ///< first and last x, y and z of those that are wanted
  std::size_t bytes = 0;       ///< of a voxel
  std::size_t volumes = 1;     ///< one after another: the same voxels of each are wanted

  std::size_t voxelCount() const; ///< that are wanted, of all volumes
};

/**
 * Fills `to` with these voxels, or throws the end of a sentence. `from`: the first of all voxels.
 * No other ones are read; those before packed ones are unpacked and dropped. It returns early if
 * `fractionDone` says stop.
 */
void readBox(
  const StoredBytes& from, const StoredBox& box, char* to, const FractionDone& fractionDone);

/** Fills `to`, or throws the end of a sentence. It returns early if `fractionDone` says stop. */
void readBytes(
  const StoredBytes& from, char* to, std::size_t count, const FractionDone& fractionDone);
}

#endif
