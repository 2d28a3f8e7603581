// SPDX-License-Identifier: BSD-3-Clause
// C++ view of Shaders/kernels.glsl: the cubic kernels, from the very source the GPU compiles.
#ifndef BrainShift_Kernels_h
#define BrainShift_Kernels_h

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace brainshift
{
using glm::mat3;
using glm::vec3;
using glm::vec4;

#define SHARED inline
#include "kernels.glsl"
#undef SHARED
}

#endif
