// SPDX-License-Identifier: BSD-3-Clause
// Draws planes through a deformed volume into the scene.
#ifndef BrainShift_SliceDrawer_h
#define BrainShift_SliceDrawer_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Picture/RayCaster.h"
#include "Representations/Slices/SliceComparison.h"
#include "Representations/Slices/SliceGeometry.h"

#include <glm/vec3.hpp>

#include <map>

class vtkOpenGLRenderWindow;

namespace brainshift
{
struct SliceScene
{
  RayCastScene volume; // tissue, offset field and camera of it
  SlicePlanes planes;
  ReferenceScene reference;
  glm::ivec3 voxels{ 1 };   // of the scalars, a side
  bool cubic = false;       // else as the textures filter
  double opacity = 1.0;     // of all that is shown
  bool mapsOpacity = false; // times the opacity map's
  bool blended = false;     // over what is there already, from back to front, leaving its depth
  bool selecting = false;   // only depth, for a selection
};

class SliceDrawer
{
public:
  // False if a shader does not compile.
  bool draw(vtkOpenGLRenderWindow* window, const SliceScene& scene, Counters& counters);

  void releaseGraphicsResources() { this->Programs.clear(); }

private:
  std::map<SlicesVariant, Program> Programs; // those drawn with so far
};
}

#endif
