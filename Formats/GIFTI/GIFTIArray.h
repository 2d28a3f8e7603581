// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief An array of numbers in a GIFTI file.
 */
#ifndef BrainShift_GIFTIArray_h
#define BrainShift_GIFTIArray_h

#include "Formats/Surfaces/Surface.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace brainshift
{
/** A matrix that takes points from one space to another. The spaces are GIFTI's words. */
struct GIFTITransform
{
  std::string from;
  std::string to;
  std::vector<double> numbers; ///< 16, row by row
};

/** One DataArray. */
struct GIFTIArray
{
  std::map<std::string, std::string> attributes; ///< of the element, such as Intent
  std::map<std::string, std::string> meta;       ///< names and values of its MetaData
  std::vector<GIFTITransform> transforms;
  NumberType type = NumberType::Float32;
  std::size_t rows = 0;    ///< Dim0
  std::size_t columns = 1; ///< the product of the other dimensions
  std::vector<char> bytes; ///< row by row, in the order of this machine

  /** The value of an attribute; empty if there is none. */
  std::string attribute(const std::string& name) const
  {
    const auto found = this->attributes.find(name);
    return found == this->attributes.end() ? std::string() : found->second;
  }
};
}

#endif
