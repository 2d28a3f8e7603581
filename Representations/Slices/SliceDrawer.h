// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws planes through a deformed volume into the window.
#ifndef BrainShift_SliceDrawer_h
#define BrainShift_SliceDrawer_h

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/VolumeChoices.h"
#include "Representations/Slices/SliceGeometry.h"
#include "Representations/Slices/SlicePart.h"
#include "Representations/Tissue/CavityTexture.h"

#include <map>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
// A reference volume beside the bent one in slices: its textures, and the uniforms of
// Shaders/Slices/comparison.glsl.

struct GpuTask;
class Program;

/// What the user chose; see vtkDeformedSlicesMapper.
struct ComparisonChoice
{
  int comparison = 0;             ///< As numbered there.
  ColorPair colors;               ///< For two colours, gradient and similarity.
  double checkerSizeMm = 1.0;     ///< Side of a field.
  double fullGradient = 1.0;      ///< Fraction of the range of greys per mm of full colour.
  double windowMm = 12.0;         ///< Diameter of the window of local similarity.
  glm::dvec3 wipePosition{ 0.0 }; ///< mm, world.
};

/// The bent volume, and what the scalars of both volumes mean.
struct ComparedVolume
{
  Grid grid;
  ValueLayout layout;
  glm::dvec2 greyRange{ 0.0, 1.0 };          ///< The volume's values that are black and white.
  StoredScalar valueFromStored;              ///< Of the volume.
  StoredScalar valueFromReference;           ///< See SceneReference.h; used in 3D, too.
  glm::dvec2 transferFromStored{ 1.0, 0.0 }; ///< Coordinate of the colour map: scale, shift.
  bool referenceNearest = false;             ///< Its voxels are drawn as they are.
  bool referenceCubic = false;               ///< Cubic filter for it; else as the texture filters.
};

/// A plane that divides a slice: mm beyond it, on the reference's side, from texture coordinates.
struct WipePlane
{
  glm::dvec3 normal{ 0.0 };
  double shift = 0.0;
};

/// What the shader needs of a reference.
struct ReferenceScene
{
  PlacedReference place;
  PlacedCavity cavity;
  glm::ivec3 voxels{ 1 }; ///< Of the reference, a side.
  bool cubic = false;     ///< Cubic filter; else as the texture filters.
  glm::dvec2 fractionFromReference{ 1.0,
    0.0 }; ///< Stored scalar to its fraction of the range of greys.
  glm::dvec2 fractionFromScalar{ 1.0,
    0.0 }; ///< The volume's stored scalar to its fraction of the greys.
  glm::dvec2 transferFromFraction{ 1.0, 0.0 }; ///< Coordinate of the colour map from that fraction.
  int comparison = 0;                          ///< 0: the reference alone.
  ColorPair colors;
  glm::dvec3 checkersFromTexture{ 1.0 }; ///< Checker fields for a texture unit.
  glm::dvec3 fullFromGradient{ 1.0 }; ///< Gradient (stored scalar per texture unit) to full colour.
  glm::dvec3 windowRadius{ 1.0 };     ///< Of local similarity, texture units.
  std::array<WipePlane, 3> wipes;     ///< For the slices across each axis of the texture.
};

/// The planes that divide the slices across each axis. Slices across the volume's axis nearest to
/// world x are divided across the axis nearest to y, all others across the axis nearest to x. The
/// reference lies towards smaller x and y: on the right of all radiological pictures.
std::array<WipePlane, 3> wipePlanes(
  const Grid& grid, const ValueLayout& layout, const glm::dvec3& positionMm);

/// The reference and its cavity in one window.
class ReferenceTextures
{
public:
  /// Uploads them if they changed, and fills in the scene. False, with a problem, if this GPU
  /// cannot.
  bool update(GpuTask& gpu, const ReferenceVolume& reference, const ComparisonChoice& choice,
    const ComparedVolume& volume, ReferenceScene& scene);

  std::vector<vtkTextureObject*> textures() const; ///< Null: not in use.
  void releaseGraphicsResources(vtkWindow* window);

private:
  ScalarTexture Voxels;
  CavityTexture Cavity;
};

/// Sets the uniforms of comparison.glsl, except for the wipe.
void setReferenceUniforms(Program& program, const ReferenceScene& scene);

/// Sets the uniforms of the wipe. `axis`: the axis of the volume's texture that the slice lies
/// across.
void setWipeUniforms(Program& program, const ReferenceScene& scene, int axis);

/// Everything that a picture of slices depends on.
struct SliceScene
{
  SceneFrame frame;
  SceneField field;
  SceneTissue tissue;
  SceneBricks bricks;
  SlicePlanes planes;
  SlicePart part;
  ReferenceScene reference;
  SceneEvidence evidence;
  SceneResection resection;
  glm::ivec3 voxels{ 1 };            ///< Of the texture of scalars, a side.
  bool cubic = false;                ///< Cubic filter; else as the texture of scalars filters.
  bool nearest = false;              ///< The textures of voxels do not filter.
  double opacity = 1.0;              ///< Of everything, 0 to 1.
  bool mapsOpacity = false;          ///< The opacity map counts, too.
  bool blended = false;              ///< Blended from back to front, without writing depth.
  bool selecting = false;            ///< Only depth is drawn, for a selection.
  bool crosshair = false;            ///< The lines where the planes cut each other are drawn.
  glm::mat3 crosshairColors{ 1.0f }; ///< A column for the plane across each axis of the texture.
};

/// Texture coordinates to the camera's clip space.
glm::dmat4 clipFromTexture(const SceneFrame& frame);

/// Runs slices.vert.glsl for a rectangle.
void drawQuad(Program& program, const SliceQuad& quad);

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
