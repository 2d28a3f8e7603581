// SPDX-License-Identifier: BSD-3-Clause
// C++ view of Shaders/Field/inversion.glsl: the solver of the backward map, from the very source the GPU
// compiles.
#ifndef BrainShift_Inversion_h
#define BrainShift_Inversion_h

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
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
  mat3 jacobian{ 1.0f };

  vec3 displacementAt(const vec3& rest)
  {
    vec3 displacement;
    this->forward.map(rest, displacement, this->jacobian);
    return displacement;
  }
  const mat3& jacobianThere() const { return this->jacobian; }
  static float min(float a, float b) { return glm::min(a, b); }
  static float dot(const vec3& a, const vec3& b) { return glm::dot(a, b); }
  static vec3 cross(const vec3& a, const vec3& b) { return glm::cross(a, b); }

#define SHARED
#include "Shaders/Field/inversion.glsl"
#undef SHARED
};
}

#endif
