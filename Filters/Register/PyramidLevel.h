// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief One level of a refinement: both volumes on its grid, and their comparison.
 */
#ifndef BrainShift_PyramidLevel_h
#define BrainShift_PyramidLevel_h

#include "Filters/Register/ComparedRegion.h"
#include "Filters/Register/RegisteredPair.h"
#include "Filters/Register/Similarity.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace brainshift
{
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
