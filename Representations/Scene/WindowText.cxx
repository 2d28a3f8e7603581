// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/WindowText.h"

#include "Common/Guard.h"

#include "vtkObjectFactory.h"
#include "vtkTextProperty.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <algorithm>

namespace brainshift
{
vtkStandardNewMacro(WindowText);

int WindowText::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    vtkWindow* window = viewport->GetVTKWindow();
    const int* tiles = window->GetTileScale();
    if (window->GetDPI() != this->Dpi || !std::equal(tiles, tiles + 2, this->Tiles))
    {
      this->Dpi = window->GetDPI();
      std::copy_n(tiles, 2, this->Tiles);
      this->GetTextProperty()->Modified();
    }
    return this->Superclass::RenderOpaqueGeometry(viewport);
  });
}
}
