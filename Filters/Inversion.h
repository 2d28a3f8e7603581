// SPDX-License-Identifier: BSD-3-Clause
// C++ view of Shaders/inversion.glsl: the solver of the backward map, from the very source the GPU
// compiles.
#ifndef BrainShift_Inversion_h
#define BrainShift_Inversion_h

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace brainshift
{
// `Forward` provides void map(vec3 rest, vec3& displacement, mat3& jacobian), in lattice
// coordinates.
template <typename Forward>
struct Inversion
{
  using vec3 = glm::vec3;
  using mat3 = glm::mat3;

  const Forward& forward;

  void forwardMap(const vec3& rest, vec3& displacement, mat3& jacobian)
  {
    this->forward.map(rest, displacement, jacobian);
  }
  static float min(float a, float b) { return glm::min(a, b); }
  static float dot(const vec3& a, const vec3& b) { return glm::dot(a, b); }
  static float determinant(const mat3& matrix) { return glm::determinant(matrix); }
  static mat3 inverse(const mat3& matrix) { return glm::inverse(matrix); }

#define SHARED
#define OUT(type) type&
#include "inversion.glsl"
#undef OUT
#undef SHARED
};
}

#endif
