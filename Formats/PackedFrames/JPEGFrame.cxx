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

// The entropy-coded data. Behind its end come zeros; isWhole then says no.
class EntropyData
{
public:
  EntropyData(const std::string& packed, std::size_t offset)
    : Bytes(reinterpret_cast<const unsigned char*>(packed.data()))
    , Size(packed.size())
    , Offset(offset)
  {
  }

  // Whether all bits that were taken were there, and each code was in its table.
  bool isWhole() const { return this->IsCode && 8 * this->Missing <= this->Count; }

  // The value of the next Huffman code (DECODE, F.2.2.3).
  int symbol(const HuffmanTable& table)
  {
    if (this->Count < 32) // a code and the number behind it have 31 bits at most
    {
      this->fill();
    }
    const HuffmanCode code = table[this->Window >> 48];
    this->IsCode = this->IsCode && code.bits > 0;
    this->drop(code.bits);
    return code.symbol;
  }

  // A number of so many bits, from 1 to 15, right behind its symbol; the lower half of them stands
  // for negative numbers (RECEIVE and EXTEND, F.2.2.1).
  int number(int bits)
  {
    const int value = static_cast<int>(this->Window >> (64 - bits));
    this->drop(bits);
    return value < 1 << (bits - 1) ? value - (1 << bits) + 1 : value;
  }

  // Goes behind a restart marker, which must be next.
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

  // Takes 4 bytes at once where none of them can begin a marker.
  bool fillFour()
  {
    if (this->Count > 32 || this->Size - this->Offset < 4)
    {
      return false;
    }
    std::uint64_t four = 0;
    bool isPlain = true;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const unsigned char byte = this->Bytes[this->Offset + i];
      four = four << 8 | byte;
      isPlain = isPlain && byte != 0xff;
    }
    if (isPlain)
    {
      this->Window |= four << (32 - this->Count);
      this->Count += 32;
      this->Offset += 4;
    }
    return isPlain;
  }

  void fill()
  {
    while (this->Count <= 48 && !this->fillFour())
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
bool readRow(const JPEGHeader& header, const std::uint16_t* above, std::uint16_t* row, int columns,
  EntropyData& data)
{
  const int middle = 1 << (header.bits - header.pointTransform - 1);
  for (int x = 0; x < columns; ++x)
  {
    const int left = x > 0 ? row[x - 1] : above ? above[0] : middle;
    const bool isInside = above && x > 0;
    const int guess = isInside ? predicted(header.predictor, left, above[x], above[x - 1]) : left;
    const int length = data.symbol(header.dcTable);
    if (length > 16)
    {
      return false;
    }
    const int difference = length == 16 ? 32768 : length > 0 ? data.number(length) : 0;
    row[x] = static_cast<std::uint16_t>(guess + difference); // modulo 65536, as the standard says
  }
  return data.isWhole();
}

bool readLossless(const JPEGHeader& header, const FrameShape& shape, EntropyData& data,
  std::vector<std::uint16_t>& samples)
{
  const int rows = header.restartInterval / shape.columns; // between restarts
  const std::size_t columns = static_cast<std::size_t>(shape.columns);
  for (int y = 0; y < shape.rows; ++y)
  {
    const bool restarts = rows > 0 && y > 0 && y % rows == 0;
    std::uint16_t* row = samples.data() + columns * static_cast<std::size_t>(y);
    if ((restarts && !data.restart()) ||
      !readRow(header, y == 0 || restarts ? nullptr : row - columns, row, shape.columns, data))
    {
      return false;
    }
  }
  for (std::uint16_t& sample : samples)
  {
    sample = static_cast<std::uint16_t>(sample << header.pointTransform);
  }
  return true;
}

using Block = std::array<float, 64>; // row by row

bool readBlock(const JPEGHeader& header, EntropyData& data, std::int64_t& dc, Block& block)
{
  block.fill(0.0F);
  const int length = data.symbol(header.dcTable);
  if (length > 15)
  {
    return false;
  }
  dc += length > 0 ? data.number(length) : 0;
  block[0] = static_cast<float>(dc * header.quantization[0]);
  for (std::size_t i = 1; i < block.size(); ++i)
  {
    const int symbol = data.symbol(header.acTable);
    const int run = symbol >> 4; // of zero coefficients
    const int size = symbol & 15;
    if (size == 0 && run < 15)
    {
      break; // end of block: all others are zero
    }
    i += static_cast<std::size_t>(run);
    if (i >= block.size())
    {
      return false;
    }
    const std::size_t place = ZigZag[i];
    block[place] =
      size > 0 ? static_cast<float>(data.number(size) * header.quantization[place]) : 0.0F;
  }
  return data.isWhole();
}

// basis[u][x]: the cosine of frequency u at x, scaled so that the transform keeps lengths (A.3.3).
std::array<std::array<float, Side>, Side> makeBasis()
{
  std::array<std::array<float, Side>, Side> basis{};
  for (int u = 0; u < Side; ++u)
  {
    for (int x = 0; x < Side; ++x)
    {
      basis[u][x] = static_cast<float>(
        (u == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * x + 1) * u * Pi / 16.0));
    }
  }
  return basis;
}

