// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/ZipFile.h"

#include "Common/Bytes.h"
#include "Common/Problem.h"
#include "Formats/Files/Inflate.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <filesystem>
#include <limits>

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

constexpr double MostUnpacked = 1032.0; // bytes of one deflated byte

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

std::uint32_t checksumOf(const char* bytes, std::size_t count)
{
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes), count));
}

void requireChecksum(const std::string& bytes, std::uint32_t checksum)
{
  throwIfAny(checksumOf(bytes.data(), bytes.size()) == checksum
      ? ""
      : "is damaged: its checksum in the zip file is another");
}
}

ZipFile::ZipFile(const std::string& fileName)
  : FileName(fileName)
  , FileSize(std::filesystem::file_size(fileName))
{
  const ZipDirectory directory = directoryOf(fileName, this->FileSize);
  const std::string bytes = fileBytes(fileName, directory.offset, directory.size);
  for (std::uint64_t at = 0; at + EntryBytes <= bytes.size();)
  {
    at += this->addEntry(bytes, at);
  }
}

std::vector<std::string> ZipFile::names() const
{
  std::vector<std::string> names;
  names.reserve(this->Entries.size());
  for (const auto& [name, entry] : this->Entries)
  {
    names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::uint64_t> ZipFile::size(const std::string& name) const
{
  const auto found = this->Entries.find(name);
  return found == this->Entries.end() ? std::nullopt
                                      : std::optional<std::uint64_t>(found->second.size);
}

std::string ZipFile::part(const std::string& name, std::uint64_t offset, std::uint64_t count) const
{
  const Entry& entry = this->Entries.at(name);
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
    throw Problem("is packed in the zip file, of which a part is wanted; make the zip file without "
                  "packing");
  }
  if (static_cast<double>(entry.size) > MostUnpacked * static_cast<double>(entry.packed) + 64.0)
  {
    throw Problem("is said to have " + std::to_string(entry.size) + " bytes in " +
      std::to_string(entry.packed) + " of the zip file, which cannot be");
  }
  const std::string packed = fileBytes(this->FileName, begin, entry.packed);
  std::string bytes = inflated(packed, entry.size, Inflate::Raw);
  requireChecksum(bytes, entry.checksum);
  return bytes;
}

// Puts the numbers of more than 32 bits of an entry in their places.
void ZipFile::takeLargeNumbers(const std::string& extra, Entry& entry)
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

// Returns the bytes of its record.
std::uint64_t ZipFile::addEntry(const std::string& bytes, std::uint64_t at)
{
  if (numberAt<std::uint32_t>(bytes, at) != EntryMark)
  {
    throw Problem("is no good zip file: its directory has something else than entries");
  }
  Entry entry;
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
    throw Problem("is no good zip file: it has the entry " + shownWords(key) + " twice");
  }
  return size;
}

// Where the bytes of an entry begin, which are all in the file.
std::uint64_t ZipFile::beginOf(const Entry& entry) const
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

namespace
{
// Numbers of a record, little-endian.
class Record
{
public:
  Record& two(std::uint64_t number) { return this->add(number, 2); }
  Record& four(std::uint64_t number) { return this->add(number, 4); }
  const std::string& bytes() const { return this->Bytes; }

private:
  Record& add(std::uint64_t number, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      this->Bytes += static_cast<char>(number >> 8 * i & 0xff);
    }
    return *this;
  }

  std::string Bytes;
};

constexpr std::uint64_t MostFiles = 65534;
constexpr std::uint64_t Version = 20;  // of the format: folders, deflate
constexpr std::uint64_t Utf8 = 0x0800; // names
constexpr std::uint64_t Day = 0x21;    // 1 January 1980, the first that the format knows
}

void writeZip(const std::vector<NamedBytes>& files, std::ostream& to)
{
  std::uint64_t place = 0;
  std::string entries;
  for (const NamedBytes& file : files)
  {
    const std::uint64_t size = file.bytes.size();
    if (place + size > std::numeric_limits<std::uint32_t>::max() || files.size() > MostFiles)
    {
      throw Problem("it would have more than 4 GiB or 65534 parts, which such a file cannot have");
    }
    Record shared;
    shared.two(Version).two(Utf8).two(0).two(0).two(Day).four(checksumOf(file.bytes.data(), size));
    shared.four(size).four(size).two(file.name.size()).two(0);
    const std::string local = Record().four(LocalMark).bytes() + shared.bytes() + file.name;
    to << local;
    to.write(file.bytes.data(), static_cast<std::streamsize>(size));
    entries += Record().four(EntryMark).two(Version).bytes() + shared.bytes() +
      Record().two(0).two(0).two(0).four(0).four(place).bytes() + file.name;
    place += local.size() + size;
  }
  to << entries << Record().four(EndMark).two(0).two(0).two(files.size()).two(files.size()).bytes()
     << Record().four(entries.size()).four(place).two(0).bytes();
}
}
