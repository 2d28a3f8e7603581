// SPDX-License-Identifier: BSD-3-Clause
#include "PictureStamp.h"

#include "Counters.h"
#include "RayCaster.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h" // for the scene's pointers
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

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

// Where the picture is seen from, and in what light.
void addView(Numbers& numbers, const RayCastScene& scene)
{
  add(numbers, scene.clipFromWorld);
  add(numbers, scene.worldFromTexture);
  numbers.insert(numbers.end(),
    { double(scene.size.x), double(scene.size.y), scene.stepMm, double(scene.skipping),
      double(scene.countSamples), double(scene.tile), double(scene.lights.headlight) });
  add(numbers, scene.lights.position);
  add(numbers, scene.lights.color);
  add(numbers, scene.lights.specular);
  const RayCastComparison& comparison = scene.comparison;
  numbers.push_back(scene.scalars->GetHandle()); // of the volume or of its reference
  if (comparison.reference)
  {
    add(numbers, comparison.reference->worldFromTexture);
    numbers.push_back(comparison.reference->scalars->GetHandle());
    numbers.push_back(comparison.cavity ? comparison.cavity->GetHandle() : 0);
    add(numbers, comparison.cavityFromTexture);
  }
}

// What was uploaded or made anew since the last picture.
void addUploads(Numbers& numbers, const Counters& counters)
{
  for (const auto count :
    { counters.volumeUploads, counters.latticeUploads, counters.transferUploads,
      counters.texelsRefined, counters.presenceUpdates, counters.bytesUploaded })
  {
    numbers.push_back(static_cast<double>(count));
  }
}

// The volume as the user chose it, and everything else in the scene.
void addProps(Numbers& numbers, vtkRenderer* renderer, const RayCastScene& scene)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
  {
    numbers.push_back(prop->GetVisibility());
    numbers.push_back(static_cast<double>(prop->GetRedrawMTime()));
  }
  add(numbers, scene.options.clipPlanes);
  add(numbers, scene.options.isovalues);
  for (int i = 0; i < 4; ++i)
  {
    numbers.push_back(scene.options.slicePlane[i]);
  }
}
}

bool PictureStamp::repeats(
  vtkRenderer* renderer, vtkVolume* volume, const RayCastScene& scene, const Counters& counters)
{
  Numbers now;
  addView(now, scene);
  addUploads(now, counters);
  addProps(now, renderer, scene);
  // Not the volume's own time: ParaView poses it for each picture anew.
  now.push_back(static_cast<double>(volume->GetMapper()->GetMTime()));
  now.push_back(static_cast<double>(volume->GetProperty()->GetMTime()));
  const bool same = now == this->Last;
  this->Last = std::move(now);
  return same;
}
}
