// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/TissueFacts.h"

#include "Filters/Attached/ReferenceVolume.h"
#include "Filters/Attached/Segmentation.h"
#include "Representations/Field/SceneDeformation.h"

#include "vtkImageData.h"

#include <cmath>

namespace brainshift
{
namespace
{
glm::dvec3 textureAt(const Grid& grid, const ValueLayout& layout, const glm::dvec3& place)
{
  return grid.gridFromWorld(place) * layout.textureFromGrid + layout.textureOfGridZero;
}

std::optional<double> numberAt(
  vtkDataArray* numbers, const Grid& grid, const ValueLayout& layout, const glm::dvec3& place)
{
  if (!numbers || numbers->GetNumberOfComponents() != 1)
  {
    return {};
  }
  // A voxel is the box around its value. A ray meets the face of the volume a little before it.
  const glm::dvec3 halfVoxel = 0.5 / glm::dvec3(layout.dimensions);
  const std::optional<long long> index =
    nearestValue(layout, textureAt(grid, layout, place), halfVoxel);
  const double number = index ? numbers->GetComponent(*index, 0) : std::nan("");
  return std::isnan(number) ? std::nullopt : std::optional<double>(number);
}

std::optional<double> numberAt(vtkDataArray* numbers, const Grid& grid, const glm::dvec3& place)
{
  return numberAt(numbers, grid, layoutOf(grid.dimensions, /*cells*/ false), place);
}
}

TissueFacts factsAt(vtkImageData* image, const DrawnValues& values, SceneDeformation& deformation,
  const glm::dvec3& deformedMm, const FinerNumber& finerAt)
{
  TissueFacts facts;
  facts.axes = worldAxesOf(image);
  facts.deformed = facts.rest = deformedMm;
  const ReferenceVolume reference = readReference(image);
  if (reference.show != ReferenceShow::Deformed)
  {
    facts.reference = numberAt(reference.voxels, reference.grid, deformedMm);
  }
  if (reference.voxels && reference.show == ReferenceShow::Reference)
  {
    return facts;
  }
  if (deformation.deformed)
  {
    facts.bent = true;
    facts.rest = deformation.map().restFromDeformed(deformedMm);
    facts.volumeRatio = glm::determinant(deformation.map().jacobian(facts.rest));
    if (!deformation.deviations.empty())
    {
      facts.deviation = deviationAt(deformation.lattice.grid, deformation.deviations, facts.rest);
    }
  }
  facts.value = numberAt(values.scalars, values.grid, values.layout, facts.rest);
  if (facts.value)
  {
    const std::optional<double> finer = finerAt(textureAt(values.grid, values.layout, facts.rest));
    facts.value = finer ? finer : facts.value;
  }
  const std::string own = facts.value ? labelName(image, *facts.value) : std::string();
  if (!own.empty() && facts.value.value_or(0.0) != 0.0)
  {
    facts.label = facts.value;
    facts.labelName = own;
    return facts;
  }
  const Segmentation segmentation = readSegmentation(image);
  facts.label = numberAt(segmentation.labels, segmentation.grid, facts.rest);
  facts.labelName =
    facts.label ? labelName(image, *facts.label, SegmentationLabels) : std::string();
  if (!own.empty() && (!facts.label || *facts.label == 0.0)) // 0 is what is no tissue
  {
    facts.label = facts.value;
    facts.labelName = own;
  }
  return facts;
}

glm::dvec3 sameTissue(SceneDeformation& deformation, const glm::dvec3& place, bool toRest)
{
  if (!deformation.deformed)
  {
    return place;
  }
  const PointMap& map = deformation.map();
  return toRest ? map.restFromDeformed(place) : map.deformedFromRest(place);
}
}
