// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/ZarrBox.h"

#include "Common/Bytes.h"
#include "Common/Parallel.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

namespace brainshift
{
namespace
{
using Index = std::vector<std::int64_t>;

constexpr double MostChunks = 4194304.0;       // 2^22: of a box; each costs a look into the store
constexpr double MostIndexBytes = 268435456.0; // 2^28: of the shards of a box
constexpr std::size_t BytesOfEntry = 16;       // of the index of a shard
constexpr std::size_t BytesOfChecksum = 4;
constexpr std::uint64_t NoChunk = std::numeric_limits<std::uint64_t>::max();

// The tiles of a grid that a box touches.
struct Tiles
{
  Index first;
  Index count;

  Tiles(const ZarrBox& box, const Index& tile)
  {
    for (std::size_t axis = 0; axis < tile.size(); ++axis)
    {
      const std::int64_t last = (box.first[axis] + box.count[axis] - 1) / tile[axis];
      this->first.push_back(box.first[axis] / tile[axis]);
      this->count.push_back(last - this->first.back() + 1);
    }
  }

  double number() const
  {
    double number = 1.0;
    for (const std::int64_t count : this->count)
    {
      number *= static_cast<double>(count);
    }
    return number;
  }

  // The tile of a number from 0 on.
  Index at(std::int64_t number) const
  {
    Index tile(this->first);
    for (std::size_t axis = tile.size(); axis-- > 0;)
    {
      tile[axis] += number % this->count[axis];
      number /= this->count[axis];
    }
    return tile;
  }
};

std::string keyOf(const ZarrArray& array, const Index& tile)
{
  std::string name = array.prefix;
  for (const std::int64_t number : tile)
  {
    name += (name.empty() ? "" : array.separator) + std::to_string(number);
  }
  return keyIn(array.path, name);
}

// The numbers of a chunk that are in a box.
struct Part
{
  Index count;
  std::int64_t from = 0; // numbers from the beginning of the chunk
  Index fromSteps;
  std::int64_t to = 0; // numbers from the beginning of the box
};

Part partOf(const ZarrArray& array, const ZarrBox& box, const Index& chunk)
{
  Part part{ Index(chunk.size()), 0, Index(chunk.size()), 0 };
  std::int64_t step = 1;
  for (std::size_t i = chunk.size(); i-- > 0;)
  {
    const auto axis = static_cast<std::size_t>(array.order[i]);
    part.fromSteps[axis] = step;
    step *= array.chunk[axis];
  }
  for (std::size_t axis = 0; axis < chunk.size(); ++axis)
  {
    const std::int64_t begin = chunk[axis] * array.chunk[axis];
    const std::int64_t first = std::max(begin, box.first[axis]);
    const std::int64_t end = std::min(begin + array.chunk[axis], box.first[axis] + box.count[axis]);
    part.count[axis] = end - first;
    part.from += (first - begin) * part.fromSteps[axis];
    part.to += (first - box.first[axis]) * box.steps[axis];
  }
  return part;
}

// Copies numbers along the last axes first. With `fromSteps` of 0, one number is copied everywhere.
template <typename Number>
void copyPart(const Number* from, Number* to, const Part& part, const Index& toSteps)
{
  const std::size_t last = part.count.size() - 1;
  Index at(part.count.size(), 0);
  from += part.from;
  to += part.to;
  for (bool isDone = false; !isDone;)
  {
    if (part.fromSteps[last] == 1 && toSteps[last] == 1)
    {
      std::memcpy(to, from, static_cast<std::size_t>(part.count[last]) * sizeof(Number));
    }
    else
    {
      for (std::int64_t i = 0; i < part.count[last]; ++i)
      {
        to[i * toSteps[last]] = from[i * part.fromSteps[last]];
      }
    }
    isDone = true;
    for (std::size_t axis = last; axis-- > 0 && isDone;)
    {
      isDone = ++at[axis] == part.count[axis];
      from += part.fromSteps[axis] * (isDone ? 1 - part.count[axis] : 1);
      to += toSteps[axis] * (isDone ? 1 - part.count[axis] : 1);
      at[axis] = isDone ? 0 : at[axis];
    }
  }
}

void copyNumbers(const char* from, std::size_t bytes, const Part& part, const ZarrBox& box)
{
  const auto copy = [&](auto number) {
    using Number = decltype(number);
    copyPart(reinterpret_cast<const Number*>(from), reinterpret_cast<Number*>(box.numbers), part,
      box.steps);
  };
  switch (bytes)
  {
    case 1:
      return copy(std::uint8_t());
    case 2:
      return copy(std::uint16_t());
    case 4:
      return copy(std::uint32_t());
    default:
      return copy(std::uint64_t());
  }
}

class BoxReader
{
public:
  BoxReader(const ZarrStore& store, const ZarrArray& array, const ZarrBox& box,
    std::vector<ZarrDamage>* damages)
    : Store(store)
    , Array(array)
    , Box(box)
    , Damages(damages)
    , Chunks(box, array.chunk)
  {
    if (this->Chunks.number() > MostChunks)
    {
      throw Problem(joined("array '", array.path, "' has ", this->Chunks.number(),
        " chunks where it is read; BrainShift reads up to ", MostChunks));
    }
  }

