// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cavity that comparisons with a reference ignore, on the GPU of one window.
#ifndef BrainShift_CavityTexture_h
#define BrainShift_CavityTexture_h

#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Scene/PlacedReference.h"
#include "Representations/Tissue/ScalarTexture.h"

class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// The voxels of a cavity.
class CavityTexture
{
public:
  /// Uploads the cavity if it changed, and fills in `placed`. Leaves `placed` as it is if there are
  /// no voxels. False, with a problem, if this GPU cannot.
  bool update(
    GpuTask& gpu, const PlacedVoxels& cavity, const VolumePlace& volume, PlacedCavity& placed);

  /// Null: there is no cavity.
  vtkTextureObject* texture() const { return this->Voxels.texture(); }

  void releaseGraphicsResources(vtkWindow* window);

private:
  ScalarTexture Voxels;
};
}

#endif
