// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief An image of faded points by themselves, which is laid over the window.
 *
 * Each pixel holds the nearest ball. So a crowd of points is as faint as a single one, and every
 * ball is drawn only once.
 */
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
/// The image of one window.
class TraceImage
{
public:
  TraceImage();
  ~TraceImage();
  TraceImage(const TraceImage&) = delete;
  void operator=(const TraceImage&) = delete;

  /// Calls drawBalls while drawing goes into the empty image, `size` pixels from 0 0.
  void draw(
    vtkOpenGLRenderWindow* window, const glm::ivec2& size, const std::function<void()>& drawBalls);

  /// Blends what was drawn over the viewport, with its depths. False if the shader does not
  /// compile.
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
