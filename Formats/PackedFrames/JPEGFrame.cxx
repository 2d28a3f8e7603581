// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/PackedFrames/JPEGFrame.h"

#include "Formats/PackedFrames/JPEGHeader.h"
#include "Formats/PackedFrames/Widen.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Side = 8; // of a block

// The bits behind the header. Behind their end come zeros; isWhole then says no.
class Bits
{
public:
  Bits(const std::string& packed, std::size_t offset)
    : Bytes(reinterpret_cast<const unsigned char*>(packed.data()))
    , Size(packed.size())
    , Offset(offset)
  {
  }

  // Whether all bits that were taken were there, and each code was in its table.
  bool isWhole() const { return this->IsCode && 8 * this->Missing <= this->Count; }

  int symbol(const HuffmanTable& table)
  {
    this->fill();
    const HuffmanCode code = table[this->Window >> 48];
    this->IsCode = this->IsCode && code.bits > 0;
    this->drop(code.bits);
    return code.symbol;
  }

  // A number of so many bits, from 1 to 15; the lower half of them stands for negative numbers.
  int number(int bits)
  {
    this->fill();
    const int value = static_cast<int>(this->Window >> (64 - bits));
    this->drop(bits);
    return value < 1 << (bits - 1) ? value - (1 << bits) + 1 : value;
  }

  // Goes behind a marker of restart, which must be next.
  bool restart()
  {
    this->fill();
    while (this->Offset + 2 < this->Size && this->Bytes[this->Offset] == 0xff &&
      this->Bytes[this->Offset + 1] == 0xff)
    {
      ++this->Offset; // markers may be filled up
    }
    const int left = this->Count - 8 * this->Missing; // bits that fill the last byte
    if (left < 0 || left >= 8 || this->Offset + 2 > this->Size)
    {
      return false;
    }
    const int marker = this->Bytes[this->Offset + 1];
    const bool isNext = this->Bytes[this->Offset] == 0xff && marker == 0xd0 + this->Restarts % 8;
    ++this->Restarts;
    this->Offset += 2;
    this->Window = 0;
    this->Count = this->Missing = 0;
    return isNext;
  }

private:
  void drop(int bits)
  {
    this->Window <<= bits;
    this->Count -= bits;
  }

  void fill()
  {
    while (this->Count <= 48)
    {
      std::uint64_t byte = 0;
      const bool isEscape = this->Offset < this->Size && this->Bytes[this->Offset] == 0xff;
      const bool isMarker =
        isEscape && (this->Offset + 1 >= this->Size || this->Bytes[this->Offset + 1] != 0);
      if (this->Offset >= this->Size || isMarker)
      {
        this->Missing = std::min(this->Missing + 1, 1 << 20);
      }
      else
      {
        byte = this->Bytes[this->Offset];
        this->Offset += isEscape ? 2 : 1;
      }
      this->Window |= byte << (56 - this->Count);
      this->Count += 8;
    }
  }

  const unsigned char* Bytes;
  std::size_t Size;
  std::size_t Offset;
  std::uint64_t Window = 0; // the next bits, from the highest down
  int Count = 0;            // of bits in the window
  int Missing = 0;          // zero bytes that were put behind the end
  int Restarts = 0;
  bool IsCode = true;
};

// The standard halves by a shift, which rounds down.
int predicted(int predictor, int left, int above, int corner)
{
  switch (predictor)
  {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return corner;
    case 4:
      return left + above - corner;
    case 5:
      return left + ((above - corner) >> 1);
    case 6:
      return above + ((left - corner) >> 1);
    default:
      return (left + above) >> 1;
  }
}

// `above` is null in the first row, and in the first behind a restart.
bool readRow(
  const JPEGHeader& header, const std::uint16_t* above, std::uint16_t* row, int columns, Bits& bits)
{
  const int middle = 1 << (header.bits - header.droppedBits - 1);
  for (int x = 0; x < columns; ++x)
  {
    const int left = x > 0 ? row[x - 1] : above ? above[0] : middle;
    const bool isInside = above && x > 0;
    const int guess = isInside ? predicted(header.predictor, left, above[x], above[x - 1]) : left;
    const int length = bits.symbol(header.first);
    if (length > 16)
    {
      return false;
    }
    const int difference = length == 16 ? 32768 : length > 0 ? bits.number(length) : 0;
    row[x] = static_cast<std::uint16_t>(guess + difference); // modulo 65536, as the standard says
  }
  return bits.isWhole();
}