  // False: stopped.
  bool read(const std::function<bool(double)>& progress)
  {
    constexpr double IndexShare = 0.1; // of the time
    if (this->Array.hasShards() &&
      !this->readIndices([&](double fraction) { return progress(IndexShare * fraction); }))
    {
      return false;
    }
    const auto all = static_cast<std::int64_t>(this->Chunks.number());
    // Larger portions would keep a user waiting who wants to stop, smaller ones leave cores idle.
    const std::int64_t portion = std::min<std::int64_t>(all / 100 + 8, 4096);
    for (std::int64_t first = 0; first < all; first += portion)
    {
      if (!progress(static_cast<double>(first) / static_cast<double>(all)))
      {
        return false;
      }
      const std::int64_t last = std::min(first + portion, all);
      parallelFor(first, last, 1, [this](std::int64_t begin, std::int64_t end) {
        for (std::int64_t number = begin; number < end; ++number)
        {
          const Index chunk = this->Chunks.at(number);
          const std::string reason = problemOf([&] { this->readChunk(chunk); });
          if (!reason.empty())
          {
            this->note(chunk, reason);
          }
        }
      });
    }
    return true;
  }

private:
  const ZarrStore& Store;
  const ZarrArray& Array;
  const ZarrBox& Box;
  std::vector<ZarrDamage>* Damages; // null: the first is thrown
  mutable std::mutex Noting;
  Tiles Chunks;
  std::map<Index, std::string> Indices; // of the shards that are there
  std::map<Index, std::string> Lost;    // why the index of a shard cannot be read

  void note(const Index& chunk, const std::string& reason) const
  {
    if (!this->Damages)
    {
      throw Problem(reason);
    }
    const Part part = partOf(this->Array, this->Box, chunk);
    ZarrDamage damage{ this->Box, reason };
    for (std::size_t axis = 0; axis < chunk.size(); ++axis)
    {
      damage.part.first[axis] =
        std::max(chunk[axis] * this->Array.chunk[axis], this->Box.first[axis]);
    }
    damage.part.count = part.count;
    damage.isMissing = this->Array.hasAllChunks && !this->Array.hasShards() &&
      !this->Store.size(this->keyOfFile(chunk));
    damage.part.numbers += part.to * static_cast<std::int64_t>(this->Array.type.bytes);
    const std::lock_guard<std::mutex> lock(this->Noting);
    this->Damages->push_back(std::move(damage));
  }

  Index chunksInShard() const
  {
    Index count;
    for (std::size_t axis = 0; axis < this->Array.chunk.size(); ++axis)
    {
      count.push_back(this->Array.shards.shape[axis] / this->Array.chunk[axis]);
    }
    return count;
  }

  bool readIndices(const std::function<bool(double)>& progress)
  {
    const Tiles shards(this->Box, this->Array.shards.shape);
    double bytes = BytesOfEntry;
    for (const std::int64_t count : this->chunksInShard())
    {
      bytes *= static_cast<double>(count);
    }
    if (bytes * shards.number() > MostIndexBytes)
    {
      throw Problem(joined("array '", this->Array.path, "' has shards with indices of ",
        bytes * shards.number(), " bytes where it is read; the limit is ", MostIndexBytes));
    }
    const auto all = static_cast<std::int64_t>(shards.number());
    for (std::int64_t number = 0; number < all; ++number)
    {
      const Index shard = shards.at(number);
      const std::string key = keyOf(this->Array, shard);
      const std::string reason = problemOf([&] {
        withBeginning("shard '" + key + "' ",
          [&] { this->readIndex(shard, key, static_cast<std::size_t>(bytes)); });
      });
      if (!reason.empty())
      {
        throwIfAny(this->Damages ? std::string() : reason);
        this->Lost[shard] = reason;
      }
      if (!progress(static_cast<double>(number) / static_cast<double>(all)))
      {
        return false;
      }
    }
    return true;
  }

  void readIndex(const Index& shard, const std::string& key, std::size_t bytes)
  {
    const std::optional<std::uint64_t> size = this->Store.size(key);
    if (!size)
    {
      return;
    }
    const ZarrShards& shards = this->Array.shards;
    const std::size_t stored = bytes + (shards.indexHasChecksum ? BytesOfChecksum : 0);
    if (*size < stored)
    {
      throw Problem("has " + std::to_string(*size) + " bytes, fewer than its index, which has " +
        std::to_string(stored));
    }
    ZarrCodecs codecs;
    if (shards.indexHasChecksum)
    {
      addCodec("crc32c", codecs);
    }
    const std::uint64_t offset = shards.indexIsAtEnd ? *size - stored : 0;
    this->Indices[shard] = unpacked(codecs, this->Store.part(key, offset, stored), bytes);
  }

