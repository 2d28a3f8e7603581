// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The loop over a box of three-dimensional indices.
 */
#ifndef BrainShift_IndexLoop_h
#define BrainShift_IndexLoop_h

#include <glm/vec3.hpp>

namespace brainshift
{
/**
 * Calls visit(index) for each index from `first` to `last`, both included, x fastest. It visits
 * nothing if `last` is below `first` along an axis.
 */
template <typename Visit>
void forEachIndex(const glm::ivec3& first, const glm::ivec3& last, Visit&& visit)
{
  glm::ivec3 index;
  for (index.z = first.z; index.z <= last.z; ++index.z)
  {
    for (index.y = first.y; index.y <= last.y; ++index.y)
    {
      for (index.x = first.x; index.x <= last.x; ++index.x)
      {
        visit(static_cast<const glm::ivec3&>(index));
      }
    }
  }
}
}

#endif
