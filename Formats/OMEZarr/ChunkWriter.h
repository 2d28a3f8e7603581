// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes the entries of a zarr store that is a folder.
#ifndef BrainShift_ChunkWriter_h
#define BrainShift_ChunkWriter_h

#include <cstddef>
#include <string>

namespace brainshift
{
constexpr int ChunkEffort = 1; ///< of blosc: 1 is the fastest, 9 packs best

/** Bytes packed with blosc: zstd, and shuffled if a number has several. */
std::string packedChunk(const std::string& bytes, std::size_t bytesOfNumber);

/**
 * Writes a file whole or not at all: beside its place first. It does not wait for the disk. Makes
 * its folder. Throws the end of a sentence.
 */
void writeEntry(const std::string& folder, const std::string& key, const std::string& bytes);
}

#endif
