// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the metadata of a zarr array say, of version 2 (.zarray) or 3 (zarr.json).
#ifndef BrainShift_ZarrArray_h
#define BrainShift_ZarrArray_h

#include "Formats/OMEZarr/ZarrCodecs.h"
#include "Formats/OMEZarr/ZarrJson.h"

#include "vtkType.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/** How the numbers of an array are stored. Booleans become uint8. */
struct ZarrType
{
  int vtkType = VTK_VOID;
  std::size_t bytes = 0;
  bool isBoolean = false;
};

/** Files that hold many chunks each, with an index of where they are. Without a shape: none. */
struct ZarrShards
{
  std::vector<std::int64_t> shape; ///< numbers along each axis; multiples of the chunk's
  bool indexIsAtEnd = true;
  bool indexIsBigEndian = false;
  bool indexHasChecksum = false;
};

/** An array with at least one axis. The axes are in the order of its metadata. */
struct ZarrArray
{
  std::string path;                ///< the key of its group in the store
  std::vector<std::int64_t> shape; ///< numbers along each axis
  std::vector<std::int64_t> chunk; ///< the same of a chunk
  ZarrType type;
  bool isBigEndian = false;
  std::string fill;       ///< the bytes of one number, as this machine orders them
  std::vector<int> order; ///< the axes in a chunk, from the slowest to the fastest
  ZarrCodecs codecs;      ///< of a chunk
  std::string prefix;     ///< before the numbers in the key of a chunk: "c" or nothing
  std::string separator;  ///< between them
  ZarrShards shards;
  bool hasAllChunks = false; ///< its writer leaves out none: one that is missing is damage
  std::optional<std::int64_t> written; ///< when its metadata was, as ZarrStore tells

  std::size_t chunkBytes() const; ///< unpacked
  bool hasShards() const { return !this->shards.shape.empty(); }
};

/** Throws the end of a sentence about the array, or if there is none. */
ZarrArray readZarrArray(const ZarrStore& store, const std::string& path);

/** Throws the end of a sentence if the array was written anew, moved or deleted since. */
void requireAsRead(const ZarrStore& store, const ZarrArray& array);

/** The bytes of one number of a type from the JSON of a fill value. */
std::string fillBytes(const Json& json, const ZarrType& type);
}

#endif
