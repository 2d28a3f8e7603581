// SPDX-License-Identifier: BSD-3-Clause
// Draws planes through a deformed volume into the scene.
#ifndef BrainShift_SliceDrawer_h
#define BrainShift_SliceDrawer_h

#include "Counters.h"
#include "Program.h"
#include "RayCaster.h"
#include "SliceGeometry.h"

#include <glm/vec3.hpp>

#include <map>

class vtkOpenGLRenderWindow;

namespace brainshift
{
// A volume to compare with.
struct ReferenceScene
{
  vtkTextureObject* scalars = nullptr;    // null: none
  glm::dmat4 referenceFromTexture{ 1.0 }; // its texture coordinates from the volume's
  glm::dvec3 low{ 0.0 };                  // its box, in its texture coordinates
  glm::dvec3 high{ 1.0 };
  glm::dvec2 shareFromReference{ 1.0, 0.0 }; // stored scalar to its share of what is shown
  glm::dvec2 shareFromScalar{ 1.0, 0.0 };    // the same of the volume
  int comparison = 0;                        // as vtkDeformedSlicesMapper numbers them
  glm::dvec3 checkersFromTexture{ 1.0 };     // checker fields for a texture unit
};

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
