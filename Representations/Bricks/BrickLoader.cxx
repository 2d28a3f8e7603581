// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Bricks/BrickLoader.h"

#include "Common/Guard.h"
#include "Common/Parallel.h"
#include "Common/ThreadPriority.h"
#include "Representations/Bricks/PageTable.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkDataArray.h"
#include "vtkTextureObject.h" // for its smart pointer

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::int64_t MostBlockBytes = 192 << 20; // of voxels that neighbours may need, too
constexpr int MostThreads = 4;

std::int64_t bytesOf(vtkDataArray* numbers)
{
  return numbers->GetNumberOfValues() * numbers->GetDataTypeSize();
}

// First and last rest brick along an axis that each voxel of a slot can reach.
struct Reach
{
  std::array<int, SlotSideVoxels> first;
  std::array<int, SlotSideVoxels> last;
};

Reach reachAlong(int axis, int brick, const BrickOrder& order)
{
  const int bricks = (order.texels[axis] + RestBrickSide - 1) / RestBrickSide;
  const double low = static_cast<double>(brick) * StreamedSide; // voxels of the finer level
  const auto restBrickOf = [&](double fine, double margin) {
    const double texture =
      (fine - order.fine.voxelOfTextureZero[axis]) / order.fine.voxelFromTexture[axis];
    const double voxel = texture * order.texels[axis] - 0.5 + margin;
    return std::clamp(static_cast<int>(std::floor(voxel / RestBrickSide)), 0, bricks - 1);
  };
  Reach reach;
  for (int i = 0; i < SlotSideVoxels; ++i)
  {
    const double middle = low + i - SlotBorder + 0.5;
    reach.first[i] = restBrickOf(std::max(middle - 1.0, low), -BrickMargin);
    reach.last[i] = restBrickOf(std::min(middle + 1.0, low + StreamedSide), BrickMargin);
  }
  return reach;
}

const glm::vec2 NoNumbers(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest());

template <typename T>
void widen(CoveredRanges& covered, const std::vector<T>& numbers, float scale,
  const std::array<Reach, 3>& reach)
{
  const glm::ivec3& count = covered.found.count;
  const auto include = [](glm::vec2& range, const glm::vec2& numbers) {
    range.x = numbers.x < range.x ? numbers.x : range.x; // false for NaN
    range.y = numbers.y > range.y ? numbers.y : range.y;
  };
  std::vector<glm::vec2> ofRow(count.x);
  std::size_t at = 0;
  for (int z = 0; z < SlotSideVoxels; ++z)
  {
    for (int y = 0; y < SlotSideVoxels; ++y)
    {
      std::fill(ofRow.begin(), ofRow.end(), NoNumbers);
      for (int x = 0; x < SlotSideVoxels; ++x, ++at)
      {
        const glm::vec2 number(scale * static_cast<float>(numbers[at]));
        for (int rest = reach[0].first[x]; rest <= reach[0].last[x]; ++rest)
        {
          include(ofRow[rest - covered.first.x], number);
        }
      }
      forEachIndex({ 0, reach[1].first[y] - covered.first.y, reach[2].first[z] - covered.first.z },
        { count.x - 1, reach[1].last[y] - covered.first.y, reach[2].last[z] - covered.first.z },
        [&](const glm::ivec3& rest) {
          include(
            covered.found.ranges[(rest.z * count.y + rest.y) * count.x + rest.x], ofRow[rest.x]);
        });
    }
  }
}
}

glm::ivec3 FineGrid::bricks() const
{
  return (this->voxels + StreamedSide - 1) / StreamedSide;
}

glm::ivec3 FineGrid::positionOf(int brick) const
{
  const glm::ivec3 side = this->bricks();
  return { brick % side.x, brick / side.x % side.y, brick / (side.x * side.y) };
}

