// SPDX-License-Identifier: BSD-3-Clause
// Asks where the control points of a Free-Form Deformation are; asked of the server, so that it
// holds wherever the data is. Positions: mm, world.
#ifndef BrainShift_LatticeProbe_h
#define BrainShift_LatticeProbe_h

#include "Filters/Deformation/Grid.h"
#include "Widgets/LatticeShapes.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

class vtkSMProxy;

// A proxy that answers questions, in the session of another one; in no undo step.
vtkSmartPointer<vtkSMProxy> makeReport(vtkSMProxy* beside, const char* name);
// Makes a property of it point at a proxy.
void point(vtkSMProxy* report, const char* property, vtkSMProxy* at);
// The numbers of an information property, asked anew.
std::vector<double> told(vtkSMProxy* report, const char* name);

class LatticeProbe
{
public:
  explicit LatticeProbe(vtkSMProxy* deformation);

  // The control points' grid, rest frame; none before the filter was applied.
  std::optional<brainshift::Grid> lattice() const;

  // What lies near a plane: all of it where there is none.
  struct Plane
  {
    glm::dvec3 point{ 0.0 };
    glm::dvec3 normal{ 0.0 };   // unit
    double halfThickness = 0.0; // 0: no plane
  };
  // Control points drawn within `radius` of a position, and those that moved within `movedRadius`.
  std::vector<brainshift::Handle> around(
    const glm::dvec3& position, double radius, double movedRadius, const Plane& plane);

  struct Cone
  {
    glm::dvec3 apex{ 0.0 };
    glm::dvec3 direction{ 0.0 }; // unit
    double radius = 0.0;         // at the apex
    double growth = 0.0;         // of the radius, a mm
  };
  std::vector<brainshift::Handle> within(const Cone& cone);

private:
  std::vector<brainshift::Handle> ask();

  vtkSmartPointer<vtkSMProxy> Report;
};

#endif
