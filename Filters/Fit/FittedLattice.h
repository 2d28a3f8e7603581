// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A fit as it is drawn: its bend on control points, guarded against folds; the residuals that this
/// leaves; and the uncertainty at the control points.
#ifndef BrainShift_FittedLattice_h
#define BrainShift_FittedLattice_h

#include "Filters/Fit/Fit.h"

namespace brainshift
{
/**
 * Adds to the displacements so that the cubic between the control points gains the field's values
 * at them. With Catmull-Rom these are the values themselves; a B-spline takes coefficients.
 */
BRAINSHIFT_DEFORMATION_EXPORT void addField(Lattice& lattice, const Process& field);

/**
 * The largest fraction, 0 to 1, of the path from one lattice to another that keeps the Jacobian
 * determinant at 0.1 or above (FoldGuard.h). Cells that fold at the start are left alone.
 *
 * @param samples   nodes between two control points that the lattice is drawn with, 0 to 16
 */
BRAINSHIFT_DEFORMATION_EXPORT double fractionWithoutFolds(
  const Lattice& start, const Lattice& end, int samples);

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
   * times larger, and then takes the largest fraction of the bend that does not fold. The base is
   * not shortened. Throws a Problem if it cannot; nothing is then known.
   *
   * @param lattice   where the control points lie, their kernel and mask; displacements are
   *                  ignored. The base's lattice must have the same.
   */
  void solve(const Measurements& measured, const RestSurface& surface, const Lattice& lattice,
    const LatticeFitChoices& choices);

  /** Whether the last solve succeeded. */
  bool isKnown() const { return this->Map.has_value(); }

  const Fit& fit() const { return this->Result; }
  const Lattice& lattice() const { return this->Bent; }
  double fraction() const
  {
    return this->Fraction;
  } ///< fraction of the bend beyond the base, 0 to 1
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
  void solveWith(double relaxation, const Measurements& measured, const RestSurface& surface,
    const Process* start);

  Fit Result;
  Lattice Start; // the base, or nothing moved
  Lattice Bent;
  std::optional<PointMap> Map;
  double Fraction = 1.0;
  double Relaxation = 1.0;
};

/**
 * Deviation (mm) along each axis of tissue that was put `distance` (mm) away from where a fit with
 * this deviation has it.
 */
BRAINSHIFT_DEFORMATION_EXPORT double withDistance(double deviation, double distance);

/** Root mean square of the numbers that are finite; NaN if there are none. */
BRAINSHIFT_DEFORMATION_EXPORT double rootMeanSquare(const std::vector<double>& numbers);

/** Most control points for which the uncertainty is found: 65 a side. */
constexpr std::size_t MostEvidencePoints = 275000;

/**
 * The uncertainty of a fit at each control point of its lattice. The variances depend on where
 * something was measured and not on what was measured. They are kept and found anew only if a
 * position or a weight changes: a pull that is dragged costs nothing.
 */
class BRAINSHIFT_DEFORMATION_EXPORT LatticeEvidence
{
public:
  /**
   * FittedLattice::deviations (mm) at the control points, x fastest, to the rounding of float.
   * Throws a Problem if there are too many control points.
   */
  std::vector<float> deviations(const FittedLattice& fitted);

  /**
   * While a hand moves what was measured, variances of a moment ago are good enough: it moves
   * traced points by little, and a position that is added makes them smaller. Default: off.
   */
  void setLive(bool on) { this->Live = on; }

  /** How often variances were found. */
  int solutions() const { return this->Solutions; }

private:
  Grid Points;
  std::vector<double> Key; // Process::covarianceKey
  std::vector<double> Variances;
  int Solutions = 0;
  bool Live = false;
};
}

#endif
