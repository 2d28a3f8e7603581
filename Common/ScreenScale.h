// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How large a pixel is to the eye.
#ifndef BrainShift_ScreenScale_h
#define BrainShift_ScreenScale_h

#include <vtkWindow.h>

#include <algorithm>

namespace brainshift
{
/// Pixels of a window for one pixel of a usual screen, along a side: 2 on a screen at 200 %. At
/// least 1. What has a size in pixels is drawn, and met by the mouse, this much larger.
inline double screenScale(vtkWindow* window)
{
  constexpr double usualDotsPerInch = 72.0; // VTK's and ParaView's for a screen at 100 %
  return window ? std::max(1.0, window->GetDPI() / usualDotsPerInch) : 1.0;
}
}

#endif