CoveredRanges coveredRanges(
  const StoredNumbers& numbers, const glm::ivec3& brick, const BrickOrder& order)
{
  const std::array<Reach, 3> reach{ reachAlong(0, brick.x, order), reachAlong(1, brick.y, order),
    reachAlong(2, brick.z, order) };
  CoveredRanges covered;
  for (int axis = 0; axis < 3; ++axis)
  {
    covered.first[axis] = reach[axis].first.front();
    covered.found.count[axis] = reach[axis].last.back() - covered.first[axis] + 1;
  }
  const glm::ivec3& count = covered.found.count;
  covered.found.ranges.assign(static_cast<std::size_t>(count.x) * count.y * count.z, NoNumbers);
  if (numbers.floats.empty())
  {
    widen(covered, numbers.sixteenBits, ShaderFromSixteenBits, reach);
  }
  else
  {
    widen(covered, numbers.floats, 1.0f, reach);
  }
  return covered;
}

BrickLoader::BrickLoader(const LevelSource& source)
  : Source(source)
{
  const int threads =
    std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, MostThreads);
  this->Levels.resize(threads);
  for (std::size_t thread = 0; thread < this->Levels.size(); ++thread)
  {
    this->Threads.emplace_back([this, thread] { this->run(thread); });
  }
}

BrickLoader::~BrickLoader()
{
  {
    const std::lock_guard<std::mutex> lock(this->Lock);
    this->Stopped = true;
  }
  this->Wake.notify_all();
  for (std::thread& thread : this->Threads)
  {
    thread.join();
  }
}

std::vector<Grid> BrickLoader::grids()
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  return this->Grids;
}

std::string BrickLoader::problem()
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  return this->Problem;
}

void BrickLoader::order(const BrickOrder& order, const std::vector<int>& bricks)
{
  {
    const std::lock_guard<std::mutex> lock(this->Lock);
    if (!(this->Order == order))
    {
      this->Read.clear();
      this->Current.clear();
    }
    this->Order = order;
    std::set<int> known;
    for (const auto& [number, brick] : this->Current)
    {
      known.insert(brick);
    }
    for (const ReadBrick& read : this->Read)
    {
      known.insert(read.brick);
    }
    this->Wanted.clear();
    std::copy_if(bricks.begin(), bricks.end(), std::back_inserter(this->Wanted),
      [&](int brick) { return known.count(brick) == 0; });
    this->Next = 0;
  }
  this->Wake.notify_all();
}

std::vector<ReadBrick> BrickLoader::take(std::size_t most)
{
  std::vector<ReadBrick> taken;
  {
    const std::lock_guard<std::mutex> lock(this->Lock);
    const auto isNext = [this](const ReadBrick& read) {
      return this->Current.empty() || read.number < this->Current.begin()->first;
    };
    while (!this->Read.empty() && isNext(this->Read.front()) && taken.size() < most)
    {
      taken.push_back(std::move(this->Read.front()));
      this->Read.pop_front();
    }
  }
  this->Wake.notify_all();
  return taken;
}

std::int64_t BrickLoader::waiting()
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  return !this->Opened
    ? 1
    : static_cast<std::int64_t>(this->Wanted.size() - this->Next + this->Read.size()) +
      this->Reading;
}

std::int64_t BrickLoader::countRead()
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  return static_cast<std::int64_t>(this->Read.size());
}

bool BrickLoader::isDone()
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  return this->Read.size() >= MostBricksInPicture ||
    (this->Opened && this->Reading == 0 && this->Next >= this->Wanted.size());
}

bool BrickLoader::isStopped()
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  return this->Stopped;
}

// Waits for the next brick that is wanted. False: stopped.
bool BrickLoader::next(BrickOrder& order, ReadBrick& read)
{
  std::unique_lock<std::mutex> lock(this->Lock);
  this->Wake.wait(lock, [this] {
    return this->Stopped ||
      (this->Opened && this->Next < this->Wanted.size() && this->Read.size() < MostBricksInPicture);
  });
  if (this->Stopped)
  {
    return false;
  }
  order = this->Order;
  read.brick = this->Wanted[this->Next++];
  read.number = this->Begun++;
  this->Current[read.number] = read.brick;
  this->Reading += 1;
  return true;
}

void BrickLoader::finish(const BrickOrder& order, ReadBrick read)
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  this->Reading -= 1;
  if (this->Order == order)
  {
    this->Current.erase(read.number);
    const auto after = std::find_if(this->Read.begin(), this->Read.end(),
      [&](const ReadBrick& other) { return other.number > read.number; });
    this->Read.insert(after, std::move(read));
  }
}

