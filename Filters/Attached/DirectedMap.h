// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief One of the two maps of a deformable volume, for filters that have a Direction.
 */
#ifndef BrainShift_DirectedMap_h
#define BrainShift_DirectedMap_h

#include "Common/FieldDirection.h"
#include "Filters/Deformation/PointMap.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <utility>

class vtkDataObject;

namespace brainshift
{
/** A map in one direction. Positions are mm along world axes. */
class VTKBRAINSHIFTFILTERS_EXPORT DirectedMap
{
public:
  /** `inverse`: how the map was made to find tissue; it decides the backward derivatives. */
  DirectedMap(PointMap map, Inverse inverse, Direction direction)
    : Map(std::move(map)) // a lattice can be large
    , Backward(inverse)
    , Towards(direction)
  {
  }

  /** Where the map takes a position. A position that is not finite stays as it is. */
  glm::dvec3 position(const glm::dvec3& from) const;

  /**
   * Derivatives of the map at `from`, which it takes to `to`: column a is d(to) / d(from_a). They
   * are not finite where a backward map meets tissue whose volume the deformation makes zero.
   */
  glm::dmat3 jacobian(const glm::dvec3& from, const glm::dvec3& to) const;

private:
  PointMap Map;
  Inverse Backward;
  Direction Towards;
};

/**
 * The normal of a surface after a map with these derivatives. It is perpendicular to the mapped
 * surface and as long as it was. If the map leaves no direction for it, the normal stays.
 */
VTKBRAINSHIFTFILTERS_EXPORT glm::dvec3 turnedNormal(
  const glm::dmat3& jacobian, const glm::dvec3& normal);

/** The map of a deformable volume. Throws a Problem if the data is none. */
VTKBRAINSHIFTFILTERS_EXPORT DirectedMap directedMapOf(vtkDataObject* volume, Direction direction);
}

#endif
