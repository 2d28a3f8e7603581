// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Draws traced points into one window: those in front of the tissue of volumes, and, faded,
 * those
 * behind it.
 */
#ifndef BrainShift_TraceDrawer_h
#define BrainShift_TraceDrawer_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Scene/FirstHits.h"
#include "Representations/Traces/TraceImage.h"
#include "Representations/Traces/TraceVertex.h"

#include "vtkSmartPointer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <map>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
/// Everything that a picture of points depends on.
struct TraceScene
{
  glm::ivec2 origin{ 0 }; ///< Of the picture in the window, pixels.
  glm::ivec2 size{ 1 };   ///< Of the picture, pixels.
  glm::dmat4 clipFromWorld{ 1.0 };
  glm::dmat4 worldFromPoint{ 1.0 };
  glm::dvec3 ahead{ 0.0, 0.0, -1.0 }; ///< Unit vector, the way the camera looks, world.
  double radius = 1.0;                ///< mm.
  double leastRadius = 1.5;           ///< Pixels, if that is more.
  double hiddenOpacity = 1.0;         ///< Share of the opacity that is left behind tissue.
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
