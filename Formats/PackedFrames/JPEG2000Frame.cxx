// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/PackedFrames/JPEG2000Frame.h"

#include "Formats/PackedFrames/JPEG2000Header.h"
#include "Formats/PackedFrames/Widen.h"

#include <openjpeg.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace brainshift
{
namespace
{
constexpr const char* Damaged = "a JPEG 2000 frame is damaged: OpenJPEG cannot unpack it";

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

std::string shapeProblem(const opj_image_t& image, const FrameShape& shape)
{
  const OPJ_UINT32 columns = image.x1 - image.x0;
  const OPJ_UINT32 rows = image.y1 - image.y0;
  const OPJ_UINT32 bits = image.numcomps > 0 ? image.comps[0].prec : 0;
  const bool isSame = image.x1 > image.x0 && image.y1 > image.y0 && image.numcomps == 1 &&
    columns == static_cast<OPJ_UINT32>(shape.columns) &&
    rows == static_cast<OPJ_UINT32>(shape.rows) && image.comps[0].dx == 1 &&
    image.comps[0].dy == 1 && bits <= static_cast<OPJ_UINT32>(shape.bitsAllocated);
  return isSame
    ? std::string()
    : otherShape(shape,
        std::to_string(columns) + " x " + std::to_string(rows) + " pixels of " +
          std::to_string(image.numcomps) + " samples in " + std::to_string(bits) + " bits")
        .problem;
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
  std::string problem = jpeg2000Problem(packed, shape);
  if (!problem.empty())
  {
    return { {}, problem };
  }
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
    return { {}, Damaged };
  }
  problem = shapeProblem(*image, shape);
  if (!problem.empty())
  {
    return { {}, problem };
  }
  if (opj_decode(codec.get(), stream.get(), image.get()) != OPJ_TRUE)
  {
    return { {}, Damaged };
  }
  problem = shapeProblem(*image, shape); // a palette may have changed it
  if (!problem.empty())
  {
    return { {}, problem };
  }
  const opj_image_comp_t& component = image->comps[0];
  if (component.w != static_cast<OPJ_UINT32>(shape.columns) ||
    component.h != static_cast<OPJ_UINT32>(shape.rows) || !component.data)
  {
    return { {}, Damaged };
  }
  const std::vector<OPJ_INT32> samples(component.data, component.data + shape.count());
  return { widened(samples, shape.bytesOfNumber()), {}, static_cast<int>(component.prec),
    component.sgnd != 0 };
}
}
