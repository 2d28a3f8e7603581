// SPDX-License-Identifier: BSD-3-Clause
#ifndef EdgeSmoothing_h
#define EdgeSmoothing_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkWeakPointer.h"

class vtkObject;
class vtkRenderer;

namespace brainshift
{
/**
 * Leaves out a renderer's smoothing of edges (FXAA) in pictures of volumes alone. VTK smooths
 * before it draws volumes, so no pixel changes, but on a software driver the pass takes some 20 ms
 * a megapixel. Where anything else is visible, a textured background too, edges are smoothed.
 */
class EdgeSmoothing
{
public:
  EdgeSmoothing();
  ~EdgeSmoothing();

  /** Watches a renderer from now on, and none before; null: none. */
  void watch(vtkRenderer* renderer);

  /** Leave anything out at all. Default true. */
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
