// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Asks where the control points of a Free-Form Deformation are. The server answers, so it works
/// wherever the data is. Positions: mm, world axes.
#ifndef BrainShift_LatticeProbe_h
#define BrainShift_LatticeProbe_h

#include "Common/Grid.h"
#include "Widgets/LatticeShapes.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

class vtkSMProxy;

namespace brainshift
{
class LatticeProbe
{
public:
  explicit LatticeProbe(vtkSMProxy* deformation);

  /// The grid of the control points in the rest frame. None before the filter was applied.
  std::optional<Grid> lattice() const;

  /// Limits a search to a layer around a plane. Without a plane there is no limit.
  struct Plane
  {
    glm::dvec3 point{ 0.0 };
    glm::dvec3 normal{ 0.0 };   ///< Unit length.
    double halfThickness = 0.0; ///< mm. 0: there is no plane.
  };
  /// Control points drawn within `radius` (mm) of a position, and moved ones within `movedRadius`.
  std::vector<ControlPoint> around(
    const glm::dvec3& position, double radius, double movedRadius, const Plane& plane);

  /// Positions around a ray.
  struct Cone
  {
    glm::dvec3 apex{ 0.0 };
    glm::dvec3 direction{ 0.0 }; ///< Unit length.
    double radius = 0.0;         ///< mm, at the apex.
    double growth = 0.0;         ///< Of the radius, mm per mm.
  };
  /// Control points drawn within a cone.
  std::vector<ControlPoint> within(const Cone& cone);

  /// Where the tissue at places lies at rest, or, if not `toRest`, where tissue at rest is drawn.
  /// Empty before the filter was applied.
  std::vector<glm::dvec3> sameTissue(const std::vector<glm::dvec3>& places, bool toRest);

private:
  std::vector<ControlPoint> ask();

  vtkSmartPointer<vtkSMProxy> Report;
};
}

#endif
