// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a camera sees: the near and the far plane, in any coordinates.
#ifndef BrainShift_Frustum_h
#define BrainShift_Frustum_h

#include "Representations/Scene/ImageArea.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

namespace brainshift
{
/// One of the planes. Positions on it are affine in ndc (normalised device coordinates, -1 to 1)
/// for every camera that VTK has.
struct FrustumPlane
{
  glm::dvec3 origin{ 0.0 }; ///< Position of ndc (0,0).
  glm::dvec3 right{ 0.0 };  ///< What one unit of ndc x adds.
  glm::dvec3 up{ 0.0 };     ///< What one unit of ndc y adds.
  double w = 1.0;           ///< Homogeneous coordinate of the plane.

  /// Position of a point in ndc.
  glm::dvec3 at(const glm::dvec2& ndc) const
  {
    return this->origin + ndc.x * this->right + ndc.y * this->up;
  }

  /// The matrix that gives the position from (1, ndc x, ndc y).
  glm::dmat3 columns() const { return glm::dmat3(this->origin, this->right, this->up); }
};

/// The space between two planes.
struct Frustum
{
  FrustumPlane near;
  FrustumPlane far;
};

/// The frustum in the coordinates of `space`.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Frustum frustumOf(const glm::dmat4& clipFromSpace);

/// For two frustums of one camera, which differ only in their near and far planes: scale and shift
/// that map a fraction of the distance between the planes of `from` to a fraction between those of
/// `to`.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::dvec2 fractionFromFraction(
  const Frustum& to, const Frustum& from);

// Where the rays of a picture met a surface first.

/// One number for each pixel. The position follows from it and from the camera of the picture,
/// which may have moved on since.
struct FirstHits
{
  /// Fraction of the way from the near to the far plane. Below 0, and beyond the area: no hit.
  vtkSmartPointer<vtkTextureObject> texture;
  ImageArea area;  ///< Of the picture.
  Frustum frustum; ///< Of the picture, mm, world.
};
}

#endif
