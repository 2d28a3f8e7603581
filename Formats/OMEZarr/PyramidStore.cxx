// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/PyramidStore.h"

#include "Common/Parallel.h"
#include "Common/Problem.h"
#include "Formats/Files/SystemPath.h"
#include "Formats/Files/Text.h"
#include "Formats/OMEZarr/ChunkWriter.h"
#include "Formats/OMEZarr/ZarrBox.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <random>
#include <thread>
#include <utility>

namespace fs = std::filesystem;

namespace brainshift
{
namespace
{
constexpr const char* Identity = "identity";
constexpr const char* WriterKey = "writer";
constexpr std::int64_t MostInRow = 16; // chunks that are made from one box in memory

// All chunks whose numbers along x, y, z are from `first` up to `end`.
template <typename Visit>
void forEachIn(const Size3& first, const Size3& end, const Visit& visit)
{
  for (std::int64_t z = first.z; z < end.z; ++z)
  {
    for (std::int64_t y = first.y; y < end.y; ++y)
    {
      for (std::int64_t x = first.x; x < end.x; ++x)
      {
        visit(Size3(x, y, z));
      }
    }
  }
}

std::string textOf(const Json& json)
{
  constexpr int Indent = 2;
  return json.dump(Indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string randomWord()
{
  std::random_device random;
  return joined(random(), "-", random(), "-", random());
}

void removeAll(const fs::path& path)
{
  std::error_code error;
  fs::remove_all(path, error);
  throwIfAny(
    error ? "'" + nameOfPath(path) + "' cannot be removed: " + error.message() : std::string());
}

// The folders of levels, the coarsest first, whether or not those between are there.
std::vector<fs::path> levelsIn(const fs::path& folder)
{
  std::error_code error;
  std::vector<fs::path> levels;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
    entry.increment(error))
  {
    const std::string name = nameOfPath(entry->path().filename());
    if (name.find_first_not_of("0123456789") == std::string::npos)
    {
      levels.push_back(entry->path());
    }
  }
  throwIfAny(error ? "its entries cannot be listed: " + error.message() : std::string());
  std::sort(levels.rbegin(), levels.rend(), [](const fs::path& one, const fs::path& other) {
    const std::string first = nameOfPath(one.filename());
    const std::string second = nameOfPath(other.filename());
    return std::make_pair(first.size(), first) < std::make_pair(second.size(), second);
  });
  return levels;
}

// Copies voxels of one channel into a chunk.
template <typename T>
void fill(const VoxelBox& from, const Size3& size, std::string& chunk)
{
  for (std::int64_t z = 0; z < size.z; ++z)
  {
    for (std::int64_t y = 0; y < size.y; ++y)
    {
      auto* to = reinterpret_cast<T*>(chunk.data()) + (z * PyramidChunk + y) * PyramidChunk;
      const T* voxel = reinterpret_cast<const T*>(from.first) + y * from.steps.y + z * from.steps.z;
      for (std::int64_t x = 0; x < size.x; ++x, voxel += from.steps.x)
      {
        *to++ = *voxel;
      }
    }
  }
}
}

PyramidStore::PyramidStore(std::string folder, PyramidContent content)
  : Folder(std::move(folder))
  , Content(std::move(content))
  , Writer(randomWord())
  , Levels(pyramidLevels(this->Content.grid))
{
  this->requireRoom();
  writeEntry(this->Folder, UnfinishedMark,
    textOf({ { Identity, this->identity() }, { WriterKey, this->Writer } }));
  const std::string group = this->Content.isVersion3 ? "zarr.json" : ".zgroup";
  Json empty = { { "zarr_format", this->Content.isVersion3 ? 3 : 2 } };
  if (this->Content.isVersion3)
  {
    empty["node_type"] = "group";
  }
  writeEntry(this->Folder, group, textOf(empty));
  this->Store = openFolderStore(this->Folder);
  this->describeLevels();
}

// What chunks can be compared with, and what coarser levels depend on beside them.
std::string PyramidStore::identity() const
{
  const PyramidContent& content = this->Content;
  std::string facts = joined(content.type, " ", content.components, " ", content.isLabelMap,
    content.isVersion3, content.knowsSides, " ");
  for (const double number : boxOf(content.grid))
  {
    facts += joined(std::setprecision(17), number, " ");
  }
  const glm::ivec3& size = content.grid.dimensions;
  return facts + joined(size.x, " ", size.y, " ", size.z);
}

// A folder is ours to change only if it is new, empty or an unfinished store.
void PyramidStore::requireRoom() const
{
  std::error_code error;
  const fs::path folder = systemPath(this->Folder);
  if (!fs::exists(folder, error))
  {
    return;
  }
  throwIfAny(fs::is_directory(folder, error) ? "" : "it exists and is no folder");
  if (fs::is_empty(folder, error))
  {
    return;
  }
  if (!fs::exists(folder / UnfinishedMark, error))
  {
    throw Problem("it exists and is not empty; choose another name, or delete it");
  }
  const std::optional<Json> mark = readJson(*openFolderStore(this->Folder), UnfinishedMark);
  if (mark && textIn(memberOf(*mark, Identity)) == this->identity())
  {
    return;
  }
  for (const char* name : { ".zattrs", ".zgroup", "zarr.json", "bricks" })
  {
    removeAll(folder / name);
  }
  for (const fs::path& level : levelsIn(folder))
  {
    removeAll(level);
  }
}

// A store that another one began or finished meanwhile is left to it.
void PyramidStore::requireOnlyWriter() const
{
  const std::optional<Json> mark = readJson(*this->Store, UnfinishedMark);
  if (!mark || textIn(memberOf(*mark, WriterKey)) != this->Writer)
  {
    throw Problem("Store " + this->Folder +
      " is being written by another program, which goes on; write this volume under another name");
  }
}

void PyramidStore::removeCoarser() const
{
  const fs::path folder = systemPath(this->Folder);
  for (const fs::path& level : levelsIn(folder))
  {
    if (level.filename() != "0")
    {
      removeAll(level);
    }
  }
  for (std::size_t i = 1; i < this->Levels.size(); ++i)
  {
    const PyramidFile array = pyramidArray(this->Content, this->Levels, i);
    writeEntry(this->Folder, array.key, textOf(array.json));
  }
}

void PyramidStore::describeLevels()
{
  const auto channels = static_cast<std::size_t>(this->Content.components);
  for (std::size_t i = 0; i < this->Levels.size(); ++i)
  {
    const PyramidFile array = pyramidArray(this->Content, this->Levels, i);
    writeEntry(this->Folder, array.key, textOf(array.json));
    this->Arrays.push_back(readZarrArray(*this->Store, std::to_string(i)));
    this->Arrays.back().hasAllChunks = true;
    const glm::ivec3 count = chunksOf(this->Levels[i]);
    const std::size_t chunks = channels * static_cast<std::size_t>(count.x) *
      static_cast<std::size_t>(count.y) * static_cast<std::size_t>(count.z);
    this->Ranges.emplace_back(chunks);
    this->All += i > 0 ? static_cast<double>(chunks) : 0.0;
  }
}

std::size_t PyramidStore::numberOf(const Chunk& chunk) const
{
  const Size3 count(chunksOf(this->Levels[chunk.level]));
  return static_cast<std::size_t>(
    ((chunk.channel * count.z + chunk.at.z) * count.y + chunk.at.y) * count.x + chunk.at.x);
}

std::string PyramidStore::keyOf(const Chunk& chunk) const
{
  const auto part = [](std::int64_t number) { return "/" + std::to_string(number); };
  return std::to_string(chunk.level) + (this->Content.isVersion3 ? "/c" : "") +
    (this->Content.components > 1 ? part(chunk.channel) : "") + part(chunk.at.z) +
    part(chunk.at.y) + part(chunk.at.x);
}

Size3 PyramidStore::sizeOf(const Chunk& chunk) const
{
  const Size3 size(this->Levels[chunk.level].size);
  return glm::min(size - chunk.at * PyramidChunk, Size3(PyramidChunk));
}

// What cannot be unpacked counts as not there, and is written again.
std::optional<std::string> PyramidStore::numbersThere(const Chunk& chunk) const
{
  const ZarrArray& array = this->Arrays[chunk.level];
  const std::size_t bytes = array.chunkBytes();
  std::optional<std::string> numbers;
  problemOf([&] {
    std::optional<std::string> packed = this->Store->read(this->keyOf(chunk), mostPacked(bytes));
    if (packed)
    {
      numbers = unpacked(array.codecs, std::move(*packed), bytes);
    }
  });
  return numbers;
}

bool PyramidStore::takeIfThere(const Chunk& chunk)
{
  const std::optional<std::string> numbers = this->numbersThere(chunk);
  if (numbers)
  {
    this->note(chunk, *numbers);
  }
  return numbers.has_value();
}

void PyramidStore::note(const Chunk& chunk, const std::string& bytes)
{
  const std::size_t number = this->numberOf(chunk);
  this->Ranges[chunk.level][number] = rangeOf(this->Content.type,
    { bytes.data(), this->sizeOf(chunk), { 1, PyramidChunk, PyramidChunk * PyramidChunk } });
}

void PyramidStore::put(const Chunk& chunk, const std::string& bytes)
{
  this->requireOnlyWriter();
  writeEntry(
    this->Folder, this->keyOf(chunk), packedChunk(bytes, this->Arrays[chunk.level].type.bytes));
  this->note(chunk, bytes);
}

std::vector<PyramidStore::Chunk> PyramidStore::chunksIn(
  std::size_t level, const Size3& first, const Size3& end) const
{
  std::vector<Chunk> chunks;
  for (int channel = 0; channel < this->Content.components; ++channel)
  {
    forEachIn(first, end, [&](const Size3& at) { chunks.push_back({ level, channel, at }); });
  }
  return chunks;
}

bool PyramidStore::write(const PyramidPiece& piece, const Going& going)
{
  const Size3 end =
    (piece.first + piece.voxels.size - std::int64_t(1)) / PyramidChunk + std::int64_t(1);
  const std::vector<Chunk> chunks = this->chunksIn(0, piece.first / PyramidChunk, end);
  // Larger portions would keep a user waiting who wants to stop.
  const std::size_t portion = 4 * std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t first = 0; first < chunks.size(); first += portion)
  {
    if (!going(static_cast<double>(first) / static_cast<double>(chunks.size())))
    {
      return false;
    }
    const std::size_t last = std::min(first + portion, chunks.size());
    parallelFor(static_cast<std::int64_t>(first), static_cast<std::int64_t>(last), 1,
      [&](std::int64_t begin, std::int64_t until) {
        for (std::int64_t i = begin; i < until; ++i)
        {
          this->writeChunk(chunks[static_cast<std::size_t>(i)], piece);
        }
      });
  }
  return true;
}

void PyramidStore::writeChunk(const Chunk& chunk, const PyramidPiece& piece)
{
  const ZarrArray& array = this->Arrays[chunk.level];
  std::string bytes(array.chunkBytes(), '\0');
  const Size3 away = chunk.at * PyramidChunk - piece.first;
  VoxelBox from = piece.voxels;
  from.first +=
    (away.x * from.steps.x + away.y * from.steps.y + away.z * from.steps.z + chunk.channel) *
    static_cast<std::int64_t>(array.type.bytes);
  switch (array.type.bytes)
  {
    case 1:
      fill<std::uint8_t>(from, this->sizeOf(chunk), bytes);
      break;
    case 2:
      fill<std::uint16_t>(from, this->sizeOf(chunk), bytes);
      break;
    case 4:
      fill<std::uint32_t>(from, this->sizeOf(chunk), bytes);
      break;
    default:
      fill<std::uint64_t>(from, this->sizeOf(chunk), bytes);
  }
  if (this->numbersThere(chunk) == bytes)
  {
    this->note(chunk, bytes);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(this->Writing);
    if (this->Written == 0)
    {
      this->requireOnlyWriter();
      this->removeCoarser();
    }
    ++this->Written;
  }
  this->put(chunk, bytes);
}

bool PyramidStore::finish(const Going& going)
{
  for (std::size_t level = 1; level < this->Levels.size(); ++level)
  {
    if (!this->makeLevel(level, going))
    {
      return false;
    }
  }
  this->requireOnlyWriter();
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    this->writeBricks(level);
  }
  this->takeRanges();
  const PyramidFile group = pyramidGroup(this->Content, this->Levels);
  writeEntry(this->Folder, group.key, textOf(group.json));
  std::error_code error;
  fs::remove(systemPath(this->Folder) / UnfinishedMark, error);
  throwIfAny(error ? "'" + std::string(UnfinishedMark) + "' cannot be removed: " + error.message()
                   : std::string());
  return true;
}

