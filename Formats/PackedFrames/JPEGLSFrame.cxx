// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/PackedFrames/JPEGLSFrame.h"

#include "Formats/PackedFrames/Widen.h"

#include <charls/charls.h>

#include <cstdint>
#include <exception>
#include <vector>

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
      return otherShape(shape,
        std::to_string(frame.width) + " x " + std::to_string(frame.height) + " pixels of " +
          std::to_string(frame.component_count) + " samples in " +
          std::to_string(frame.bits_per_sample) + " bits");
    }
    return { frame.bits_per_sample <= 8 ? decoded<std::uint8_t>(decoder, shape)
                                        : decoded<std::uint16_t>(decoder, shape),
      {}, static_cast<int>(frame.bits_per_sample), false };
  }
  catch (const std::exception& problem)
  {
    return { {}, std::string("a JPEG-LS frame is damaged; CharLS says: ") + problem.what() };
  }
}
}
