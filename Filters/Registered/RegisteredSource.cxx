// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Registered/RegisteredSource.h"

#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Filters/Attached/Segmentation.h"
#include "Filters/Registered/ComparedVoxels.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double PositionTolerance = 1e-3; // voxels
constexpr double ComparedBesideMm = 1.0;   // of the mask

// The voxels that have no number which can be compared.
Mask unknownOf(const Volume& volume)
{
  Mask unknown;
  const auto isUnknown = [](float value) { return !(std::abs(value) <= LargestComparedValue); };
  if (std::any_of(volume.values.begin(), volume.values.end(), isUnknown))
  {
    unknown.grid = volume.grid;
    for (const float value : volume.values)
    {
      unknown.inside.push_back(isUnknown(value) ? 1 : 0);
    }
  }
  return unknown;
}

Volume volumeOf(vtkDataArray* array, const Grid& grid)
{
  Volume volume{ grid, std::vector<float>(array->GetNumberOfTuples()) };
  for (std::size_t i = 0; i < volume.values.size(); ++i)
  {
    volume.values[i] = static_cast<float>(array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  return volume;
}

// The lowest value in place of those that are unknown. It is that outside an ultrasound fan.
void fillUnknown(Volume& volume, const Mask& unknown)
{
  float low = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < unknown.inside.size(); ++i)
  {
    low = unknown.inside[i] ? low : std::min(low, volume.values[i]);
  }
  for (std::size_t i = 0; i < unknown.inside.size(); ++i)
  {
    volume.values[i] = unknown.inside[i] ? low : volume.values[i];
  }
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

void compareMovingTissue(vtkImageData* image, RegisteredPair& pair)
{
  const Segmentation segmentation = readSegmentation(image);
  Mask moving = movingTissue(segmentation);
  if (!moving.inside.empty() && !pair.inside.inside.empty())
  {
    requireHostMemory(
      "Growing a mask of " + sizeText(glm::dvec3(moving.grid.dimensions)) + " voxels",
      MaskGrowthBytes * static_cast<double>(moving.grid.count()));
    growMask(moving, ComparedBesideMm);
    pair.inside = std::move(moving);
  }
}

RegisteredGrids findGrids(vtkImageData* image)
{
  if (!image || !comparedScalars(image))
  {
    throw Problem("The volume has no point scalars of one component");
  }
  const ReferenceVolume reference = readReference(image);
  if (!reference.voxels)
  {
    throw Problem("The volume carries no reference; Compare Volumes attaches one");
  }
  const RegisteredGrids grids{ gridOf(image), reference.grid };
  if (glm::any(glm::lessThan(grids.rest.dimensions, glm::ivec3(2))) ||
    glm::any(glm::lessThan(grids.reference.dimensions, glm::ivec3(2))))
  {
    throw Problem(
      "The volume or its reference has one point along an axis; both must have at least 2");
  }
  return grids;
}

RegisteredSource readSource(vtkImageData* image)
{
  RegisteredSource source;
  if (carriesDeformation(image))
  {
    source.bent = std::make_unique<const Deformation>(readDeformation(image));
    source.pair.inside = maskOf(source.bent->lattice);
  }
  const ReferenceVolume reference = readReference(image);
  source.pair.rest = volumeOf(comparedScalars(image), gridOf(image));
  source.pair.reference = volumeOf(reference.voxels, reference.grid);
  source.pair.cavity = maskOf(reference.cavity);
  source.pair.restUnknown = unknownOf(source.pair.rest);
  source.pair.referenceUnknown = unknownOf(source.pair.reference);
  fillUnknown(source.pair.rest, source.pair.restUnknown);
  fillUnknown(source.pair.reference, source.pair.referenceUnknown);
  return source;
}

namespace
{
// Whether voxels count, and whether they differ.
struct Content
{
  bool hasAny = false;
  bool varies = false;
  float value = 0.0f; // of the first one
};

Content contentOf(const Volume& volume, const Region& region)
{
  Content found;
  const glm::ivec3& sides = volume.grid.dimensions;
  for (std::size_t number = 0; number < volume.values.size() && !found.varies; ++number)
  {
    const float value = volume.values[number];
    if (found.hasAny && value == found.value)
    {
      continue;
    }
    const int row = static_cast<int>(number / sides.x);
    const glm::ivec3 index(static_cast<int>(number % sides.x), row % sides.y, row / sides.y);
    if (counts(region, volume.grid.worldFromGrid(index)))
    {
      found.varies = found.hasAny;
      found.value = found.hasAny ? found.value : value;
      found.hasAny = true;
    }
  }
  return found;
}

// `covered`: the sentence if the region leaves nothing of the volume.
void requireContent(
  const std::string& name, const Volume& volume, const Region& region, const char* covered)
{
  const Mask* unknown = region.outside[1];
  if (unknown && !contentOf(volume, { nullptr, nullptr, { nullptr, unknown } }).hasAny)
  {
    throw Problem("No voxel of " + name + " is a finite number up to " +
      numberText(LargestComparedValue) + ", so there is nothing to compare");
  }
  const Content content = contentOf(volume, region);
  if (!content.hasAny)
  {
    throw Problem(covered);
  }
  if (!content.varies)
  {
    throw Problem("All voxels of " + name + " that count have the value " +
      numberText(content.value) + ", so there is nothing to compare");
  }
}
}

void requireContent(const RegisteredPair& pair)
{
  requireContent("the volume", pair.rest,
    { nullptr, orNull(pair.inside), { nullptr, orNull(pair.restUnknown) } },
    "The mask of the deformation holds all of the volume. Only tissue that may move is compared, "
    "so the mask must leave some");
  requireContent("the reference", pair.reference,
    { nullptr, nullptr, { orNull(pair.cavity), orNull(pair.referenceUnknown) } },
    "The cavity covers all of the reference, so there is nothing to compare. Draw it smaller");
}

void requireRefinable(const Deformation* bent, const Grid& rest)
{
  if (!bent)
  {
    throw Problem("The volume carries no deformation; Free-Form Deformation attaches one");
  }
  if (bent->strength != 1.0)
  {
    throw Problem("Strength is " + numberText(bent->strength) + "; a refinement needs 1");
  }
  if (bent->inverse != Inverse::Exact)
  {
    throw Problem("The deformation has the negated inverse; a refinement needs the exact one");
  }
  const Grid& lattice = bent->lattice.grid;
  const glm::dvec3 first = rest.gridFromWorld(lattice.origin);
  const glm::dvec3 last = rest.gridFromWorld(lattice.worldFromGrid(lattice.dimensions - 1)) -
    glm::dvec3(rest.dimensions - 1);
  const glm::dvec3 tolerance(PositionTolerance);
  if (!glm::all(glm::lessThan(glm::abs(first), tolerance)) ||
    !glm::all(glm::lessThan(glm::abs(last), tolerance)))
  {
    throw Problem(
      "The volume was cropped or resampled after it was bent; a refinement needs all of it");
  }
}
}
