// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Unpacks JPEG 2000 frames (ISO 15444-1) by OpenJPEG: streams of codes, and files in the format
/// JP2.
#include "Formats/PackedFrames/PackedFrame.h"

#include "Common/Bytes.h"

#include <openjpeg.h>

#include <memory>
#include <set>

namespace brainshift
{
namespace
{
const std::string DamagedBecause = "a JPEG 2000 frame is damaged: ";
constexpr std::uint64_t StartOfCodes = 0xff4f;
constexpr std::uint64_t SizeMarker = 0xff51;
constexpr std::uint64_t StartOfTile = 0xff90;
constexpr std::uint64_t CodesBox = 0x6a703263; // "jp2c"
constexpr std::size_t SizeBytes = 45;          // with the first marker, and one component
constexpr std::uint64_t MostTiles = 4096;

// A big-endian number; 0 behind the end.
template <typename Number>
std::uint64_t numberAt(const std::string& packed, std::size_t offset)
{
  return storedNumberAt<Number>(packed, offset, true).value_or(0);
}

// Where the stream of codes begins: at once, or in a box of the format JP2. The end without one.
std::size_t beginOfCodes(const std::string& packed)
{
  std::size_t offset = 0;
  while (offset < packed.size() && numberAt<std::uint16_t>(packed, offset) != StartOfCodes)
  {
    const bool isLong = numberAt<std::uint32_t>(packed, offset) == 1;
    const std::uint64_t length = isLong ? numberAt<std::uint64_t>(packed, offset + 8)
                                        : numberAt<std::uint32_t>(packed, offset);
    const std::size_t head = isLong ? 16 : 8;
    if (numberAt<std::uint32_t>(packed, offset + 4) == CodesBox)
    {
      return offset + head;
    }
    if (length < head || length > packed.size() - offset)
    {
      return packed.size();
    }
    offset += length;
  }
  return offset;
}

// How many tiles lie side by side; 0 if they cannot cover the picture.
std::uint64_t tilesAlong(const std::string& packed, std::size_t codes, std::size_t axis)
{
  const std::uint64_t end = numberAt<std::uint32_t>(packed, codes + 8 + 4 * axis);
  const std::uint64_t side = numberAt<std::uint32_t>(packed, codes + 24 + 4 * axis);
  const std::uint64_t begin = numberAt<std::uint32_t>(packed, codes + 32 + 4 * axis);
  return side == 0 || begin >= end ? 0 : (end - begin + side - 1) / side;
}

// The tiles that have a part.
std::set<std::uint64_t> tilesIn(const std::string& packed, std::size_t codes)
{
  std::size_t offset = codes + 2;
  while (offset + 4 <= packed.size() && numberAt<std::uint16_t>(packed, offset) != StartOfTile)
  {
    offset += 2 + numberAt<std::uint16_t>(packed, offset + 2);
  }
  std::set<std::uint64_t> tiles;
  while (offset + 12 <= packed.size() && numberAt<std::uint16_t>(packed, offset) == StartOfTile)
  {
    tiles.insert(numberAt<std::uint16_t>(packed, offset + 4));
    const std::uint64_t length = numberAt<std::uint32_t>(packed, offset + 6);
    if (length < 12) // 0: up to the end
    {
      break;
    }
    offset += length;
  }
  return tiles;
}

// Throws unless a frame, of any bytes, is one of this shape with all its tiles. OpenJPEG would take
// memory for any size that a header announces, and fill missing tiles with zeros.
void requireJPEG2000(const std::string& packed, const FrameShape& shape)
{
  const std::size_t codes = beginOfCodes(packed);
  if (codes + SizeBytes > packed.size() || numberAt<std::uint16_t>(packed, codes) != StartOfCodes ||
    numberAt<std::uint16_t>(packed, codes + 2) != SizeMarker)
  {
    throw Problem(DamagedBecause + "it does not begin with its size");
  }
  const std::uint64_t components = numberAt<std::uint16_t>(packed, codes + 40);
  const std::uint64_t bits = 1 + (numberAt<std::uint8_t>(packed, codes + 42) & 127);
  std::uint64_t sides[2] = { 0, 0 };
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const std::uint64_t end = numberAt<std::uint32_t>(packed, codes + 8 + 4 * axis);
    const std::uint64_t begin = numberAt<std::uint32_t>(packed, codes + 16 + 4 * axis);
    sides[axis] = end > begin ? end - begin : 0;
  }
  if (sides[0] != static_cast<std::uint64_t>(shape.columns) ||
    sides[1] != static_cast<std::uint64_t>(shape.rows) || components != 1 ||
    bits > static_cast<std::uint64_t>(shape.bitsAllocated))
  {
    throw otherShape(shape, shapeText(sides[0], sides[1], components, bits));
  }
  const std::uint64_t across = tilesAlong(packed, codes, 0);
  const std::uint64_t down = tilesAlong(packed, codes, 1);
  if (across == 0 || down == 0 || across > MostTiles || down > MostTiles ||
    across * down > MostTiles)
  {
    throw Problem(DamagedBecause + "it announces " + std::to_string(across) + " x " +
      std::to_string(down) + " tiles; it must be 1 to 4096 in all");
  }
  const std::set<std::uint64_t> tiles = tilesIn(packed, codes);
  if (tiles.size() != across * down || *tiles.rbegin() >= across * down)
  {
    throw Problem(DamagedBecause + "it has " + std::to_string(tiles.size()) + " of its " +
      std::to_string(across * down) + " tiles");
  }
}

constexpr const char* Damaged2000 = "a JPEG 2000 frame is damaged: OpenJPEG cannot unpack it";

// What OpenJPEG reads instead of a file.
struct Memory
{
  const char* bytes = nullptr;
  std::size_t size = 0;
  std::size_t offset = 0;
};

OPJ_SIZE_T read(void* to, OPJ_SIZE_T size, void* data)
{
  auto& memory = *static_cast<Memory*>(data);
  const std::size_t count = std::min<std::size_t>(size, memory.size - memory.offset);
  if (count == 0)
  {
    return static_cast<OPJ_SIZE_T>(-1); // the end
  }
  std::memcpy(to, memory.bytes + memory.offset, count);
  memory.offset += count;
  return count;
}

OPJ_OFF_T skip(OPJ_OFF_T size, void* data)
{
  auto& memory = *static_cast<Memory*>(data);
  if (size < 0 || static_cast<std::size_t>(size) > memory.size - memory.offset)
  {
    memory.offset = memory.size;
    return -1;
  }
  memory.offset += static_cast<std::size_t>(size);
  return size;
}

OPJ_BOOL seek(OPJ_OFF_T offset, void* data)
{
  auto& memory = *static_cast<Memory*>(data);
  if (offset < 0 || static_cast<std::size_t>(offset) > memory.size)
  {
    return OPJ_FALSE;
  }
  memory.offset = static_cast<std::size_t>(offset);
  return OPJ_TRUE;
}

using Codec = std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)>;
using Stream = std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)>;
using Image = std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)>;

