// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Where a camera stands at first, so that tissue fills the view.
 */
#ifndef BrainShift_FirstCamera_h
#define BrainShift_FirstCamera_h

#include "Filters/Looks/Intensities.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

namespace brainshift
{
/** A camera, mm, world. */
struct FirstCamera
{
  glm::dvec3 position{ 0.0 };
  glm::dvec3 focalPoint{ 0.0 };
  glm::dvec3 up{ 0.0, 0.0, 1.0 };
  double parallelScale = 1.0; ///< mm: half the height of the picture at the focal point
};

/**
 * Looks at the tissue in a box from the patient's right, front and above.
 *
 * @param box         mm, world; it must be valid
 * @param aspect      width of the view as a share of its height
 * @param viewAngle   of the picture's height, degrees
 */
VTKBRAINSHIFTFILTERS_EXPORT FirstCamera firstCamera(
  const Box& box, double aspect, double viewAngle);
}

#endif
