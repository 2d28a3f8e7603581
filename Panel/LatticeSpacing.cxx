// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeSpacing.h"

#include <pqPipelineSource.h>

#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <algorithm>
#include <cmath>

VolumeSize volumeSize(pqPipelineSource* deformation)
{
  VolumeSize size;
  if (deformation->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return size; // not applied yet
  }
  vtkSMSourceProxy* proxy = deformation->getSourceProxy();
  const double* bounds = proxy->GetDataInformation()->GetBounds();
  const vtkSMPropertyHelper dimensions(proxy, "LatticeDimensions");
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double length = bounds[2 * axis + 1] - bounds[2 * axis];
    if (length <= 0.0) // an empty volume has its bounds the wrong way round
    {
      return {};
    }
    size.diagonal = std::hypot(size.diagonal, length);
    size.spacing = std::max(size.spacing, length / std::max(dimensions.GetAsInt(axis) - 1, 1));
  }
  return size;
}
