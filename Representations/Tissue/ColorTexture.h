// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Colours that a volume brings along: the first three of four numbers of each voxel.
 */
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
/// The colours of one volume on the GPU of one window.
class ColorTexture
{
public:
  ColorTexture();
  ~ColorTexture();

  /// Uploads the array if it changed since the last call. Whole numbers are clamped to 0 to 255,
  /// real numbers to 0 to 1. `dimensions`: voxels a side. False if the GPU refuses.
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
