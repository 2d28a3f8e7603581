// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/PictureStamp.h"

#include "Representations/Gpu/Counters.h"
#include "Representations/Picture/RayCaster.h"
#include "Representations/Traces/TracePoints.h"

#include "vtkMath.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h" // for the scene's pointers
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <glm/common.hpp>
#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>

namespace brainshift
{
namespace
{
using Numbers = std::vector<double>;

template <typename Value>
void add(Numbers& numbers, const std::vector<Value>& values)
{
  numbers.push_back(static_cast<double>(values.size()));
  numbers.insert(numbers.end(), values.begin(), values.end());
}

void add(Numbers& numbers, const glm::dmat4& matrix)
{
  numbers.insert(numbers.end(), &matrix[0][0], &matrix[0][0] + 16);
}

// Whether the clipping planes leave all of the volume.
bool isUncut(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.clipFromWorld * scene.worldFromTexture;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec4 clip =
      clipFromTexture * glm::dvec4(glm::mix(scene.spaceLow, scene.spaceHigh, side), 1.0);
    if (std::abs(clip.z) > clip.w)
    {
      return false;
    }
  }
  return true;
}

// Clipping planes follow everything in the scene, traced points too; they count if they cut.
void addCamera(Numbers& numbers, const RayCastScene& scene)
{
  glm::dmat4 clipFromWorld = scene.clipFromWorld;
  if (isUncut(scene))
  {
    clipFromWorld = glm::row(clipFromWorld, 2, glm::dvec4(0.0));
  }
  add(numbers, clipFromWorld);
}

// Where the picture is seen from, and in what light.
void addView(Numbers& numbers, const RayCastScene& scene)
{
  addCamera(numbers, scene);
  add(numbers, scene.worldFromTexture);
  for (int axis = 0; axis < 3; ++axis)
  {
    numbers.insert(
      numbers.end(), { scene.latticeFromTexture[axis], scene.latticeOfTextureZero[axis] });
  }
  numbers.insert(numbers.end(),
    { double(scene.offsets != nullptr), double(scene.size.x), double(scene.size.y), scene.stepMm,
      double(scene.skipping), double(scene.countSamples), double(scene.tile),
      double(scene.lights.headlight) });
  add(numbers, scene.lights.position);
  add(numbers, scene.lights.color);
  add(numbers, scene.lights.specular);
  const RayCastComparison& comparison = scene.comparison;
  numbers.push_back(scene.scalars->GetHandle()); // of the volume or of its reference
  if (comparison.reference)
  {
    add(numbers, comparison.reference->worldFromTexture);
    numbers.push_back(comparison.reference->scalars->GetHandle());
    numbers.push_back(comparison.cavity.voxels ? comparison.cavity.voxels->GetHandle() : 0);
    add(numbers, comparison.cavity.cavityFromTexture);
  }
}

void add(Numbers& numbers, std::initializer_list<std::int64_t> counts)
{
  for (const std::int64_t count : counts)
  {
    numbers.push_back(static_cast<double>(count));
  }
}

// The volume as the user chose it, and everything else in the scene.
void addProps(Numbers& numbers, vtkRenderer* renderer, vtkVolume* volume, const RayCastScene& scene)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
  {
    if (prop == volume || TracePoints::SafeDownCast(prop)) // drawn over the volumes
    {
      continue;
    }
    // What is nowhere changes often: ParaView's selections, for example.
    const double* bounds = prop->GetVisibility() ? prop->GetBounds() : nullptr;
    const bool seen = bounds && vtkMath::AreBoundsInitialized(bounds);
    numbers.push_back(seen ? static_cast<double>(prop->GetRedrawMTime()) : 0.0);
  }
  add(numbers, scene.options.clipPlanes);
  add(numbers, scene.options.isovalues);
  for (int i = 0; i < 4; ++i)
  {
    numbers.push_back(scene.options.slicePlane[i]);
  }
}
}

namespace
{
// A camera's matrix is rounded otherwise when its clipping planes move; counts and times are far
// below the 12 digits that are compared.
bool same(const Numbers& a, const Numbers& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](double one, double other) { return std::abs(one - other) <= 1e-12 * std::abs(one); });
}
}

PictureStamp::Change PictureStamp::change(vtkRenderer* renderer, vtkVolume* volume,
  unsigned long long settingsTime, const RayCastScene& scene, const Counters& counters)
{
  Numbers now;
  addView(now, scene);
  add(now, { counters.volumeUploads, counters.transferUploads, counters.segmentUploads });
  addProps(now, renderer, volume, scene);
  // Not the volume's own time: ParaView poses it for each picture anew.
  now.push_back(static_cast<double>(settingsTime));
  now.push_back(static_cast<double>(volume->GetProperty()->GetMTime()));
  Numbers bending;
  add(bending,
    { counters.latticeUploads, counters.texelsRefined, counters.presenceUpdates,
      counters.bytesUploaded, static_cast<std::int64_t>(volume->GetRedrawMTime()) });
  Numbers space;
  for (int axis = 0; axis < 3; ++axis)
  {
    space.insert(
      space.end(), { scene.spaceLow[axis], scene.spaceHigh[axis], scene.fieldTexel[axis] });
  }
  const bool sameView = same(now, this->Last);
  const bool sameSpace = space == this->LastSpace;
  const bool sameBending = bending == this->LastBending;
  this->Last = std::move(now);
  this->LastSpace = std::move(space);
  this->LastBending = std::move(bending);
  return !sameView ? Anything : !sameSpace ? Reaching : sameBending ? Nothing : Bending;
}
}
