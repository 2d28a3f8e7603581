// SPDX-License-Identifier: BSD-3-Clause
#ifndef MovingWindow_h
#define MovingWindow_h

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
 * Leaves out what nobody misses in a window that moves and is drawn by a software driver:
 * - smoothing of insets (orientation axes), for which the driver would wait for the picture under
 *   them;
 * - the copy of depths beside that of colours into what the window shows (some 6 ms a megapixel),
 *   where VTK leaves showing it to others (NoBlit): Qt's widget takes colours alone. Depths are
 *   read from where they were drawn.
 */
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT MovingWindow
{
public:
  MovingWindow();
  ~MovingWindow();

  /** Watches the window of a renderer from now on, and none before; null: none. */
  void watch(vtkRenderer* renderer);

  /** Leave anything out at all. Default true. */
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
