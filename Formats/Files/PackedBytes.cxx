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

void unpackAll(std::ifstream& file, const StoredBytes& from, char* to, std::size_t count,
  const FractionDone& fractionDone)
{
  const std::string damaged = "has packed numbers that are damaged or too few";
  Unpacker unpacker(file);
  std::vector<char> unwanted(std::min<std::uint64_t>(from.unpackedSkip, Piece));
  for (std::uint64_t left = from.unpackedSkip; left > 0;)
  {
    const std::size_t wanted = std::min<std::uint64_t>(left, Piece);
    if (unpacker.unpack(unwanted.data(), wanted) < wanted)
    {
      throw Problem(damaged);
    }
    left -= wanted;
  }
  for (std::size_t done = 0; done < count;)
  {
    const std::size_t wanted = std::min(count - done, Piece);
    if (unpacker.unpack(to + done, wanted) < wanted)
    {
      throw Problem(damaged);
    }
    done += wanted;
    if (!fractionDone(static_cast<double>(done) / static_cast<double>(count)))
    {
      return;
    }
  }
  unwanted.resize(Piece); // what follows the numbers is no more than this, and their checksum
  unpacker.unpack(unwanted.data(), unwanted.size());
  if (!unpacker.isGood())
  {
    throw Problem(damaged);
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
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    count *= static_cast<std::size_t>(this->extent[2 * axis + 1] - this->extent[2 * axis] + 1);
  }
  return count;
}

// Rows that follow one another in the file, in whole slices or a whole volume, are read at once.
void readBox(
  const StoredBytes& from, const StoredBox& box, char* to, const FractionDone& fractionDone)
{
  const auto side = [&](int axis) { return static_cast<std::uint64_t>(box.dimensions[axis]); };
  const auto first = [&](int axis) { return static_cast<std::uint64_t>(box.extent[2 * axis]); };
  const auto count = [&](int axis) {
    return static_cast<std::uint64_t>(box.extent[2 * axis + 1]) + 1 - first(axis);
  };
  if (box.voxelCount() == 0) // a rank without a part
  {
    return;
  }
  const bool wholeRows = count(0) == side(0);
  const bool wholeSlices = wholeRows && count(1) == side(1);
  const std::uint64_t slices = wholeSlices ? 1 : count(2);
  const std::uint64_t rows = wholeRows ? 1 : count(1);
  const std::uint64_t bytes = box.voxelCount() / (slices * rows) * box.bytes; // of a run
  std::ifstream file;
  file.rdbuf()->pubsetbuf(nullptr, 0); // it would read more than a short row
  file.open(from.fileName, std::ios::binary);
  if (!file)
  {
    throw Problem("cannot be opened");
  }
  std::uint64_t run = 0;
  bool stopped = false;
  for (; run < slices * rows && !stopped; ++run)
  {
    const std::uint64_t z = first(2) + run / rows;
    const std::uint64_t y = first(1) + run % rows;
    const std::uint64_t before = ((z * side(1) + y) * side(0) + first(0)) * box.bytes;
    file.seekg(static_cast<std::streamoff>(from.offset + before));
    readAll(file, to + run * bytes, bytes, [&](double fraction) {
      const double done =
        (static_cast<double>(run) + fraction) / static_cast<double>(slices * rows);
      stopped = !fractionDone(done);
      return !stopped;
    });
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
