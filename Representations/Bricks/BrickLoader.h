// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads bricks of finer levels on threads of their own. Only a picture that is saved waits for
/// them.
#ifndef BrainShift_BrickLoader_h
#define BrainShift_BrickLoader_h

#include "Formats/Volumes/FinerLevels.h"
#include "Representations/Tissue/ScalarTexture.h"

#include <condition_variable>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace brainshift
{
/// Voxels of a finer level in the texture coordinates of the volume that is drawn: the first one
/// reaches from 0 to 1.
struct FineGrid
{
  std::size_t level = 0;
  glm::ivec3 voxels{ 0 };
  glm::dvec3 voxelFromTexture{ 1.0 };
  glm::dvec3 voxelOfTextureZero{ 0.0 };

  /// Bricks of StreamedSide voxels, a side.
  VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::ivec3 bricks() const;

  VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::ivec3 positionOf(int brick) const;

  bool operator==(const FineGrid& other) const
  {
    return this->level == other.level && this->voxels == other.voxels &&
      this->voxelFromTexture == other.voxelFromTexture &&
      this->voxelOfTextureZero == other.voxelOfTextureZero;
  }
};

/// Bricks that come between two pictures, some 100 MB of 16-bit numbers: more wait for the next.
constexpr std::size_t MostBricksInPicture = 1024;

/// What bricks are read of, and for what.
struct BrickOrder
{
  FineGrid fine;
  glm::ivec3 texels{ 0 }; ///< Of the texture that is drawn where there are no bricks, a side.
  int component = 0;

  bool operator==(const BrickOrder& other) const
  {
    return this->fine == other.fine && this->texels == other.texels &&
      this->component == other.component;
  }
};

/// What interpolation can find in the rest bricks (Skipping/RestPresence.h) that a brick covers.
struct CoveredRanges
{
  glm::ivec3 first{ 0 };
  BrickRanges found;
};

/// The ranges of a brick's slot: stored numbers, as ScalarTexture::storedNumbers gives them.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT CoveredRanges coveredRanges(
  const StoredNumbers& numbers, const glm::ivec3& brick, const BrickOrder& order);

/// A brick, or the reason why there is none.
struct ReadBrick
{
  int brick = 0;
  std::int64_t number = 0; ///< Bricks are taken in the order in which they were begun.
  StoredNumbers numbers;   ///< Of a slot, x fastest; empty: it could not be read.
  CoveredRanges ranges;
  std::string remark; ///< A sentence on what is not as the file should have it; may be empty.
};

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT BrickLoader
{
public:
  explicit BrickLoader(const LevelSource& source);
  ~BrickLoader();
  BrickLoader(const BrickLoader&) = delete;
  void operator=(const BrickLoader&) = delete;

  /// Where the finer levels lie. Empty while the headers are read, and if they cannot be.
  std::vector<Grid> grids();

  /// A sentence if the headers cannot be read; else empty.
  std::string problem();

  /// Replaces what is wanted, the most urgent brick first. Bricks of a different order are dropped.
  void order(const BrickOrder& order, const std::vector<int>& bricks);

  /// Bricks that were read since the last call, up to `most`; none before one that was begun before
  /// it, so that places in a texture, and with them rounding, do not depend on the threads.
  std::vector<ReadBrick> take(std::size_t most);

  /// Bricks that are still to come, or were not taken; 1 while the headers are read.
  std::int64_t waiting();

  /// Bricks that were read and not taken.
  std::int64_t countRead();

  /// Whether nothing more comes before bricks are taken or ordered.
  bool isDone();

private:
  struct Block // of voxels, as the file packs them
  {
    vtkSmartPointer<vtkDataArray> numbers; // of the file's type
    glm::ivec3 first{ 0 };
    glm::ivec3 size{ 0 };
    std::string remark;
  };
  struct KnownBlock
  {
    std::mutex lock; // of the block; what else is here has that of all blocks
    bool isRead = false;
    Block block;
    std::int64_t bytes = 0;
    std::int64_t used = 0;
  };
  using BlockKey = std::array<int, 4>; // level, place
  using Blocks = std::map<BlockKey, std::shared_ptr<KnownBlock>>;

  void run(std::size_t thread);
  void open();
  bool next(BrickOrder& order, ReadBrick& read);
  void finish(const BrickOrder& order, ReadBrick read);
  void read(FinerLevels& levels, const BrickOrder& order, ReadBrick& read);
  std::shared_ptr<const Block> blockAt(
    FinerLevels& levels, const BrickOrder& order, const glm::ivec3& place);
  Block readBlock(FinerLevels& levels, const BrickOrder& order, const glm::ivec3& place);
  void forgetOldBlocks();
  bool isStopped();

  LevelSource Source;
  std::vector<std::unique_ptr<FinerLevels>> Levels; // one for each thread, opened by the first

  std::mutex BlocksLock; // of the next three
  Blocks Known;
  std::int64_t BlocksUsed = 0;
  std::int64_t BlockBytes = 0;

  std::mutex Lock; // of all that follows
  std::condition_variable Wake;
  bool Stopped = false;
  bool Opened = false;
  std::vector<Grid> Grids;
  std::string Problem;
  BrickOrder Order;
  std::vector<int> Wanted;
  std::size_t Next = 0;                // of Wanted
  std::int64_t Begun = 0;              // bricks, of all orders
  int Reading = 0;                     // threads that read a brick
  std::map<std::int64_t, int> Current; // numbers and bricks of the order that are read now
  std::list<ReadBrick> Read;           // by their numbers
  std::vector<std::thread> Threads;
};
}

#endif
