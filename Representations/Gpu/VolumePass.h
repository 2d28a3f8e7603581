// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Renders into a 3D texture: what all computing passes share (paper, section 2: "GPGPU").
///
/// A new pass is one fragment shader and one call.
#ifndef BrainShift_VolumePass_h
#define BrainShift_VolumePass_h

#include "Filters/Deformation/FieldChange.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <initializer_list>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace brainshift
{
/// Runs the program in use, with its uniforms set, for every texel of a box of the 3D `targets`,
/// which are equally large. The first target gets gl_FragData[0], and so on. The program's vertex
/// and geometry stages are those of volumePassSource. `first`, `count`: the box, texels.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT void runVolumePass(vtkOpenGLRenderWindow* window,
  int programHandle, std::initializer_list<vtkTextureObject*> targets, const glm::ivec3& first,
  const glm::ivec3& count);

/// How far along x to move a box of texels that starts at `first`, so that a software driver lets
/// two threads draw it. Its threads share a target by squares of 64 pixels, whatever its layers,
/// and only one of them would draw a box within one square. 0 with other drivers.
int leadToSecondThread(int first, int count);

/// Waits for a box of texels of a 3D texture with four floats and reads it, x fastest. `first`,
/// `count`: the box, texels.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<glm::vec4> readVolume(vtkOpenGLRenderWindow* window,
  vtkTextureObject* texture, const glm::ivec3& first, const glm::ivec3& count);

/// A texture without texels whose ends hold beyond them. `format`: OpenGL's, of its texels;
/// `filter`: vtkTextureObject's.
vtkSmartPointer<vtkTextureObject> makeTexture(
  vtkOpenGLRenderWindow* window, unsigned int format, int filter);

/// Texels of a box of a 3D texture, x fastest. `format`, `type`: OpenGL's, of the values.
struct Texels
{
  IndexBox box;
  unsigned int format = 0;
  unsigned int type = 0;
  const void* values = nullptr;
};

void replaceTexels(vtkTextureObject* texture, const Texels& texels);

/// Sets all of a 3D texture to zero.
void clearVolume(vtkOpenGLRenderWindow* window, vtkTextureObject* target);
}

#endif
