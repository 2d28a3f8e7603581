// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads camera, light and position of a volume from VTK.
#ifndef BrainShift_SceneFrame_h
#define BrainShift_SceneFrame_h

#include "Representations/Scene/RayCastScene.h"
#include "Representations/Scene/SceneGeometry.h"

class vtkRenderer;
class vtkVolume;

namespace brainshift
{
/// A volume, and the renderer that draws it now.
struct DrawnVolume
{
  vtkRenderer* renderer = nullptr;
  vtkVolume* volume = nullptr;
};

/// Fills the scene's frame. At most MaxLights lights are taken; lights that are off do not count.
SceneFrame frameOf(const DrawnVolume& drawn, const DrawnValues& values);
}

#endif
