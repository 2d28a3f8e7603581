// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/SavedPicture.h"

#include "vtkPVView.h"

namespace brainshift
{
namespace
{
// ParaView tells the view's subclasses alone.
struct CapturingView : vtkPVView
{
  static bool isCapturing(vtkPVView* view)
  {
    bool (vtkPVView::*ask)() = &CapturingView::GetInCaptureScreenshot;
    return view && (view->*ask)();
  }
};
}

bool isToBeSaved(vtkView* view)
{
  return CapturingView::isCapturing(vtkPVView::SafeDownCast(view));
}
}
