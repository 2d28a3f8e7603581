// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Traced points as rows of a process: each holds the cortex at its distance along the normal and
/// lets it slide.
///
/// The distance to the tangent plane, and not to the nearest point: Chen and Medioni, "Object
/// modelling by registration of multiple range images", Image and Vision Computing 10 (1992).
/// Points are projected anew and the equations linear in the field are solved again: Gauss-Newton
/// steps.
#ifndef BrainShift_TraceRows_h
#define BrainShift_TraceRows_h

#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/** The nearest point of the cortex to a traced point, by the field so far. */
struct TraceFoot
{
  glm::dvec3 tissue{ 0.0 }; ///< mm, rest frame: what base and field put at the traced point
  glm::dvec3 foot{ 0.0 };   ///< mm, rest frame: the nearest point of the cortex to that
  glm::dvec3 normal{ 0.0 }; ///< unit vector out of the bent cortex at the foot
  double value = 0.0;       ///< mm: along the normal, how far the field must take the foot
  bool counts = false;      ///< false: there is no cortex
};

/** Projects traced points on the cortex. It makes one Newton step for `tissue` in each call. */
class BRAINSHIFT_DEFORMATION_EXPORT TraceProjection
{
public:
  /**
   * @param traces    mm, in the frame of the bent volume
   * @param surface   the cortex at rest
   * @param base      bends before the field does; null: nothing does
   */
  TraceProjection(std::vector<glm::dvec3> traces, RestSurface surface,
    std::shared_ptr<const FitBase> base = nullptr);

  /** Projects with a field. Returns the largest distance (mm) that a point moved. */
  double project(const Process& field);

  const std::vector<TraceFoot>& feet() const { return this->Feet; }

private:
  std::vector<glm::dvec3> Traces;
  RestSurface Surface;
  std::shared_ptr<const FitBase> Base;
  std::vector<TraceFoot> Feet;
};

/** Which traced points are averaged into one row. */
class BRAINSHIFT_DEFORMATION_EXPORT TraceBins
{
public:
  /** One bin for each point if they are few; else cubes. `deviation`: mm, of one point. */
  TraceBins(const std::vector<glm::dvec3>& traces, const FitSettings& settings, double deviation);

  /** A row for each bin with a point that counts. */
  std::vector<Row> rows(const std::vector<TraceFoot>& feet) const;

private:
  std::vector<std::vector<std::size_t>> Members;
  double Variance; // mm^2, of one point
  double Floor;    // mm^2, of a bin
};
}

#endif
