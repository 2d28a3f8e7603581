// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Registered/RegisteredSource.h"

#include "Common/ImageGrid.h"
#include "Filters/Attached/ReferenceVolume.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <glm/vector_relational.hpp>

#include <cmath>

namespace brainshift
{
namespace
{
vtkDataArray* scalarsOf(vtkImageData* image)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars = scalars ? scalars : image->GetPointData()->GetArray(0);
  return scalars && scalars->GetNumberOfComponents() == 1 ? scalars : nullptr;
}

std::vector<float> floatsOf(vtkDataArray* array)
{
  std::vector<float> values(array->GetNumberOfTuples());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double value = array->GetComponent(static_cast<vtkIdType>(i), 0);
    values[i] = std::isfinite(value) ? static_cast<float>(value) : 0.0f;
  }
  return values;
}

Mask maskOf(const PlacedVoxels& cavity)
{
  Mask mask;
  if (cavity.voxels)
  {
    mask.grid = cavity.grid;
    mask.inside.resize(mask.grid.count());
    for (std::size_t i = 0; i < mask.inside.size(); ++i)
    {
      mask.inside[i] = cavity.voxels->GetComponent(static_cast<vtkIdType>(i), 0) != 0.0 ? 1 : 0;
    }
  }
  return mask;
}

// The nodes that the lattice's mask lets move: only tissue there is compared.
Mask maskOf(const Lattice& lattice)
{
  Mask mask;
  if (lattice.mask)
  {
    const glm::ivec3 nodes = (lattice.grid.dimensions - 1) * lattice.mask->perCell + 1;
    mask.grid = withDimensions(lattice.grid, nodes);
    for (const float weight : lattice.mask->values)
    {
      mask.inside.push_back(weight > 0.0f ? 1 : 0);
    }
  }
  return mask;
}
}

std::string findGrids(vtkImageData* image, RegisteredGrids& grids)
{
  if (!image || !scalarsOf(image))
  {
    return "The volume has no point scalars of one component";
  }
  const ReferenceVolume reference = readReference(image);
  if (!reference.voxels)
  {
    return "The volume carries no reference; Compare Volumes attaches one";
  }
  grids = { gridOf(image), reference.grid };
  if (glm::any(glm::lessThan(grids.rest.dimensions, glm::ivec3(2))) ||
    glm::any(glm::lessThan(grids.reference.dimensions, glm::ivec3(2))))
  {
    return "The volume or its reference has one point along an axis; both must have at least 2";
  }
  return {};
}

std::string readSource(vtkImageData* image, RegisteredSource& source)
{
  if (carriesDeformation(image))
  {
    const Deformation bent = readDeformation(image);
    source.pair.inside = maskOf(bent.lattice);
    source.bent = std::make_unique<const Deformation>(bent);
  }
  const ReferenceVolume reference = readReference(image);
  source.pair.rest = { gridOf(image), floatsOf(scalarsOf(image)) };
  source.pair.reference = { reference.grid, floatsOf(reference.voxels) };
  source.pair.cavity = maskOf(reference.cavity);
  return {};
}
}
