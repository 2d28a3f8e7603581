// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/BaseLattice.h"

#include "Common/FieldDirection.h"
#include "Common/Grid.h"
#include "Common/ImageGrid.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/Lattice.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace brainshift
{
namespace
{
// Adds a displacement field on any grid to a lattice, read trilinearly at the control points.
void addField(Lattice& lattice, vtkImageData* image, vtkDataArray* field)
{
  const Grid from = gridOf(image);
  const auto value = [&](const glm::ivec3& at) {
    double tuple[3];
    field->GetTuple(static_cast<vtkIdType>(from.offset(at.x, at.y, at.z)), tuple);
    return glm::dvec3(tuple[0], tuple[1], tuple[2]);
  };
  const glm::ivec3 last = from.dimensions - 1;
  std::size_t point = 0;
  forEachIndex(glm::ivec3(0), lattice.grid.dimensions - 1, [&](const glm::ivec3& index) {
    const glm::dvec3 position =
      glm::clamp(from.gridFromWorld(lattice.grid.worldFromGrid(glm::dvec3(index))), glm::dvec3(0.0),
        glm::dvec3(last));
    const glm::ivec3 low(position);
    const glm::dvec3 within = position - glm::dvec3(low);
    glm::dvec3 sum(0.0);
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      const glm::dvec3 weight = glm::mix(1.0 - within, within, glm::dvec3(side));
      sum += weight.x * weight.y * weight.z * value(glm::min(low + side, last));
    }
    lattice.displacements[point++] += glm::vec3(sum);
  });
}
}

std::string addBase(Lattice& lattice, vtkImageData* base)
{
  if (!base || base->GetNumberOfPoints() == 0)
  {
    return {};
  }
  if (directionOf(base) == Direction::Backward)
  {
    return "The base lattice is a backward field; it must be a forward field. Invert Displacement "
           "Field makes a forward field";
  }
  vtkDataArray* field = fieldOf(base);
  if (!field)
  {
    return "The base lattice has no point array of 3 components (mm)";
  }
  const std::string problem = problemOfGrid(gridOf(base));
  if (!problem.empty())
  {
    return "The base lattice's " + problem;
  }
  addField(lattice, base, field);
  const auto finite = [](const glm::vec3& d) {
    return std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z);
  };
  const std::string array =
    std::string("base lattice's array ") + (field->GetName() ? field->GetName() : "without a name");
  return std::all_of(lattice.displacements.begin(), lattice.displacements.end(), finite)
    ? problemOfDisplacements(lattice, "the " + array)
    : "The " + array + " holds a number that is not finite";
}
}
