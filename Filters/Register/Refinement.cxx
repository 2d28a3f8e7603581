// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Refinement.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double LongestStepPoints = 1.5;
constexpr int MostHalvings = 4;

// How often a step that would fold is sought again by a stiffer volume, and how much stiffer.
constexpr int MostStiffenings = 3;
constexpr double Stiffening = 1.5;
// The lumped Hessian is larger than the true one, so that longer steps often help.
constexpr double LongestStride = 2.0;
constexpr double StrideGrowth = 1.2;
constexpr double Converged = 1e-4; // share of the energy that a step must gain

std::vector<glm::vec3> turned(const std::vector<glm::vec3>& vectors, const glm::dmat3& by)
{
  const glm::mat3 turn(by);
  std::vector<glm::vec3> result;
  result.reserve(vectors.size());
  for (const glm::vec3& vector : vectors)
  {
    result.push_back(turn * vector);
  }
  return result;
}

const Mask* orNull(const Mask& mask)
{
  return mask.inside.empty() ? nullptr : &mask;
}

LevelVolumes levelOf(const RegisteredPair& pair, double spacingMm, const Reach& reach)
{
  const Grid grid = coarseGrid(pair.rest.grid, spacingMm);
  LevelVolumes level;
  level.rest = resampled(smoothed(pair.rest, spacingMm), grid);
  level.reference = resampled(smoothed(pair.reference, spacingMm), grid);
  level.restWeights = weightsOf(grid, { nullptr, orNull(pair.inside), nullptr }, reach);
  level.referenceWeights =
    weightsOf(grid, { &pair.reference.grid, nullptr, orNull(pair.cavity) }, reach);
  return level;
}

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

Refinement::Refinement(
  RegisteredPair pair, const Lattice& start, const RefinementSettings& settings)
  : Pair(std::move(pair))
  , Settings(settings)
  , Start(start)
  , Bent(start)
  , Stiff(start.grid, settings.stiffness)
  , StartControls(turned(start.displacements, glm::transpose(start.grid.direction)))
  , Controls(StartControls)
{
  // Cells that fold by themselves at the start are left alone.
  this->Guard.setBase(start, settings.samples);
  this->Progress.isFinished = settings.levelsMm.empty();
  this->Progress.stiffness = settings.stiffness;
}

std::vector<glm::vec3> Refinement::bendOf(const std::vector<glm::vec3>& controls) const
{
  std::vector<glm::vec3> bend = controls;
  for (std::size_t i = 0; i < bend.size(); ++i)
  {
    bend[i] -= this->StartControls[i];
  }
  return bend;
}

double Refinement::energyOf(
  const std::vector<glm::vec3>& controls, const Agreement& agreement) const
{
  const std::vector<glm::vec3> bend = this->bendOf(controls);
  return agreement.disagreement + dot(bend, this->Stiff.times(bend));
}

Lattice Refinement::latticeOf(const std::vector<glm::vec3>& controls) const
{
  Lattice result = this->Start;
  result.displacements = turned(controls, this->Start.grid.direction);
  return result;
}

void Refinement::take(const Lattice& lattice, Agreement agreement, double energy)
{
  this->Bent = lattice;
  this->Controls = turned(lattice.displacements, glm::transpose(lattice.grid.direction));
  this->Known = std::move(agreement);
  this->Energy = energy;
  this->Progress.disagreement = this->Known.disagreement;
  this->Progress.comparedShare = this->Known.samples / this->SamplesAtRest;
}

void Refinement::prepareLevel()
{
  const double spacingMm = this->Settings.levelsMm[this->Progress.level];
  const LevelVolumes level = levelOf(this->Pair, spacingMm, reachOf(this->Settings.similarity));
  this->Compare = makeSimilarity(this->Settings.similarity, level, this->Start);
  const glm::dvec3& spacing = level.rest.grid.spacing;
  this->LongestStepMm = LongestStepPoints * std::max(spacing.x, std::max(spacing.y, spacing.z));
  const std::vector<float>& weights = level.restWeights.values;
  this->SamplesAtRest = std::max(1.0, std::accumulate(weights.begin(), weights.end(), 0.0));
  this->StepsOfLevel = 0;
  this->Stride = 1.0;
  Agreement atStart = this->Compare(this->StartControls);
  this->Progress.disagreementAtStart = atStart.disagreement;
  Agreement here = this->Compare(this->Controls);
  const double energy = this->energyOf(this->Controls, here);
  if (energy > atStart.disagreement)
  {
    const double startEnergy = atStart.disagreement;
    this->take(this->Start, std::move(atStart), startEnergy);
  }
  else
  {
    this->take(this->Bent, std::move(here), energy);
  }
}

