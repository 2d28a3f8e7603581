// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief One level of a refinement: which samples it compares, both volumes on its grid, and their
 *        comparison.
 */
#ifndef BrainShift_PyramidLevel_h
#define BrainShift_PyramidLevel_h

#include "Filters/Register/Similarity.h"
#include "Filters/Register/Volume.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace brainshift
{
/**
 * Which samples of a volume are compared: all of its box, or those near the fan of an ultrasound
 * reference.
 */
class ComparedRegion
{
public:
  ComparedRegion(const RegisteredPair& pair, const RefinementPlan& plan);

  /** Whether the fan is known, or there is none. */
  bool isFound() const { return !this->Limits || !this->Fan.inside.empty(); }

  /** Finds the fan of the reference (Sweep.h); it takes as long as a step. */
  void find(const Volume& reference, const Grid& lattice);

  /** The voxels inside the fan; null: there is none. */
  const Mask* fan() const { return this->Fan.inside.empty() ? nullptr : &this->Fan; }

  double spacingMm(const RefinementLevel& level) const;

  /** The samples of a level, without those far from the fan. */
  Grid grid(const RefinementLevel& level) const;

  /**
   * Factor on the stiffness, which is a mean over the lattice, where the cost is a mean over the
   * fan. Without the factor, a volume would be the softer the smaller the fan is.
   */
  double stiffness() const;

  /** Fraction of the fan that is compared, or of the samples that have a partner; 0 to 1. */
  double overlap(const CostAndForces& compared, const Grid& samples) const;

  /** The spacing of a level for a volume with as little tissue as may be: the finest there is. */
  static double finestSpacingMm(const RefinementLevel& level, const Grid& rest);

private:
  Grid Rest;
  double TissueFraction; // of the volume's voxels
  double Stiffness;      // of the plan
  std::optional<FanLimits> Limits;
  Mask Fan;
  double FanMm3 = 0.0; // of the volume's box, at most
  double BoxMm3 = 0.0; // of the lattice
};

class PyramidLevel
{
public:
  /** @param pair   lives longer than the level */
  PyramidLevel(const RegisteredPair& pair, const ComparedRegion& region,
    const RefinementLevel& level, const Lattice& lattice);

  bool isPrepared() const { return this->IsPrepared; }

  /** Does a part of the work before the first comparison; each takes about as long as a step. */
  void prepare();

  CostAndForces compare(const std::vector<glm::vec3>& controls)
  {
    return this->Compared->compare(controls);
  }

  const Grid& grid() const { return this->Samples; }

  /** Bytes that a level takes beside the volumes themselves. */
  static double bytes(
    const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementLevel& level);

private:
  void readRest();
  void readReference();
  void weighRest();
  void weighReference();
  void makeComparison();

  const RegisteredPair& Pair;
  const Mask* Fan;
  const Metric* Compares;
  double SpacingMm;
  Grid Samples;
  const Lattice& Over;
  LevelVolumes Volumes; // while it is prepared
  std::size_t PartsDone = 0;
  std::unique_ptr<Comparison> Compared;
  bool IsPrepared = false;
};
}

#endif
