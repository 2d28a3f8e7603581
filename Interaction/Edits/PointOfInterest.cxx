// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/PointOfInterest.h"

#include <pqUndoStack.h>

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMTrace.h>

namespace brainshift
{
namespace
{
constexpr const char* Name = "PointOfInterest";
}

void setPointOfInterest(vtkSMProxy* filter, const glm::dvec3& position)
{
  glm::dvec3 before(0.0);
  vtkSMPropertyHelper property(filter, Name);
  property.Get(&before[0], 3);
  if (position == before)
  {
    return;
  }
  SCOPED_UNDO_SET("Point of interest");
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
  property.Set(&position[0], 3);
  filter->UpdateVTKObjects();
}

void centrePointOfInterest(vtkSMProxy* filter)
{
  // The property's domain has the centre. An unchecked value is not sent to observers.
  vtkSMProperty* property = filter->GetProperty(Name);
  property->ResetToDomainDefaults(/*use_unchecked_values*/ true);
  vtkSMPropertyHelper unchecked(property);
  unchecked.SetUseUnchecked(true);
  glm::dvec3 centre(0.0);
  unchecked.Get(&centre[0], 3);
  property->ClearUncheckedElements();
  setPointOfInterest(filter, centre);
}
}
