// SPDX-License-Identifier: BSD-3-Clause
// One of the two maps of a deformable volume, for filters that take a direction.
#ifndef BrainShift_DirectedMap_h
#define BrainShift_DirectedMap_h

#include "Filters/Deformation/PointMap.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <utility>

class vtkDataObject;

namespace brainshift
{
enum class Direction
{
  Forward = 0,  // deformedFromRest: where tissue goes
  Backward = 1, // restFromDeformed: which tissue is seen
};

class VTKBRAINSHIFTFILTERS_EXPORT DirectedMap
{
public:
  DirectedMap(PointMap map, Inverse inverse, Direction direction)
    : Map(std::move(map)) // a lattice can be large
    , Backward(inverse)
    , Towards(direction)
  {
  }

  // Position in the frame the map leads to, of one in the frame it starts from. mm, world. A
  // position that is not finite stays.
  glm::dvec3 position(const glm::dvec3& from) const;

  // Derivatives of the map at `from`, whose position is `to`: column a is d(to)/d(from_a). Not
  // finite where a backward map meets tissue that is pressed to nothing.
  glm::dmat3 jacobian(const glm::dvec3& from, const glm::dvec3& to) const;

private:
  PointMap Map;
  Inverse Backward;
  Direction Towards;
};

// What a surface's normal becomes under a map with these derivatives: across the mapped surface,
// as long as it was. A normal that the map leaves without direction stays.
VTKBRAINSHIFTFILTERS_EXPORT glm::dvec3 turnedNormal(
  const glm::dmat3& jacobian, const glm::dvec3& normal);

// The map of a filter's deformation input; none, with one sentence in `problem`, if the input is
// no deformable volume.
VTKBRAINSHIFTFILTERS_EXPORT std::optional<DirectedMap> directedMapOf(
  vtkDataObject* volume, Direction direction, std::string& problem);
}

#endif
