// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws traced points into one window: those in front of the tissue of volumes, and, faded, those
/// behind it.
#ifndef BrainShift_TraceDrawer_h
#define BrainShift_TraceDrawer_h

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/Frustum.h"

#include <array>
#include <functional>
#include <map>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
// A traced point as the GPU takes it.

/// Position and colour of a ball.
struct TraceVertex
{
  std::array<float, 3> position;     ///< mm, the points' own coordinates.
  std::array<std::uint8_t, 4> color; ///< Red, green, blue, opacity.
};

// The order in which points are drawn.

/// The points along a Z-curve, so that neighbours in space follow each other. A software driver
/// sorts balls into tiles of the picture and reads them back from the memory in which they were set
/// up. With ordered points that takes a third less time. Points in one cell of the curve, a 32nd of
/// their box a side, keep their order.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<TraceVertex> sortedBySpace(
  const std::vector<TraceVertex>& vertices);

// An image of faded points by themselves, which is laid over the window.
//
// Each pixel holds the nearest ball. So a crowd of points is as faint as a single one, and every
// ball is drawn only once.

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

/// Everything that a picture of points depends on.
struct TraceScene
{
  glm::ivec2 origin{ 0 }; ///< Of the picture in the window, pixels.
  glm::ivec2 size{ 1 };   ///< Of the picture, pixels.
  glm::dmat4 clipFromWorld{ 1.0 };
  glm::dmat4 worldFromPoint{ 1.0 };
  glm::dvec3 ahead{ 0.0, 0.0, -1.0 }; ///< Unit vector of the view direction, world.
  double radius = 1.0;                ///< mm.
  double leastRadius = 1.5;           ///< Pixels, if that is more.
  double hiddenOpacity = 1.0;         ///< Fraction of the opacity that is left behind tissue.
  std::vector<const FirstHits*> hits; ///< Of the volumes; at most MaxTissues.
};

/// Points, programs and images of one window.
class TraceDrawer
{
public:
  /// Sends points to the GPU.
  void upload(const std::vector<TraceVertex>& vertices);

  /// Draws the points that were uploaded. False if a shader does not compile.
  bool draw(vtkOpenGLRenderWindow* window, const TraceScene& scene, Counters& counters);

  void releaseGraphicsResources(vtkWindow* window);

private:
  void setUniforms(Program& program, const TraceScene& scene);
  void drawBalls(unsigned int program);

  vtkSmartPointer<vtkOpenGLBufferObject> Vertices;
  int Count = 0;
  bool Translucent = false;        // some point's colour is
  std::map<int, Program> Programs; // by the number of volumes
  TraceImage Image;                // of faded points
};
}

#endif
