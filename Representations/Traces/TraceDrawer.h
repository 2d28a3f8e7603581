// SPDX-License-Identifier: BSD-3-Clause
// Draws traced points into one window: what of them lies in front of the tissue that volumes show,
// and, faded, what lies behind.
#ifndef BrainShift_TraceDrawer_h
#define BrainShift_TraceDrawer_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Scene/FirstHits.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Traces/TraceImage.h"

#include "vtkSmartPointer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
struct TraceVertex
{
  std::array<float, 3> position;     // mm, the points' own coordinates
  std::array<std::uint8_t, 4> color; // red, green, blue, opacity
};

struct TraceScene
{
  glm::ivec2 origin{ 0 }; // of the picture in the window, pixels
  glm::ivec2 size{ 1 };
  glm::dmat4 clipFromWorld{ 1.0 };
  glm::dmat4 worldFromPoint{ 1.0 };
  glm::dvec3 ahead{ 0.0, 0.0, -1.0 }; // unit vector, the way the camera looks
  double radius = 1.0;                // mm
  double hiddenOpacity = 1.0;         // share, of what lies behind tissue
  std::vector<const FirstHits*> hits; // of the volumes; at most MaxTissues
};

class TraceDrawer
{
public:
  void upload(const std::vector<TraceVertex>& vertices);

  // False if the shader does not compile.
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
