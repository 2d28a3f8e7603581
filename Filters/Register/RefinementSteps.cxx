// SPDX-License-Identifier: BSD-3-Clause
// The steps of a refinement: rigid ones, and those that bend.
#include "Filters/Register/Refinement.h"

#include "Filters/Register/RigidStep.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int MostHalvings = 4;

// How often a step that would fold is sought again by a stiffer volume, and how much stiffer.
constexpr int MostStiffenings = 3;
constexpr double Stiffening = 1.5;
// The lumped Hessian is larger than the true one, so that longer steps often help.
constexpr double LongestStride = 2.0;
constexpr double StrideGrowth = 1.2;
constexpr double Converged = 1e-4; // share of the energy that a step must gain

// Speckle makes the reference's slopes, and with them the Hessian, many times too large. So rigid
// steps begin longer and grow fast.
constexpr double FirstRigidStride = 4.0;
constexpr double LongestRigidStride = 16.0;
constexpr double RigidStrideGrowth = 2.0;
constexpr double RigidStrideLoss = 0.25;
constexpr double LeastRigidStepMm = 0.02;
constexpr double LeastInSight = 0.75; // of the samples that were compared at the start

double longest(const std::vector<glm::vec3>& vectors)
{
  float result = 0.0f;
  for (const glm::vec3& vector : vectors)
  {
    result = std::max(result, glm::length(vector));
  }
  return result;
}
}

// A fold in one place would hold the step everywhere. A stiffer volume folds nowhere.
void Refinement::stiffen()
{
  this->Progress.stiffness *= Stiffening;
  this->Stiff = Stiffness(this->Start.grid, this->stiffnessFactor() * this->Progress.stiffness);
  this->Energy = this->energyOf(this->Controls, this->Known);
}

double Refinement::firstStride() const
{
  return this->stage().isRigid ? FirstRigidStride : 1.0;
}

Refinement::Candidate Refinement::candidateAt(
  const std::vector<glm::vec3>& step, double share) const
{
  Candidate found;
  found.controls = this->Controls;
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    found.controls[i] += static_cast<float>(share) * step[i];
  }
  found.lattice = this->latticeOf(found.controls);
  found.kept = this->Settings.guards ? this->Guard.share(this->Bent, found.lattice) : 1.0;
  if (found.kept < 1.0)
  {
    found.lattice = between(this->Bent, found.lattice, found.kept);
    found.controls = this->controlsOf(found.lattice);
  }
  return found;
}

void Refinement::findStep(RefinementTrial& trial) const
{
  trial.step = newtonStep(this->Stiff, this->Known.forces, this->bendOf(this->Controls));
  trial.lengthMm = longest(trial.step);
  trial.share =
    std::min(this->Stride, trial.lengthMm > 0.0 ? this->LongestStepMm / trial.lengthMm : 1.0);
}

// Compares once at most, so that a call stays short however often a step is halved.
Refinement::Outcome Refinement::tryStep()
{
  if (!this->Trying)
  {
    this->findStep(this->Trying.emplace());
  }
  Outcome outcome = this->tryStep(*this->Trying);
  if (outcome == Outcome::Open && ++this->Trying->attempts > MostHalvings + MostStiffenings)
  {
    this->Progress.movedMm = 0.0;
    outcome = Outcome::Settled;
  }
  if (outcome != Outcome::Open)
  {
    this->Trying.reset();
  }
  return outcome;
}

Refinement::Outcome Refinement::tryStep(RefinementTrial& trial)
{
  const Candidate candidate = this->candidateAt(trial.step, trial.share);
  if (candidate.kept < 1.0 && trial.stiffenings++ < MostStiffenings)
  {
    this->stiffen();
    this->findStep(trial);
    return Outcome::Open;
  }
  Agreement agreement = this->Compare(candidate.controls);
  const double energy = this->energyOf(candidate.controls, agreement);
  this->Progress.share = std::min(this->Progress.share, candidate.kept);
  if (!(energy < this->Energy)) // nor is no number
  {
    trial.share *= 0.5;
    return Outcome::Open;
  }
  const double gain = this->Energy - energy;
  this->Progress.movedMm = trial.share * candidate.kept * trial.lengthMm;
  this->take(candidate.lattice, std::move(agreement), energy);
  this->Stride = std::min(LongestStride, StrideGrowth * std::max(1.0, trial.share));
  return gain > Converged * energy ? Outcome::Improved : Outcome::Settled;
}

Refinement::Outcome Refinement::moveRigidly()
{
  const RigidStep step = rigidStep(this->Start.grid, this->Controls, this->Known.forces);
  const double share = std::min(this->Stride, this->LongestStepMm / std::max(1e-9, step.lengthMm));
  const Candidate candidate = this->candidateAt(step.steps, share); // only a mask's edge can fold
  Agreement agreement = this->Compare(candidate.controls);
  const double gain = this->Known.disagreement - agreement.disagreement; // the bend costs the same
  // A mean gets better, too, where what disagrees moves out of sight.
  const bool staysInSight = agreement.samples >= LeastInSight * this->SamplesAtStart;
  this->Progress.movedMm = 0.0;
  this->Progress.share = std::min(this->Progress.share, candidate.kept);
  if (!(gain > 0.0) || !staysInSight)
  {
    this->Stride = RigidStrideLoss * share;
    return this->Stride * step.lengthMm > LeastRigidStepMm ? Outcome::Open : Outcome::Settled;
  }
  for (std::size_t i = 0; i < this->Unbent.size(); ++i)
  {
    this->Unbent[i] += candidate.controls[i] - this->Controls[i];
  }
  this->Progress.movedMm = share * candidate.kept * step.lengthMm;
  this->take(candidate.lattice, std::move(agreement), this->Energy - gain);
  this->Stride = std::min(LongestRigidStride, RigidStrideGrowth * share);
  return gain > Converged * this->Energy ? Outcome::Improved : Outcome::Settled;
}
}
