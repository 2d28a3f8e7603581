// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The tables and parameters of a JPEG frame: all before its entropy-coded data (ITU-T T.81,
 *        ISO/IEC 10918-1).
 */
#ifndef BrainShift_JPEGHeader_h
#define BrainShift_JPEGHeader_h

#include "Filters/PackedFrames/FrameShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace brainshift
{
/** A Huffman code, found by the next 16 bits. */
struct HuffmanCode
{
  std::uint8_t bits = 0;   ///< its length; 0: no code begins with these bits
  std::uint8_t symbol = 0; ///< its value (HUFFVAL)
};

/** A Huffman table: 65536 entries, or none. */
using HuffmanTable = std::vector<HuffmanCode>;

/** One frame with one scan of one component. */
struct JPEGHeader
{
  bool isLossless = false; ///< process 14; if not, sequential DCT
  int bits = 0;            ///< sample precision, from 2 to 16
  int predictor = 0;       ///< of a lossless frame, from 1 to 7
  int pointTransform = 0;  ///< of a lossless frame: lowest bits left out, fewer than `bits`
  int restartInterval = 0; ///< samples or blocks between two restart markers; 0: none
  HuffmanTable dcTable;    ///< codes of DC coefficients, or of differences of a lossless frame
  HuffmanTable acTable;    ///< codes of AC coefficients; empty in a lossless frame
  std::array<int, 64> quantization{}; ///< elements of the quantization table, row by row
  std::size_t begin = 0;              ///< offset of the entropy-coded data, bytes
};

/** The zig-zag sequence: place of a coefficient in its block, row by row, from its index in the
 * file (T.81, figure A.6). */
extern const std::array<std::uint8_t, 64> ZigZag;

/**
 * Reads all up to the entropy-coded data. Returns a sentence if the frame cannot be read, else
 * nothing.
 */
std::string readJPEGHeader(const std::string& packed, const FrameShape& shape, JPEGHeader& header);
}

#endif
