// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Casts the rays of a scene into images of its own, which are then laid over the window.
#ifndef BrainShift_RayCaster_h
#define BrainShift_RayCaster_h

#include "Representations/Picture/CastImages.h"
#include "Representations/Scene/RayCastScene.h"

#include <map>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
/// The programs and images of one window.
class RayCaster
{
public:
  RayCaster();
  ~RayCaster();

  /// Draws the image. False if a shader does not compile or the image cannot be made.
  bool cast(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  /// Draws the scene's part of the image that is held, with the camera of that image. The rest of
  /// the image stays.
  bool castPart(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  CastImages& images() { return this->Images; }
  const CastImages& images() const { return this->Images; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool draw(
    vtkOpenGLRenderWindow* window, const RayCastScene& scene, bool part, Counters& counters);
  bool findSpans(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  CastImages Images;
  std::map<RayCastVariant, Program> CastPrograms; // those drawn with so far
  Program SpansProgram;
};
}

#endif
