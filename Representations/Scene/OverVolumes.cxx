// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/OverVolumes.h"

#include "vtkPropCollection.h"
#include "vtkRenderer.h"

namespace brainshift
{
bool OverVolumes::areVisibleIn(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
  {
    if (prop->GetVisibility() && OverVolumes::SafeDownCast(prop))
    {
      return true;
    }
  }
  return false;
}
}