// Least and greatest number of each channel.
void PyramidStore::takeRanges()
{
  const std::size_t each =
    this->Ranges[0].size() / static_cast<std::size_t>(this->Content.components);
  this->Content.ranges.clear();
  for (std::size_t first = 0; first < this->Ranges[0].size(); first += each)
  {
    Range whole{ 0.0, 0.0 };
    bool hasAny = false;
    for (std::size_t i = first; i < first + each; ++i)
    {
      const Range& range = this->Ranges[0][i];
      if (range[0] <= range[1]) // no NaN
      {
        whole = { hasAny ? std::min(whole[0], range[0]) : range[0],
          hasAny ? std::max(whole[1], range[1]) : range[1] };
        hasAny = true;
      }
    }
    this->Content.ranges.push_back(whole);
  }
}

bool PyramidStore::makeLevel(std::size_t level, const Going& going)
{
  const Size3 count(chunksOf(this->Levels[level]));
  for (int channel = 0; channel < this->Content.components; ++channel)
  {
    for (std::int64_t row = 0; row < count.y * count.z; ++row)
    {
      for (std::int64_t x = 0; x < count.x; x += MostInRow)
      {
        if (!going(this->Done / this->All))
        {
          return false;
        }
        const std::int64_t many = std::min(MostInRow, count.x - x);
        this->makeRow({ level, channel, { x, row % count.y, row / count.y } }, many);
        this->Done += static_cast<double>(many);
      }
    }
  }
  return true;
}