// The inverse DCT along the first index, of all 8 columns at once. Even frequencies are symmetric
// about the middle, odd ones antisymmetric: each sum serves two samples.
Block invertedColumns(const Block& from)
{
  static const auto basis = makeBasis();
  Block to;
  for (int y = 0; y < Side / 2; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      const float even = basis[0][y] * from[x] + basis[2][y] * from[2 * Side + x] +
        basis[4][y] * from[4 * Side + x] + basis[6][y] * from[6 * Side + x];
      const float odd = basis[1][y] * from[Side + x] + basis[3][y] * from[3 * Side + x] +
        basis[5][y] * from[5 * Side + x] + basis[7][y] * from[7 * Side + x];
      to[Side * y + x] = even + odd;
      to[Side * (Side - 1 - y) + x] = even - odd;
    }
  }
  return to;
}

Block transposed(const Block& block)
{
  Block result;
  for (int y = 0; y < Side; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      result[Side * x + y] = block[Side * y + x];
    }
  }
  return result;
}

// The inverse DCT of a block.
void invertDCT(Block& block)
{
  block = transposed(invertedColumns(transposed(invertedColumns(block))));
}

// The first sample of a block in the frame.
struct BlockCorner
{
  int left = 0;
  int top = 0;
};

// Blocks at the right and lower rim stand over it.
void store(const Block& block, int bits, const FrameShape& shape, const BlockCorner& corner,
  std::vector<std::uint16_t>& samples)
{
  const auto [left, top] = corner;
  const float most = static_cast<float>((1 << bits) - 1);
  const float shift = static_cast<float>(1 << (bits - 1)) + 0.5F; // level shift, and rounding
  const int columns = std::min(Side, shape.columns - left);
  for (int y = 0; y < std::min(Side, shape.rows - top); ++y)
  {
    std::uint16_t* row = samples.data() +
      static_cast<std::size_t>(top + y) * static_cast<std::size_t>(shape.columns) + left;
    for (int x = 0; x < columns; ++x)
    {
      row[x] = static_cast<std::uint16_t>(
        static_cast<int>(std::clamp(block[Side * y + x] + shift, 0.0F, most)));
    }
  }
}

bool readDCT(const JPEGHeader& header, const FrameShape& shape, EntropyData& data,
  std::vector<std::uint16_t>& samples)
{
  std::int64_t dc = 0; // DC coefficient of the last block
  std::int64_t index = 0;
  Block block{};
  for (int top = 0; top < shape.rows; top += Side)
  {
    for (int left = 0; left < shape.columns; left += Side, ++index)
    {
      if (header.restartInterval > 0 && index > 0 && index % header.restartInterval == 0)
      {
        dc = 0;
        if (!data.restart())
        {
          return false;
        }
      }
      if (!readBlock(header, data, dc, block))
      {
        return false;
      }
      invertDCT(block);
      store(block, header.bits, shape, { left, top }, samples);
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
  EntropyData data(packed, header.begin);
  const bool isRead = header.isLossless ? readLossless(header, shape, data, samples)
                                        : readDCT(header, shape, data, samples);
  if (!isRead)
  {
    return { {},
      "a JPEG frame is damaged: its Huffman data ends or is invalid before the last pixel" };
  }
  return { widened(samples, shape.bytesOfNumber()), {}, header.bits, false };
}
}
