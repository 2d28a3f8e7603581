// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Text in a view that follows the resolution of the window. VTK's actor keeps the letters of the
/// last picture, so ParaView's screenshots, which change resolution and tiles, showed them small.
#ifndef BrainShift_WindowText_h
#define BrainShift_WindowText_h

#include "vtkTextActor.h"

namespace brainshift
{
class WindowText : public vtkTextActor
{
public:
  static WindowText* New();
  vtkTypeMacro(WindowText, vtkTextActor);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;

protected:
  WindowText() = default;
  ~WindowText() override = default;

private:
  int Dpi = 0; // dots per inch, and tiles a side, of the last picture
  int Tiles[2] = { 1, 1 };
};
}

#endif
