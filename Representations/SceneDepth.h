// SPDX-License-Identifier: BSD-3-Clause
// A copy of the window's depth: where rays must stop at what is drawn already.
#ifndef BrainShift_SceneDepth_h
#define BrainShift_SceneDepth_h

#include "vtkSmartPointer.h"

#include <glm/vec2.hpp>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class SceneDepth
{
public:
  SceneDepth();
  ~SceneDepth();

  // Copies the depth of a rectangle (pixels) of the framebuffer that is bound for drawing.
  void capture(vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size);

  vtkTextureObject* texture() const { return this->Depth; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Depth;
};
}

#endif
