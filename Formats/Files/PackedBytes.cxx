// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/PackedBytes.h"

#include "Common/HostMemory.h"
#include "Common/Problem.h"
#include "Formats/Files/PlainFile.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace brainshift
{
namespace
{
constexpr int DetectZlibOrGzip = 15 + 32;      // zlib's window bits
constexpr std::size_t Piece = 1 << 20;         // bytes at a time
constexpr double LargestDeflateRatio = 1100.0; // no zlib stream unpacks to more times its size

// Unpacks a file piece by piece.
class Unpacker
{
public:
  explicit Unpacker(std::ifstream& packed)
    : Packed(packed)
    , In(Piece)
  {
    this->Good = inflateInit2(&this->Stream, DetectZlibOrGzip) == Z_OK;
  }
  ~Unpacker() { inflateEnd(&this->Stream); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  // Unpacks up to `count` bytes; fewer at the end, or if the packed ones are damaged.
  std::size_t unpack(char* to, std::size_t count)
  {
    this->Stream.next_out = reinterpret_cast<Bytef*>(to);
    this->Stream.avail_out = static_cast<uInt>(count);
    while (this->Good && !this->Ended && this->Stream.avail_out > 0)
    {
      const bool hasMore = this->fill();
      const int status = inflate(&this->Stream, Z_NO_FLUSH); // what it keeps needs no more bytes
      this->Good = status == Z_OK || status == Z_STREAM_END || status == Z_BUF_ERROR;
      this->Ended =
        (status == Z_STREAM_END && !this->beginsAnother()) || (status == Z_BUF_ERROR && !hasMore);
    }
    return count - this->Stream.avail_out;
  }

  bool isGood() const { return this->Good; }

private:
  // False at the end of the file.
  bool fill()
  {
    if (this->Stream.avail_in == 0)
    {
      this->Packed.read(this->In.data(), static_cast<std::streamsize>(this->In.size()));
      this->Stream.next_in = reinterpret_cast<Bytef*>(this->In.data());
      this->Stream.avail_in = static_cast<uInt>(this->Packed.gcount());
    }
    return this->Stream.avail_in > 0;
  }

  // Files of gzip may follow one another; what else follows is not read.
  bool beginsAnother()
  {
    constexpr Bytef GzipsFirst = 0x1f;
    return this->fill() && *this->Stream.next_in == GzipsFirst &&
      inflateReset(&this->Stream) == Z_OK;
  }

  std::ifstream& Packed;
  std::vector<char> In;
  z_stream Stream{};
  bool Good = false;
  bool Ended = false;
};

// Reads packed bytes one after another. Throws where they are damaged or too few.
class PackedReader
{
public:
  explicit PackedReader(std::ifstream& file)
    : Bytes(file)
    , Unwanted(Piece)
  {
  }

  void skip(std::uint64_t count)
  {
    for (std::uint64_t left = count; left > 0;)
    {
      const std::size_t wanted = std::min<std::uint64_t>(left, Piece);
      this->take(this->Unwanted.data(), wanted);
      left -= wanted;
    }
  }

  // False if `fractionDone` said stop.
  bool read(char* to, std::uint64_t count, const FractionDone& fractionDone)
  {
    for (std::uint64_t done = 0; done < count;)
    {
      const std::size_t wanted = std::min<std::uint64_t>(count - done, Piece);
      this->take(to + done, wanted);
      done += wanted;
      if (!fractionDone(static_cast<double>(done) / static_cast<double>(count)))
      {
        return false;
      }
    }
    return true;
  }

  // What follows the numbers is no more than a piece, and their checksum.
  void end()
  {
    this->Bytes.unpack(this->Unwanted.data(), this->Unwanted.size());
    if (!this->Bytes.isGood())
    {
      throw Problem(Damaged);
    }
  }

private:
  static constexpr const char* Damaged = "has packed numbers that are damaged or too few";

  void take(char* to, std::size_t count)
  {
    if (this->Bytes.unpack(to, count) < count)
    {
      throw Problem(Damaged);
    }
  }

  Unpacker Bytes;
  std::vector<char> Unwanted;
};

void unpackAll(std::ifstream& file, const StoredBytes& from, char* to, std::size_t count,
  const FractionDone& fractionDone)
{
  PackedReader reader(file);
  reader.skip(from.unpackedSkip);
  if (reader.read(to, count, fractionDone))
  {
    reader.end();
  }
}

void readAll(std::ifstream& file, char* to, std::size_t count, const FractionDone& fractionDone)
{
  for (std::size_t done = 0; done < count;)
  {
    const std::size_t wanted = std::min(count - done, 16 * Piece);
    if (!file.read(to + done, static_cast<std::streamsize>(wanted)))
    {
      throw Problem("has only " + std::to_string(done + static_cast<std::size_t>(file.gcount())) +
        " readable bytes of numbers");
    }
    done += wanted;
    if (!fractionDone(static_cast<double>(done) / static_cast<double>(count)))
    {
      return;
    }
  }
}
}

bool beginsLikeGzip(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  char first[2] = {};
  return file.read(first, 2) && first[0] == '\x1f' && first[1] == '\x8b';
}

void requireBytes(const StoredBytes& from, double count)
{
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(from.fileName, error));
  if (error)
  {
    throw Problem("has an unknown size");
  }
  const double bytes = std::max(size - static_cast<double>(from.offset), 0.0);
  const double wanted = count + (from.isPacked ? static_cast<double>(from.unpackedSkip) : 0.0);
  // A damaged header asks for more than any file can hold.
  if (bytes * (from.isPacked ? LargestDeflateRatio : 1.0) >= wanted)
  {
    return;
  }
  std::ostringstream problem;
  problem.precision(15);
  problem << "has " << bytes << (from.isPacked ? " packed bytes" : " bytes of numbers")
          << " where the header announces " << wanted << (from.isPacked ? " bytes of numbers" : "");
  throw Problem(problem.str());
}

void readBytes(
  const StoredBytes& from, char* to, std::size_t count, const FractionDone& fractionDone)
{
  std::ifstream file(from.fileName, std::ios::binary);
  if (!file)
  {
    throw Problem("cannot be opened");
  }
  file.seekg(static_cast<std::streamoff>(from.offset));
  if (from.isPacked)
  {
    unpackAll(file, from, to, count, fractionDone);
  }
  else
  {
    readAll(file, to, count, fractionDone);
  }
}

std::size_t StoredBox::voxelCount() const
{
  std::size_t count = this->volumes;
  for (int axis = 0; axis < 3; ++axis)
  {
    count *= static_cast<std::size_t>(this->extent[2 * axis + 1] - this->extent[2 * axis] + 1);
  }
  return count;
}

namespace
{
// The bytes of a box in the order of the file: runs of as many bytes, such as rows. Rows that
// follow one another, in whole slices or a whole volume, are one run.
class BoxRuns
{
public:
  explicit BoxRuns(const StoredBox& box)
    : Box(box)
  {
    const bool wholeRows = this->count(0) == this->side(0);
    const bool wholeSlices = wholeRows && this->count(1) == this->side(1);
    this->Rows = wholeRows ? 1 : this->count(1);
    this->RunsOfVolume = (wholeSlices ? 1 : this->count(2)) * this->Rows;
    this->Runs = box.volumes * this->RunsOfVolume;
    this->Bytes = box.voxelCount() / this->Runs * box.bytes;
  }

  std::uint64_t runs() const { return this->Runs; }
  std::uint64_t bytes() const { return this->Bytes; } // of a run

  // Bytes of the volumes before a run.
  std::uint64_t before(std::uint64_t run) const
  {
    const std::uint64_t volume = run / this->RunsOfVolume;
    const std::uint64_t ofVolume = run % this->RunsOfVolume;
    const std::uint64_t z = volume * this->side(2) + this->first(2) + ofVolume / this->Rows;
    const std::uint64_t y = this->first(1) + ofVolume % this->Rows;
    return ((z * this->side(1) + y) * this->side(0) + this->first(0)) * this->Box.bytes;
  }

  // Whether the last run ends where the last volume does.
  bool reachEnd() const
  {
    const std::uint64_t all =
      this->Box.volumes * this->side(0) * this->side(1) * this->side(2) * this->Box.bytes;
    return this->before(this->Runs - 1) + this->Bytes == all;
  }

private:
  std::uint64_t side(int axis) const { return this->Box.dimensions[axis]; }
  std::uint64_t first(int axis) const { return this->Box.extent[2 * axis]; }
  std::uint64_t count(int axis) const { return this->Box.extent[2 * axis + 1] + 1 - first(axis); }

  const StoredBox& Box;
  std::uint64_t Rows = 1; // of runs in a slice
  std::uint64_t RunsOfVolume = 1;
  std::uint64_t Runs = 0;
  std::uint64_t Bytes = 0;
};

void unpackBox(std::ifstream& file, const StoredBytes& from, const BoxRuns& box, char* to,
  const std::function<FractionDone(std::uint64_t run)>& doneOf)
{
  PackedReader reader(file);
  reader.skip(from.unpackedSkip);
  std::uint64_t at = 0;
  for (std::uint64_t run = 0; run < box.runs(); ++run)
  {
    reader.skip(box.before(run) - at);
    if (!reader.read(to + run * box.bytes(), box.bytes(), doneOf(run)))
    {
      return;
    }
    at = box.before(run) + box.bytes();
  }
  if (box.reachEnd())
  {
    reader.end();
  }
}
}

void readBox(
  const StoredBytes& from, const StoredBox& box, char* to, const FractionDone& fractionDone)
{
  if (box.voxelCount() == 0) // a rank without a part
  {
    return;
  }
  const BoxRuns runs(box);
  std::ifstream file;
  if (!from.isPacked)
  {
    file.rdbuf()->pubsetbuf(nullptr, 0); // it would read more than a short row
  }
  file.open(from.fileName, std::ios::binary);
  if (!file)
  {
    throw Problem("cannot be opened");
  }
  bool stopped = false;
  const auto doneOf = [&](std::uint64_t run) {
    return [&, run](double fraction) {
      stopped =
        !fractionDone((static_cast<double>(run) + fraction) / static_cast<double>(runs.runs()));
      return !stopped;
    };
  };
  if (from.isPacked)
  {
    file.seekg(static_cast<std::streamoff>(from.offset));
    unpackBox(file, from, runs, to, doneOf);
    return;
  }
  for (std::uint64_t run = 0; run < runs.runs() && !stopped; ++run)
  {
    file.seekg(static_cast<std::streamoff>(from.offset + runs.before(run)));
    readAll(file, to + run * runs.bytes(), runs.bytes(), doneOf(run));
  }
}

std::string readUnpackedBeginning(const std::string& fileName, std::size_t bytes)
{
  if (!isPlainFile(fileName) || !beginsLikeGzip(fileName))
  {
    return readBeginning(fileName, bytes);
  }
  std::string found(bytes, '\0');
  const gzFile file = gzopen(fileName.c_str(), "rb");
  const int read = file ? gzread(file, found.data(), static_cast<unsigned>(bytes)) : 0;
  if (file)
  {
    gzclose(file);
  }
  found.resize(static_cast<std::size_t>(std::max(read, 0)));
  return found;
}

std::vector<char> unpackedGzip(const std::vector<char>& packed, double timesInMemory)
{
  constexpr std::size_t Piece = std::size_t(1) << 24;
  constexpr int Gzip = 16; // beside the size of the window
  z_stream stream{};
  std::vector<char> bytes;
  int result = inflateInit2(&stream, MAX_WBITS + Gzip);
  std::size_t taken = 0;
  std::size_t made = 0;
  const std::string problem = problemOf([&] {
    while (result == Z_OK)
    {
      withBeginning("cannot be read: ", [&] {
        requireHostMemory("what it unpacks to", timesInMemory * static_cast<double>(made + Piece));
      });
      bytes.resize(made + Piece);
      const std::size_t in = std::min(Piece, packed.size() - taken);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data())) + taken;
      stream.avail_in = static_cast<uInt>(in);
      stream.next_out = reinterpret_cast<Bytef*>(bytes.data()) + made;
      stream.avail_out = static_cast<uInt>(Piece);
      result = inflate(&stream, Z_NO_FLUSH);
      taken += in - stream.avail_in;
      made += Piece - stream.avail_out;
      if (result == Z_STREAM_END && taken < packed.size())
      {
        result = inflateReset(&stream); // members may follow one another
      }
    }
  });
  inflateEnd(&stream);
  throwIfAny(problem);
  throwIfAny(result == Z_STREAM_END ? "" : "is damaged: it cannot be unpacked to its end");
  bytes.resize(made);
  return bytes;
}
}
