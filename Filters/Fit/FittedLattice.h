// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A fit as it is drawn: its bend on control points, guarded, and what that leaves of what
 *        was measured.
 */
#ifndef BrainShift_FittedLattice_h
#define BrainShift_FittedLattice_h

#include "Common/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Fit/Fit.h"

#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/** How a fit is put on control points. */
struct LatticeFitChoices
{
  int samples = 4;                ///< nodes between two control points as it is drawn, 0 to 16
  bool guards = true;             ///< false: the bend is taken as it is
  const Process* start = nullptr; ///< a field close to the answer: see Fit::solve
};

class BRAINSHIFT_DEFORMATION_EXPORT FittedLattice
{
public:
  /** Factor on the deviations with which the guard tries again before it shortens the bend. */
  static constexpr double Relaxed = 1.5;

  /**
   * Solves and samples. If the bend folds, it solves once more with deviations that are `Relaxed`
   * times larger, and then takes the largest share of the bend that does not fold. What the base
   * bends is not shortened.
   *
   * @param lattice   where the control points lie, their kernel and mask; displacements are
   *                  ignored. The base's lattice must have the same.
   * @return one sentence without a full stop if it cannot; nothing is then known
   */
  std::string solve(const Measurements& measured, const RestSurface& surface,
    const Lattice& lattice, const LatticeFitChoices& choices);

  /** Whether the last solve succeeded. */
  bool isKnown() const { return this->Map.has_value(); }

  const Fit& fit() const { return this->Result; }
  const Lattice& lattice() const { return this->Bent; }
  double share() const { return this->Share; }           ///< of the bend beyond the base, 0 to 1
  double relaxation() const { return this->Relaxation; } ///< 1 or Relaxed

  /** Where the lattice and then the rigid part take tissue at rest (mm). */
  glm::dvec3 measuredFromRest(const glm::dvec3& rest) const;

  /**
   * Standard deviations (mm) of measuredFromRest along each axis. Where the guard, the mask or the
   * control points keep the lattice away from the fit, that distance counts too: the root of
   * deviation^2 + distance^2 / 3. Infinity if nothing was measured.
   */
  std::vector<double> deviations(const std::vector<glm::dvec3>& rest) const;

  /** deviations() where the process has these variances (Process::variances). */
  std::vector<double> deviations(
    const std::vector<glm::dvec3>& rest, const std::vector<double>& variances) const;

  /** How far (mm) pairs miss their measured ends; NaN for a pair that is switched off. */
  std::vector<double> residuals(const std::vector<PointPair>& pairs) const;

  /** How far (mm) traced points lie outside the cortex that the lattice bends; NaN without it. */
  std::vector<double> traceResiduals(
    const std::vector<glm::dvec3>& traces, const RestSurface& surface) const;

private:
  void countWhatIsAway(const std::vector<glm::dvec3>& rest, std::vector<double>& deviations) const;
  std::string solveWith(double relaxation, const Measurements& measured, const RestSurface& surface,
    const Process* start);

  Fit Result;
  Lattice Start; // the base, or nothing moved
  Lattice Bent;
  std::optional<PointMap> Map;
  double Share = 1.0;
  double Relaxation = 1.0;
};

/**
 * Deviation (mm) along each axis of tissue that was put `distance` (mm) away from where a fit with
 * this deviation has it.
 */
BRAINSHIFT_DEFORMATION_EXPORT double withDistance(double deviation, double distance);

/** Root mean square of the numbers that are finite; NaN if there are none. */
BRAINSHIFT_DEFORMATION_EXPORT double rootMeanSquare(const std::vector<double>& numbers);
}

#endif
