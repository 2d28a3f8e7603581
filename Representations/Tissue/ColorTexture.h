// SPDX-License-Identifier: BSD-3-Clause
// Colours that a volume brings along: the first three of four numbers a voxel, on the GPU.
#ifndef BrainShift_ColorTexture_h
#define BrainShift_ColorTexture_h

#include "Representations/Gpu/Counters.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <glm/vec3.hpp>

class vtkDataArray;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class ColorTexture
{
public:
  ColorTexture();
  ~ColorTexture();

  // Uploads the array if it changed since the last call: 0 to 255 of whole numbers, 0 to 1 of
  // others, clamped. False if the GPU refuses.
  bool update(vtkOpenGLRenderWindow* window, vtkDataArray* array, const glm::ivec3& dimensions,
    Counters& counters);

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  vtkWeakPointer<vtkDataArray> Uploaded;
  unsigned long long UploadedTime = 0;
};
}

#endif
