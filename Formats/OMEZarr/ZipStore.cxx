// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A zarr store in a zip file, also one of more than 4 GiB (zip64): entries are stored or deflated.
#include "Common/Bytes.h"
#include "Common/Problem.h"
#include "Formats/OMEZarr/Inflate.h"
#include "Formats/OMEZarr/ZarrStore.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

namespace brainshift
{
namespace
{
// Bytes of the records of a zip file, and what they begin with.
constexpr std::uint64_t EndBytes = 22;
constexpr std::uint64_t LocatorBytes = 20;
constexpr std::uint64_t LargeEndBytes = 56;
constexpr std::uint64_t EntryBytes = 46;
constexpr std::uint64_t LocalBytes = 30;
constexpr std::uint32_t EndMark = 0x06054b50;
constexpr std::uint32_t LocatorMark = 0x07064b50;
constexpr std::uint32_t LargeEndMark = 0x06064b50;
constexpr std::uint32_t EntryMark = 0x02014b50;
constexpr std::uint32_t LocalMark = 0x04034b50;

constexpr std::uint64_t MostComment = 0xffff;
constexpr std::uint32_t InExtra = 0xffffffff; // the number is in the field of zip64
constexpr std::uint64_t MostDirectory = std::uint64_t(1) << 29; // bytes: 5 million entries
constexpr int Deflated = 8;

struct ZipEntry
{
  std::uint64_t header = 0; // where its local header begins
  std::uint64_t packed = 0; // bytes
  std::uint64_t size = 0;   // bytes, unpacked
  std::uint32_t checksum = 0;
  int method = 0;
  bool isEncrypted = false;
};

template <typename Number>
Number numberAt(const std::string& bytes, std::uint64_t offset)
{
  const std::optional<Number> number = storedNumberAt<Number>(bytes, offset, false);
  if (!number)
  {
    throw Problem("is no whole zip file: a record of its directory is cut off");
  }
  return *number;
}

struct ZipDirectory
{
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

// What the last records of a file say of its directory.
ZipDirectory directoryOf(const std::string& fileName, std::uint64_t fileSize)
{
  const std::uint64_t tailSize = std::min(fileSize, EndBytes + MostComment + LocatorBytes);
  const std::string tail = fileBytes(fileName, fileSize - tailSize, tailSize);
  const std::size_t end = tail.rfind("PK\5\6");
  if (end == std::string::npos)
  {
    throw Problem("is no whole zip file: it has no directory at its end");
  }
  ZipDirectory directory{ numberAt<std::uint32_t>(tail, end + 16),
    numberAt<std::uint32_t>(tail, end + 12) };
  if (end >= LocatorBytes && numberAt<std::uint32_t>(tail, end - LocatorBytes) == LocatorMark)
  {
    const auto at = numberAt<std::uint64_t>(tail, end - LocatorBytes + 8);
    if (fileSize < LargeEndBytes || at > fileSize - LargeEndBytes)
    {
      throw Problem("is no whole zip file: its directory is said to be outside");
    }
    const std::string record = fileBytes(fileName, at, LargeEndBytes);
    if (numberAt<std::uint32_t>(record, 0) != LargeEndMark)
    {
      throw Problem("is no good zip file: its directory is not where it is said to be");
    }
    directory = { numberAt<std::uint64_t>(record, 48), numberAt<std::uint64_t>(record, 40) };
  }
  if (directory.size > MostDirectory || directory.size > fileSize ||
    directory.offset > fileSize - directory.size)
  {
    throw Problem("has a zip directory of " + std::to_string(directory.size) +
      " bytes; it must be in the file and may have up to " + std::to_string(MostDirectory));
  }
  return directory;
}

// Puts the numbers of more than 32 bits of an entry in their places.
void takeLargeNumbers(const std::string& extra, ZipEntry& entry)
{
  constexpr int LargeNumbers = 1;
  for (std::size_t at = 0; at + 4 <= extra.size();)
  {
    const auto kind = numberAt<std::uint16_t>(extra, at);
    const auto size = numberAt<std::uint16_t>(extra, at + 2);
    std::size_t next = at + 4;
    for (std::uint64_t* number : { &entry.size, &entry.packed, &entry.header })
    {
      if (kind == LargeNumbers && *number == InExtra)
      {
        *number = numberAt<std::uint64_t>(extra, next);
        next += 8;
      }
    }
    at += 4 + size;
  }
}

class ZipStore : public ZarrStore
{
public:
  explicit ZipStore(const std::string& fileName)
    : FileName(fileName)
    , FileSize(std::filesystem::file_size(fileName))
  {
    const ZipDirectory directory = directoryOf(fileName, this->FileSize);
    const std::string bytes = fileBytes(fileName, directory.offset, directory.size);
    for (std::uint64_t at = 0; at + EntryBytes <= bytes.size();)
    {
      at += this->addEntry(bytes, at);
    }
    this->findTop();
  }

  std::optional<std::uint64_t> size(const std::string& key) const override
  {
    const auto found = this->Entries.find(this->Top + key);
    return found == this->Entries.end() ? std::nullopt
                                        : std::optional<std::uint64_t>(found->second.size);
  }

