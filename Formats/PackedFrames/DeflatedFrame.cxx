// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Unpacks frames that are deflated one by one, without a header of zlib (DICOM part 5, A.4.13).
#include "Common/Bytes.h"
#include "Formats/PackedFrames/PackedFrame.h"

#include "vtk_zlib.h"

#include <limits>

namespace brainshift
{
namespace
{
// Inflates as many bytes as there is room for. False if there are fewer.
bool inflateInto(const std::string& packed, std::string& plain)
{
  z_stream stream{};
  constexpr std::size_t Most = std::numeric_limits<uInt>::max(); // that zlib counts
  if (packed.size() > Most || plain.size() > Most || inflateInit2(&stream, -MAX_WBITS) != Z_OK)
  {
    return false;
  }
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(plain.data());
  stream.avail_out = static_cast<uInt>(plain.size());
  inflate(&stream, Z_FINISH);
  const bool isWhole = stream.avail_out == 0;
  inflateEnd(&stream);
  return isWhole;
}
}

UnpackedFrame unpackDeflated(const std::string& packed, const FrameShape& shape)
{
  std::string plain(shape.count() * shape.bytesOfNumber(), '\0');
  if (!inflateInto(packed, plain))
  {
    throw Problem(
      "a deflated frame is damaged: it does not hold " + std::to_string(plain.size()) + " bytes");
  }
  toMachineOrder(plain.data(), shape.count(), shape.bytesOfNumber(), false);
  return { plain };
}
}
