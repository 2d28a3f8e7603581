// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The two kinds of steps of a refinement: one bends the volume, one moves it rigidly.
 *
 * Both follow Gauss and Newton (Nocedal and Wright, Numerical Optimization, 2nd ed., section 10.3).
 *
 * A rigid step has six numbers instead of three for each control point, so that the random forces
 * of speckle average out.
 */
#ifndef BrainShift_RefinementSteps_h
#define BrainShift_RefinementSteps_h

#include "Filters/Deformation/Export.h"
#include "Filters/Register/LatticeRows.h"
#include "Filters/Register/PyramidLevel.h"
#include "Filters/Register/RefinementState.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace brainshift
{
enum class StepOutcome
{
  Open,     ///< try again
  Improved, ///< the level goes on
  Settled   ///< there is nothing more to gain on this level
};

/** A step of all control points. */
struct RigidStep
{
  std::vector<glm::vec3> steps; ///< mm along the grid's axes
  double lengthMm = 0.0;        ///< the longest of those on which forces act
};

/**
 * The step of Gauss and Newton of a shift and a small rotation of the bent lattice.
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
  /** @param longestMm   of a control point in one step */
  RefinementStep(const StepGrowth& growth, double longestMm)
    : Growth(growth)
    , LongestMm(longestMm)
    , Stride(growth.first)
  {
  }
  virtual ~RefinementStep() = default;

  /** Compares once at most, so that a call stays short. */
  virtual StepOutcome attempt(RefinementState& state, PyramidLevel& level) = 0;

protected:
  StepGrowth Growth;
  double LongestMm;
  double Stride; // factor on the next step
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
  void find(BendTrial& trial, const RefinementState& state) const;
  StepOutcome attempt(BendTrial& trial, RefinementState& state, PyramidLevel& level);

  std::unique_ptr<BendTrial> Trying;
};

/** Where a step is too long, nothing moves, and the next one is shorter. It costs no energy. */
class RigidMove : public RefinementStep
{
public:
  using RefinementStep::RefinementStep;

  StepOutcome attempt(RefinementState& state, PyramidLevel& level) override;
};
}

#endif