  std::string part(const std::string& key, std::uint64_t offset, std::uint64_t count) const override
  {
    const ZipEntry& entry = this->Entries.at(this->Top + key);
    const std::uint64_t begin = this->beginOf(entry);
    const bool isWhole = offset == 0 && count == entry.size;
    if (entry.method != Deflated)
    {
      std::string bytes = fileBytes(this->FileName, begin + offset, count);
      if (isWhole)
      {
        requireChecksum(bytes, entry.checksum);
      }
      return bytes;
    }
    if (!isWhole)
    {
      throw Problem("is a shard that is packed in the zip file; make the zip file without packing");
    }
    const std::string packed = fileBytes(this->FileName, begin, entry.packed);
    std::string bytes = inflated(packed, entry.size, Inflate::Raw);
    requireChecksum(bytes, entry.checksum);
    return bytes;
  }

private:
  std::string FileName;
  std::uint64_t FileSize;
  std::unordered_map<std::string, ZipEntry> Entries;
  std::string Top; // before the keys

  static void requireChecksum(const std::string& bytes, std::uint32_t checksum)
  {
    const uLong found = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    throwIfAny(found == checksum ? "" : "is damaged: its checksum in the zip file is another");
  }

  // Returns the bytes of its record.
  std::uint64_t addEntry(const std::string& bytes, std::uint64_t at)
  {
    if (numberAt<std::uint32_t>(bytes, at) != EntryMark)
    {
      throw Problem("is no good zip file: its directory has something else than entries");
    }
    ZipEntry entry;
    entry.isEncrypted = (numberAt<std::uint16_t>(bytes, at + 8) & 1) != 0;
    entry.method = numberAt<std::uint16_t>(bytes, at + 10);
    entry.checksum = numberAt<std::uint32_t>(bytes, at + 16);
    entry.packed = numberAt<std::uint32_t>(bytes, at + 20);
    entry.size = numberAt<std::uint32_t>(bytes, at + 24);
    entry.header = numberAt<std::uint32_t>(bytes, at + 42);
    const std::uint64_t name = numberAt<std::uint16_t>(bytes, at + 28);
    const std::uint64_t extra = numberAt<std::uint16_t>(bytes, at + 30);
    const std::uint64_t comment = numberAt<std::uint16_t>(bytes, at + 32);
    const std::uint64_t size = EntryBytes + name + extra + comment;
    if (size > bytes.size() - at)
    {
      throw Problem("is no whole zip file: an entry of its directory is cut off");
    }
    takeLargeNumbers(bytes.substr(at + EntryBytes + name, extra), entry);
    const std::string key = bytes.substr(at + EntryBytes, name);
    if (!key.empty() && key.back() != '/' && !this->Entries.emplace(key, entry).second)
    {
      throw Problem("is no good zip file: it has an entry twice");
    }
    return size;
  }

  // The outermost folder with metadata; the first by the alphabet of several.
  void findTop()
  {
    std::optional<std::string> top;
    std::ptrdiff_t least = 0;
    for (const auto& [key, entry] : this->Entries)
    {
      const std::size_t slash = key.rfind('/');
      const std::string name = key.substr(slash == std::string::npos ? 0 : slash + 1);
      const std::string folder = key.substr(0, key.size() - name.size());
      const std::ptrdiff_t depth = std::count(folder.begin(), folder.end(), '/');
      const bool isMetadata = name == "zarr.json" || name == ".zattrs" || name == ".zgroup";
      if (isMetadata && (!top || depth < least || (depth == least && folder < *top)))
      {
        top = folder;
        least = depth;
      }
    }
    this->Top = top.value_or("");
  }

  // Where the bytes of an entry begin, which are all in the file.
  std::uint64_t beginOf(const ZipEntry& entry) const
  {
    if (entry.isEncrypted || (entry.method != 0 && entry.method != Deflated) ||
      (entry.method == 0 && entry.packed != entry.size))
    {
      throw Problem("is packed by the method " + std::to_string(entry.method) +
        (entry.isEncrypted ? " and encrypted" : "") +
        " of zip; BrainShift reads 0 (stored) and 8 (deflated)");
    }
    if (this->FileSize < LocalBytes || entry.header > this->FileSize - LocalBytes)
    {
      throw Problem("is said to be outside of the zip file");
    }
    const std::string local = fileBytes(this->FileName, entry.header, LocalBytes);
    if (numberAt<std::uint32_t>(local, 0) != LocalMark)
    {
      throw Problem("is not where the zip file says");
    }
    const std::uint64_t begin = entry.header + LocalBytes + numberAt<std::uint16_t>(local, 26) +
      numberAt<std::uint16_t>(local, 28);
    if (begin > this->FileSize || entry.packed > this->FileSize - begin)
    {
      throw Problem("is cut off: the zip file ends before it does");
    }
    return begin;
  }
};
}

std::unique_ptr<ZarrStore> openZipStore(const std::string& fileName)
{
  return std::make_unique<ZipStore>(fileName);
}
}
