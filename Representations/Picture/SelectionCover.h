// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Excludes surfaces behind the tissue of the last picture from a selection.
#ifndef BrainShift_SelectionCover_h
#define BrainShift_SelectionCover_h

#include "Representations/Gpu/Program.h"

class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace brainshift
{
struct FirstHits;

/// Whether a renderer draws a selection of points now.
bool selectsPoints(vtkRenderer* renderer);

/// The program that does it, of one window.
class SelectionCover
{
public:
  /// Draws over the selection's buffer and its depth. False if the shader does not compile.
  bool draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, const FirstHits& hits,
    Counters& counters);

  void releaseGraphicsResources() { this->CoverProgram.forget(); }

private:
  Program CoverProgram;
};
}

#endif
