// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The two kinds of steps of a refinement: one bends the volume, one moves it rigidly.
///
/// Both solve for the forces (Nocedal and Wright, Numerical Optimization, 2nd ed., section 10.3): a
/// bend by a quasi-Newton step (Stiffness.h), a motion by a Gauss-Newton step.
///
/// A rigid step has six parameters instead of three for each control point, so that the random
/// forces of speckle average out.
#ifndef BrainShift_RefinementSteps_h
#define BrainShift_RefinementSteps_h

#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Register/PyramidLevel.h"
#include "Filters/Register/Starts.h"
#include "Filters/Register/Stiffness.h"

namespace brainshift
{
// The lattice that a refinement changes, its energy, and the figures after a step.

struct RefinementSettings
{
  RefinementPlan plan = similarities().front().plan;
  double stiffness = 1.0; ///< factor on the stiffness; above 0
  int mostSteps = 15;     ///< on each level where it bends
  int samples = 4;        ///< nodes between two control points, 0 to 16
  bool guards = true;     ///< whether the fold guard shortens steps
  int starts = 1;         ///< positions from which rigid levels search; 1 to MostStarts

  /** Most steps of a level. */
  int mostStepsOf(const RefinementLevel& level) const
  {
    constexpr int RigidStepsPerStep = 3;
    return this->mostSteps * (level.isRigid ? RigidStepsPerStep : 1);
  }
};

/** The figures after a step. */
struct RefinementProgress
{
  int level = 0;             ///< from 0 on, the coarsest
  int steps = 0;             ///< on all levels
  double cost = 0.0;         ///< of this level; 0: both volumes agree; NaN ends the refinement
  double costAtStart = 0.0;  ///< of the lattice as it began, on the same level
  double movedMm = 0.0;      ///< longest move of a control point in the last step
  double stepFraction = 1.0; ///< smallest fraction of a step that the fold guard allowed
  double overlap = 0.0;      ///< see ComparedRegion::overlap; of levels with the first support
  double stiffness = 1.0;    ///< the factor in use; raised where tissue would have folded
  double done = 0.0;         ///< fraction of the most steps there may be, 0 to 1; 1 at the end
  bool isFinished = false;
};

/** A result of rigid levels, or where they begin. */
struct RigidPosition
{
  Controls controls;
  Controls unbent;
  double cost = 0.0;
};

struct RefinementState
{
  RefinementState(const Lattice& from, const RefinementSettings& settings);

  Lattice start;
  Lattice bent;
  Controls startControls;
  Controls unbent; ///< without elastic energy: the start, moved rigidly
  Controls controls;
  CostAndForces known;         ///< of `controls`
  double energy = 0.0;         ///< of `controls`: cost and stiffness
  double samplesAtStart = 0.0; ///< that were compared on this level
  Stiffness stiffness;
  RefinementProgress progress;

  /** Sets the plan's factor on the stiffness. */
  void setStiffness(double factor);

  /** Makes the volume stiffer. */
  void stiffen(double factor);

  /** Begins a level where it is. */
  void beginLevel(CostAndForces here, const CostAndForces& atStart);

  /** Goes back to the start if the energy is less there. */
  void returnIfWorse(const CostAndForces& atStart);

  RigidPosition position() const { return { this->controls, this->unbent, this->known.cost }; }

  void moveTo(const RigidPosition& position);

  /** Moves to another lattice, as if the volume had been bent so at the start. */
  void moveTo(const Lattice& lattice);

  /**
   * The start, moved rigidly about a position (mm, world) by up to `farthest` mm and degrees.
   * Number 0 is the start itself; others are random, the same for the same number.
   */
  RigidPosition startNear(const glm::dvec3& middle, int number, double farthest = 6.0) const;

  /** The displacements that have elastic energy. */
  Controls bendOf(const Controls& at) const;

  double energyOf(const Controls& at, const CostAndForces& compared) const;

  /** The result of a step, as far as the fold guard allows it. */
  struct Candidate
  {
    Lattice lattice;
    Controls controls;
    double fraction = 1.0; // of the step
  };
  Candidate candidateAt(const Controls& step, double length, bool isRigid = false) const;

  void take(const Lattice& lattice, CostAndForces compared, double energyThere);

private:
  Lattice latticeOf(const Controls& at) const;

  FoldGuard Guard;
  bool Guards;
  double StiffnessFactor = 1.0;
};

enum class StepOutcome
{
  Open,     ///< try again
  Improved, ///< the level continues
  Settled   ///< no further step would gain on this level
};

/** A step of all control points. */
struct RigidStep
{
  std::vector<glm::vec3> steps; ///< mm along the grid's axes
  double lengthMm = 0.0;        ///< the longest of those on which forces act
};

/**
 * The Gauss-Newton step of a translation and a small rotation of the deformed lattice.
 *
 * @param displacements   of the control points, mm along the grid's axes
 * @param forces          ForceNumbers for each control point (LatticeRows.h)
 */
BRAINSHIFT_DEFORMATION_EXPORT RigidStep rigidStep(
  const Grid& lattice, const std::vector<glm::vec3>& displacements, const ControlForces& forces);

/** The steps of one level. */
class RefinementStep
{
public:
  /**
   * @param longestMm   of a control point in one step
   * @param converged   the level ends with a step that gains a smaller fraction of the energy
   */
  RefinementStep(double longestMm, double converged)
    : LongestMm(longestMm)
    , Converged(converged)
  {
  }
  virtual ~RefinementStep() = default;

  /** Compares once at most, so that a call stays short. */
  virtual StepOutcome attempt(RefinementState& state, PyramidLevel& level) = 0;

protected:
  double LongestMm;
  double Converged;
};

/** A step that bends, of which each call tries one length. */
struct BendTrial
{
  Controls step;
  double lengthMm = 0.0; ///< of the longest of them
  double fraction = 0.0; ///< that is tried next
  int attempts = 0;
  int stiffenings = 0;
};

/**
 * A step is halved until the energy falls. Where it would fold tissue, a stiffer volume is tried
 * first, so that a fold in one position does not shorten the step everywhere.
 */
class BendStep : public RefinementStep
{
public:
  using RefinementStep::RefinementStep;

  StepOutcome attempt(RefinementState& state, PyramidLevel& level) override;

private:
  void find(BendTrial& trial, const RefinementState& state);
  StepOutcome attempt(BendTrial& trial, RefinementState& state, PyramidLevel& level);

  std::unique_ptr<BendTrial> Trying;
  Controls Before; // where the last step began; empty: none was taken with this stiffness
  Controls PullBefore;
};

/** A step that is too long moves nothing, and the next one is shorter. It has no elastic energy. */
class RigidMove : public RefinementStep
{
public:
  using RefinementStep::RefinementStep;

  StepOutcome attempt(RefinementState& state, PyramidLevel& level) override;

private:
  double StepLength = 8.0; // factor on the next Gauss-Newton step, which speckle makes short
};

/** The first step of a level with these samples. */
std::unique_ptr<RefinementStep> makeStep(
  const RefinementPlan& plan, const RefinementLevel& level, const Grid& samples);
}

#endif
