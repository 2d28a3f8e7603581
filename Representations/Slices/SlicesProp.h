// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   SlicesProp
 * @brief   the prop of Deformed Slices: a volume to ParaView, a surface to the eye
 *
 * ParaView's volume delivery, transforms and colour maps come with a vtkPVLODVolume. Opaque slices
 * are drawn together with the surfaces, so that whatever follows knows their depth. See-through
 * slices are drawn together with the volumes.
 */
#ifndef BrainShift_SlicesProp_h
#define BrainShift_SlicesProp_h

#include "vtkPVLODVolume.h"

#include <functional>

class vtkVolumeMapper;

namespace brainshift
{
class SlicesProp : public vtkPVLODVolume
{
public:
  static SlicesProp* New();
  vtkTypeMacro(SlicesProp, vtkPVLODVolume);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;

  vtkVolumeMapper* Slices = nullptr;   ///< Draws them; the representation owns both.
  std::function<bool()> IsTranslucent; ///< Whether what lies behind may be seen through them.

private:
  bool Draws(bool translucent);
  int Draw(vtkViewport* viewport);
};
}

#endif
