// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The points of tissue that lie farthest out: enough to place a camera.
 */
#ifndef BrainShift_FarPoints_h
#define BrainShift_FarPoints_h

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
/** Of all positions added, the farthest one in each of many directions, among them the axes. */
class FarPoints
{
public:
  FarPoints();

  /** A position, mm, world. */
  void add(const glm::dvec3& world);

  /** mm, world; empty if no process added any. All processes must call it and get the same. */
  std::vector<glm::dvec3> ofAllProcesses() const;

private:
  struct Farthest
  {
    double reach; // mm along the direction
    glm::dvec3 point{ 0.0 };
  };

  std::vector<glm::dvec3> Directions; // of unit length
  std::vector<Farthest> Found;        // for each direction
};
}

#endif
