// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Refines a lattice so that a volume matches a reference, a part of a step for each call.
///
/// It starts from the lattice as it is, for example as a user bent it by hand, on a coarse level,
/// and ends on the finest. The plan of a similarity (Similarity.h) lists the levels. A step is a
/// Gauss-Newton step of the control points, at most 1.5 points of its level long and shortened
/// until the energy falls (RefinementSteps.h). The energy is the cost plus the stiffness
/// (Stiffness.h) of the change since the start; a rigid motion costs no energy. A level that bends
/// starts from the better of the last result and the start, so that the result never has more
/// energy than the start. Levels that move rigidly may search from several starts; the results with
/// the least cost go on.
#ifndef BrainShift_Refinement_h
#define BrainShift_Refinement_h

#include "Filters/Register/RefinementSteps.h"

#include <utility>

namespace brainshift
{
class BRAINSHIFT_DEFORMATION_EXPORT Refinement
{
public:
  /**
   * @param start   over the volume's box, with its mask
   */
  Refinement(RegisteredPair pair, const Lattice& start, const RefinementSettings& settings);

  /**
   * Begins at another lattice, moved by a step of the control points as far as the fold guard
   * allows it; before the first call of step(). The change until there has no stiffness.
   */
  void beginAt(const Lattice& lattice, const Controls& motion);

  /**
   * Tries one length of a step, or prepares a part of the next level, which takes about as long. A
   * step is taken once one of its lengths succeeds. Nothing once it is finished.
   */
  const RefinementProgress& step();

  const RefinementProgress& progress() const { return this->Shown; }

  /**
   * The lattice after the last step. While a level searches from several positions, the best that
   * it has found.
   */
  const Lattice& lattice() const
  {
    const Result* best = this->better();
    return best ? best->lattice : this->State.bent;
  }

  /** Hands the volumes back, once it is finished. */
  RegisteredPair takePair() { return std::move(this->Pair); }

  /** The last level, once it is finished, if the check of the result compares alike; or null. */
  std::unique_ptr<PyramidLevel> takeLevel()
  {
    return this->progress().isFinished ? std::move(this->Level) : nullptr;
  }

  /** Bytes that a refinement takes beside the volumes themselves. */
  static double bytes(const Grid& rest, const Grid& reference, const Grid& lattice,
    const RefinementSettings& settings);

private:
  const RefinementLevel& level() const { return this->Settings.plan.levels[this->Index]; }
  void prepareLevel();
  void beginLevel();
  void takeStep();
  void finishPosition();
  void finishLevel();
  void findStarts();
  void compareNear();
  void begin(const RigidPosition& position);
  void reportOverlap();
  void report();

  // What this level found from another position than the present one.
  struct Result
  {
    Lattice lattice;
    double cost = 0.0;
    double overlap = 0.0;
  };
  // What is better than the present position, or null.
  const Result* better() const;

  RegisteredPair Pair;
  RefinementSettings Settings;
  RefinementState State;
  ComparedRegion Region;
  int Index = 0;    // of the level
  int LastUsed = 0; // the last level that was not left out
  int StepsOfLevel = 0;
  bool BeganElsewhere = false; // what matches worse than the start may still lead to a better match
  std::unique_ptr<PyramidLevel> Level;
  std::unique_ptr<CostAndForces> AtStart; // on this level
  std::unique_ptr<CostAndForces> Here;    // where the level would begin
  std::vector<RigidPosition> Near;        // that are still to be compared
  std::vector<RigidPosition> Open;        // from which this level is still to begin
  std::vector<RigidPosition> Found;       // on this level
  std::unique_ptr<RefinementStep> Step;

  std::optional<Result> Best;
  RefinementProgress Shown; // of lattice()
};
}

#endif
