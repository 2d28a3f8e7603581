// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/VisibleTissue.h"

#include "Filters/Deformation/Lattice.h"
#include "Representations/Scene/VolumeChoices.h"

#include "vtkDataArray.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double LookedAt = 20000.0; // voxels, about
}

void countVisible(const DrawnValues& values, vtkVolumeProperty* property, const Lattice* lattice,
  TissueCounts& counts)
{
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  const bool all = property->GetTransferFunctionMode() == vtkVolumeProperty::TF_2D;
  const int component = drawnComponents(property, values.scalars).scalar;
  const glm::ivec3& sides = values.layout.voxels;
  if (glm::any(glm::lessThan(sides, glm::ivec3(1))))
  {
    return;
  }
  const double count = static_cast<double>(sides.x) * sides.y * sides.z;
  const int step = static_cast<int>(std::ceil(std::cbrt(std::max(count / LookedAt, 1.0))));
  for (int z = std::min(step / 2, sides.z - 1); z < sides.z; z += step)
  {
    for (int y = std::min(step / 2, sides.y - 1); y < sides.y; y += step)
    {
      for (int x = std::min(step / 2, sides.x - 1); x < sides.x; x += step)
      {
        const vtkIdType tuple = (static_cast<vtkIdType>(z) * sides.y + y) * sides.x + x;
        const double value = numberOf(values.scalars, tuple, component);
        if (std::isfinite(value) && (all || opacity->GetValue(value) > 0.0))
        {
          const glm::dvec3 rest = values.grid.worldFromGrid(glm::dvec3(x, y, z));
          const glm::dvec3 moved = lattice ? displacementOfTissue(*lattice, rest) : glm::dvec3(0.0);
          counts.add(rest + moved, static_cast<long long>(step) * step * step);
        }
      }
    }
  }
}
}
