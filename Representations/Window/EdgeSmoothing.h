// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Leaves out the smoothing of edges in pictures of volumes alone.
#ifndef BrainShift_EdgeSmoothing_h
#define BrainShift_EdgeSmoothing_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkWeakPointer.h"

class vtkObject;
class vtkRenderer;

namespace brainshift
{
/**
 * Leaves out a renderer's smoothing of edges (FXAA) in pictures that show only volumes. VTK smooths
 * before it draws volumes, so no pixel changes. On a software driver the pass would take about 20
 * ms for each megapixel. If anything else is visible, like a textured background, edges are
 * smoothed.
 */
class EdgeSmoothing
{
public:
  EdgeSmoothing();
  ~EdgeSmoothing();

  /** Watches this renderer, and no other, from now on. Null: watches none. */
  void watch(vtkRenderer* renderer);

  /** Whether anything is left out. Default true. */
  void setEnabled(bool enabled) { this->Enabled = enabled; }

private:
  static void beforePicture(vtkObject*, unsigned long, void* self, void*);
  static void afterPicture(vtkObject*, unsigned long, void* self, void*);

  vtkNew<vtkCallbackCommand> Before;
  vtkNew<vtkCallbackCommand> After;
  vtkWeakPointer<vtkRenderer> Renderer;
  bool Enabled = true;
  bool LeftOut = false; // of the picture that is being drawn
};
}

#endif
