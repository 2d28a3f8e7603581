// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the rigid motion and the bend of the volume from measurements, and their uncertainty.
///
/// measuredFromRest is the bend, then a rigid motion. The bend is that of the base, and a field on
/// top of it. All measurements are solved together, so their order does not matter.
#ifndef BrainShift_Fit_h
#define BrainShift_Fit_h

#include "Filters/Fit/Measurements.h"
#include "Filters/Fit/OpenRotation.h"
#include "Filters/Fit/RigidPose.h"

namespace brainshift
{
/**
 * A ball with this many deviations as its radius holds 95 % of a normal distribution in space: the
 * root of the quantile of the chi-squared distribution with three degrees of freedom.
 */
constexpr double DeviationsOfBall95 = 2.7954834829151074;

class BRAINSHIFT_DEFORMATION_EXPORT Fit
{
public:
  Fit();

  /**
   * Solves. Without any measurement the volume stays as it is.
   *
   * @param surface   the cortex at rest; without it traces do not count
   * @param start     a field close to the answer, say that of a moment ago. Traced points are then
   *                  projected with it, and the equations are solved once. This is for a hand that
   *                  moves: the result depends a little on the start.
   *
   * Throws a Problem if it cannot; the last result is then void.
   */
  void solve(const Measurements& measured, const FitSettings& settings,
    const RestSurface& surface = {}, const Process* start = nullptr);

  /** The rigid part: measured from rest. The identity if the volume only bends. */
  const RigidPose& rigid() const { return this->Rigid; }

  /** Whether the pairs are too few, or too near to a line, to find any rotation: FitSettings. */
  bool isRotationExpectedSmall() const { return this->ExpectsSmallRotation; }

  /** Displacement (mm) of tissue at a rest position before the rigid part moves it. */
  glm::dvec3 bend(const glm::dvec3& rest) const
  {
    return this->Field.displacement(rest) +
      (this->Base ? this->Base->displacement(rest) : glm::dvec3(0.0));
  }

  /** bend() of many positions, on all cores. */
  std::vector<glm::dvec3> bends(const std::vector<glm::dvec3>& rest) const;

  /** Where tissue at rest was or would be measured (mm): rigid part and bend. */
  glm::dvec3 measuredFromRest(const glm::dvec3& rest) const
  {
    return this->Rigid.apply(rest + this->bend(rest));
  }

  /**
   * Standard deviation (mm) of measuredFromRest along each axis, as calibrated by leaving pairs
   * out. Infinity if nothing was measured. It is that of the position of the tissue: a ball with
   * the radius DeviationsOfBall95 times it holds the tissue with 95 %. The measured position also
   * has the error of a measurement: there the radius is DeviationsOfBall95 times the root of
   * deviation^2 + (landmarkDeviation * calibration)^2. A rotation that the landmarks leave open
   * widens it (OpenRotation).
   */
  double deviation(const glm::dvec3& rest) const;

  /** deviation() of many positions, on all cores. */
  std::vector<double> deviations(const std::vector<glm::dvec3>& rest) const;

  /** deviation() where the process has this variance (Process::variances). */
  double deviationOf(double variance, const glm::dvec3& rest) const;

  /**
   * For each landmark its leave-one-out error: the distance (mm) between the measured landmark and
   * its prediction by a fit without it, in closed form. NaN for a landmark that is switched off,
   * and for one that the others do not determine: its deviation without it is beyond 100 mm.
   */
  const std::vector<double>& leaveOneOut() const { return this->LeaveOneOut; }

  /** Factor on deviations that makes them agree with the leave-one-out errors. */
  double calibration() const { return this->Calibration; }

  /** Number of projections of the traced points. */
  int steps() const { return this->Steps; }

  /** The field that bends on top of the base. */
  const Process& field() const { return this->Field; }

private:
  void solveRigid(const Measurements& measured, const FitSettings& settings);
  void solveBend(const Measurements& measured, const FitSettings& settings,
    const RestSurface& surface, const Process* start);
  void judge(const Measurements& measured);

  Process Field;
  std::shared_ptr<const FitBase> Base;
  RigidPose Rigid;
  OpenRotation Open;
  std::vector<std::optional<std::size_t>> LandmarkRows; // the first of the three
  std::vector<std::optional<std::size_t>> PullRows;
  std::vector<double> LeaveOneOut;
  double Calibration = 1.0;
  int Steps = 0;
  bool ExpectsSmallRotation = false;
};
}

#endif
