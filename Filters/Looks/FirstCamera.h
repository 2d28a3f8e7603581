// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Where a camera stands at first, so that tissue fills the view.
 */
#ifndef BrainShift_FirstCamera_h
#define BrainShift_FirstCamera_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
/** Of all positions added, the farthest one in each of many directions, among them the axes. */
class FarPoints
{
public:
  FarPoints();

  /** A position, mm, world. */
  void add(const glm::dvec3& world);

  /** mm, world; empty if no process added any. All processes must call it and get the same. */
  std::vector<glm::dvec3> ofAllProcesses() const;

private:
  struct Farthest
  {
    double reach; // mm along the direction
    glm::dvec3 point{ 0.0 };
  };

  std::vector<glm::dvec3> Directions; // of unit length
  std::vector<Farthest> Found;        // for each direction
};

/** A camera, mm, world. */
struct FirstCamera
{
  glm::dvec3 position{ 0.0 };
  glm::dvec3 focalPoint{ 0.0 };
  glm::dvec3 up{ 0.0, 0.0, 1.0 };
  double parallelScale = 1.0; ///< mm: half the height of the picture at the focal point
};

/**
 * Looks at tissue from the patient's right, front and above. All its points are seen; those
 * farthest apart stand a little inside two opposite edges of the view.
 *
 * @param tissue      mm, world; at least one: see FarPoints
 * @param aspect      width of the view as a share of its height
 * @param viewAngle   of the picture's height, degrees
 */
VTKBRAINSHIFTFILTERS_EXPORT FirstCamera firstCamera(
  const std::vector<glm::dvec3>& tissue, double aspect, double viewAngle);
}

#endif
