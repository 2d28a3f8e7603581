// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A stroke: one edit of the deformation, as data.
///
/// The list of strokes is the only record of what a user did. A lattice follows from it.
#ifndef BrainShift_Stroke_h
#define BrainShift_Stroke_h

#include "Common/Export.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace brainshift
{
/** The tools. A stroke holds the number of the tool that made it. */
enum class Tool
{
  None = -1, ///< no tool
  Move = 0,
  Soft = 1,
  Stamp = 2,
  Pull = 3,
};

/** Which control points the strokes of a tool move. */
enum class StrokeShape
{
  None,   ///< the tool makes no strokes
  Point,  ///< the one nearest to the anchor, measured in the rest frame
  Sphere, ///< all within a sphere around the anchor, measured in the deformed frame
  /**
   * All within an ellipsoid of revolution around the anchor, measured in the deformed frame. The
   * strokes go along its long axis.
   * Source: van der Steen et al., SPIE 7169 (2009), section 2.
   */
  Ellipsoid,
};

/** The part of a tool that strokes need. Interaction/Commands/Tools.h has the rest. */
struct ToolTraits
{
  Tool tool;
  const char* name; ///< as the user reads it, before translation
  StrokeShape shape;
};

/** All tools, in the order of their buttons. */
constexpr std::array KnownTools{
  ToolTraits{ Tool::Move, "Move", StrokeShape::Point },
  ToolTraits{ Tool::Soft, "Soft", StrokeShape::Sphere },
  ToolTraits{ Tool::Stamp, "Stamp", StrokeShape::Ellipsoid },
  ToolTraits{ Tool::Pull, "Pull", StrokeShape::None },
};

/** The traits of a tool; those of no tool have an empty name. */
constexpr ToolTraits traitsOf(Tool tool)
{
  for (const ToolTraits& traits : KnownTools)
  {
    if (traits.tool == tool)
    {
      return traits;
    }
  }
  return { Tool::None, "", StrokeShape::None };
}

constexpr StrokeShape shapeOf(Tool tool)
{
  return traitsOf(tool).shape;
}

/**
 * One edit. As a list of 14 numbers: tool, anchor xyz, vector xyz, axis xyz, major, minor, sigma,
 * enabled (1 or 0).
 */
struct Stroke
{
  Tool tool = Tool::Move;
  glm::dvec3 anchor{ 0.0 }; ///< mm, world: where the user took hold
  glm::dvec3 vector{ 0.0 }; ///< mm, world axes: displacement where the weight is 1

  /**
   * Ellipsoid: direction of the long axis, of any length above 0. Point: spacing (mm) of the
   * lattice the stroke was made at, along each lattice axis; 0 0 0 leaves it to `major`. Sphere:
   * unused.
   */
  glm::dvec3 axis{ 0.0 };

  /**
   * mm. Ellipsoid: half the length of the long axis. Sphere: radius. Point: spacing of the lattice
   * the stroke was made at, if `axis` does not give it; 0: the spacing of the lattice it is applied
   * to.
   */
  double major = 0.0;

  double minor = 0.0;  ///< mm. Ellipsoid: radius across the long axis. Others: unused
  double sigma = 0.5;  ///< width of the Gaussian, as a fraction of the radius. Point: unused
  bool enabled = true; ///< false: the stroke is kept but moves nothing

  /** Whether all 14 numbers are equal. */
  BRAINSHIFT_DEFORMATION_EXPORT bool operator==(const Stroke& other) const;
  bool operator!=(const Stroke& other) const { return !(*this == other); }
};

/** Length of a stroke as a list of numbers. */
constexpr int NumbersPerStroke = 14;

/** Each number of a stroke lies between this and its negative. */
constexpr double LargestStrokeNumber = 1e9;

/** Least sigma: half the weight is lost at a thousandth of the radius. A Point has none. */
constexpr double SmallestSigma = 0.001;

/**
 * Reads strokes from their list of numbers. Throws a Problem that names the stroke, the number, its
 * value and its limit if a number is bad.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<Stroke> strokesFromNumbers(
  const std::vector<double>& numbers);

/** The strokes as a list of numbers, 14 for each. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<double> numbersFromStrokes(
  const std::vector<Stroke>& strokes);

/**
 * Weight, 0 to 1, at a distance d from the anchor: a Gaussian times (1 - d^2)^2, so that value and
 * slope are 0 at d = 1. The factor is Tukey's biweight: Beaton and Tukey, Technometrics 16 (1974).
 *
 * @param distance   as a fraction of the radius
 * @param sigma      width of the Gaussian, as a fraction of the radius
 */
BRAINSHIFT_DEFORMATION_EXPORT double falloff(double distance, double sigma);

/**
 * Distance from the anchor as a fraction of the radius: 1 on the sphere or on the ellipsoid of a
 * stroke. It has no meaning for a Point.
 *
 * @param position   mm, deformed frame
 */
BRAINSHIFT_DEFORMATION_EXPORT double normalisedDistance(
  const Stroke& stroke, const glm::dvec3& position);
}

#endif
