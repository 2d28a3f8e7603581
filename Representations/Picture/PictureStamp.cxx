// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/PictureStamp.h"

#include "Representations/Gpu/Counters.h"
#include "Representations/Scene/OverVolumes.h"
#include "Representations/Scene/RayCastScene.h"

#include "vtkMath.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
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

// Whether the camera's clipping planes leave all of the volume.
bool isUncut(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.frame.clipFromWorld * scene.frame.worldFromTexture;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec4 clip =
      clipFromTexture * glm::dvec4(glm::mix(scene.cuts.spaceLow, scene.cuts.spaceHigh, side), 1.0);
    if (std::abs(clip.z) > clip.w)
    {
      return false;
    }
  }
  return true;
}

// The camera's clipping planes follow everything in the scene, even traced points. They count only
// if they cut the volume.
void addCamera(Numbers& numbers, const RayCastScene& scene)
{
  glm::dmat4 clipFromWorld = scene.frame.clipFromWorld;
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
  add(numbers, scene.frame.worldFromTexture);
  const SceneField& field = scene.field;
  for (int axis = 0; axis < 3; ++axis)
  {
    numbers.insert(
      numbers.end(), { field.latticeFromTexture[axis], field.latticeOfTextureZero[axis] });
  }
  const SceneImage& image = scene.image;
  const SceneLights& lights = scene.frame.lights;
  numbers.insert(numbers.end(),
    { double(field.offsets != nullptr), double(image.size.x), double(image.size.y),
      scene.tissue.stepMm, double(image.skips), double(image.countSamples),
      double(scene.frame.tile), double(lights.headlight) });
  add(numbers, lights.position);
  add(numbers, lights.color);
  add(numbers, lights.specular);
  const SceneComparison& comparison = scene.comparison;
  numbers.push_back(scene.tissue.scalars->GetHandle()); // of the volume or of its reference
  if (comparison.reference)
  {
    add(numbers, comparison.reference->frame.worldFromTexture);
    numbers.push_back(comparison.reference->tissue.scalars->GetHandle());
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
void addProps(Numbers& numbers, const DrawnVolume& drawn, const RayCastScene& scene)
{
  vtkPropCollection* props = drawn.renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
  {
    if (prop == drawn.volume || OverVolumes::SafeDownCast(prop))
    {
      continue;
    }
    // What is nowhere changes often: ParaView's selections, for example.
    const double* bounds = prop->GetVisibility() ? prop->GetBounds() : nullptr;
    const bool seen = bounds && vtkMath::AreBoundsInitialized(bounds);
    numbers.push_back(seen ? static_cast<double>(prop->GetRedrawMTime()) : 0.0);
  }
  add(numbers, scene.cuts.clipPlanes);
  add(numbers, scene.blending.isovalues);
  for (int i = 0; i < 4; ++i)
  {
    numbers.push_back(scene.blending.slicePlane[i]);
  }
}

// A camera's matrix rounds differently when its clipping planes move. Counts and times have far
// fewer than the 12 digits that are compared.
bool same(const Numbers& a, const Numbers& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](double one, double other) { return std::abs(one - other) <= 1e-12 * std::abs(one); });
}
}

PictureStamp::Change PictureStamp::change(const DrawnVolume& drawn, unsigned long long settingsTime,
  const RayCastScene& scene, const Counters& counters)
{
  Numbers now;
  addView(now, scene);
  add(now,
    { counters.volumeUploads, counters.transferUploads, counters.segmentUploads,
      counters.evidenceUploads, scene.evidence.deviations ? 1 : 0 });
  addProps(now, drawn, scene);
  // Not the volume's own time: ParaView poses it for each picture anew.
  now.push_back(static_cast<double>(settingsTime));
  now.push_back(static_cast<double>(drawn.volume->GetProperty()->GetMTime()));
  Numbers bending;
  add(bending,
    { counters.latticeUploads, counters.texelsRefined, counters.presenceUpdates,
      counters.bytesUploaded, static_cast<std::int64_t>(drawn.volume->GetRedrawMTime()) });
  Numbers space;
  for (int axis = 0; axis < 3; ++axis)
  {
    space.insert(space.end(),
      { scene.cuts.spaceLow[axis], scene.cuts.spaceHigh[axis], scene.field.texel[axis] });
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