// All at once: a store that is written anew later must not be read half as it was.
void BrickLoader::open()
{
  const std::string problem = sentenceThrownBy("The finer levels of the volume", [&] {
    for (std::unique_ptr<FinerLevels>& levels : this->Levels)
    {
      levels = std::make_unique<FinerLevels>(this->Source);
    }
  });
  const std::lock_guard<std::mutex> lock(this->Lock);
  this->Opened = true;
  this->Problem = problem;
  if (problem.empty())
  {
    this->Grids = this->Levels.front()->grids();
  }
  this->Wake.notify_all();
}

void BrickLoader::run(std::size_t thread)
{
  keepLoopsOnThisThread();
  giveWayToOtherThreads(); // pictures go before bricks
  if (thread == 0)
  {
    this->open();
  }
  BrickOrder order;
  ReadBrick read;
  while (this->next(order, read))
  {
    const std::string failure = sentenceThrownBy(
      "A brick of the volume", [&] { this->read(*this->Levels[thread], order, read); });
    if (!failure.empty())
    {
      read.numbers = {};
      read.remark = failure;
    }
    this->finish(order, std::exchange(read, {}));
  }
}

BrickLoader::Block BrickLoader::readBlock(
  FinerLevels& levels, const BrickOrder& order, const glm::ivec3& place)
{
  const int side = levels.blockSide(order.fine.level);
  Block block;
  block.first = place * side;
  block.size = glm::min(block.first + side, order.fine.voxels) - block.first;
  const glm::ivec3 last = block.first + block.size - 1;
  const int extent[6] = { block.first.x, last.x, block.first.y, last.y, block.first.z, last.z };
  block.numbers = levels.read(
    order.fine.level, extent, [this](double) { return !this->isStopped(); }, block.remark);
  if (!block.numbers)
  {
    throw brainshift::Problem("was not read: the volume is no longer drawn");
  }
  return block;
}

// Bricks side by side need the same voxels: each block is unpacked once, also for two threads.
std::shared_ptr<const BrickLoader::Block> BrickLoader::blockAt(
  FinerLevels& levels, const BrickOrder& order, const glm::ivec3& place)
{
  const BlockKey key{ static_cast<int>(order.fine.level), place.x, place.y, place.z };
  std::shared_ptr<KnownBlock> known;
  {
    const std::lock_guard<std::mutex> lock(this->BlocksLock);
    std::shared_ptr<KnownBlock>& entry = this->Known[key];
    entry = entry ? entry : std::make_shared<KnownBlock>();
    entry->used = ++this->BlocksUsed;
    known = entry;
  }
  const std::lock_guard<std::mutex> lock(known->lock);
  if (!known->isRead)
  {
    known->block = this->readBlock(levels, order, place);
    known->isRead = true;
    const std::lock_guard<std::mutex> lockOfAll(this->BlocksLock);
    const auto entry = this->Known.find(key);
    if (entry != this->Known.end() && entry->second == known) // it was not forgotten meanwhile
    {
      known->bytes = bytesOf(known->block.numbers);
      this->BlockBytes += known->bytes;
    }
  }
  return { known, &known->block };
}

void BrickLoader::forgetOldBlocks()
{
  const std::lock_guard<std::mutex> lock(this->BlocksLock);
  while (this->BlockBytes > MostBlockBytes && this->Known.size() > 1)
  {
    const auto oldest = std::min_element(this->Known.begin(), this->Known.end(),
      [](const auto& a, const auto& b) { return a.second->used < b.second->used; });
    this->BlockBytes -= oldest->second->bytes;
    this->Known.erase(oldest);
  }
}

