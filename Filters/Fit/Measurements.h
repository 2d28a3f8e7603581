// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The measurements and their standard deviations: the input of a fit; and which landmark at rest
/// is which measured one.
///
/// The *rest frame* is the volume as loaded. The *measured frame* is that of the tracker or of the
/// reference. Both are mm.
#ifndef BrainShift_Measurements_h
#define BrainShift_Measurements_h

#include "Common/Problem.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Fit/Process.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace brainshift
{
/**
 * The deformation before a fit: one that a refinement found, or a field of another program. It is
 * the mean of the process. Positions are world mm.
 */
struct FitBase
{
  Lattice lattice;
  PointMap map; ///< of the lattice

  explicit FitBase(Lattice bent)
    : lattice(std::move(bent))
    , map(lattice)
  {
  }

  /** Whether it is the base of such a lattice, with the same mask. */
  bool isOf(const Lattice& other) const
  {
    return this->lattice.grid == other.grid && this->lattice.kernel == other.kernel &&
      this->lattice.mask == other.mask && this->lattice.displacements == other.displacements;
  }

  /** Displacement (mm) of tissue at rest. */
  glm::dvec3 displacement(const glm::dvec3& rest) const
  {
    return this->map.deformedFromRest(rest) - rest;
  }
};

/** A piece of tissue that was found at rest and where it was measured: a landmark, or a pull. */
struct PointPair
{
  glm::dvec3 rest{ 0.0 };     ///< mm, rest frame
  glm::dvec3 measured{ 0.0 }; ///< mm, measured frame
  double weight = 1.0;        ///< divides the variance; 0: the pair is switched off
};

/** A point of a surface. */
struct SurfacePoint
{
  glm::dvec3 position{ 0.0 }; ///< mm, rest frame
  glm::dvec3 normal{ 0.0 };   ///< unit vector that points out of the tissue
};

/**
 * The nearest point of the cortex at rest to a position (mm, rest frame). Nothing if there is no
 * surface. Several threads call it at once.
 *
 * @param trace   number of the traced point. Its next nearest point is close to the last one.
 */
using RestSurface =
  std::function<std::optional<SurfacePoint>(const glm::dvec3& rest, std::size_t trace)>;

/** Each of the lists may be empty. */
struct Measurements
{
  std::vector<PointPair> landmarks;
  std::vector<PointPair> pulls;      ///< tissue that a hand put somewhere
  std::vector<glm::dvec3> pins;      ///< mm, rest frame: tissue that stays
  std::vector<glm::dvec3> traces;    ///< mm, measured frame: points on the bent cortex
  std::vector<SurfacePoint> anchors; ///< cortex that may slide, and that neither sinks nor rises
  /**
   * The deformation before the fit; null: none. Pins and anchors hold the volume where it is then.
   */
  std::shared_ptr<const FitBase> base;
};

/**
 * The uncertainty of measurements. Deviations are standard deviations in mm along each axis.
 *
 * Landmarks alone are near-rigid: the fit takes a rigid motion out of them and bends little. With
 * traces, pulls, pins or a base the volume is assumed to be registered already, and bends much.
 */
struct FitSettings
{
  Matern landmarkKernel{ 40.0, 1.0 };
  double landmarkDeviation = 0.7;    ///< of a landmark of weight 1, when there are landmarks only
  double rotationPriorDegrees = 3.0; ///< standard deviation of a rotation about each axis ...
  std::size_t pairsWithoutPrior = 7; ///< ... which so many pairs that span a plane do not need
  Matern surfaceKernel{ 60.0, 8.0 };
  double surfaceDeviation = 0.7; ///< of a trace, a pull, and a landmark beside them
  double anchorDeviation = 1.0;
  double pinDeviation = 0.1;
  double relaxation = 1.0;             ///< factor on the deviations of what was measured
  std::size_t tracesWithoutBins = 500; ///< more traced points than these are averaged in bins
  double binMm = 6.0;                  ///< edge of a bin
  double binFloorMm = 0.5;             ///< deviation of a bin however many points it averages
  int steps = 5;                       ///< most times that traced points are projected
  double stepToleranceMm = 0.05;       ///< ... fewer if none of them moved by more than this
};

/** Whether a pair counts: its weight is above 0. */
inline bool isOn(const PointPair& pair)
{
  return pair.weight > 0.0;
}

/**
 * Whether the measurements say nothing about a rigid motion: see FitSettings. Pulls that are
 * switched off do not count.
 */
inline bool bendsOnly(const Measurements& measured)
{
  return measured.base || !measured.traces.empty() || !measured.pins.empty() ||
    std::any_of(measured.pulls.begin(), measured.pulls.end(), isOn);
}

/** Throws a Problem on a number that is not finite, a coordinate beyond 1 km, a weight below 0. */
BRAINSHIFT_DEFORMATION_EXPORT void requireGood(const Measurements& measured);

/** Throws a Problem on a setting that is out of its range. */
BRAINSHIFT_DEFORMATION_EXPORT void requireGood(const FitSettings& settings);

/**
 * Pairs of numbers, at rest and measured, in the order at rest, and landmarks without a partner.
 */
struct LandmarkMatch
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<std::string> unmatched; ///< "landmark tip at rest", "measured landmark 4"
  std::vector<std::string> repeated;  ///< names that a list has more than once, if names count
};

/**
 * Matches by name, else by order where neither list has a name. Names that occur several times
 * match in their order. Landmarks without a name match nothing if the others match by name.
 *
 * @param rest, measured   the names, empty where a landmark has none
 * @param byOrder          whether names do not count at all
 *
 * Throws a Problem if a list has names and no name is on both lists, unless a list is empty.
 */
BRAINSHIFT_DEFORMATION_EXPORT LandmarkMatch matchLandmarks(const std::vector<std::string>& rest,
  const std::vector<std::string>& measured, bool byOrder = false);
}

#endif
