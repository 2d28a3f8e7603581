// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The solver of the backward map for C++. It compiles Shaders/Field/inversion.glsl, the file that
/// the GPU runs too, so both sides take the same steps.
///
/// Newton's steps, halved while they do not help: Dennis and Schnabel, Numerical Methods for
/// Unconstrained Optimization and Nonlinear Equations (1983), chapter 6. Near folding the step is
/// that of the fixed-point iteration: Chen et al., "A simple fixed-point approach to invert a
/// deformation field", Medical Physics 35 (2008).
#ifndef BrainShift_Inversion_h
#define BrainShift_Inversion_h

#include <glm/glm.hpp>

namespace brainshift
{
/**
 * Gives the functions of the GLSL file what they call.
 *
 * `Forward` has `void map(vec3 rest, vec3& displacement, mat3& jacobian) const`: the displacement
 * and the derivatives of position + displacement, both in lattice coordinates.
 */
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
