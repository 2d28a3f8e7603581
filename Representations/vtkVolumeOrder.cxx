// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeOrder.h"

#include "vtkCamera.h"
#include "vtkDeformedSlicesMapper.h"
#include "vtkDeformedVolumeMapper.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkVolumeOrder);

namespace
{
// A volume of which an MPI rank draws a part has its place among others by all of it.
const double* boundsOf(vtkProp* prop)
{
  auto* volume = vtkVolume::SafeDownCast(prop);
  vtkAbstractVolumeMapper* mapper = volume ? volume->GetMapper() : nullptr;
  auto* bent = vtkDeformedVolumeMapper::SafeDownCast(mapper);
  auto* slices = vtkDeformedSlicesMapper::SafeDownCast(mapper);
  const double* all = bent ? bent->GetTissueOfAllRanks()
    : slices               ? slices->GetTissueOfAllRanks()
                           : nullptr;
  return all ? all : prop->GetBounds();
}
}

vtkVolumeOrder::vtkVolumeOrder() = default;
vtkVolumeOrder::~vtkVolumeOrder() = default;

double vtkVolumeOrder::Cull(vtkRenderer* renderer, vtkProp** props, int& count, int& initialized)
{
  const double* ahead = renderer->GetActiveCamera()->GetDirectionOfProjection();
  double time = 0.0; // a culler returns the sum of the props that it keeps
  std::vector<std::pair<double, vtkProp*>> volumes; // depth of the middle
  std::vector<int> places;
  for (int i = 0; i < count; ++i)
  {
    time += initialized ? props[i]->GetRenderTimeMultiplier() : 1.0;
    const bool sorted = this->Enabled && vtkVolume::SafeDownCast(props[i]);
    const double* box = sorted ? boundsOf(props[i]) : nullptr;
    if (box)
    {
      const double depth = 0.5 *
        (ahead[0] * (box[0] + box[1]) + ahead[1] * (box[2] + box[3]) +
          ahead[2] * (box[4] + box[5]));
      volumes.emplace_back(depth, props[i]);
      places.push_back(i);
    }
  }
  std::stable_sort(volumes.begin(), volumes.end(),
    [](const auto& left, const auto& right) { return left.first > right.first; });
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    props[places[i]] = volumes[i].second;
  }
  return time;
}
