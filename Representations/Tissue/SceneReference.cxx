// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/SceneReference.h"

#include "vtkColorTransferFunction.h"
#include "vtkVolumeProperty.h"

namespace brainshift
{
namespace
{
StoredScalar fromRangeToRange(const glm::dvec2& from, const glm::dvec2& to)
{
  const double scale = from.y > from.x && to.y > to.x ? (to.y - to.x) / (from.y - from.x) : 1.0;
  return { scale, to.x - from.x * scale };
}
}

StoredScalar usualMapping(const glm::dvec2& reference, const glm::dvec2& volume)
{
  const double common = std::min(reference.y, volume.y) - std::max(reference.x, volume.x);
  const double both = std::max(reference.y, volume.y) - std::min(reference.x, volume.x);
  return 2.0 * common >= both ? StoredScalar() : fromRangeToRange(reference, volume);
}

StoredScalar valueFromReference(
  const ReferenceVolume& reference, const TissueRequest& own, const glm::dvec2& range)
{
  if (range.x < range.y)
  {
    const double* ends = own.property->GetRGBTransferFunction()->GetRange();
    return fromRangeToRange(range, { ends[0], ends[1] });
  }
  return usualMapping(wholeOf(reference).range, own.range);
}

SceneReference referenceOf(vtkDataObject* volume, const TissueRequest& own, const glm::dvec2& range)
{
  SceneReference reference;
  const ReferenceVolume carried = readReference(volume);
  if (!carried.voxels)
  {
    return reference;
  }
  reference.cavity = carried.cavity;
  reference.show = carried.show;
  reference.tissue = own;
  reference.tissue.segment = {}; // the labels are the volume's
  reference.tissue.values = { carried.voxels, carried.grid,
    layoutOf(carried.grid.dimensions, false) };
  const WholeReference whole = wholeOf(carried);
  reference.tissue.wholePoints = whole.points;
  reference.first = whole.first;
  reference.tissue.labels = carried.isLabels;
  reference.tissue.nearest =
    carried.isLabels || own.property->GetInterpolationType() == VTK_NEAREST_INTERPOLATION;
  reference.tissue.mapped = valueFromReference(carried, own, range);
  return reference;
}

void widenByReference(vtkDataObject* volume, double bounds[6])
{
  const ReferenceVolume reference = readReference(volume);
  for (int corner = 0; corner < 8 && reference.voxels; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world =
      reference.grid.worldFromGrid(side * glm::dvec3(reference.grid.dimensions - 1));
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = std::min(bounds[2 * axis], world[axis]);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], world[axis]);
    }
  }
}

std::int64_t referenceBytes(const SceneReference& reference)
{
  DrawnSizes sizes;
  addTissueSizes(reference.tissue, sizes);
  std::int64_t bytes = memoryNeed(sizes).total();
  if (vtkDataArray* cavity = reference.cavity.voxels)
  {
    bytes +=
      static_cast<std::int64_t>(ScalarTexture::bytesOf(cavity, 0)) * cavity->GetNumberOfTuples();
  }
  return bytes;
}
}
