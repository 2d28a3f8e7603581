// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A folder that becomes an OME-Zarr image, in parts: chunks of the finest level in any order, then
/// the coarser levels, and last what makes it an image for readers.
///
/// Until then a file, UnfinishedMark, says that it is not finished, its grid and type, and who
/// writes it. If grid and type are the same again, each chunk of the finest level that has the same
/// numbers is kept. Before another one is written, the coarser levels are removed: they are always
/// made of those chunks. Of two writers the first one stops before its next chunk.
#ifndef BrainShift_PyramidStore_h
#define BrainShift_PyramidStore_h

#include "Formats/OMEZarr/HalvedVoxels.h"
#include "Formats/OMEZarr/ZarrArray.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

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
   * Makes the folder, or continues an unfinished one of the same grid, type and kind. An unfinished
   * one of other content is emptied first. A folder with other files is refused.
   */
  PyramidStore(std::string folder, PyramidContent content);

  /** Writes chunks that are not there or have other numbers. False: stopped. */
  bool write(const PyramidPiece& piece, const Going& going);

  /** Chunks of the finest level that were written, not kept. */
  std::size_t chunksWritten() const { return this->Written; }

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
  std::string Writer; ///< random: it is this one as long as the mark has it
  std::vector<PyramidLevel> Levels;
  std::unique_ptr<ZarrStore> Store;
  std::vector<ZarrArray> Arrays;          ///< of the levels
  std::vector<std::vector<Range>> Ranges; ///< of the chunks of each level, the channel slowest
  double Done = 0.0;                      ///< chunks of coarser levels that are made
  double All = 0.0;
  std::mutex Writing; // guards Written and the removal of coarser levels
  std::size_t Written = 0;

  std::string identity() const;
  void requireRoom() const;
  void requireOnlyWriter() const;
  void describeLevels();
  std::size_t numberOf(const Chunk& chunk) const;
  std::string keyOf(const Chunk& chunk) const;
  Size3 sizeOf(const Chunk& chunk) const; ///< voxels of it within the level
  std::optional<std::string> numbersThere(const Chunk& chunk) const;
  bool takeIfThere(const Chunk& chunk);
  void removeCoarser() const;
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
