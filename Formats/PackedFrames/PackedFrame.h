// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a file says of its packed frames, what a frame unpacks to, and what unpacks it.
#ifndef BrainShift_PackedFrame_h
#define BrainShift_PackedFrame_h

#include "Common/Problem.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace brainshift
{
/** The size of a frame of one sample per pixel. */
struct FrameShape
{
  int columns = 0;
  int rows = 0;
  int bitsAllocated = 0; ///< for each number: 8, 16 or 32

  std::size_t count() const
  {
    return static_cast<std::size_t>(this->columns) * static_cast<std::size_t>(this->rows);
  }
  std::size_t bytesOfNumber() const { return static_cast<std::size_t>(this->bitsAllocated) / 8; }
};

/** Numbers of `bitsAllocated` bits in the machine's order of bytes. */
struct UnpackedFrame
{
  std::string numbers;   ///< rows of columns
  int bits = 0;          ///< of a number, as the frame says; 0: it says nothing
  bool isSigned = false; ///< whether the frame says that numbers are signed
};

///@{
/**
 * Unpacks one frame, of any bytes, or throws one sentence: a damaged frame gives a problem or wrong
 * numbers, and nothing is read or written elsewhere. What follows the last pixel is not looked at.
 */
UnpackedFrame unpackJPEG(const std::string& packed, const FrameShape& shape);
UnpackedFrame unpackJPEGLS(const std::string& packed, const FrameShape& shape);
UnpackedFrame unpackJPEG2000(const std::string& packed, const FrameShape& shape);
UnpackedFrame unpackRunLengths(const std::string& packed, const FrameShape& shape);
UnpackedFrame unpackDeflated(const std::string& packed, const FrameShape& shape);
///@}

/** What a frame has, in a sentence: "64 x 32 pixels of 1 samples in 12 bits". */
template <typename Number>
std::string shapeText(Number columns, Number rows, Number samples, Number bits)
{
  return std::to_string(columns) + " x " + std::to_string(rows) + " pixels of " +
    std::to_string(samples) + " samples in " + std::to_string(bits) + " bits";
}

/** Says that a frame has another size than its file. */
inline Problem otherShape(const FrameShape& shape, const std::string& what)
{
  return Problem("a frame has " + what + "; the file says " + std::to_string(shape.columns) +
    " x " + std::to_string(shape.rows) + " pixels of 1 sample in up to " +
    std::to_string(shape.bitsAllocated) + " bits");
}

/** The bytes of samples that became numbers of another type. */
template <typename Number, typename Sample>
std::string bytesAs(const std::vector<Sample>& samples)
{
  const std::vector<Number> numbers(samples.begin(), samples.end());
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/** Numbers of 1, 2 or 4 bytes with the lower bits of the samples; signs are kept. */
template <typename Sample>
std::string widened(const std::vector<Sample>& samples, std::size_t bytesOfNumber)
{
  switch (bytesOfNumber)
  {
    case 1:
      return bytesAs<std::uint8_t>(samples);
    case 2:
      return bytesAs<std::uint16_t>(samples);
    default:
      return bytesAs<std::uint32_t>(samples);
  }
}
}

#endif
