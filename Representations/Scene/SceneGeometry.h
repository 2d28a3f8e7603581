// SPDX-License-Identifier: BSD-3-Clause
// How world, volume, lattice, bricks and textures lie to each other. Volume, lattice, offset field
// and bricks share their axes, so every mapping between them is a scale and a shift.
#ifndef BrainShift_SceneGeometry_h
#define BrainShift_SceneGeometry_h

#include "Filters/Deformation/FieldChange.h"
#include "Filters/Deformation/Grid.h"
#include "Representations/Scene/ImageArea.h"
#include "Filters/Deformation/OffsetField.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

class vtkAbstractVolumeMapper;
class vtkDataArray;
class vtkImageData;
class vtkMatrix4x4;
class vtkRenderer;
class vtkVolume;

namespace brainshift
{
struct PresenceRequest;
struct RayCastScene;

// How the values of the drawn array lie: on the image's points, or in its cells.
struct ValueLayout
{
  glm::ivec3 dimensions{ 0 };        // values a side
  glm::dvec3 textureFromGrid{ 1.0 }; // texture = grid * textureFromGrid + textureOfGridZero
  glm::dvec3 textureOfGridZero{ 0.0 };
  glm::dvec3 low{ 0.0 }; // the volume's box, texture coordinates
  glm::dvec3 high{ 1.0 };
};

ValueLayout layoutOf(const glm::ivec3& points, bool cells);

// What a mapper shows of an image.
struct ShownValues
{
  vtkDataArray* scalars = nullptr; // null: there is no such array, or not with all values
  Grid grid;
  ValueLayout layout;
};

ShownValues shownValuesOf(vtkAbstractVolumeMapper* mapper, vtkImageData* image);

glm::dmat4 worldFromTexture(const Grid& grid, const ValueLayout& layout, vtkMatrix4x4* actor);
glm::dmat4 clipFromWorld(vtkRenderer* renderer);

// Texture units for one lattice cell: the unit the offset field is wanted in.
glm::dvec3 textureFromLattice(const Grid& grid, const ValueLayout& layout, const Grid& lattice);

// Widens bounds (mm; x, y, z, least and greatest each) by the box of an offset field's nodes.
void widenByNodes(const Grid& lattice, const FieldNodes& nodes, double bounds[6]);

// Fills in how the offset field and the lattice lie to the texture, and the space tissue can reach.
void placeField(const Grid& grid, const ValueLayout& layout, const Grid& lattice,
  const FieldNodes& nodes, RayCastScene& scene);

// The box (texture coordinates) between vtkVolumeMapper's cropping planes: low and high x, y, z, mm
// along the volume's axes. What is cropped is what is seen, so the box is not deformed.
void cropBox(const Grid& grid, const ValueLayout& layout, const double planes[6], glm::dvec3& low,
  glm::dvec3& high);

// Fills in camera, place of the volume and light.
void describeView(vtkRenderer* renderer, vtkVolume* volume, const Grid& grid,
  const ValueLayout& layout, RayCastScene& scene);

// Finds the pixels of the scene's image that boxes of bricks can be seen at; all of them if part of
// one lies behind the eye. Bricks count from the scene's first one. Where pixels are so large that
// the rasteriser's rounding would come near BrickMargin, nothing is skipped: the picture is tiny.
void placeShownPixels(const std::vector<IndexBox>& boxes, RayCastScene& scene);

// The pixels of the scene's image at which all is seen that lies between positions (lattice
// coordinates) in a space (texture coordinates); all of them if a position lies behind the eye.
PixelPart pixelsBetween(const std::vector<glm::vec3>& positions, const glm::dvec3& spaceLow,
  const glm::dvec3& spaceHigh, const RayCastScene& scene);

// Fills in how the deformed frame's bricks lie to the texture, in both.
void placeBricks(const ValueLayout& layout, RayCastScene& scene, PresenceRequest& request);
}

#endif
