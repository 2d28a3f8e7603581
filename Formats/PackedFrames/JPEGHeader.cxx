// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/PackedFrames/JPEGHeader.h"

#include "Common/Bytes.h"

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

std::string readFrame(
  const Segment& segment, const FrameShape& shape, Frame& frame, JPEGHeader& header)
{
  if (frame.marker != 0 || segment.size < 9)
  {
    return Damaged + (frame.marker != 0 ? "it has two headers" : "its header is too short");
  }
  header.bits = segment.bytes[0];
  const int rows = twoBytes(segment.bytes + 1);
  const int columns = twoBytes(segment.bytes + 3);
  const int components = segment.bytes[5];
  const int mostBits = segment.marker == SOF0 ? 8 : 16;
  if (rows != shape.rows || columns != shape.columns || components != 1 || header.bits < 2 ||
    header.bits > mostBits || header.bits > shape.bitsAllocated)
  {
    return otherShape(shape,
      std::to_string(columns) + " x " + std::to_string(rows) + " pixels of " +
        std::to_string(components) + " samples in " + std::to_string(header.bits) + " bits")
      .problem;
  }
  if (segment.marker != SOF3 && header.bits > 12)
  {
    return "a JPEG frame has a DCT of " + std::to_string(header.bits) +
      " bits; the standard allows 12";
  }
  frame.marker = segment.marker;
  header.isLossless = segment.marker == SOF3;
  frame.component = segment.bytes[6];
  frame.quantization = segment.bytes[8];
  return {};
}

// What a lossless frame cannot have: the end of a sentence. Empty if there is nothing.
std::string losslessProblem(const JPEGHeader& header, int columns)
{
  if (header.dcTable.empty())
  {
    return "it lacks a Huffman table";
  }
  if (header.predictor < 1 || header.predictor > 7)
  {
    return "its predictor is " + std::to_string(header.predictor) + "; it must be from 1 to 7";
  }
  if (header.restartInterval % columns != 0)
  {
    return "its restart interval is " + std::to_string(header.restartInterval) +
      " samples; it must be a multiple of its " + std::to_string(columns) + " columns";
  }
  return header.pointTransform < header.bits
    ? std::string()
    : "its point transform is " + std::to_string(header.pointTransform) +
      "; it must be below its " + std::to_string(header.bits) + " bits";
}

std::string readScan(const Segment& segment, const FrameShape& shape, const Frame& frame,
  const Tables& tables, JPEGHeader& header)
{
  if (frame.marker == 0 || segment.size != 6 || segment.bytes[0] != 1 ||
    segment.bytes[1] != frame.component)
  {
    return Damaged + "its scan does not have its only component";
  }
  const std::size_t dc = segment.bytes[2] >> 4;
  const std::size_t ac = segment.bytes[2] & 15;
  header.dcTable = dc < TableCount ? tables.dc[dc] : HuffmanTable();
  if (header.isLossless)
  {
    header.predictor = segment.bytes[3];
    header.pointTransform = segment.bytes[5] & 15;
    const std::string problem = losslessProblem(header, shape.columns);
    return problem.empty() ? problem : Damaged + problem;
  }
  header.acTable = ac < TableCount ? tables.ac[ac] : HuffmanTable();
  if (header.dcTable.empty() || header.acTable.empty())
  {
    return Damaged + "it lacks a Huffman table";
  }
  if (frame.quantization >= TableCount || tables.quantization[frame.quantization].empty())
  {
    return Damaged + "it lacks its quantization table";
  }
  for (std::size_t i = 0; i < header.quantization.size(); ++i)
  {
    header.quantization[i] = tables.quantization[frame.quantization][i];
  }
  return {};
}

std::string readTable(const Segment& segment, Tables& tables, JPEGHeader& header)
{
  switch (segment.marker)
  {
    case DHT:
      return readHuffmanTables(segment, tables) ? "" : Damaged + "a Huffman table is invalid";
    case DQT:
      return readQuantizationTables(segment, tables) ? ""
                                                     : Damaged + "a quantization table is invalid";
    case DRI:
      header.restartInterval = segment.size == 2 ? twoBytes(segment.bytes) : 0;
      return segment.size == 2 ? "" : Damaged + "its restart interval is invalid";
    default:
      break;
  }
  if ((segment.marker >= APP0 && segment.marker <= APP15) || segment.marker == COM)
  {
    return {};
  }
  if (segment.marker > SOF0 && segment.marker <= SOF15 && segment.marker != DAC)
  {
    return "a JPEG frame is progressive or coded in another way that BrainShift does not read; it "
           "reads baseline, extended and lossless frames with Huffman codes";
  }
  return Damaged + "it has the marker " + std::to_string(segment.marker) + " in its header";
}
}

const std::array<std::uint8_t, 64> ZigZag = { 0, 1, 8, 16, 9, 2, 3, 10, 17, 24, 32, 25, 18, 11, 4,
  5, 12, 19, 26, 33, 40, 48, 41, 34, 27, 20, 13, 6, 7, 14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36,
  29, 22, 15, 23, 30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63 };

std::string readJPEGHeader(const std::string& packed, const FrameShape& shape, JPEGHeader& header)
{
  if (packed.size() < 2 || static_cast<unsigned char>(packed[0]) != 0xff ||
    static_cast<unsigned char>(packed[1]) != SOI)
  {
    return Damaged + "it does not begin with the marker of an image (SOI)";
  }
  Tables tables;
  Frame frame;
  Segment segment;
  header.begin = 2;
  while (nextSegment(packed, header.begin, segment))
  {
    const bool isFrame = segment.marker == SOF0 || segment.marker == SOF1 || segment.marker == SOF3;
    const std::string problem = isFrame ? readFrame(segment, shape, frame, header)
      : segment.marker == SOS           ? readScan(segment, shape, frame, tables, header)
                                        : readTable(segment, tables, header);
    if (!problem.empty() || segment.marker == SOS)
    {
      return problem;
    }
  }
  return Damaged + "it ends before its scan";
}
}
