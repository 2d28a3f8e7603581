// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One level of a refinement: its samples, both volumes on its grid, and their comparison.
#ifndef BrainShift_PyramidLevel_h
#define BrainShift_PyramidLevel_h

#include "Filters/Register/Similarity.h"

namespace brainshift
{
/**
 * The region inside the fan, on voxels of about 1 mm. Voxels outside it are connected to the border
 * of the volume through voxels that have the lowest value. Dark tissue within the fan is inside. If
 * the volume has no such border, all of it is inside.
 */
BRAINSHIFT_DEFORMATION_EXPORT Mask sweptRegion(const Volume& ultrasound);

/**
 * The part of a grid within `marginMm` of a region, with two points or more along each axis. The
 * whole grid if they do not meet.
 */
BRAINSHIFT_DEFORMATION_EXPORT Grid croppedTo(const Grid& grid, const Mask& region, double marginMm);

/**
 * The part of a volume that is compared: all of its box, or the samples near the fan of an
 * ultrasound reference.
 */
class ComparedRegion
{
public:
  ComparedRegion(const RegisteredPair& pair, const RefinementPlan& plan);

  /** Whether the fan is known, or there is none. */
  bool isFound() const { return !this->Limits || !this->Fan.inside.empty(); }

  /** Finds the fan of the reference and its beam; it takes as long as a step. */
  void find(const RegisteredPair& pair, const Grid& lattice);

  /** The voxels inside the fan; null: there is none. */
  const Mask* fan() const { return this->Fan.inside.empty() ? nullptr : &this->Fan; }

  /** The middle of the fan (mm, world), or of the volume. */
  glm::dvec3 middle() const { return this->Middle; }

  /**
   * The direction of the ultrasound beam (world, of length 1): from the middle of the fan to that
   * of the volume's tissue, because a probe on the brain looks inwards. 0: the two are too near
   * each other to tell it, as in a volume that was cut around the fan.
   */
  glm::dvec3 beam() const { return this->Beam; }

  double spacingMm(const RefinementLevel& level) const;

  /** The samples of a level, without those far from the fan, or from the box of crop(). */
  Grid grid(const RefinementLevel& level) const;

  /**
   * From now on a level has no samples more than some points beyond the box of what counts: inside
   * the mask, with a partner within the box of the reference. Only without a fan, which does so.
   */
  void crop(const RegisteredPair& pair, const Lattice& bent);

  /** Whether a level that is finer than its plan says has few enough points. */
  bool allowsFiner(const RefinementLevel& level) const;

  /** Whether a level that may be skipped is finer than the former one, and its cost low enough. */
  bool isWorthwhile(const RefinementLevel& level, const RefinementLevel& former, double cost) const;

  /**
   * Factor on the stiffness. The stiffness is a mean over the lattice, the cost a mean over the
   * fan; without the factor, a smaller fan would make the volume softer.
   */
  double stiffness() const;

  /** Fraction of the fan that is compared, or of the samples that have a partner; 0 to 1. */
  double overlap(const CostAndForces& compared, const Grid& samples) const;

  /** The finest spacing that a level may have: that for a volume with the least tissue. */
  static double finestSpacingMm(const RefinementLevel& level, const Grid& rest);

private:
  Grid Rest;
  double TissueFraction; // of the volume's voxels
  double Stiffness;      // of the plan
  std::optional<FanLimits> Limits;
  Mask Fan;
  glm::dvec3 Middle{ 0.0 };
  glm::dvec3 Beam{ 0.0 };
  std::optional<std::array<glm::dvec3, 2>> Counting; // a box, mm along the axes of Rest, from it
  double FanMm3 = 0.0;                               // of the volume's box, at most
  double BoxMm3 = 0.0;                               // of the lattice
};

/**
 * A level of a check, coarser if its grid over all of a volume had more points than memory should
 * be taken for.
 */
BRAINSHIFT_DEFORMATION_EXPORT RefinementLevel withinMemory(
  const RefinementLevel& level, const Grid& rest);

class PyramidLevel
{
public:
  /**
   * @param pair      lives until the level is prepared, and so does the region
   * @param lattice   the same
   */
  PyramidLevel(const RegisteredPair& pair, const ComparedRegion& region,
    const RefinementLevel& level, const Lattice& lattice);

  bool isPrepared() const { return this->IsPrepared; }

  /** Does a part of the work before the first comparison; each takes about as long as a step. */
  void prepare();

  CostAndForces compare(const std::vector<glm::vec3>& controls)
  {
    return this->Compared->compare(controls);
  }

  /** Compares only samples in the half; once it is prepared. */
  void restrictTo(const HalfSpace& half) { this->Compared->restrictTo(half); }

  /** Goes on to a level that is compared alike; it may have to prepare more. */
  void become(const RefinementLevel& level);

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
  Volume weights(const Region& seen, const Region& known) const;

  const RegisteredPair& Pair;
  const Mask* Fan;
  glm::dvec3 Beam;
  const Metric* Compares;
  Part Taken; // of its metric
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
