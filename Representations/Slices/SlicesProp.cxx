// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SlicesProp.h"

#include "Common/Guard.h"

#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkVolumeMapper.h"

namespace brainshift
{
vtkStandardNewMacro(SlicesProp);

// Where the data is elsewhere, ParaView's outline stands for it.
bool SlicesProp::Draws(bool translucent)
{
  return !this->EnableLOD && this->Slices && this->Slices->GetNumberOfInputConnections(0) > 0 &&
    this->IsTranslucent() == translucent;
}

int SlicesProp::Draw(vtkViewport* viewport)
{
  this->Slices->Render(vtkRenderer::SafeDownCast(viewport), this);
  return 1;
}

int SlicesProp::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    return this->Draws(false) ? this->Draw(viewport)
                              : this->Superclass::RenderOpaqueGeometry(viewport);
  });
}

int SlicesProp::RenderVolumetricGeometry(vtkViewport* viewport)
{
  // The superclass would draw the mapper it has, which is the slices'.
  return guarded(this, 0, [&] {
    return this->EnableLOD ? this->Superclass::RenderVolumetricGeometry(viewport)
      : this->Draws(true)  ? this->Draw(viewport)
                           : 0;
  });
}
}
