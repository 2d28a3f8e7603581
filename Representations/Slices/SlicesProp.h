// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   SlicesProp
 * @brief   the prop of Deformed Slices: a volume to ParaView, a surface to the eye
 *
 * ParaView's volume delivery, transforms and colour maps come with a vtkPVLODVolume. Opaque slices
 * are drawn when surfaces are, so that whatever follows knows their depth; others with the volumes.
 */
#ifndef BrainShift_SlicesProp_h
#define BrainShift_SlicesProp_h

#include "vtkPVLODVolume.h"

class vtkDeformedSlicesMapper;

namespace brainshift
{
class SlicesProp : public vtkPVLODVolume
{
public:
  static SlicesProp* New();
  vtkTypeMacro(SlicesProp, vtkPVLODVolume);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;

  vtkDeformedSlicesMapper* Slices = nullptr; // of the representation that owns both

private:
  bool Draws(bool translucent);
  int Draw(vtkViewport* viewport);
};
}

#endif
