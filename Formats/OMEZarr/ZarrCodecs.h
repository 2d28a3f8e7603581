// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What packs the bytes of a chunk: blosc, zstd, gzip, zlib, lz4, and the checksum crc32c.
#ifndef BrainShift_ZarrCodecs_h
#define BrainShift_ZarrCodecs_h

#include <cstddef>
#include <string>
#include <vector>

namespace brainshift
{
/** Codecs by the names of zarr, in the order in which they packed. */
using ZarrCodecs = std::vector<std::string>;

/** Adds a codec, or throws the end of a sentence if BrainShift does not unpack it there. */
void addCodec(const std::string& name, ZarrCodecs& codecs);

/** Exactly `size` bytes, or throws the end of a sentence about what was packed. */
std::string unpacked(const ZarrCodecs& codecs, std::string packed, std::size_t size);

/** The most bytes that a packed chunk of `size` bytes may reasonably have. */
std::size_t mostPacked(std::size_t size);
}

#endif
