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
struct RayCastScene;

class SceneDepth
{
public:
  SceneDepth();
  ~SceneDepth();

  // Makes the depth of the framebuffer that is bound for drawing readable in a viewport (pixels) of
  // it; of that, only what lies between the pixels `low` and `high`, counted in the viewport, is
  // wanted.
  void capture(vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size,
    const glm::ivec2& low, const glm::ivec2& high);

  // The same where a scene can show something, and tells the scene of it.
  void captureBehind(vtkOpenGLRenderWindow* window, const glm::ivec2& origin,
    const glm::ivec2& size, RayCastScene& scene);

  vtkTextureObject* texture() const { return this->Shown; }
  vtkTextureObject* copied() const { return this->Copy; } // null if the window's own is read
  // Texture coordinates from the share of the viewport: scale and shift.
  const glm::vec2& textureFromShare() const { return this->TextureFromShare; }
  const glm::vec2& textureOfShareZero() const { return this->TextureOfShareZero; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  void copy(vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size,
    const glm::ivec2& low, const glm::ivec2& high);

  vtkSmartPointer<vtkTextureObject> Shown; // the window's own, or Copy
  vtkSmartPointer<vtkTextureObject> Copy;
  glm::vec2 TextureFromShare{ 1.0f };
  glm::vec2 TextureOfShareZero{ 0.0f };
};
}

#endif
