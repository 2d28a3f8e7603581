// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Mappings between world, grid and textures of a volume.
///
/// Volume, lattice, offset field and bricks share their axes. So every mapping between two of them
/// is a scale and a shift.
#ifndef BrainShift_SceneGeometry_h
#define BrainShift_SceneGeometry_h

#include "Common/Grid.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <optional>

class vtkAbstractVolumeMapper;
class vtkDataArray;
class vtkImageData;
class vtkMatrix4x4;
class vtkRenderer;

namespace brainshift
{
/// Layout of the values of the drawn array: on the image's points, or in its cells.
struct ValueLayout
{
  glm::ivec3 voxels{ 0 };            ///< Values of the array, a side.
  glm::ivec3 perTexel{ 1 };          ///< Of these, a side, that one texel stands for.
  glm::ivec3 dimensions{ 0 };        ///< Texels a side.
  glm::dvec3 textureFromGrid{ 1.0 }; ///< texture = grid * textureFromGrid + textureOfGridZero
  glm::dvec3 textureOfGridZero{ 0.0 };
  glm::dvec3 low{ 0.0 }; ///< The volume's box, texture coordinates.
  glm::dvec3 high{ 1.0 };
  bool ofCells = false;

  bool isWhole() const { return this->perTexel == glm::ivec3(1); }

  /// Texture coordinates of a position in grid coordinates.
  glm::dvec3 textureAt(const glm::dvec3& grid) const
  {
    return grid * this->textureFromGrid + this->textureOfGridZero;
  }
};

/// Layout of values on `points` points a side, or in the cells between them.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ValueLayout layoutOf(const glm::ivec3& points, bool cells);

/// The same volume in a texture with a texel for `perTexel` voxels a side. The last ones may stand
/// for fewer.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ValueLayout coarser(
  const ValueLayout& layout, const glm::ivec3& perTexel);

/// How far beyond the volume's box (texture coordinates) a place still counts as inside: a plane on
/// the very face of the box must not come and go with rounding.
glm::dvec3 roundingOf(const ValueLayout& layout);

/// Number of the value nearest to a place (texture coordinates). None farther than `margin` outside
/// the volume's box (texture coordinates along each axis). A place between two values belongs to
/// the later one, whichever part of a volume the layout is of.
std::optional<long long> nearestValue(
  const ValueLayout& layout, const glm::dvec3& texture, const glm::dvec3& margin);

/// The values of an image that are drawn, and their layout.
struct DrawnValues
{
  vtkDataArray* scalars = nullptr; ///< Null: there is no such array, or it has too few values.
  Grid grid;
  ValueLayout layout;
};

/// The values that a mapper is set to draw.
DrawnValues drawnValuesOf(vtkAbstractVolumeMapper* mapper, vtkImageData* image);

/// World (mm) from texture coordinates; `actor` is the matrix of the vtkVolume.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::dmat4 worldFromTexture(
  const Grid& grid, const ValueLayout& layout, vtkMatrix4x4* actor);

/// Clip coordinates from world (mm), of the renderer's active camera.
glm::dmat4 clipFromWorld(vtkRenderer* renderer);

/// Texture coordinates from world (mm), before the actor's matrix.
glm::dvec3 textureFromWorld(const DrawnValues& values, const glm::dvec3& world);
}

#endif
