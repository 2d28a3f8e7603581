// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bytes that are packed by deflate, when the size that they must have is known.
#ifndef BrainShift_Inflate_h
#define BrainShift_Inflate_h

#include <cstddef>
#include <string>

namespace brainshift
{
/** What is around the deflated bytes. */
enum class Inflate
{
  Raw,    ///< nothing
  Wrapped ///< a header of gzip or zlib
};

/** Exactly `size` bytes, and nothing left over, or throws the end of a sentence. */
std::string inflated(const std::string& packed, std::size_t size, Inflate wrapping);
}

#endif