// Makes chunks that follow each other along x from a box of the finer level.
void PyramidStore::makeRow(const Chunk& chunk, std::int64_t many)
{
  std::vector<Chunk> missing;
  for (std::int64_t i = 0; i < many; ++i)
  {
    const Chunk one{ chunk.level, chunk.channel, chunk.at + Size3(i, 0, 0) };
    if (!this->takeIfThere(one))
    {
      missing.push_back(one);
    }
  }
  if (missing.empty())
  {
    return;
  }
  const PyramidLevel& finer = this->Levels[chunk.level - 1];
  const HalvingWay way{ this->Content.type, this->Levels[chunk.level].step / finer.step,
    this->Content.isLabelMap ? Halving::MostFrequent : Halving::Mean };
  const Size3 first = chunk.at * PyramidChunk * Size3(way.step);
  const Size3 size =
    glm::min(Size3(finer.size) - first, Size3(many, 1, 1) * PyramidChunk * Size3(way.step));
  const std::string numbers = this->numbersOf(chunk.level - 1, chunk.channel, first, size);
  const VoxelBox box{ numbers.data(), size, { 1, size.x, size.x * size.y } };
  parallelFor(
    0, static_cast<std::int64_t>(missing.size()), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Chunk& one = missing[static_cast<std::size_t>(i)];
        std::string bytes(this->Arrays[one.level].chunkBytes(), '\0');
        halve(box, way, { (one.at - chunk.at) * PyramidChunk, this->sizeOf(one), bytes.data() });
        this->put(one, bytes);
      }
    });
}

