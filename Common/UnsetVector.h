// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Vectors of many numbers that are written before they are read.
#ifndef BrainShift_UnsetVector_h
#define BrainShift_UnsetVector_h

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace brainshift
{
/** Memory of a vector, without values: to set all of them takes as long as to use them once. */
template <typename T>
struct UnsetAllocator : std::allocator<T>
{
  template <typename Other>
  struct rebind
  {
    using other = UnsetAllocator<Other>;
  };

  template <typename Made>
  void construct(Made* place)
  {
    ::new (static_cast<void*>(place)) Made;
  }
  template <typename Made, typename... From>
  void construct(Made* place, From&&... from)
  {
    ::new (static_cast<void*>(place)) Made(std::forward<From>(from)...);
  }
};

/** A vector whose new elements have no value before one is written. */
template <typename T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;
}

#endif
