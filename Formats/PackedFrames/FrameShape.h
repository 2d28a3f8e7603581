// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What a file says of its packed frames, and what a frame unpacks to.
 */
#ifndef BrainShift_FrameShape_h
#define BrainShift_FrameShape_h

#include <cstddef>
#include <string>

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

/** Numbers of `bitsAllocated` bits in the machine's order of bytes, or why there are none. */
struct UnpackedFrame
{
  std::string numbers;   ///< rows of columns; empty if there is a problem
  std::string problem;   ///< a sentence without a full stop; empty if there is none
  int bits = 0;          ///< of a number, as the frame says; 0: it says nothing
  bool isSigned = false; ///< whether the frame says that numbers are signed
};

/** Says that a frame has another size than its file. `what` is what the frame has. */
inline UnpackedFrame otherShape(const FrameShape& shape, const std::string& what)
{
  return { {},
    "a frame has " + what + "; the file says " + std::to_string(shape.columns) + " x " +
      std::to_string(shape.rows) + " pixels of 1 sample in up to " +
      std::to_string(shape.bitsAllocated) + " bits" };
}
}

#endif
