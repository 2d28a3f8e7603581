// SPDX-License-Identifier: BSD-3-Clause
// One edit of the deformation, as data: design section "one truth for edits".
#ifndef BrainShift_Stroke_h
#define BrainShift_Stroke_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace brainshift
{
enum class Tool
{
  Move = 0,  // one control point: the nearest to the anchor in the rest frame
  Soft = 1,  // all within a sphere around the anchor, measured in the deformed frame
  Stamp = 2, // all within an ellipsoid of revolution, in the deformed frame (paper, section 2)
};

// A stroke is 14 numbers:
// tool, anchor xyz, vector xyz, axis xyz, major, minor, sigma, enabled (1 or 0).
struct Stroke
{
  Tool tool = Tool::Move;
  glm::dvec3 anchor{ 0.0 }; // mm, world: where the user took hold
  glm::dvec3 vector{ 0.0 }; // mm, world axes: how far full weight moves
  glm::dvec3 axis{ 0.0 };   // Stamp: direction of the long axis, any length above 0.
                            // Move: lattice spacing (mm) along each lattice axis, or 0 0 0
  double major = 0.0;       // mm. Stamp: half the long axis. Soft: radius. Move: spacing of the
                            // lattice the stroke was made at; 0: that of the lattice it meets
  double minor = 0.0;       // mm. Stamp: radius across the long axis. Others: unused
  double sigma = 0.5;       // width of the Gaussian, as a share of the radius. Move: unused
  bool enabled = true;

  VTKBRAINSHIFTFILTERS_EXPORT bool operator==(const Stroke& other) const;
  bool operator!=(const Stroke& other) const { return !(*this == other); }
};

constexpr int NumbersPerStroke = 14;

// Reads strokes from their flat list of numbers. On bad input returns no strokes and writes one
// sentence to `error` that names the number, its value and its limit; `error` is empty otherwise.
VTKBRAINSHIFTFILTERS_EXPORT std::vector<Stroke> strokesFromNumbers(
  const std::vector<double>& numbers, std::string& error);

VTKBRAINSHIFTFILTERS_EXPORT std::vector<double> numbersFromStrokes(
  const std::vector<Stroke>& strokes);

// Weight, 0 to 1, at a distance from the anchor given as a share of the radius: a Gaussian of width
// `sigma` that falls smoothly (value and slope) to 0 at distance 1.
VTKBRAINSHIFTFILTERS_EXPORT double falloff(double distance, double sigma);

// Distance from the anchor as a share of the radius: 1 on the sphere of a Soft stroke or on the
// ellipsoid of a Stamp. `position`: mm, deformed frame. Not meant for Move.
VTKBRAINSHIFTFILTERS_EXPORT double normalisedDistance(
  const Stroke& stroke, const glm::dvec3& position);
}

#endif