namespace
{
// The voxels of a slot along one axis that a block has: first, and one past the last.
glm::ivec2 partOfSlot(int firstVoxel, int voxels, int firstOfBlock, int sizeOfBlock)
{
  const auto isBefore = [&](int i, int end) {
    return std::clamp(firstVoxel + i, 0, voxels - 1) < end;
  };
  glm::ivec2 part(0);
  while (part.x < SlotSideVoxels && isBefore(part.x, firstOfBlock))
  {
    part.x += 1;
  }
  part.y = part.x;
  while (part.y < SlotSideVoxels && isBefore(part.y, firstOfBlock + sizeOfBlock))
  {
    part.y += 1;
  }
  return part;
}

struct Copied // the voxels that a slot has of a block
{
  glm::ivec3 firstVoxel; // of the slot
  glm::ivec3 voxels;     // of the level
  glm::ivec3 first;      // of the block
  glm::ivec3 size;
};

// Numbers of all components, as many as a slot has voxels.
vtkSmartPointer<vtkDataArray> slotLike(vtkDataArray* numbers)
{
  constexpr vtkIdType SlotVoxels = SlotSideVoxels * SlotSideVoxels * SlotSideVoxels;
  auto slot = vtkSmartPointer<vtkDataArray>::Take(numbers->NewInstance());
  slot->SetNumberOfComponents(numbers->GetNumberOfComponents());
  slot->SetNumberOfTuples(SlotVoxels);
  return slot;
}

// Beyond the volume its outermost voxels are repeated, as a texture does.
void copyBlock(const Copied& copied, vtkDataArray* from, vtkDataArray* to)
{
  const std::size_t bytes =
    static_cast<std::size_t>(from->GetDataTypeSize()) * from->GetNumberOfComponents();
  const auto* firstFrom = static_cast<const char*>(from->GetVoidPointer(0));
  auto* firstTo = static_cast<char*>(to->GetVoidPointer(0));

  std::array<glm::ivec2, 3> parts;
  for (int axis = 0; axis < 3; ++axis)
  {
    parts[axis] = partOfSlot(
      copied.firstVoxel[axis], copied.voxels[axis], copied.first[axis], copied.size[axis]);
  }
  const auto within = [&](int i, int axis) {
    return std::clamp(copied.firstVoxel[axis] + i, 0, copied.voxels[axis] - 1) - copied.first[axis];
  };
  for (int z = parts[2].x; z < parts[2].y; ++z)
  {
    for (int y = parts[1].x; y < parts[1].y; ++y)
    {
      const char* row = firstFrom +
        bytes * static_cast<std::size_t>(within(z, 2) * copied.size.y + within(y, 1)) *
          copied.size.x;
      char* out =
        firstTo + bytes * static_cast<std::size_t>(z * SlotSideVoxels + y) * SlotSideVoxels;
      for (int x = parts[0].x; x < parts[0].y;)
      {
        // A run of voxels that are not repeated, or one that is.
        int end = x + 1;
        while (end < parts[0].y && within(end, 0) == within(x, 0) + end - x)
        {
          ++end;
        }
        std::memcpy(out + bytes * x, row + bytes * within(x, 0), bytes * (end - x));
        x = end;
      }
    }
  }
}
}

void BrickLoader::read(FinerLevels& levels, const BrickOrder& order, ReadBrick& read)
{
  const int side = levels.blockSide(order.fine.level);
  const glm::ivec3 place = order.fine.positionOf(read.brick);
  const glm::ivec3 low = place * StreamedSide - SlotBorder;
  const glm::ivec3 last = order.fine.voxels - 1;
  vtkSmartPointer<vtkDataArray> slot;
  forEachIndex(glm::max(low, glm::ivec3(0)) / side, glm::min(low + SlotSideVoxels - 1, last) / side,
    [&](const glm::ivec3& at) {
      const std::shared_ptr<const Block> found = this->blockAt(levels, order, at);
      const Block& block = *found;
      const Copied copied{ low, order.fine.voxels, block.first, block.size };
      slot = slot ? slot : slotLike(block.numbers);
      copyBlock(copied, block.numbers, slot);
      read.remark = read.remark.empty() ? block.remark : read.remark;
    });
  this->forgetOldBlocks();
  read.numbers = ScalarTexture::storedNumbers(slot, glm::ivec3(SlotSideVoxels), order.component);
  read.ranges = coveredRanges(read.numbers, place, order);
}
}