Stream streamOf(Memory& memory)
{
  Stream stream(opj_stream_default_create(OPJ_TRUE), &opj_stream_destroy);
  opj_stream_set_user_data(stream.get(), &memory, nullptr);
  opj_stream_set_user_data_length(stream.get(), memory.size);
  opj_stream_set_read_function(stream.get(), read);
  opj_stream_set_skip_function(stream.get(), skip);
  opj_stream_set_seek_function(stream.get(), seek);
  return stream;
}

void requireShape(const opj_image_t& image, const FrameShape& shape)
{
  const OPJ_UINT32 columns = image.x1 - image.x0;
  const OPJ_UINT32 rows = image.y1 - image.y0;
  const OPJ_UINT32 bits = image.numcomps > 0 ? image.comps[0].prec : 0;
  const bool isSame = image.x1 > image.x0 && image.y1 > image.y0 && image.numcomps == 1 &&
    columns == static_cast<OPJ_UINT32>(shape.columns) &&
    rows == static_cast<OPJ_UINT32>(shape.rows) && image.comps[0].dx == 1 &&
    image.comps[0].dy == 1 && bits <= static_cast<OPJ_UINT32>(shape.bitsAllocated);
  if (!isSame)
  {
    throw otherShape(shape, shapeText(columns, rows, image.numcomps, bits));
  }
}

// Odd frames are filled up with a zero, which is none of OpenJPEG's business.
std::size_t sizeWithoutFilling(const std::string& packed)
{
  const std::size_t last = packed.find_last_not_of('\0');
  const bool isEnd = last != std::string::npos && last > 0 &&
    static_cast<unsigned char>(packed[last]) == 0xd9 &&
    static_cast<unsigned char>(packed[last - 1]) == 0xff;
  return isEnd ? last + 1 : packed.size();
}
}

UnpackedFrame unpackJPEG2000(const std::string& packed, const FrameShape& shape)
{
  requireJPEG2000(packed, shape);
  const bool isFile = packed.compare(0, 4, "\0\0\0\x0c", 4) == 0;
  Memory memory{ packed.data(), sizeWithoutFilling(packed), 0 };
  const Stream stream = streamOf(memory);
  const Codec codec(
    opj_create_decompress(isFile ? OPJ_CODEC_JP2 : OPJ_CODEC_J2K), &opj_destroy_codec);
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  opj_image_t* read = nullptr;
  const bool isSetUp = opj_setup_decoder(codec.get(), &parameters) == OPJ_TRUE &&
    opj_read_header(stream.get(), codec.get(), &read) == OPJ_TRUE && read;
  const Image image(read, &opj_image_destroy);
  if (!isSetUp)
  {
    throw Problem(Damaged2000);
  }
  requireShape(*image, shape);
  if (opj_decode(codec.get(), stream.get(), image.get()) != OPJ_TRUE)
  {
    throw Problem(Damaged2000);
  }
  requireShape(*image, shape); // a palette may have changed it
  const opj_image_comp_t& component = image->comps[0];
  if (component.w != static_cast<OPJ_UINT32>(shape.columns) ||
    component.h != static_cast<OPJ_UINT32>(shape.rows) || !component.data)
  {
    throw Problem(Damaged2000);
  }
  const std::vector<OPJ_INT32> samples(component.data, component.data + shape.count());
  return { widened(samples, shape.bytesOfNumber()), static_cast<int>(component.prec),
    component.sgnd != 0 };
}
}
