// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What a user chooses of a volume beside colour map and light, read from VTK's mapper and
 * property: the numbers of a voxel that are drawn, and the blend mode.
 */
#ifndef BrainShift_VolumeChoices_h
#define BrainShift_VolumeChoices_h

#include "Representations/Gpu/ShaderSource.h"
#include "Representations/Scene/RayCastScene.h"

#include <glm/mat4x4.hpp>

#include <string>
#include <vector>

class vtkDataArray;
class vtkVolumeMapper;
class vtkVolumeProperty;

namespace brainshift
{
/// Which numbers of a voxel are drawn.
struct DrawnComponents
{
  /// Gives opacity, gradient and, if `coloring` is Mapped, colour. -1: the length of the vector.
  int scalar = 0;
  Coloring coloring = Coloring::Mapped;
};

/// What a stored number means: value = stored * scale + shift.
struct StoredScalar
{
  double scale = 1.0;
  double shift = 0.0;
};

/// One mapping, then the next.
inline StoredScalar mappedFurther(const StoredScalar& first, const StoredScalar& next)
{
  return { first.scale * next.scale, first.shift * next.scale + next.shift };
}

/// The numbers that a property draws of an array, as ParaView's "Volume" does. The colour map
/// chooses among independent ones. Dependent ones are colour and opacity (two numbers) or red,
/// green, blue and opacity (four numbers).
DrawnComponents drawnComponents(vtkVolumeProperty* property, vtkDataArray* scalars);

/// The blend mode. Composite if the chosen one cannot be drawn.
Blend blendOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property);

/// What opacity depends on. Scalar if the other choice cannot be drawn.
Opacity opacityOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars);

/// Isosurface values in ascending order, at most MaxIsovalues.
std::vector<double> isovaluesOf(vtkVolumeProperty* property);

/// Fills the scene's blending. `stored`: what the texture of scalars stores.
SceneBlending blendingOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property,
  vtkDataArray* scalars, const StoredScalar& stored, const glm::dmat4& worldFromTexture);

/// One sentence for each choice that looks different from ParaView's "Volume".
std::vector<std::string> unsupportedChoices(
  vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars);
}

#endif
