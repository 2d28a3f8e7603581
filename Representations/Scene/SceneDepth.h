// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The depth of what is drawn already, at which rays must stop.
#ifndef BrainShift_SceneDepth_h
#define BrainShift_SceneDepth_h

#include "Representations/Scene/RayCastScene.h"

#include "vtkSmartPointer.h"

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
/// A window's depth as a texture: the window's own one, or a copy.
class SceneDepth
{
public:
  SceneDepth();
  ~SceneDepth();

  /// Makes the depth of the bound framebuffer readable where rays are cast. `origin` and `size`:
  /// the viewport, pixels of the window. The pixels of `image` may be larger.
  SceneBehind captureBehind(vtkOpenGLRenderWindow* window, const glm::ivec2& origin,
    const glm::ivec2& size, const SceneImage& image);

  /// Null if the window's own texture is read.
  vtkTextureObject* copied() const { return this->Copy; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  void copy(vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size,
    const PixelBox& part);

  vtkSmartPointer<vtkTextureObject> Readable; // the window's own, or Copy
  vtkSmartPointer<vtkTextureObject> Copy;
};
}

#endif
