// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cubic kernels of the lattice.
///
/// The GPU gets their numbers as uniforms, so both sides compute with the same ones.
#ifndef BrainShift_Kernels_h
#define BrainShift_Kernels_h

#include <glm/glm.hpp>

namespace brainshift
{
/**
 * Catmull-Rom: the displacement passes through the control points. The default, as in van der Steen
 * et al., SPIE 7169 (2009), section 2. Source: Catmull and Rom, "A class of local interpolating
 * splines", in Computer Aided Geometric Design (1974).
 */
constexpr int KernelCatmullRom = 0;

/**
 * Uniform cubic B-spline: the displacement only comes near the control points, but its second
 * derivatives are continuous. Source: Rueckert et al., IEEE Transactions on Medical Imaging 18
 * (1999).
 */
constexpr int KernelBSpline = 1;

/**
 * Weights of the four control points around a position, in the order of the lattice. The position
 * lies at `t` (0 to 1) between the second and the third. The weights sum to 1.
 */
inline glm::vec4 kernelWeights(int kernel, float t)
{
  float s = 1.0f - t;
  if (kernel == KernelBSpline)
  {
    return glm::vec4(s * s * s, 4.0f + t * t * (3.0f * t - 6.0f), 4.0f + s * s * (3.0f * s - 6.0f),
             t * t * t) *
      (1.0f / 6.0f);
  }
  return glm::vec4(-t * s * s, 2.0f + t * t * (3.0f * t - 5.0f), 2.0f + s * s * (3.0f * s - 5.0f),
           -s * t * t) *
    0.5f;
}

/** The weights as polynomials: kernelPolynomials(kernel) * vec4(1, t, t^2, t^3) gives them. */
inline glm::mat4 kernelPolynomials(int kernel)
{
  if (kernel == KernelBSpline)
  {
    return glm::mat4(1, 4, 1, 0, /**/ -3, 0, 3, 0, /**/ 3, -6, 3, 0, /**/ -1, 3, -3, 1) *
      (1.0f / 6.0f);
  }
  return glm::mat4(0, 2, 0, 0, /**/ -1, 0, 1, 0, /**/ 2, -5, 4, -1, /**/ -1, 3, -3, 1) * 0.5f;
}

/** Derivatives of kernelWeights with respect to `t`. They sum to 0. */
inline glm::vec4 kernelSlopes(int kernel, float t)
{
  float s = 1.0f - t;
  if (kernel == KernelBSpline)
  {
    return glm::vec4(-s * s, t * (3.0f * t - 4.0f), -s * (3.0f * s - 4.0f), t * t) * 0.5f;
  }
  return glm::vec4(-s * (s - 2.0f * t), t * (9.0f * t - 10.0f), -s * (9.0f * s - 10.0f),
           -t * (2.0f * s - t)) *
    0.5f;
}
}

#endif