  void readChunk(const Index& chunk) const
  {
    if (!this->Lost.empty())
    {
      const auto lost = this->Lost.find(this->shardOf(chunk));
      throwIfAny(lost == this->Lost.end() ? std::string() : lost->second);
    }
    const Part part = partOf(this->Array, this->Box, chunk);
    const std::string key = this->keyOfFile(chunk);
    withBeginning(
      "chunk '" + key + "' " + (this->Array.hasShards() ? this->numbersText(chunk) : ""), [&] {
        const std::size_t bytes = this->Array.chunkBytes();
        std::optional<std::string> packed = this->Array.hasShards()
          ? this->packedInShard(chunk, key)
          : this->Store.read(key, mostPacked(bytes));
        if (!packed)
        {
          throwIfAny(this->Array.hasAllChunks ? "is missing" : "");
          Part same = part;
          same.from = 0;
          std::fill(same.fromSteps.begin(), same.fromSteps.end(), 0);
          copyNumbers(this->Array.fill.data(), this->Array.type.bytes, same, this->Box);
          return;
        }
        std::string numbers = unpacked(this->Array.codecs, std::move(*packed), bytes);
        toMachineOrder(numbers.data(), bytes / this->Array.type.bytes, this->Array.type.bytes,
          this->Array.isBigEndian);
        if (this->Array.type.isBoolean)
        {
          std::transform(numbers.begin(), numbers.end(), numbers.begin(),
            [](char byte) { return static_cast<char>(byte != 0); });
        }
        copyNumbers(numbers.data(), this->Array.type.bytes, part, this->Box);
      });
  }

  static std::string numbersText(const Index& chunk)
  {
    std::string text;
    for (const std::int64_t number : chunk)
    {
      text += (text.empty() ? "(" : ", ") + std::to_string(number);
    }
    return text + ") ";
  }

  Index shardOf(const Index& chunk) const
  {
    Index shard(chunk);
    const Index inShard = this->chunksInShard();
    for (std::size_t axis = 0; axis < shard.size(); ++axis)
    {
      shard[axis] /= inShard[axis];
    }
    return shard;
  }

  std::string keyOfFile(const Index& chunk) const
  {
    return keyOf(this->Array, this->Array.hasShards() ? this->shardOf(chunk) : chunk);
  }

  std::optional<std::string> packedInShard(const Index& chunk, const std::string& key) const
  {
    const auto index = this->Indices.find(this->shardOf(chunk));
    if (index == this->Indices.end())
    {
      return std::nullopt;
    }
    const Index inShard = this->chunksInShard();
    std::size_t entry = 0;
    for (std::size_t axis = 0; axis < chunk.size(); ++axis)
    {
      entry = entry * static_cast<std::size_t>(inShard[axis]) +
        static_cast<std::size_t>(chunk[axis] % inShard[axis]);
    }
    const char* const at = index->second.data() + entry * BytesOfEntry;
    const bool isBig = this->Array.shards.indexIsBigEndian;
    const auto offset = storedNumber<std::uint64_t>(at, isBig);
    const auto count = storedNumber<std::uint64_t>(at + BytesOfEntry / 2, isBig);
    if (offset == NoChunk && count == NoChunk)
    {
      return std::nullopt;
    }
    const std::uint64_t size = this->Store.size(key).value_or(0);
    const std::size_t most = mostPacked(this->Array.chunkBytes());
    if (offset > size || count > size - offset || count > most)
    {
      throw Problem("is said to have " + std::to_string(count) + " bytes from byte " +
        std::to_string(offset) + " on; the shard has " + std::to_string(size) +
        ", and the chunk may have up to " + std::to_string(most));
    }
    return this->Store.part(key, offset, count);
  }
};
}

std::string missingChunk(const ZarrStore& store, const ZarrArray& array)
{
  constexpr double MostLooks = 64.0;
  const ZarrBox all{ Index(array.shape.size(), 0), array.shape, nullptr, {} };
  const Tiles files(all, array.hasShards() ? array.shards.shape : array.chunk);
  const double looks = std::min(MostLooks, files.number());
  for (int i = 0; i < static_cast<int>(looks); ++i)
  {
    const auto file = static_cast<std::int64_t>((i + 0.5) / looks * files.number());
    if (store.size(keyOf(array, files.at(file))))
    {
      return {};
    }
  }
  return keyOf(array, files.first);
}

bool readZarrBox(const ZarrStore& store, const ZarrArray& array, const ZarrBox& box,
  const std::function<bool(double)>& progress, std::vector<ZarrDamage>* damages)
{
  return BoxReader(store, array, box, damages).read(progress);
}
}
