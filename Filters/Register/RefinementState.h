// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The lattice that a refinement changes, its energy, and what is known after a step.
 */
#ifndef BrainShift_RefinementState_h
#define BrainShift_RefinementState_h

#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Register/LevelSamples.h"
#include "Filters/Register/Similarity.h"
#include "Filters/Register/Stiffness.h"

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
struct RefinementSettings
{
  RefinementPlan plan = similarities().front().plan;
  double stiffness = 1.0; ///< factor on the stiffness; above 0
  int mostSteps = 15;     ///< on each level where it bends
  int samples = 4;        ///< nodes between two control points, 0 to 16
  bool guards = true;     ///< whether the fold guard shortens steps
};

/** What is known after a step. */
struct RefinementProgress
{
  int level = 0;             ///< from 0 on, the coarsest
  int steps = 0;             ///< on all levels
  double cost = 0.0;         ///< of this level; 0: both volumes agree
  double costAtStart = 0.0;  ///< of the lattice as it began, on the same level
  double movedMm = 0.0;      ///< longest move of a control point in the last step
  double stepFraction = 1.0; ///< smallest fraction of a step that the fold guard allowed
  double overlap = 0.0;      ///< see ComparedRegion::overlap; on the levels of the first metric
  double stiffness = 1.0; ///< what was used; larger than asked for where tissue would have folded
  double done = 0.0;      ///< fraction of the most steps there may be, 0 to 1; 1 at the end
  bool isFinished = false;
};

/** Displacements of the control points: mm along the grid's axes. */
using Controls = std::vector<glm::vec3>;

struct RefinementState
{
  RefinementState(const Lattice& from, const RefinementSettings& settings);

  Lattice start;
  Lattice bent;
  Controls startControls;
  Controls unbent; ///< what the stiffness counts from: the start, moved rigidly
  Controls controls;
  CostAndForces known;         ///< of `controls`
  double energy = 0.0;         ///< of `controls`: cost and stiffness
  double samplesAtStart = 0.0; ///< that were compared on this level
  Stiffness stiffness;
  RefinementProgress progress;

  /** Sets the factor on the stiffness that the plan asks for. */
  void setStiffness(double factor);

  /** Makes the volume stiffer. */
  void stiffen(double factor);

  /** Begins a level with the better of the last result and the start. */
  void beginLevel(CostAndForces here, CostAndForces atStart);

  /** What the stiffness counts. */
  Controls bendOf(const Controls& at) const;

  double energyOf(const Controls& at, const CostAndForces& compared) const;

  /** Where a step would lead, as far as the fold guard allows it. */
  struct Candidate
  {
    Lattice lattice;
    Controls controls;
    double fraction = 1.0; // of the step
  };
  Candidate candidateAt(const Controls& step, double length) const;

  void take(const Lattice& lattice, CostAndForces compared, double energyThere);

private:
  Lattice latticeOf(const Controls& at) const;

  FoldGuard Guard;
  bool Guards;
  double StiffnessFactor = 1.0;
};
}

#endif
