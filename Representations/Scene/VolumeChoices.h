// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a user chooses of a volume beside colour map and light, read from VTK's mapper and
/// property: the numbers of a voxel that are drawn, and the blend mode.
#ifndef BrainShift_VolumeChoices_h
#define BrainShift_VolumeChoices_h

#include "Representations/Scene/RayCastScene.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkType.h"

class vtkDataArray;
class vtkPlane;
class vtkVolumeMapper;
class vtkVolumeProperty;

namespace brainshift
{
// Clipping planes and cropping regions of a mapper, in texture coordinates.
//
// Both cut what is seen: they stay where they are when tissue moves.

/// Coefficients of a plane (mm, world) in texture coordinates.
glm::dvec4 texturePlane(vtkPlane* plane, const glm::dmat4& worldFromTexture);

/// How many clipping planes a mapper has.
int clipPlaneCount(vtkVolumeMapper* mapper);

/// Fills the scene's cuts for the volume that `mapper` draws.
SceneCuts cutsOf(vtkVolumeMapper* mapper, const DrawnValues& values, const SceneFrame& frame,
  const SceneField& field);

/// The sides of a part of the deformed frame (bounds, mm; empty: all of it) as
/// SceneCuts::partPlanes.
std::vector<float> partPlanesOf(
  const std::vector<double>& part, const glm::dmat4& worldFromTexture);

/// Fills the scene's cuts for a reference that is drawn in place of the mapper's volume. The
/// volume's cropping becomes clipping planes. `exact`: false if cropping keeps other regions than
/// the middle one, which planes cannot express: then it cuts nothing.
SceneCuts cutsOfReference(vtkVolumeMapper* mapper, const RayCastScene& reference,
  const DrawnValues& volume, const glm::dmat4& worldFromVolumeTexture, bool& exact);

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

/// A component of a tuple; -1: its length.
double numberOf(vtkDataArray* scalars, vtkIdType tuple, int component);

/// The blend mode. Composite if the chosen one cannot be drawn.
Blend blendOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property);

/// What opacity depends on. Scalar if the other choice cannot be drawn.
Opacity opacityOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars);

/// Isosurface values in ascending order, at most MaxIsovalues.
std::vector<double> isovaluesOf(vtkVolumeProperty* property);

/// Fills the scene's blending. `stored`: what the texture of scalars stores.
SceneBlending blendingOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property,
  vtkDataArray* scalars, const StoredScalar& stored, const glm::dmat4& worldFromTexture);

/// One sentence for each choice that is drawn differently from ParaView's "Volume".
std::vector<std::string> unsupportedChoices(
  vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars);
}

#endif
