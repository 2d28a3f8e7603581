// SPDX-License-Identifier: BSD-3-Clause
// What the ray caster needs to draw a bent volume and a reference in one picture.
#ifndef BrainShift_RayCastComparison_h
#define BrainShift_RayCastComparison_h

#include "Representations/Tissue/PlacedReference.h"

#include <glm/vec3.hpp>

class vtkVolume;
class vtkVolumeMapper;

namespace brainshift
{
struct RayCastScene;

struct RayCastComparison
{
  RayCastScene* reference = nullptr; // as if drawn alone; null: nothing to compare with
  double agreementMm = 1.0;          // surfaces half as far apart count as one
  glm::dvec3 cropLow{ -1e6 };        // what cropping leaves of it, the bent volume's texture
  glm::dvec3 cropHigh{ 1e6 };        // coordinates
  PlacedCavity cavity;               // what colours ignore
};

// What reference.glsl, layers.glsl and skipping.glsl need for a scene with a reference.
void setComparisonUniforms(Program& program, const RayCastScene& scene);

// Cuts a scene that is drawn in place of a mapper's volume as the mapper crops that one, by planes.
// False where that takes more than planes: regions other than the middle one.
bool cropByPlanes(vtkVolumeMapper* mapper, vtkVolume* volume, const Grid& grid,
  const ValueLayout& layout, RayCastScene& scene);

// As placeShownPixels (SceneGeometry.h), of the scene's tissue and its reference, if any, together.
void placeComparedPixels(RayCastScene& scene);
}

#endif
