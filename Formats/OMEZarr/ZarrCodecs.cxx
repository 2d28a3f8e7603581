// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/ZarrCodecs.h"

#include "Common/Bytes.h"
#include "Common/Problem.h"
#include "Formats/Files/Inflate.h"
#include "Formats/Files/Text.h"

#include "vtk_lz4.h"

#include <blosc.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace brainshift
{
namespace
{
constexpr const char* Checksum = "crc32c";
constexpr std::size_t ChecksumBytes = 4;
constexpr std::size_t LengthBytes = 4; // before the block of lz4

const std::array<const char*, 5> Compressors{ "blosc", "gzip", "lz4", "zlib", "zstd" };

bool isCompressor(const std::string& name)
{
  return std::find(Compressors.begin(), Compressors.end(), name) != Compressors.end();
}

void requireSize(std::size_t found, std::size_t size)
{
  if (found != size)
  {
    throw Problem(
      "unpacks to " + std::to_string(found) + " bytes; it must have " + std::to_string(size));
  }
}

std::string fromBlosc(const std::string& packed, std::size_t size)
{
  std::size_t found = 0;
  if (blosc_cbuffer_validate(packed.data(), packed.size(), &found) != 0)
  {
    throw Problem("is damaged: its header of blosc does not fit its " +
      std::to_string(packed.size()) + " bytes");
  }
  requireSize(found, size);
  std::string bytes(size, '\0');
  constexpr int Threads = 1; // chunks are unpacked beside each other
  const int made = blosc_decompress_ctx(packed.data(), bytes.data(), size, Threads);
  throwIfAny(made < 0 ? "is damaged: blosc cannot unpack it" : "");
  requireSize(static_cast<std::size_t>(made), size);
  return bytes;
}

std::string fromZstd(const std::string& packed, std::size_t size)
{
  std::string bytes(size, '\0');
  const std::size_t made = ZSTD_decompress(bytes.data(), size, packed.data(), packed.size());
  if (ZSTD_isError(made))
  {
    throw Problem(
      std::string("is damaged: zstd cannot unpack it (") + ZSTD_getErrorName(made) + ")");
  }
  requireSize(made, size);
  return bytes;
}

std::string fromLZ4(const std::string& packed, std::size_t size)
{
  requireSize(storedNumberAt<std::uint32_t>(packed, 0, false).value_or(0), size);
  std::string bytes(size, '\0');
  const int made = LZ4_decompress_safe(packed.data() + LengthBytes, bytes.data(),
    static_cast<int>(packed.size() - LengthBytes), static_cast<int>(size));
  throwIfAny(made < 0 ? "is damaged: lz4 cannot unpack it" : "");
  requireSize(static_cast<std::size_t>(made), size);
  return bytes;
}

std::array<std::uint32_t, 256> checksumTable()
{
  constexpr std::uint32_t Castagnoli = 0x82f63b78; // the polynomial, its bits reversed
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte)
  {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = (sum >> 1) ^ ((sum & 1) != 0 ? Castagnoli : 0);
    }
    table[byte] = sum;
  }
  return table;
}

std::uint32_t checksumOf(const char* bytes, std::size_t count)
{
  static const std::array<std::uint32_t, 256> table = checksumTable();
  std::uint32_t sum = 0xffffffff;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum = table[(sum ^ static_cast<unsigned char>(bytes[i])) & 0xff] ^ (sum >> 8);
  }
  return ~sum;
}

std::string withoutChecksum(std::string bytes)
{
  const std::size_t size = bytes.size() - std::min(bytes.size(), ChecksumBytes);
  const auto stored = storedNumberAt<std::uint32_t>(bytes, size, false);
  if (!stored || *stored != checksumOf(bytes.data(), size))
  {
    throw Problem("is damaged: its checksum (crc32c) is another");
  }
  bytes.resize(size);
  return bytes;
}

std::string decompressed(const std::string& codec, const std::string& packed, std::size_t size)
{
  return codec == "blosc" ? fromBlosc(packed, size)
    : codec == "zstd"     ? fromZstd(packed, size)
    : codec == "lz4"      ? fromLZ4(packed, size)
                          : inflated(packed, size, Inflate::Wrapped);
}
}

void addCodec(const std::string& name, ZarrCodecs& codecs)
{
  constexpr std::size_t Most = 8;
  const std::string numcodecs = "numcodecs."; // zarr-python's, of the same bytes
  const std::string plain = name.rfind(numcodecs, 0) == 0 ? name.substr(numcodecs.size()) : name;
  if (!isCompressor(plain) && plain != Checksum)
  {
    throw Problem("has the codec '" + shownWords(name) +
      "'; BrainShift reads blosc, zstd, gzip, zlib, lz4 and crc32c");
  }
  const bool isSecond =
    isCompressor(plain) && std::any_of(codecs.begin(), codecs.end(), isCompressor);
  if (isSecond || codecs.size() == Most)
  {
    throw Problem("is packed by '" + shownWords(name) +
      "' once more; BrainShift reads chunks that are packed once, with up to 7 checksums");
  }
  codecs.push_back(plain);
}

std::string unpacked(const ZarrCodecs& codecs, std::string packed, std::size_t size)
{
  for (auto codec = codecs.rbegin(); codec != codecs.rend(); ++codec)
  {
    if (*codec == Checksum)
    {
      packed = withoutChecksum(std::move(packed));
      continue;
    }
    // What comes before a compressor are checksums.
    const auto checksums = static_cast<std::size_t>(codecs.rend() - codec - 1);
    packed = decompressed(*codec, packed, size + ChecksumBytes * checksums);
  }
  if (packed.size() != size)
  {
    throw Problem(
      "has " + std::to_string(packed.size()) + " bytes; it must have " + std::to_string(size));
  }
  return packed;
}

std::size_t mostPacked(std::size_t size)
{
  constexpr std::size_t Beside = std::size_t(1) << 20; // headers, and of blocks that do not shrink
  return size + size / 4 + Beside;
}
}
