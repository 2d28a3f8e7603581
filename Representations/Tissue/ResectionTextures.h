// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The tumour and the cavity of a resection on the GPU of one window.
#ifndef BrainShift_ResectionTextures_h
#define BrainShift_ResectionTextures_h

#include "Filters/Attached/Resection.h"
#include "Representations/Scene/RayCastScene.h"

#include "vtkTextureObject.h" // for its smart pointer

class vtkWindow;

namespace brainshift
{
struct GpuTask;
struct VolumePlace;

/// The part of a mask with voxels that are inside, and as many around it as its smooth edge needs,
/// which are outside. `voxels`: 1 or 0 for each point of the grid, x fastest. A mask without such
/// voxels gives one voxel that is outside.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Mask croppedMask(const PlacedVoxels& placed);

/// The fractions of a mask.
class MaskTexture
{
public:
  /// Uploads the mask if it changed and fills in where it lies; without voxels, lets go of the
  /// texture. False, with a problem, if this GPU cannot.
  bool update(
    GpuTask& gpu, const PlacedVoxels& mask, const VolumePlace& volume, PlacedFractions& placed);

  /// Null: there is none.
  vtkTextureObject* texture() const { return this->Texture; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  Grid Place;                             // of the voxels in the texture
  vtkSmartPointer<vtkDataArray> Uploaded; // as of UploadedTime, on UploadedGrid
  unsigned long long UploadedTime = 0;
  Grid UploadedGrid;
};

/// Both masks.
class ResectionTextures
{
public:
  /// Uploads what changed and fills in the scene. False, with a problem, if this GPU cannot.
  bool update(
    GpuTask& gpu, const Resection& resection, const VolumePlace& volume, SceneResection& scene);

  std::vector<vtkTextureObject*> textures() const; ///< Null: not in use.
  void releaseGraphicsResources(vtkWindow* window);

private:
  MaskTexture Removed;
  MaskTexture Tumour;
};
}

#endif
