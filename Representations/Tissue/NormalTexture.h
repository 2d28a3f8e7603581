// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Gradients for light, computed once on the GPU when the volume is loaded (paper, section 2).
#ifndef BrainShift_NormalTexture_h
#define BrainShift_NormalTexture_h

#include "Representations/Gpu/Program.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// The gradients of one texture of scalars, 10 bits a component.
class NormalTexture
{
public:
  NormalTexture();
  ~NormalTexture();

  /// Computes the gradients of `scalars` unless they are there already. `dimensions`: voxels a
  /// side. `half`: at half resolution. `difference`: how much stored values usually differ within
  /// two voxels; longer gradients are cut to that length. False if the shader does not compile or
  /// the GPU refuses.
  bool update(GpuTask& gpu, vtkTextureObject* scalars, const glm::ivec3& dimensions, bool half,
    float difference);

  /// gradient (stored values per texture unit) = (texel - ZeroGradient) / scale
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
