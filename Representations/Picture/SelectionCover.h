// SPDX-License-Identifier: BSD-3-Clause
// Hides from a surface selection what the tissue drawn last hides from the eye.
#ifndef BrainShift_SelectionCover_h
#define BrainShift_SelectionCover_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"

class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace brainshift
{
struct FirstHits;

// Whether a renderer draws a selection of points, and not one of cells or nothing of the kind.
bool selectsPoints(vtkRenderer* renderer);

class SelectionCover
{
public:
  // Draws over the selection's buffer and its depth. False if the shader does not compile.
  bool draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, const FirstHits& hits,
    Counters& counters);

  void releaseGraphicsResources() { this->CoverProgram.forget(); }

private:
  Program CoverProgram;
};
}

#endif
