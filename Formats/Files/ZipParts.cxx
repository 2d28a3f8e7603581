// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/ZipParts.h"

#include "Common/Bytes.h"
#include "Common/HostMemory.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <limits>

namespace brainshift
{
namespace
{
constexpr std::uint32_t LocalHeader = 0x04034b50;
constexpr std::uint32_t Entry = 0x02014b50;
constexpr std::uint32_t End = 0x06054b50;
constexpr std::uint32_t End64 = 0x06064b50;
constexpr std::uint32_t End64Locator = 0x07064b50;
constexpr std::size_t LocalBytes = 30;
constexpr std::size_t EntryBytes = 46;
constexpr std::size_t EndBytes = 22;
constexpr std::size_t LongestComment = 65535;
constexpr std::uint64_t MostParts = 65536;
constexpr double MostUnpacked = 1032.0; // bytes of one deflated byte
constexpr std::uint16_t Deflated = 8;

// Numbers of an archive at a place that may be anywhere.
class Reader
{
public:
  explicit Reader(const std::vector<char>& archive)
    : Archive(archive)
  {
  }

  template <typename T>
  T at(std::uint64_t place) const
  {
    this->require(place, sizeof(T));
    return storedNumber<T>(this->Archive.data() + place, false);
  }

  std::string text(std::uint64_t place, std::size_t count) const
  {
    this->require(place, count);
    return { this->Archive.data() + place, count };
  }

  void require(std::uint64_t place, std::uint64_t count) const
  {
    const std::uint64_t size = this->Archive.size();
    if (place > size || count > size - place)
    {
      throw Problem("is a damaged zip archive: " + std::to_string(count) + " bytes at byte " +
        std::to_string(place) + " are beyond its end at " + std::to_string(size));
    }
  }

private:
  const std::vector<char>& Archive;
};

// Where the record is that ends an archive.
std::uint64_t endOf(const std::vector<char>& archive, const Reader& reader)
{
  const std::uint64_t size = archive.size();
  for (std::uint64_t back = EndBytes; back <= std::min(size, EndBytes + LongestComment + 0ul);
    ++back)
  {
    if (reader.at<std::uint32_t>(size - back) == End)
    {
      return size - back;
    }
  }
  throw Problem("is no whole zip archive: it has no end record");
}

// The number and the place of the entries.
struct Directory
{
  std::uint64_t count = 0;
  std::uint64_t place = 0;
};

Directory directoryOf(const std::vector<char>& archive, const Reader& reader)
{
  const std::uint64_t end = endOf(archive, reader);
  Directory found{ reader.at<std::uint16_t>(end + 10), reader.at<std::uint32_t>(end + 16) };
  const bool isLong = found.count == std::numeric_limits<std::uint16_t>::max() ||
    found.place == std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint64_t LocatorBytes = 20;
  if (isLong && end >= LocatorBytes && reader.at<std::uint32_t>(end - LocatorBytes) == End64Locator)
  {
    const auto end64 = reader.at<std::uint64_t>(end - LocatorBytes + 8);
    throwIfAny(reader.at<std::uint32_t>(end64) == End64
        ? ""
        : "is a damaged zip archive: its zip64 end record is not where it must be");
    found = { reader.at<std::uint64_t>(end64 + 32), reader.at<std::uint64_t>(end64 + 48) };
  }
  if (found.count > MostParts)
  {
    throw Problem("has " + std::to_string(found.count) + " files in its zip archive; it may have " +
      std::to_string(MostParts));
  }
  return found;
}

// Sizes beyond 4 GiB are in an extra field, those that are there in this order.
void takeLongSizes(const Reader& reader, std::uint64_t place, std::uint64_t end, ZipPart& part)
{
  constexpr std::uint16_t Zip64 = 1;
  constexpr std::uint64_t Long = std::numeric_limits<std::uint32_t>::max();
  while (place + 4 <= end)
  {
    const auto kind = reader.at<std::uint16_t>(place);
    const auto size = reader.at<std::uint16_t>(place + 2);
    std::uint64_t at = place + 4;
    for (std::uint64_t* number : { &part.unpacked, &part.packed, &part.offset })
    {
      if (kind == Zip64 && *number == Long)
      {
        *number = reader.at<std::uint64_t>(at);
        at += sizeof(std::uint64_t);
      }
    }
    place += 4 + std::uint64_t(size);
  }
}

ZipPart entryAt(const Reader& reader, std::uint64_t place)
{
  ZipPart part;
  const auto flags = reader.at<std::uint16_t>(place + 8);
  const auto method = reader.at<std::uint16_t>(place + 10);
  part.checksum = reader.at<std::uint32_t>(place + 16);
  part.packed = reader.at<std::uint32_t>(place + 20);
  part.unpacked = reader.at<std::uint32_t>(place + 24);
  part.offset = reader.at<std::uint32_t>(place + 42);
  part.name = reader.text(place + EntryBytes, reader.at<std::uint16_t>(place + 28));
  const std::uint64_t extra = place + EntryBytes + part.name.size();
  takeLongSizes(reader, extra, extra + reader.at<std::uint16_t>(place + 30), part);
  part.isDeflated = method == Deflated;
  if ((flags & 1) != 0 || (method != 0 && method != Deflated))
  {
    throw Problem("has the file " + shownWords(part.name) + " in its zip archive, which is " +
      ((flags & 1) != 0 ? "encrypted" : "packed by method " + std::to_string(method)) +
      "; it must be stored or deflated");
  }
  return part;
}

void inflatePart(const char* from, const ZipPart& part, std::vector<char>& to)
{
  z_stream stream{};
  bool isWhole = inflateInit2(&stream, -MAX_WBITS) == Z_OK; // without a header
  constexpr std::uint64_t Piece = 1 << 30;
  std::uint64_t taken = 0;
  std::uint64_t made = 0;
  int result = isWhole ? Z_OK : Z_DATA_ERROR;
  while (result == Z_OK)
  {
    const std::uint64_t in = std::min(Piece, part.packed - taken);
    const std::uint64_t out = std::min(Piece, part.unpacked - made);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from)) + taken;
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(to.data()) + made;
    stream.avail_out = static_cast<uInt>(out);
    result = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += out - stream.avail_out;
    if (result == Z_OK && in == stream.avail_in && out == stream.avail_out)
    {
      result = Z_BUF_ERROR; // nothing moves any more
    }
  }
  inflateEnd(&stream);
  isWhole = isWhole && result == Z_STREAM_END && made == part.unpacked;
  throwIfAny(isWhole ? ""
                     : "has a damaged file " + shownWords(part.name) +
        " in its zip archive: it cannot be inflated to " + std::to_string(part.unpacked) +
        " bytes");
}

