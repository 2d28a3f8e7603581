// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMBytes.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <cstring>

namespace brainshift
{
namespace
{
constexpr std::uint64_t WindowBytes = 16384;
}

DICOMBytes::DICOMBytes(const std::string& path, std::uint64_t mostInflated)
  : Stream(path, std::ios::binary | std::ios::ate)
  , Kept(mostInflated)
{
  this->Size = this->Stream ? static_cast<std::uint64_t>(this->Stream.tellg()) : 0;
}

bool DICOMBytes::read(std::uint64_t offset, std::uint64_t count, void* to)
{
  if (offset > this->Size || count > this->Size - offset)
  {
    return false;
  }
  if (this->IsInflated)
  {
    if (offset + count > this->Inflated.size())
    {
      return false;
    }
    std::memcpy(to, this->Inflated.data() + offset, count);
    return true;
  }
  this->Stream.clear();
  return this->Stream.seekg(static_cast<std::streamoff>(offset)) &&
    this->Stream.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
}

const unsigned char* DICOMBytes::at(std::uint64_t offset, std::size_t count)
{
  const bool isThere =
    offset >= this->WindowOffset && offset + count <= this->WindowOffset + this->Window.size();
  if (!isThere)
  {
    const std::uint64_t end = this->IsInflated ? this->Inflated.size() : this->Size;
    const std::uint64_t rest = offset < end ? end - offset : 0;
    this->Window.resize(std::min(rest, std::max<std::uint64_t>(WindowBytes, count)));
    this->WindowOffset = offset;
    if (this->Window.size() < count ||
      !this->read(offset, this->Window.size(), this->Window.data()))
    {
      this->Window.clear();
      return nullptr;
    }
  }
  return this->Window.data() + (offset - this->WindowOffset);
}

bool DICOMBytes::inflateFrom(std::uint64_t offset)
{
  std::string packed(offset < this->Size ? this->Size - offset : 0, '\0');
  std::string unpacked(offset, '\0');
  if (packed.empty() || !this->read(0, offset, unpacked.data()) ||
    !this->read(offset, packed.size(), packed.data()))
  {
    return false;
  }
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) // without a header
  {
    return false;
  }
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  std::vector<char> piece(1 << 16);
  int result = Z_OK;
  while (result == Z_OK && unpacked.size() < this->Kept)
  {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    result = inflate(&stream, Z_NO_FLUSH);
    unpacked.append(piece.data(), piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  this->Inflated = std::move(unpacked);
  this->IsInflated = true;
  const bool isWhole = result == Z_STREAM_END;
  const bool isCut = result == Z_OK && this->Kept < MostInflated;
  this->Size = isCut ? MostInflated : this->Inflated.size();
  this->Window.clear();
  return isWhole || isCut;
}
}
