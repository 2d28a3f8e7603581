// SPDX-License-Identifier: BSD-3-Clause
// What a user chooses of a volume beside colour map and light: blend mode, clipping, cropping,
// components. Read from VTK's mapper and property, and given to the ray caster's program.
#ifndef BrainShift_RayCastOptions_h
#define BrainShift_RayCastOptions_h

#include "Representations/Gpu/ShaderSource.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <string>
#include <vector>

class vtkDataArray;
class vtkTextureObject;
class vtkVolumeMapper;
class vtkVolumeProperty;

namespace brainshift
{
class Program;

// Which numbers of a voxel are shown.
struct ShownComponents
{
  int scalar = 0; // gives opacity, gradient and, unless `coloring` says otherwise, colour; -1: the
                  // length of the vector
  Coloring coloring = Coloring::Mapped;
};

// Stored scalar of the textures: value = stored * scale + shift.
struct StoredScalar
{
  double scale = 1.0;
  double shift = 0.0;
};

// One mapping, then the next.
inline StoredScalar mappedFurther(const StoredScalar& first, const StoredScalar& next)
{
  return { first.scale * next.scale, first.shift * next.scale + next.shift };
}

struct RayCastOptions
{
  Blend blend = Blend::Composite;
  Coloring coloring = Coloring::Mapped;
  std::vector<float> clipPlanes; // 4 each: texture coordinates, kept where dot + w >= 0
  bool regions = false;          // some of VTK's 27 cropping regions, by the next three
  int regionFlags = 0;           // bit x + 3 y + 9 z
  glm::dvec3 regionLow{ 0.0 };   // texture coordinates
  glm::dvec3 regionHigh{ 1.0 };
  std::vector<float> isovalues;                // stored scalars, ascending
  glm::dvec2 shareFromScalar{ 1.0, 0.0 };      // stored scalar to its share of the array's range
  glm::dvec2 averagedScalars{ 0.0, 1.0 };      // stored scalars that the average takes
  glm::dvec4 slicePlane{ 0.0, 0.0, 1.0, 0.0 }; // texture coordinates
  vtkTextureObject* colors = nullptr;          // Coloring::Direct
  vtkTextureObject* colorScalars = nullptr;    // Coloring::OtherScalar
  glm::dvec2 transferFromColorScalar{ 1.0, 0.0 };
  vtkTextureObject* segment = nullptr; // null: all tissue is drawn
  glm::dvec3 segmentVoxel{ 1.0 };      // one of its voxels, texture coordinates
  glm::dvec2 cutGradient{ 1.0, 0.0 };  // stored scalar to how much its edge counts for light
};

// The numbers that a property shows of an array, as ParaView's "Volume" does: independent ones by
// the colour map's choice, dependent ones as colour and opacity (two numbers) or as red, green,
// blue and opacity (four).
ShownComponents shownComponents(vtkVolumeProperty* property, vtkDataArray* scalars);

// Blend mode as it can be drawn.
Blend blendOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property);

// Isosurface values in ascending order, as many as can be drawn.
std::vector<double> isovaluesOf(vtkVolumeProperty* property);

// Fills in planes and values; blend, coloring, regions and textures are the caller's.
void describeOptions(vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars,
  const StoredScalar& stored, const glm::dmat4& worldFromTexture, RayCastOptions& options);

// One sentence for each choice that is drawn otherwise than ParaView's "Volume" would.
std::vector<std::string> unsupportedChoices(
  vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars);

void setOptionUniforms(Program& program, const RayCastOptions& options);

// Those of them that components.glsl needs.
void setColoringUniforms(Program& program, const RayCastOptions& options);
}

#endif
