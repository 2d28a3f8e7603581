// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Draws planes through a deformed volume into the window.
 */
#ifndef BrainShift_SliceDrawer_h
#define BrainShift_SliceDrawer_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Scene/RayCastScene.h"
#include "Representations/Slices/SliceComparison.h"
#include "Representations/Slices/SliceGeometry.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <map>

class vtkOpenGLRenderWindow;

namespace brainshift
{
/// Everything that a picture of slices depends on.
struct SliceScene
{
  SceneFrame frame;
  SceneField field;
  SceneTissue tissue;
  SlicePlanes planes;
  ReferenceScene reference;
  SceneEvidence evidence;
  glm::ivec3 voxels{ 1 };            ///< Of the scalars, a side.
  bool cubic = false;                ///< Cubic filter; else as the textures filter.
  double opacity = 1.0;              ///< Of everything, 0 to 1.
  bool mapsOpacity = false;          ///< The opacity map counts, too.
  bool blended = false;              ///< Blended from back to front, without writing depth.
  bool selecting = false;            ///< Only depth is drawn, for a selection.
  bool crosshair = false;            ///< The lines where the planes cut each other are drawn.
  glm::mat3 crosshairColors{ 1.0f }; ///< A column for the plane across each axis of the texture.
};

/// The programs of one window.
class SliceDrawer
{
public:
  /// Draws the planes. False if a shader does not compile.
  bool draw(vtkOpenGLRenderWindow* window, const SliceScene& scene, Counters& counters);

  void releaseGraphicsResources() { this->Programs.clear(); }

private:
  std::map<SlicesVariant, Program> Programs; // those drawn with so far
};
}

#endif