// Numbers of a level, x fastest.
std::string PyramidStore::numbersOf(
  std::size_t level, int channel, const Size3& first, const Size3& size) const
{
  const ZarrArray& array = this->Arrays[level];
  std::string numbers(static_cast<std::size_t>(size.x * size.y * size.z) * array.type.bytes, '\0');
  ZarrBox box{ { first.z, first.y, first.x }, { size.z, size.y, size.x }, numbers.data(),
    { size.x * size.y, size.x, 1 } };
  if (this->Content.components > 1)
  {
    box.first.insert(box.first.begin(), channel);
    box.count.insert(box.count.begin(), 1);
    box.steps.insert(box.steps.begin(), 0);
  }
  readZarrBox(*this->Store, array, box, [](double) { return true; });
  return numbers;
}

void PyramidStore::writeBricks(std::size_t level) const
{
  const PyramidFile array = pyramidBricks(this->Content, this->Levels, level);
  writeEntry(this->Folder, array.key, textOf(array.json));
  const std::string folder = "bricks/" + std::to_string(level);
  const std::string axes = this->Content.components > 1 ? "/0/0/0/0/0" : "/0/0/0/0";
  const std::vector<Range>& ranges = this->Ranges[level];
  const std::string bytes(
    reinterpret_cast<const char*>(ranges.data()), ranges.size() * sizeof(Range));
  writeEntry(this->Folder, folder + (this->Content.isVersion3 ? "/c" : "") + axes,
    packedChunk(bytes, sizeof(double)));
}
}
