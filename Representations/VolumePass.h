// SPDX-License-Identifier: BSD-3-Clause
// Renders into a 3D texture: the framework all computing passes share (paper, section 2: "GPGPU").
// A new pass is one fragment shader and one call.
#ifndef BrainShift_VolumePass_h
#define BrainShift_VolumePass_h

#include <glm/vec3.hpp>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace brainshift
{
// Runs the program in use, with its uniforms set, for every texel of a box of the 3D `target`.
// The program's vertex and geometry stages are those of volumePassSource.
void runVolumePass(vtkOpenGLRenderWindow* window, int programHandle, vtkTextureObject* target,
  const glm::ivec3& first, const glm::ivec3& count);
}

#endif
