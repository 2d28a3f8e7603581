// SPDX-License-Identifier: BSD-3-Clause
// Gradients for light, found once on the GPU when the volume is loaded (paper, section 2).
#ifndef BrainShift_NormalTexture_h
#define BrainShift_NormalTexture_h

#include "Counters.h"
#include "Program.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <glm/vec3.hpp>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class NormalTexture
{
public:
  NormalTexture();
  ~NormalTexture();

  enum Form
  {
    Half,   // half resolution, 16-bit floats
    Full,   // full resolution, 16-bit floats
    Packed, // full resolution, 16-bit whole numbers, with the scalar (which must lie in 0 to 1)
  };

  // Computes the gradients of `scalars` (voxels a side given), unless they are there already.
  // `range`: greatest minus least stored value.
  bool update(vtkOpenGLRenderWindow* window, vtkTextureObject* scalars,
    const glm::ivec3& dimensions, Form form, float range, Counters& counters);

  bool packed() const { return this->Shown == Packed; }

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  vtkWeakPointer<vtkTextureObject> Source; // the scalars it was made from
  Form Shown = Half;
  Program NormalsPrograms[2]; // [packed]
};
}

#endif
