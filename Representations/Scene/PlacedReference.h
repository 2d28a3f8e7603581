// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Position of a reference volume, and of the cavity drawn in it, relative to the bent volume. Rays
/// and slices both need it.
#ifndef BrainShift_PlacedReference_h
#define BrainShift_PlacedReference_h

#include "Representations/Scene/Tints.h"

class vtkMatrix4x4;
class vtkTextureObject;

namespace brainshift
{
class Program;
struct Grid;
struct ValueLayout;

/// A reference volume beside the bent one.
struct PlacedReference
{
  vtkTextureObject* scalars = nullptr;    ///< Null: nothing is compared.
  glm::dmat4 referenceFromTexture{ 1.0 }; ///< From the bent volume's texture coordinates.
  glm::dvec3 low{ 0.0 };                  ///< The reference's box, its own texture coordinates.
  glm::dvec3 high{ 1.0 };
};

/// A cavity in the reference, which comparisons ignore.
struct PlacedCavity
{
  vtkTextureObject* voxels = nullptr;  ///< Null: there is no cavity.
  glm::dmat4 cavityFromTexture{ 1.0 }; ///< From the bent volume's texture coordinates.
  double least = 0.5;                  ///< Stored values from here on are inside.
};

/// Position of the bent volume's texture.
struct VolumePlace
{
  glm::dmat4 worldFromTexture{ 1.0 };
  vtkMatrix4x4* actor = nullptr; ///< It moves the reference and the cavity, too.

  /// Texture coordinates of another grid from those of the bent volume.
  glm::dmat4 otherFromTexture(const Grid& grid, const ValueLayout& layout) const;
};

/// Sets the uniforms of a reference, see Shaders/Tissue/reference.glsl.
void setReferencePlace(Program& program, const PlacedReference& reference);

/// Sets the colours in which both volumes are drawn.
void setComparisonColors(Program& program, const ColorPair& colors);

/// Sets the uniforms of Shaders/Tissue/cavity.glsl, if there is a cavity.
void setCavityUniforms(Program& program, const PlacedCavity& cavity);
}

#endif
