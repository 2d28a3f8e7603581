// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/SoftwareFallback.h"

#include "vtkSmartVolumeMapper.h"

namespace brainshift
{
void drawInSoftware(vtkVolumeMapper* mapper, vtkSmartVolumeMapper* fallback)
{
  // What stopped our mapper would stop VTK's GPU mapper, too, in some cases by an abort.
  fallback->SetRequestedRenderModeToRayCast();
  fallback->SetInputConnection(mapper->GetInputConnection(0, 0));
  fallback->SetScalarMode(mapper->GetScalarMode());
  fallback->SelectScalarArray(mapper->GetArrayName());
  const int blend = mapper->GetBlendMode();
  const bool blends = blend == vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND ||
    blend == vtkVolumeMapper::MINIMUM_INTENSITY_BLEND || blend == vtkVolumeMapper::ADDITIVE_BLEND;
  fallback->SetBlendMode(blends ? blend : vtkVolumeMapper::COMPOSITE_BLEND);
  fallback->SetCropping(mapper->GetCropping());
  fallback->SetCroppingRegionFlags(mapper->GetCroppingRegionFlags());
  fallback->SetCroppingRegionPlanes(mapper->GetCroppingRegionPlanes());
  fallback->SetClippingPlanes(mapper->GetClippingPlanes());
}
}
