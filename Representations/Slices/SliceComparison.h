// SPDX-License-Identifier: BSD-3-Clause
// A reference volume beside the bent one in slices: what lies on the GPU, and what the shader is
// told (Shaders/Slices/comparison.glsl).
#ifndef BrainShift_SliceComparison_h
#define BrainShift_SliceComparison_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Tissue/PlacedReference.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Tissue/ScalarTexture.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Tissue/Tissue.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class Program;

// What the user chose; see vtkDeformedSlicesMapper.
struct ComparisonChoice
{
  int comparison = 0;             // as numbered there
  double checkerSizeMm = 1.0;     // of a field
  double fullGradient = 1.0;      // share of what is shown within a mm that is fully green
  glm::dvec3 wipePosition{ 0.0 }; // mm, world
};

// How the volume's scalars and texture lie to the world, and the scalars of both to what is shown.
struct ComparedVolume
{
  Grid grid;
  ValueLayout layout;
  glm::dvec2 shownRange{ 0.0, 1.0 };         // the volume's values that are black and white
  StoredScalar valueFromStored;              // of the volume
  StoredScalar valueFromReference;           // as in 3D: see SceneReference.h
  glm::dvec2 transferFromStored{ 1.0, 0.0 }; // coordinate of the colour map
  bool nearest = false;                      // filter of both
};

// A plane that divides a slice: mm beyond it from texture coordinates, on the reference's side.
struct WipePlane
{
  glm::dvec3 normal{ 0.0 };
  double shift = 0.0;
};

struct ReferenceScene
{
  PlacedReference place;
  PlacedCavity cavity;
  glm::ivec3 voxels{ 1 };                    // of the reference, a side
  glm::dvec2 shareFromReference{ 1.0, 0.0 }; // stored scalar to its share of what is shown
  glm::dvec2 shareFromScalar{ 1.0, 0.0 };    // the same of the volume
  glm::dvec2 transferFromShare{ 1.0, 0.0 };
  int comparison = 0;                    // 0: the reference alone
  glm::dvec3 checkersFromTexture{ 1.0 }; // checker fields for a texture unit
  glm::dvec3 greenFromGradient{ 1.0 };   // stored scalar for a unit of its texture, to full green
  std::array<WipePlane, 3> wipes;        // of the slices across each axis of the volume's texture
};

// Slices across the volume's axis nearest to world x are divided across the one nearest to y, all
// others across the one nearest to x. The reference lies towards smaller x and y: on the right of
// all radiological pictures.
std::array<WipePlane, 3> wipePlanes(
  const Grid& grid, const ValueLayout& layout, const glm::dvec3& positionMm);

// The reference and its cavity in a window.
class ReferenceTextures
{
public:
  // Makes them current and fills in the scene. False, with one sentence in `problem`, if this GPU
  // cannot.
  bool update(vtkOpenGLRenderWindow* window, const ReferenceVolume& reference,
    const ComparisonChoice& choice, const ComparedVolume& volume, ReferenceScene& scene,
    Counters& counters, std::string& problem);

  std::vector<vtkTextureObject*> textures() const; // null: not in use
  void releaseGraphicsResources(vtkWindow* window);

private:
  ScalarTexture Voxels;
  CavityTexture Cavity;
};

void setReferenceUniforms(Program& program, const ReferenceScene& scene);

// `axis`: of the volume's texture, that the slice to be drawn lies across.
void setWipeUniforms(Program& program, const ReferenceScene& scene, int axis);
}

#endif
