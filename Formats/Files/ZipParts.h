// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The parts of a zip archive, stored or deflated. Sizes are compared with the archive and the
/// memory before anything is taken.
#ifndef BrainShift_ZipParts_h
#define BrainShift_ZipParts_h

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace brainshift
{
/** One file in an archive. */
struct ZipPart
{
  std::string name;           ///< its path in the archive, with /
  std::uint64_t offset = 0;   ///< of its local header, in the archive
  std::uint64_t packed = 0;   ///< bytes in the archive
  std::uint64_t unpacked = 0; ///< bytes of the file
  std::uint32_t checksum = 0; ///< CRC-32 of the file
  bool isDeflated = false;    ///< else stored
};

/** The files of an archive, without folders. Throws the end of a sentence. */
std::vector<ZipPart> zipPartsOf(const std::vector<char>& archive);

/** The bytes of a file of an archive, or throws the end of a sentence. */
std::vector<char> unpackedPart(const std::vector<char>& archive, const ZipPart& part);

/** A file for writeZip. */
struct NamedBytes
{
  std::string name;
  std::vector<char> bytes;
};

/** Writes files, stored, as an archive of up to 4 GiB, or throws the end of a sentence. */
void writeZip(const std::vector<NamedBytes>& files, std::ostream& to);
}

#endif
