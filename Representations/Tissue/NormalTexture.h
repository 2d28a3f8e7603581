// SPDX-License-Identifier: BSD-3-Clause
// Gradients for light, found once on the GPU when the volume is loaded (paper, section 2).
#ifndef BrainShift_NormalTexture_h
#define BrainShift_NormalTexture_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"

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

  // Computes the gradients of `scalars` (voxels a side given), unless they are there already: at
  // half or at full resolution, 10 bits a component. `difference`: how much stored values usually
  // differ within two voxels; longer gradients are cut to that length.
  bool update(vtkOpenGLRenderWindow* window, vtkTextureObject* scalars,
    const glm::ivec3& dimensions, bool half, float difference, Counters& counters);

  // A texel less ZeroGradient is the gradient, for each texture unit, times this; long ones are
  // cut.
  double scale() const { return this->Scale; }

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  vtkWeakPointer<vtkTextureObject> Source; // the scalars it was made from
  bool Half = false;
  double Scale = 1.0;
  Program NormalsProgram;
};
}

#endif