// A fold in one place would hold the step everywhere. A stiffer volume folds nowhere.
void Refinement::stiffen()
{
  this->Progress.stiffness *= Stiffening;
  this->Stiff = Stiffness(this->Start.grid, this->Progress.stiffness);
  this->Energy = this->energyOf(this->Controls, this->Known);
}

bool Refinement::improve()
{
  std::vector<glm::vec3> step;
  double length = 0.0;
  double share = 0.0;
  const auto findStep = [&] {
    step = newtonStep(this->Stiff, this->Known.forces, this->bendOf(this->Controls));
    length = longest(step);
    share = std::min(this->Stride, length > 0.0 ? this->LongestStepMm / length : 1.0);
  };
  findStep();
  int stiffenings = 0;
  for (int attempt = 0; attempt <= MostHalvings + MostStiffenings; ++attempt, share *= 0.5)
  {
    std::vector<glm::vec3> controls = this->Controls;
    for (std::size_t i = 0; i < controls.size(); ++i)
    {
      controls[i] += static_cast<float>(share) * step[i];
    }
    Lattice candidate = this->latticeOf(controls);
    double kept = 1.0;
    if (this->Settings.guards)
    {
      kept = this->Guard.share(this->Bent, candidate);
      if (kept < 1.0 && stiffenings++ < MostStiffenings)
      {
        this->stiffen();
        findStep();
        share *= 2.0; // what the loop halves
        continue;
      }
      if (kept < 1.0)
      {
        candidate = between(this->Bent, candidate, kept);
        controls = turned(candidate.displacements, glm::transpose(candidate.grid.direction));
      }
    }
    Agreement agreement = this->Compare(controls);
    const double energy = this->energyOf(controls, agreement);
    if (energy < this->Energy)
    {
      const double gain = this->Energy - energy;
      this->Progress.movedMm = share * kept * length;
      this->Progress.share = std::min(this->Progress.share, kept);
      this->take(candidate, std::move(agreement), energy);
      this->Stride = std::min(LongestStride, StrideGrowth * std::max(1.0, share));
      return gain > Converged * energy;
    }
  }
  this->Progress.movedMm = 0.0;
  return false;
}

void Refinement::finishLevel()
{
  this->Compare = {};
  if (this->Progress.level + 1 < static_cast<int>(this->Settings.levelsMm.size()))
  {
    ++this->Progress.level;
  }
  else
  {
    this->Progress.isFinished = true;
    this->Pair = {};
  }
}

void Refinement::tellDone()
{
  const double levels = static_cast<double>(this->Settings.levelsMm.size());
  const double ofLevel =
    this->Compare ? static_cast<double>(this->StepsOfLevel) / this->Settings.mostSteps : 0.0;
  this->Progress.done = this->Progress.isFinished ? 1.0 : (this->Progress.level + ofLevel) / levels;
}

const RefinementProgress& Refinement::step()
{
  if (this->Progress.isFinished)
  {
    return this->Progress;
  }
  if (!this->Compare)
  {
    this->prepareLevel();
  }
  ++this->Progress.steps;
  ++this->StepsOfLevel;
  if (!this->improve() || this->StepsOfLevel >= this->Settings.mostSteps)
  {
    this->finishLevel();
  }
  this->tellDone();
  return this->Progress;
}

double Refinement::bytes(
  const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementSettings& settings)
{
  double most = 0.0;
  for (const double spacingMm : settings.levelsMm)
  {
    const Grid level = coarseGrid(rest, spacingMm);
    // One of the two is smoothed at a time, with the lines that are smoothed beside it.
    const double smoothing = sizeof(float) * 2.0 * std::max(rest.count(), reference.count());
    const double points = static_cast<double>(level.count());
    most = std::max(most,
      smoothing + similarityBytes(settings.similarity, points) + 4.0 * sizeof(float) * points +
        LatticeRows::bytes(lattice.dimensions, level.dimensions));
  }
  return most + 40.0 * sizeof(float) * 3.0 * static_cast<double>(lattice.count());
}
}
