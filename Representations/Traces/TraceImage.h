// SPDX-License-Identifier: BSD-3-Clause
// An image of faded points by themselves. Of each pixel it holds the nearest ball, so that a crowd,
// laid over the scene once, is as faint as a single one; and every ball is drawn only once for it.
#ifndef BrainShift_TraceImage_h
#define BrainShift_TraceImage_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"

#include "vtkSmartPointer.h"

#include <glm/vec2.hpp>

#include <functional>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class TraceImage
{
public:
  TraceImage();
  ~TraceImage();
  TraceImage(const TraceImage&) = delete;
  void operator=(const TraceImage&) = delete;

  // Calls drawBalls with the empty image in place of the scene, `size` pixels from 0 0.
  void draw(
    vtkOpenGLRenderWindow* window, const glm::ivec2& size, const std::function<void()>& drawBalls);

  // Blends what was drawn over the viewport, with its depths. False if the shader does not compile.
  bool layOver(vtkOpenGLRenderWindow* window, Counters& counters);

  void releaseGraphicsResources(vtkWindow* window);

private:
  void provide(vtkOpenGLRenderWindow* window, const glm::ivec2& size);

  vtkSmartPointer<vtkTextureObject> Colors; // times opacity, opacity
  vtkSmartPointer<vtkTextureObject> Depths; // window depths; 1: no ball
  Program OverProgram;
};
}

#endif
