// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Leaves out work that is not visible in a window that moves.
#ifndef BrainShift_MovingWindow_h
#define BrainShift_MovingWindow_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <vector>

class vtkObject;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkTextureObject;

namespace brainshift
{
/**
 * Leaves out two things in a window that moves and is drawn by a software driver:
 * - The smoothing of insets (orientation axes). The driver would have to finish the picture under
 *   them first.
 * - The copy of depths into the framebuffer that the window shows, about 6 ms for each megapixel.
 *   It is left out only if VTK leaves the display to others (NoBlit): Qt's widget takes only
 * colours.
 *   Depths are read from where they were drawn.
 */
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT MovingWindow
{
public:
  MovingWindow();
  ~MovingWindow();

  /** Watches the window of this renderer, and no other, from now on. Null: watches none. */
  void watch(vtkRenderer* renderer);

  /** Whether anything is left out. Default true. */
  void setEnabled(bool enabled) { this->Enabled = enabled; }

private:
  static void beforePicture(vtkObject*, unsigned long, void* self, void*);
  static void afterPicture(vtkObject*, unsigned long, void* self, void*);
  void leaveOut();
  void leaveOutInsets();
  void leaveOutDepths();
  void putBack();

  vtkNew<vtkCallbackCommand> Before;
  vtkNew<vtkCallbackCommand> After;
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;    // while anything is left out
  std::vector<vtkWeakPointer<vtkRenderer>> Insets; // that are not smoothed
  vtkSmartPointer<vtkTextureObject> ShownDepths;   // taken from what the window shows
  bool Enabled = true;
};
}

#endif
