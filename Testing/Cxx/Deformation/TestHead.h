// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A head of labels on grids, and strokes all over it, for tests of masks.
#ifndef BrainShift_TestHead_h
#define BrainShift_TestHead_h

#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <vector>

namespace brainshift::testing::head
{
constexpr int Samples = 4;
constexpr int Brain = 4;
constexpr int Skull = 7;

// Two millimetres a voxel.
inline const Grid VolumeGrid = plainGrid({ 41, 37, 33 }, glm::dvec3(2.0));
inline const glm::dvec3 Middle(40.0, 36.0, 32.0);

// A head: a brain with a cleft from above, in a skull. Labels from a position (mm).
inline int labelAt(const glm::dvec3& world)
{
  const double fromMiddle = glm::length((world - Middle) / glm::dvec3(1.2, 1.1, 1.0));
  const bool cleft = std::abs(world.x - Middle.x) < 2.5 && world.z > Middle.z + 6.0;
  return fromMiddle > 28.0 ? 0 : fromMiddle > 24.0 || cleft ? Skull : Brain;
}

// A finer grid that shares no axis with the volume and covers it.
inline Grid obliqueMaskGrid()
{
  Grid grid = plainGrid(glm::ivec3(90), glm::dvec3(1.3));
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1.0, -2.0, 0.5)));
  grid.origin = Middle - grid.worldVectorFromGrid(glm::dvec3(44.5));
  return grid;
}

// Strokes all over the head, most of which would fold tissue.
inline std::vector<Stroke> strongStrokes(unsigned int seed, int count)
{
  Random random(seed);
  std::vector<Stroke> strokes;
  for (int i = 0; i < count; ++i)
  {
    Stroke stroke = strokeAt(i % 2 ? Tool::Soft : Tool::Stamp, random.point(VolumeGrid, -4.0),
      random.between(glm::dvec3(-25.0), glm::dvec3(25.0)));
    stroke.major = random.between(12.0, 40.0);
    stroke.minor = random.between(10.0, 30.0);
    strokes.push_back(stroke);
  }
  return strokes;
}
}

#endif
