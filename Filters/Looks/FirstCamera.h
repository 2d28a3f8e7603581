// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The first camera of a view, so that tissue fills it, and the points of tissue that it needs: the
/// farthest ones.
///
/// It is here and not with the views because the points are on the server, in parts on its
/// processes.
#ifndef BrainShift_FirstCamera_h
#define BrainShift_FirstCamera_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/glm.hpp>

#include <vector>

namespace brainshift
{
/**
 * Of all positions added, the farthest one in each of many directions, among them the axes. The
 * directions are a Fibonacci lattice: Gonzalez, "Measurement of areas on a sphere using Fibonacci
 * and latitude-longitude lattices", Mathematical Geosciences 42 (2010).
 */
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
    double extent; // mm along the direction
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
 * farthest apart are a little inside two opposite edges of the view.
 *
 * @param tissue      mm, world; at least one: see FarPoints
 * @param aspect      width of the view as a fraction of its height
 * @param viewAngle   of the picture's height, degrees
 */
VTKBRAINSHIFTFILTERS_EXPORT FirstCamera firstCamera(
  const std::vector<glm::dvec3>& tissue, double aspect, double viewAngle);
}

#endif
