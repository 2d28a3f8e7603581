// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/RefinementSteps.h"

#include "Filters/Register/RigidStep.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int MostHalvings = 4;
constexpr double Halving = 0.5;

// How often a step that would fold is sought again by a stiffer volume, and how much stiffer.
constexpr int MostStiffenings = 3;
constexpr double Stiffening = 1.5;
constexpr double Converged = 1e-4; // fraction of the energy that a step must gain

constexpr double RigidShortening = 0.25;
constexpr double LeastRigidStepMm = 0.02;
constexpr double LeastInSight = 0.75; // of the samples that were compared at the start

double longest(const Controls& vectors)
{
  float result = 0.0f;
  for (const glm::vec3& vector : vectors)
  {
    result = std::max(result, glm::length(vector));
  }
  return result;
}
}

void BendStep::find(BendTrial& trial, const RefinementState& state) const
{
  trial.step = newtonStep(state.stiffness, state.known.forces, state.bendOf(state.controls));
  trial.lengthMm = longest(trial.step);
  trial.fraction =
    std::min(this->Stride, trial.lengthMm > 0.0 ? this->LongestMm / trial.lengthMm : 1.0);
}

StepOutcome BendStep::attempt(RefinementState& state, PyramidLevel& level)
{
  if (!this->Trying)
  {
    this->Trying = std::make_unique<BendTrial>();
    this->find(*this->Trying, state);
  }
  StepOutcome outcome = this->attempt(*this->Trying, state, level);
  if (outcome == StepOutcome::Open && ++this->Trying->attempts > MostHalvings + MostStiffenings)
  {
    state.progress.movedMm = 0.0;
    outcome = StepOutcome::Settled;
  }
  if (outcome != StepOutcome::Open)
  {
    this->Trying = nullptr;
  }
  return outcome;
}

StepOutcome BendStep::attempt(BendTrial& trial, RefinementState& state, PyramidLevel& level)
{
  const RefinementState::Candidate candidate = state.candidateAt(trial.step, trial.fraction);
  if (candidate.fraction < 1.0 && trial.stiffenings++ < MostStiffenings)
  {
    state.stiffen(Stiffening);
    this->find(trial, state);
    return StepOutcome::Open;
  }
  CostAndForces compared = level.compare(candidate.controls);
  const double energy = state.energyOf(candidate.controls, compared);
  state.progress.stepFraction = std::min(state.progress.stepFraction, candidate.fraction);
  if (!(energy < state.energy)) // also rejects NaN
  {
    trial.fraction *= Halving;
    return StepOutcome::Open;
  }
  const double gain = state.energy - energy;
  state.progress.movedMm = trial.fraction * candidate.fraction * trial.lengthMm;
  state.take(candidate.lattice, std::move(compared), energy);
  this->Stride =
    std::min(this->Growth.longest, this->Growth.growth * std::max(1.0, trial.fraction));
  return gain > Converged * energy ? StepOutcome::Improved : StepOutcome::Settled;
}

StepOutcome RigidMove::attempt(RefinementState& state, PyramidLevel& level)
{
  const RigidStep step = rigidStep(state.start.grid, state.controls, state.known.forces);
  const double fraction = std::min(this->Stride, this->LongestMm / std::max(1e-9, step.lengthMm));
  // Only the edge of a mask can fold.
  const RefinementState::Candidate candidate = state.candidateAt(step.steps, fraction);
  CostAndForces compared = level.compare(candidate.controls);
  const double gain = state.known.cost - compared.cost; // the bend costs the same
  // A mean also falls where tissue that disagrees leaves the fan.
  const bool staysInSight = compared.samples >= LeastInSight * state.samplesAtStart;
  state.progress.movedMm = 0.0;
  state.progress.stepFraction = std::min(state.progress.stepFraction, candidate.fraction);
  if (!(gain > 0.0) || !staysInSight)
  {
    this->Stride = RigidShortening * fraction;
    return this->Stride * step.lengthMm > LeastRigidStepMm ? StepOutcome::Open
                                                           : StepOutcome::Settled;
  }
  for (std::size_t i = 0; i < state.unbent.size(); ++i)
  {
    state.unbent[i] += candidate.controls[i] - state.controls[i];
  }
  state.progress.movedMm = fraction * candidate.fraction * step.lengthMm;
  state.take(candidate.lattice, std::move(compared), state.energy - gain);
  this->Stride = std::min(this->Growth.longest, this->Growth.growth * fraction);
  return gain > Converged * state.energy ? StepOutcome::Improved : StepOutcome::Settled;
}
}
