// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief How far a fit can be believed at each control point of its lattice.
 */
#ifndef BrainShift_LatticeEvidence_h
#define BrainShift_LatticeEvidence_h

#include "Common/Export.h"
#include "Common/Grid.h"

#include <string>
#include <vector>

namespace brainshift
{
class FittedLattice;

/** Most control points for which evidence is found: 65 a side. */
constexpr std::size_t MostEvidencePoints = 275000;

/**
 * The variances depend on where something was measured and not on what was measured. They are kept
 * and found anew only if a place or a weight changes: a pull that is dragged costs nothing.
 */
class BRAINSHIFT_DEFORMATION_EXPORT LatticeEvidence
{
public:
  /**
   * FittedLattice::deviations (mm) at the control points, x fastest, to the rounding of float.
   *
   * @param problem   set to one sentence without a full stop if there are too many control points;
   *                  there are no deviations then
   */
  std::vector<float> deviations(const FittedLattice& fitted, std::string& problem);

  /**
   * While a hand moves what was measured, variances of a moment ago are good enough: it moves
   * traced places by little, and a place that is added makes them smaller. Default: off.
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
