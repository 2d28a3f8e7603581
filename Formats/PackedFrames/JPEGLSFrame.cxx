// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Unpacks JPEG-LS frames (ISO 14495-1) by CharLS.
#include "Formats/PackedFrames/PackedFrame.h"

#include <charls/charls.h>

#include <exception>

namespace brainshift
{
namespace
{
template <typename T>
std::string decoded(const charls::jpegls_decoder& decoder, const FrameShape& shape)
{
  std::vector<T> samples(shape.count());
  decoder.decode(samples.data(), samples.size() * sizeof(T));
  return widened(samples, shape.bytesOfNumber());
}
}

UnpackedFrame unpackJPEGLS(const std::string& packed, const FrameShape& shape)
{
  try
  {
    charls::jpegls_decoder decoder;
    decoder.source(packed);
    decoder.read_header();
    const charls::frame_info frame = decoder.frame_info();
    if (frame.width != static_cast<std::uint32_t>(shape.columns) ||
      frame.height != static_cast<std::uint32_t>(shape.rows) || frame.component_count != 1 ||
      frame.bits_per_sample > shape.bitsAllocated)
    {
      throw otherShape(shape,
        shapeText<std::int64_t>(
          frame.width, frame.height, frame.component_count, frame.bits_per_sample));
    }
    return { frame.bits_per_sample <= 8 ? decoded<std::uint8_t>(decoder, shape)
                                        : decoded<std::uint16_t>(decoder, shape),
      static_cast<int>(frame.bits_per_sample), false };
  }
  catch (const Problem&)
  {
    throw;
  }
  catch (const std::exception& thrown)
  {
    throw Problem(std::string("a JPEG-LS frame is damaged; CharLS says: ") + thrown.what());
  }
}
}