std::uint32_t checksumOf(const std::vector<char>& bytes)
{
  constexpr std::size_t Piece = 1 << 30;
  uLong sum = crc32(0, nullptr, 0);
  for (std::size_t at = 0; at < bytes.size(); at += Piece)
  {
    sum = crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()) + at,
      static_cast<uInt>(std::min(Piece, bytes.size() - at)));
  }
  return static_cast<std::uint32_t>(sum);
}
}

std::vector<ZipPart> zipPartsOf(const std::vector<char>& archive)
{
  const Reader reader(archive);
  const Directory directory = directoryOf(archive, reader);
  std::vector<ZipPart> parts;
  std::uint64_t place = directory.place;
  for (std::uint64_t i = 0; i < directory.count; ++i)
  {
    if (reader.at<std::uint32_t>(place) != Entry)
    {
      throw Problem(
        "is a damaged zip archive: its entry " + std::to_string(i) + " is not where it must be");
    }
    const ZipPart part = entryAt(reader, place);
    if (!part.name.empty() && part.name.back() != '/')
    {
      parts.push_back(part);
    }
    place += EntryBytes + std::uint64_t(reader.at<std::uint16_t>(place + 28)) +
      reader.at<std::uint16_t>(place + 30) + reader.at<std::uint16_t>(place + 32);
  }
  return parts;
}

std::vector<char> unpackedPart(const std::vector<char>& archive, const ZipPart& part)
{
  const Reader reader(archive);
  if (reader.at<std::uint32_t>(part.offset) != LocalHeader)
  {
    throw Problem(
      "is a damaged zip archive: the file " + shownWords(part.name) + " is not where it must be");
  }
  const std::uint64_t first = part.offset + LocalBytes +
    reader.at<std::uint16_t>(part.offset + 26) + reader.at<std::uint16_t>(part.offset + 28);
  reader.require(first, part.packed);
  const auto most = MostUnpacked * static_cast<double>(part.packed) + 64.0;
  if (static_cast<double>(part.unpacked) > most ||
    (!part.isDeflated && part.packed != part.unpacked))
  {
    throw Problem("has the file " + shownWords(part.name) + " of " + std::to_string(part.unpacked) +
      " bytes in " + std::to_string(part.packed) + " of its zip archive, which cannot be");
  }
  withBeginning("cannot be read: ",
    [&] { requireHostMemory("its part " + part.name, static_cast<double>(part.unpacked)); });
  const char* from = archive.data() + first;
  std::vector<char> bytes(static_cast<std::size_t>(part.unpacked));
  if (part.isDeflated)
  {
    inflatePart(from, part, bytes);
  }
  else
  {
    std::copy_n(from, bytes.size(), bytes.begin());
  }
  throwIfAny(checksumOf(bytes) == part.checksum
      ? ""
      : "has a damaged file " + shownWords(part.name) + " in its zip archive: its CRC is wrong");
  return bytes;
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
    if (place + size > std::numeric_limits<std::uint32_t>::max() || files.size() > MostParts - 2)
    {
      throw Problem("it would have more than 4 GiB or 65534 parts, which such a file cannot have");
    }
    Record shared;
    shared.two(Version).two(Utf8).two(0).two(0).two(Day).four(checksumOf(file.bytes));
    shared.four(size).four(size).two(file.name.size()).two(0);
    const std::string local = Record().four(LocalHeader).bytes() + shared.bytes() + file.name;
    to << local;
    to.write(file.bytes.data(), static_cast<std::streamsize>(size));
    entries += Record().four(Entry).two(Version).bytes() + shared.bytes() +
      Record().two(0).two(0).two(0).four(0).four(place).bytes() + file.name;
    place += local.size() + size;
  }
  to << entries << Record().four(End).two(0).two(0).two(files.size()).two(files.size()).bytes()
     << Record().four(entries.size()).four(place).two(0).bytes();
}
}
