// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads a box of a zarr array: the chunks that it touches, and no others.
#ifndef BrainShift_ZarrBox_h
#define BrainShift_ZarrBox_h

#include "Formats/OMEZarr/ZarrArray.h"

#include <functional>

namespace brainshift
{
/** A box, along each axis of an array, and where its numbers go. */
struct ZarrBox
{
  std::vector<std::int64_t> first; ///< index
  std::vector<std::int64_t> count; ///< at least 1, within the array
  char* numbers = nullptr;         ///< where the first number goes
  std::vector<std::int64_t> steps; ///< numbers from one index to the next, there
};

/** The key of the first chunk (or shard) if up to 64, from all over the array, are not there; empty
 * if one is. */
std::string missingChunk(const ZarrStore& store, const ZarrArray& array);

/** A part of a box whose chunk is cut off or damaged, or missing where it must be. */
struct ZarrDamage
{
  ZarrBox part;
  std::string reason;     ///< the end of a sentence that names the chunk
  bool isMissing = false; ///< from an array that has all its chunks
};

/**
 * Fills a box. A chunk that is not there has the fill value, or counts as damaged if the array has
 * all its chunks. One that is cut off or damaged is
 * added to `damages`, and its part remains as it was; without a list it throws the reason. Returns
 * false if `progress`, which receives the fraction that is done, says stop.
 */
bool readZarrBox(const ZarrStore& store, const ZarrArray& array, const ZarrBox& box,
  const std::function<bool(double)>& progress, std::vector<ZarrDamage>* damages = nullptr);
}

#endif
