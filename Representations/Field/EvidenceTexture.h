// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The uncertainty of each position in a drawn volume (one standard deviation, mm), on the GPU of
/// one window.
#ifndef BrainShift_EvidenceTexture_h
#define BrainShift_EvidenceTexture_h

#include "Representations/Scene/RayCastScene.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h" // for its smart pointer

class vtkWindow;

namespace brainshift
{
struct DrawnValues;
struct GpuTask;
struct SceneDeformation;

/// The deviations at the control points.
class EvidenceTexture
{
public:
  /// Uploads the deviations if they changed and fills in the scene. If the volume carries none, a
  /// remark says so and the scene has none. False, with a problem, if this GPU cannot.
  bool update(GpuTask& gpu, const SceneDeformation& deformation, const DrawnValues& values,
    SceneEvidence& evidence);

  /// Null: nothing was shown yet.
  vtkTextureObject* texture() const { return this->Texture; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  std::vector<float> Uploaded;
};
}

#endif
