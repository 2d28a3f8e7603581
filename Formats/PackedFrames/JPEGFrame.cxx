// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Unpacks JPEG frames with Huffman codes (ITU-T T.81, ISO/IEC 10918-1): baseline, extended to 12
/// bits, and lossless.
#include "Common/Bytes.h"
#include "Formats/PackedFrames/PackedFrame.h"

#include <array>
#include <cmath>
#include <numeric>

namespace brainshift
{
namespace
{
// Markers, the second byte of each (T.81, table B.1).
constexpr int SOF0 = 0xc0;  // start of frame: baseline DCT
constexpr int SOF1 = 0xc1;  // extended sequential DCT
constexpr int SOF3 = 0xc3;  // lossless
constexpr int SOF15 = 0xcf; // the last of frames, of kinds that are not read
constexpr int DHT = 0xc4;   // Huffman tables
constexpr int DAC = 0xcc;   // conditions of arithmetic coding
constexpr int SOI = 0xd8;   // start of image
constexpr int SOS = 0xda;   // start of scan
constexpr int DQT = 0xdb;   // quantization tables
constexpr int DRI = 0xdd;   // restart interval
constexpr int APP0 = 0xe0;  // segments of programs
constexpr int APP15 = 0xef;
constexpr int COM = 0xfe; // a comment

// A Huffman code, found by the next 16 bits.
struct HuffmanCode
{
  std::uint8_t bits = 0;   // its length; 0: no code begins with these bits
  std::uint8_t symbol = 0; // its value (HUFFVAL)
};

// A Huffman table: 65536 entries, or none.
using HuffmanTable = std::vector<HuffmanCode>;

// One frame with one scan of one component.
struct JPEGHeader
{
  bool isLossless = false; // process 14; if not, sequential DCT
  int bits = 0;            // sample precision, from 2 to 16
  int predictor = 0;       // of a lossless frame, from 1 to 7
  int pointTransform = 0;  // of a lossless frame: lowest bits left out, fewer than `bits`
  int restartInterval = 0; // samples or blocks between two restart markers; 0: none
  HuffmanTable dcTable;    // codes of DC coefficients, or of differences of a lossless frame
  HuffmanTable acTable;    // codes of AC coefficients; empty in a lossless frame
  std::array<int, 64> quantization{}; // elements of the quantization table, row by row
  std::size_t begin = 0;              // offset of the entropy-coded data, bytes
};

// The zig-zag sequence: place of a coefficient in its block, row by row, from its index in the file
// (T.81, figure A.6).
const std::array<std::uint8_t, 64> ZigZag = { 0, 1, 8, 16, 9, 2, 3, 10, 17, 24, 32, 25, 18, 11, 4,
  5, 12, 19, 26, 33, 40, 48, 41, 34, 27, 20, 13, 6, 7, 14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36,
  29, 22, 15, 23, 30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63 };

constexpr std::size_t TableCount = 4;
const std::string Damaged = "a JPEG frame is damaged: ";

struct Segment
{
  int marker = 0;
  const unsigned char* bytes = nullptr; // behind its length
  std::size_t size = 0;
};

struct Tables
{
  std::array<HuffmanTable, TableCount> dc;
  std::array<HuffmanTable, TableCount> ac;
  std::array<std::vector<int>, TableCount> quantization;
};

struct Frame
{
  int marker = 0; // 0: none yet
  int component = 0;
  std::size_t quantization = 0;
};

int twoBytes(const unsigned char* bytes)
{
  return storedNumber<std::uint16_t>(bytes, true);
}

// Moves `offset` behind the next segment. False if there is none.
bool nextSegment(const std::string& packed, std::size_t& offset, Segment& segment)
{
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  while (offset + 4 <= packed.size() && bytes[offset] == 0xff && bytes[offset + 1] == 0xff)
  {
    ++offset; // markers may be filled up
  }
  if (offset + 4 > packed.size() || bytes[offset] != 0xff)
  {
    return false;
  }
  const auto length = static_cast<std::size_t>(twoBytes(bytes + offset + 2));
  if (length < 2 || length > packed.size() - offset - 2)
  {
    return false;
  }
  segment = { bytes[offset + 1], bytes + offset + 4, length - 2 };
  offset += 2 + length;
  return true;
}

// Codes of one length follow each other, and longer ones follow shorter ones.
bool fillTable(const unsigned char* counts, const unsigned char* symbols, HuffmanTable& table)
{
  table.assign(std::size_t(1) << 16, HuffmanCode());
  std::size_t at = 0;
  for (int bits = 1; bits <= 16; ++bits)
  {
    const std::size_t step = std::size_t(1) << (16 - bits);
    for (int i = 0; i < counts[bits - 1]; ++i, ++symbols)
    {
      if (at + step > table.size())
      {
        return false;
      }
      for (const std::size_t end = at + step; at < end; ++at)
      {
        table[at] = { static_cast<std::uint8_t>(bits), *symbols };
      }
    }
  }
  return true;
}

bool readHuffmanTables(Segment segment, Tables& tables)
{
  constexpr std::size_t Head = 17; // which table, and how many codes of each length
  while (segment.size >= Head)
  {
    const std::size_t tableClass = segment.bytes[0] >> 4;
    const std::size_t which = segment.bytes[0] & 15;
    const std::size_t count = std::accumulate(segment.bytes + 1, segment.bytes + Head, 0U);
    if (tableClass > 1 || which >= TableCount || count > 256 || Head + count > segment.size ||
      !fillTable(segment.bytes + 1, segment.bytes + Head,
        tableClass == 0 ? tables.dc[which] : tables.ac[which]))
    {
      return false;
    }
    segment.bytes += Head + count;
    segment.size -= Head + count;
  }
  return segment.size == 0;
}

bool readQuantizationTables(Segment segment, Tables& tables)
{
  while (segment.size > 0)
  {
    const std::size_t bytes = 1 + (segment.bytes[0] >> 4);
    const std::size_t which = segment.bytes[0] & 15;
    if (bytes > 2 || which >= TableCount || 1 + 64 * bytes > segment.size)
    {
      return false;
    }
    tables.quantization[which].resize(64);
    for (std::size_t i = 0; i < 64; ++i)
    {
      const unsigned char* element = segment.bytes + 1 + i * bytes;
      tables.quantization[which][ZigZag[i]] = bytes == 1 ? *element : twoBytes(element);
    }
    segment.bytes += 1 + 64 * bytes;
    segment.size -= 1 + 64 * bytes;
  }
  return true;
}

void readFrame(const Segment& segment, const FrameShape& shape, Frame& frame, JPEGHeader& header)
{
  if (frame.marker != 0 || segment.size < 9)
  {
    throw Problem(Damaged + (frame.marker != 0 ? "it has two headers" : "its header is too short"));
  }
  header.bits = segment.bytes[0];
  const int rows = twoBytes(segment.bytes + 1);
  const int columns = twoBytes(segment.bytes + 3);
  const int components = segment.bytes[5];
  const int mostBits = segment.marker == SOF0 ? 8 : 16;
  if (rows != shape.rows || columns != shape.columns || components != 1 || header.bits < 2 ||
    header.bits > mostBits || header.bits > shape.bitsAllocated)
  {
    throw otherShape(shape, shapeText(columns, rows, components, header.bits));
  }
  if (segment.marker != SOF3 && header.bits > 12)
  {
    throw Problem(
      "a JPEG frame has a DCT of " + std::to_string(header.bits) + " bits; the standard allows 12");
  }
  frame.marker = segment.marker;
  header.isLossless = segment.marker == SOF3;
  frame.component = segment.bytes[6];
  frame.quantization = segment.bytes[8];
}

// Throws the end of a sentence about what a lossless frame cannot have.
void requireLossless(const JPEGHeader& header, int columns)
{
  if (header.dcTable.empty())
  {
    throw Problem("it lacks a Huffman table");
  }
  if (header.predictor < 1 || header.predictor > 7)
  {
    throw Problem(
      "its predictor is " + std::to_string(header.predictor) + "; it must be from 1 to 7");
  }
  if (header.restartInterval % columns != 0)
  {
    throw Problem("its restart interval is " + std::to_string(header.restartInterval) +
      " samples; it must be a multiple of its " + std::to_string(columns) + " columns");
  }
  if (!(header.pointTransform < header.bits))
  {
    throw Problem("its point transform is " + std::to_string(header.pointTransform) +
      "; it must be below its " + std::to_string(header.bits) + " bits");
  }
}

void readScan(const Segment& segment, const FrameShape& shape, const Frame& frame,
  const Tables& tables, JPEGHeader& header)
{
  if (frame.marker == 0 || segment.size != 6 || segment.bytes[0] != 1 ||
    segment.bytes[1] != frame.component)
  {
    throw Problem(Damaged + "its scan does not have its only component");
  }
  const std::size_t dc = segment.bytes[2] >> 4;
  const std::size_t ac = segment.bytes[2] & 15;
  header.dcTable = dc < TableCount ? tables.dc[dc] : HuffmanTable();
  if (header.isLossless)
  {
    header.predictor = segment.bytes[3];
    header.pointTransform = segment.bytes[5] & 15;
    withBeginning(Damaged, [&] { requireLossless(header, shape.columns); });
    return;
  }
  header.acTable = ac < TableCount ? tables.ac[ac] : HuffmanTable();
  if (header.dcTable.empty() || header.acTable.empty())
  {
    throw Problem(Damaged + "it lacks a Huffman table");
  }
  if (frame.quantization >= TableCount || tables.quantization[frame.quantization].empty())
  {
    throw Problem(Damaged + "it lacks its quantization table");
  }
  for (std::size_t i = 0; i < header.quantization.size(); ++i)
  {
    header.quantization[i] = tables.quantization[frame.quantization][i];
  }
}

void readTable(const Segment& segment, Tables& tables, JPEGHeader& header)
{
  switch (segment.marker)
  {
    case DHT:
      throwIfAny(readHuffmanTables(segment, tables) ? "" : Damaged + "a Huffman table is invalid");
      return;
    case DQT:
      throwIfAny(
        readQuantizationTables(segment, tables) ? "" : Damaged + "a quantization table is invalid");
      return;
    case DRI:
      header.restartInterval = segment.size == 2 ? twoBytes(segment.bytes) : 0;
      throwIfAny(segment.size == 2 ? "" : Damaged + "its restart interval is invalid");
      return;
    default:
      break;
  }
  if ((segment.marker >= APP0 && segment.marker <= APP15) || segment.marker == COM)
  {
    return;
  }
  if (segment.marker > SOF0 && segment.marker <= SOF15 && segment.marker != DAC)
  {
    throw Problem(
      "a JPEG frame is progressive or coded in another way that BrainShift does not read; it "
      "reads baseline, extended and lossless frames with Huffman codes");
  }
  throw Problem(Damaged + "it has the marker " + std::to_string(segment.marker) + " in its header");
}

// Reads all up to the entropy-coded data.
JPEGHeader readJPEGHeader(const std::string& packed, const FrameShape& shape)
{
  JPEGHeader header;
  if (packed.size() < 2 || static_cast<unsigned char>(packed[0]) != 0xff ||
    static_cast<unsigned char>(packed[1]) != SOI)
  {
    throw Problem(Damaged + "it does not begin with the marker of an image (SOI)");
  }
  Tables tables;
  Frame frame;
  Segment segment;
  header.begin = 2;
  while (nextSegment(packed, header.begin, segment))
  {
    const bool isFrame = segment.marker == SOF0 || segment.marker == SOF1 || segment.marker == SOF3;
    if (isFrame)
    {
      readFrame(segment, shape, frame, header);
    }
    else if (segment.marker == SOS)
    {
      readScan(segment, shape, frame, tables, header);
      return header;
    }
    else
    {
      readTable(segment, tables, header);
    }
  }
  throw Problem(Damaged + "it ends before its scan");
}

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
  const JPEGHeader header = readJPEGHeader(packed, shape);
  std::vector<std::uint16_t> samples(shape.count());
  EntropyData data(packed, header.begin);
  const bool isRead = header.isLossless ? readLossless(header, shape, data, samples)
                                        : readDCT(header, shape, data, samples);
  if (!isRead)
  {
    throw Problem(
      "a JPEG frame is damaged: its Huffman data ends or is invalid before the last pixel");
  }
  return { widened(samples, shape.bytesOfNumber()), header.bits, false };
}
}
