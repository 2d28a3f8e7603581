// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A folder that becomes an OME-Zarr image, in parts: chunks of the finest level in any order, then
/// the coarser levels, and last what makes it an image for readers.
///
/// Until then a file, UnfinishedMark, says that it is not finished and what it is made of. A store
/// of the same content goes on with the chunks that are there and can be unpacked.
#ifndef BrainShift_PyramidStore_h
#define BrainShift_PyramidStore_h

#include "Formats/OMEZarr/HalvedVoxels.h"
#include "Formats/OMEZarr/ZarrArray.h"

#include <functional>
#include <memory>

namespace brainshift
{
/** Some voxels of the finest level, all channels of each side by side. */
struct PyramidPiece
{
  Size3 first{ 0 }; ///< a multiple of PyramidChunk
  VoxelBox voxels;  ///< up to a multiple of PyramidChunk, or to the end
};

/** Faults are thrown as the end of a sentence. */
class PyramidStore
{
public:
  /** Returns false if the work is to stop. */
  using Going = std::function<bool(double fraction)>;

  /**
   * Makes the folder, or goes on with an unfinished one if `identity` is the same and not empty. An
   * unfinished one of another identity is emptied first. A folder with other files is refused.
   */
  PyramidStore(std::string folder, PyramidContent content, const std::string& identity);

  /** Whether all chunks of a box of the finest level are there. It unpacks them. */
  bool isThere(const Size3& first, const Size3& size);

  /** Writes chunks that are not there. False: stopped. */
  bool write(const PyramidPiece& piece, const Going& going);

  /** Makes the coarser levels and the metadata. False: stopped. */
  bool finish(const Going& going);

private:
  using Range = std::array<double, 2>;

  // A chunk of a level.
  struct Chunk
  {
    std::size_t level;
    int channel;
    Size3 at; ///< its number along x, y, z
  };

  std::string Folder;
  PyramidContent Content;
  std::vector<PyramidLevel> Levels;
  std::unique_ptr<ZarrStore> Store;
  std::vector<ZarrArray> Arrays;          ///< of the levels
  std::vector<std::vector<Range>> Ranges; ///< of the chunks of each level, the channel slowest
  std::vector<std::vector<char>> Known;   ///< whether each of them is there
  double Done = 0.0;                      ///< chunks of coarser levels that are made
  double All = 0.0;

  void requireRoom(const std::string& identity) const;
  void describeLevels();
  std::size_t numberOf(const Chunk& chunk) const;
  std::string keyOf(const Chunk& chunk) const;
  Size3 sizeOf(const Chunk& chunk) const; ///< voxels of it within the level
  bool takeIfThere(const Chunk& chunk);
  void note(const Chunk& chunk, const std::string& bytes);
  void put(const Chunk& chunk, const std::string& bytes);
  std::vector<Chunk> chunksIn(std::size_t level, const Size3& first, const Size3& end) const;
  void writeChunk(const Chunk& chunk, const PyramidPiece& piece);
  void takeRanges();
  bool makeLevel(std::size_t level, const Going& going);
  void makeRow(const Chunk& chunk, std::int64_t many);
  std::string numbersOf(
    std::size_t level, int channel, const Size3& first, const Size3& size) const;
  void writeBricks(std::size_t level) const;
};
}

#endif
