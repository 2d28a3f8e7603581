// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edits the property PointOfInterest of a Free-Form Deformation, for the key I and for the panel.
/// An edit acts at once, without Apply, and is one undo step. An edit without a change is no step.
#ifndef BrainShift_PointOfInterest_h
#define BrainShift_PointOfInterest_h

#include <glm/glm.hpp>

class vtkSMProxy;

namespace brainshift
{
/// Moves the point to a position (mm, world axes).
void setPointOfInterest(vtkSMProxy* filter, const glm::dvec3& position);
/// Moves the point to the centre of the volume.
void centrePointOfInterest(vtkSMProxy* filter);
}

#endif
