// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/Inflate.h"

#include "Common/Problem.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <limits>

namespace brainshift
{
namespace
{
// Gives the memory of zlib back.
struct Inflating
{
  z_stream stream{};
  ~Inflating() { inflateEnd(&this->stream); }
};

// zlib counts in 32 bits.
uInt step(std::size_t left)
{
  return static_cast<uInt>(std::min<std::size_t>(left, std::numeric_limits<uInt>::max()));
}
}

std::string inflated(const std::string& packed, std::size_t size, Inflate wrapping)
{
  constexpr int GzipOrZlib = 32; // zlib's word for "look which of them it is"
  Inflating inflating;
  z_stream& stream = inflating.stream;
  if (inflateInit2(&stream, wrapping == Inflate::Raw ? -MAX_WBITS : MAX_WBITS + GzipOrZlib) != Z_OK)
  {
    throw Problem("cannot be unpacked: zlib gets no memory; close other data or programs");
  }
  std::string bytes(size, '\0');
  char surplus = 0; // where a byte too many goes, so that the end is seen
  std::size_t taken = 0;
  std::size_t made = 0;
  int state = Z_OK;
  while (state == Z_OK && made <= size)
  {
    const uInt in = step(packed.size() - taken);
    const uInt out = made < size ? step(size - made) : 1;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data())) + taken;
    stream.avail_in = in;
    stream.next_out = reinterpret_cast<Bytef*>(made < size ? bytes.data() + made : &surplus);
    stream.avail_out = out;
    state = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += out - stream.avail_out;
  }
  if (state != Z_STREAM_END || made != size || taken != packed.size())
  {
    throw Problem(state == Z_DATA_ERROR
        ? "is damaged: zlib cannot unpack it"
        : "does not unpack to the " + std::to_string(size) + " bytes that it must have");
  }
  return bytes;
}
}
