// SPDX-License-Identifier: BSD-3-Clause
// What a camera sees: the near and the far plane, in any coordinates.
#ifndef BrainShift_Frustum_h
#define BrainShift_Frustum_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace brainshift
{
// Positions on it are affine in ndc for every camera VTK has.
struct FrustumPlane
{
  glm::dvec3 origin{ 0.0 }; // position of ndc (0,0)
  glm::dvec3 right{ 0.0 };  // what one unit of ndc x and y adds
  glm::dvec3 up{ 0.0 };
  double w = 1.0; // homogeneous

  glm::dvec3 at(const glm::dvec2& ndc) const
  {
    return this->origin + ndc.x * this->right + ndc.y * this->up;
  }
  // Times (1, ndc x, ndc y): the position.
  glm::dmat3 columns() const { return glm::dmat3(this->origin, this->right, this->up); }
};

struct Frustum
{
  FrustumPlane near;
  FrustumPlane far;
};

VTKBRAINSHIFTREPRESENTATIONS_EXPORT Frustum frustumOf(const glm::dmat4& clipFromSpace);

// Of one camera with other near and far planes: the share of the way between those of `to`, from
// the share between those of `from`: scale and shift.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::dvec2 shareFromShare(
  const Frustum& to, const Frustum& from);
}

#endif
