// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What stands before the numbers of a JPEG frame (ISO 10918-1).
 */
#ifndef BrainShift_JPEGHeader_h
#define BrainShift_JPEGHeader_h

#include "Formats/PackedFrames/FrameShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace brainshift
{
/** What a code of Huffman means, found by the next 16 bits. */
struct HuffmanCode
{
  std::uint8_t bits = 0; ///< its length; 0: no code begins so
  std::uint8_t symbol = 0;
};

/** One table of codes: 65536 entries, or none. */
using HuffmanTable = std::vector<HuffmanCode>;

/** One frame with one scan of one component. */
struct JPEGHeader
{
  bool isLossless = false; ///< process 14; if not, sequential cosine transform
  int bits = 0;            ///< of a sample, from 2 to 16
  int predictor = 0;       ///< of a lossless frame, from 1 to 7
  int droppedBits = 0;     ///< lowest bits that a lossless frame leaves out, fewer than `bits`
  int restartInterval = 0; ///< samples or blocks between two markers of restart; 0: none
  HuffmanTable first;      ///< codes of differences, or of the first coefficient of a block
  HuffmanTable others;     ///< codes of the other coefficients; empty in a lossless frame
  std::array<int, 64> quantization{}; ///< factors of coefficients, row by row
  std::size_t begin = 0;              ///< offset of the numbers, bytes
};

/** Place of a coefficient, row by row, from its number in the file. */
extern const std::array<std::uint8_t, 64> PlaceOfCoefficient;

/** Reads all up to the numbers. Returns a sentence if the frame cannot be read, else nothing. */
std::string readJPEGHeader(const std::string& packed, const FrameShape& shape, JPEGHeader& header);
}

#endif