bool readLossless(const JPEGHeader& header, const FrameShape& shape, Bits& bits,
  std::vector<std::uint16_t>& samples)
{
  const int interval = header.restartInterval;
  if (interval % shape.columns != 0)
  {
    return false; // the standard lets restarts be at the beginning of rows only
  }
  const int rows = interval / shape.columns; // between restarts
  const std::size_t columns = static_cast<std::size_t>(shape.columns);
  for (int y = 0; y < shape.rows; ++y)
  {
    const bool restarts = rows > 0 && y > 0 && y % rows == 0;
    std::uint16_t* row = samples.data() + columns * static_cast<std::size_t>(y);
    if ((restarts && !bits.restart()) ||
      !readRow(header, y == 0 || restarts ? nullptr : row - columns, row, shape.columns, bits))
    {
      return false;
    }
  }
  for (std::uint16_t& sample : samples)
  {
    sample = static_cast<std::uint16_t>(sample << header.droppedBits);
  }
  return true;
}

using Block = std::array<double, 64>;

bool readBlock(const JPEGHeader& header, Bits& bits, double& first, Block& block)
{
  block.fill(0.0);
  const int length = bits.symbol(header.first);
  if (length > 15)
  {
    return false;
  }
  first += length > 0 ? bits.number(length) : 0;
  block[0] = first * header.quantization[0];
  for (std::size_t i = 1; i < block.size(); ++i)
  {
    const int symbol = bits.symbol(header.others);
    const int zeros = symbol >> 4;
    const int size = symbol & 15;
    if (size == 0 && zeros < 15)
    {
      break; // all others are zero
    }
    i += static_cast<std::size_t>(zeros);
    if (i >= block.size())
    {
      return false;
    }
    const std::size_t place = PlaceOfCoefficient[i];
    block[place] = size > 0 ? double(bits.number(size)) * header.quantization[place] : 0.0;
  }
  return bits.isWhole();
}

// waves[u][x]: the cosine of frequency u at x, scaled so that the transform keeps lengths.
std::array<std::array<double, Side>, Side> makeWaves()
{
  std::array<std::array<double, Side>, Side> waves{};
  for (int u = 0; u < Side; ++u)
  {
    for (int x = 0; x < Side; ++x)
    {
      waves[u][x] = (u == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * x + 1) * u * Pi / 16.0);
    }
  }
  return waves;
}

// The inverse cosine transform: columns, then rows.
void invertTransform(Block& block)
{
  static const auto waves = makeWaves();
  Block half{};
  for (int v = 0; v < Side; ++v)
  {
    for (int u = 0; u < Side; ++u)
    {
      const double coefficient = block[Side * v + u];
      for (int y = 0; coefficient != 0.0 && y < Side; ++y)
      {
        half[Side * y + u] += coefficient * waves[v][y];
      }
    }
  }
  for (int y = 0; y < Side; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      double sum = 0.0;
      for (int u = 0; u < Side; ++u)
      {
        sum += half[Side * y + u] * waves[u][x];
      }
      block[Side * y + x] = sum;
    }
  }
}

// Blocks at the right and lower rim stand over it.
void store(const Block& block, int bits, const FrameShape& shape, int left, int top,
  std::vector<std::uint16_t>& samples)
{
  const double most = (1 << bits) - 1;
  const double middle = 1 << (bits - 1);
  for (int y = 0; y < std::min(Side, shape.rows - top); ++y)
  {
    for (int x = 0; x < std::min(Side, shape.columns - left); ++x)
    {
      const double value = std::clamp(std::round(block[Side * y + x] + middle), 0.0, most);
      samples[static_cast<std::size_t>(top + y) * static_cast<std::size_t>(shape.columns) +
        static_cast<std::size_t>(left + x)] = static_cast<std::uint16_t>(value);
    }
  }
}

bool readTransformed(const JPEGHeader& header, const FrameShape& shape, Bits& bits,
  std::vector<std::uint16_t>& samples)
{
  double first = 0.0; // coefficient of the last block
  std::int64_t index = 0;
  Block block{};
  for (int top = 0; top < shape.rows; top += Side)
  {
    for (int left = 0; left < shape.columns; left += Side, ++index)
    {
      if (header.restartInterval > 0 && index > 0 && index % header.restartInterval == 0)
      {
        first = 0.0;
        if (!bits.restart())
        {
          return false;
        }
      }
      if (!readBlock(header, bits, first, block))
      {
        return false;
      }
      invertTransform(block);
      store(block, header.bits, shape, left, top, samples);
    }
  }
  return true;
}

}

UnpackedFrame unpackJPEG(const std::string& packed, const FrameShape& shape)
{
  JPEGHeader header;
  const std::string problem = readJPEGHeader(packed, shape, header);
  if (!problem.empty())
  {
    return { {}, problem };
  }
  std::vector<std::uint16_t> samples(shape.count());
  Bits bits(packed, header.begin);
  const bool isRead = header.isLossless ? readLossless(header, shape, bits, samples)
                                        : readTransformed(header, shape, bits, samples);
  if (!isRead)
  {
    return { {}, "a JPEG frame is damaged: its codes do not make up its pixels" };
  }
  return { widened(samples, shape.bytesOfNumber()), {}, header.bits, false };
}
}
