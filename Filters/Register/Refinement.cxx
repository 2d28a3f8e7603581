// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Refinement.h"

#include "Filters/Register/SelfSimilarity.h"
#include "Filters/Register/Sweep.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double LongestStepPoints = 1.5;

// So that a step stays short and memory small: of samples of tissue on a level that may be left
// out. Air costs little. A level that is not finer than the last one by this factor in volume says
// nothing new.
constexpr double MostSamples = 0.95e6;
constexpr double LeastTissue = 0.25; // share of a volume that is taken for tissue
// Around an ultrasound sweep: tissue farther away than this is not compared.
constexpr double FarthestMm = 10.0;
constexpr float Air = 0.05f; // share of the range of values
constexpr double FinerVolume = 0.8;

// A correlation that begins below 0.8 in the mean has another cause than place: the contrast.
constexpr double MostDisagreement = 0.2;
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

// The spacing of a stage: as fine as it asks for and the number of its samples allows.
double spacingOf(const RefinementStage& stage, const Grid& rest, double tissueShare)
{
  constexpr double Coarser = 1.02;
  double spacingMm = stage.spacingMm;
  while (stage.mostDisagreement < 1.0 &&
    tissueShare * static_cast<double>(coarseGrid(rest, spacingMm).count()) > MostSamples)
  {
    spacingMm *= Coarser;
  }
  return spacingMm;
}

double tissueShareOf(const std::vector<float>& values)
{
  const Range range = rangeOf(values);
  const auto isTissue = [&](float value) { return range.share(value) > Air; };
  const double count = static_cast<double>(std::count_if(values.begin(), values.end(), isTissue));
  return std::max(LeastTissue, count / std::max<std::size_t>(1, values.size()));
}

double pointVolume(const Grid& grid)
{
  return grid.spacing.x * grid.spacing.y * grid.spacing.z;
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

std::vector<RefinementStage> stagesOf(SimilarityKind kind)
{
  if (kind == SimilarityKind::LinearCombination)
  {
    // Self-similarity reaches farther; the linear combination places more exactly.
    return { { SimilarityKind::SelfSimilarity, 4.0 }, { SimilarityKind::SelfSimilarity, 2.0 },
      { kind, 1.0 } };
  }
  // Where the volumes correlate once they lie right, correlation places them more exactly.
  return { { kind, 4.0 }, { kind, 2.0 },
    { SimilarityKind::LocalCorrelation, 1.3, MostDisagreement } };
}

Refinement::Refinement(
  RegisteredPair pair, const Lattice& start, const RefinementSettings& settings)
  : Pair(std::move(pair))
  , Settings(settings)
  , TissueShare(tissueShareOf(Pair.rest.values))
  , Start(start)
  , Bent(start)
  , Stiff(start.grid, settings.stiffness)
  , StartControls(turned(start.displacements, glm::transpose(start.grid.direction)))
  , Controls(StartControls)
{
  // Cells that fold by themselves at the start are left alone.
  this->Guard.setBase(start, settings.samples);
  this->Progress.isFinished = settings.stages.empty();
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
  // Of the first similarity alone: another one reaches farther, and shares would not compare.
  if (this->stage().similarity == this->Settings.stages.front().similarity)
  {
    this->Progress.comparedShare = this->Known.samples / std::max(1.0, this->Known.possible);
  }
}

const RefinementStage& Refinement::stage() const
{
  return this->Settings.stages[this->Progress.level];
}

bool Refinement::isUltrasound() const
{
  return this->Settings.stages.back().similarity == SimilarityKind::LinearCombination;
}

// The samples of a stage. A probe sees a part of a head, so that the rest need not be kept.
Grid Refinement::gridOf(const RefinementStage& stage) const
{
  const Grid& rest = this->Pair.rest.grid;
  const Grid grid = coarseGrid(rest, spacingOf(stage, rest, this->TissueShare));
  return this->isUltrasound() ? croppedTo(grid, this->Swept, FarthestMm) : grid;
}

// Each part takes about as long as a step, so that whoever calls can do other things in between.
void Refinement::prepareLevel()
{
  if (this->isUltrasound() && this->Swept.inside.empty())
  {
    this->Swept = sweptRegion(this->Pair.reference);
    return;
  }
  const double spacingMm = spacingOf(this->stage(), this->Pair.rest.grid, this->TissueShare);
  const Grid grid = this->gridOf(this->stage());
  const Reach reach = reachOf(this->stage().similarity);
  const bool isDescribed = this->stage().similarity == SimilarityKind::SelfSimilarity;
  using Numbers = std::vector<float>;
  LevelVolumes& level = this->Level;
  switch (this->PreparedParts++)
  {
    case 0:
      level.rest = resampled(smoothed(this->Pair.rest, spacingMm), grid);
      break;
    case 1:
      level.reference = resampled(smoothed(this->Pair.reference, spacingMm), grid);
      break;
    case 2:
      level.restWeights = weightsOf(grid, { nullptr, orNull(this->Pair.inside), nullptr }, reach);
      break;
    case 3:
      level.referenceWeights = weightsOf(grid,
        { &this->Pair.reference.grid, orNull(this->Swept), orNull(this->Pair.cavity) }, reach);
      break;
    case 4:
      level.referenceNumbers = isDescribed ? selfSimilarity(level.reference) : Numbers();
      break;
    case 5:
      level.restNumbers = isDescribed ? selfSimilarity(level.rest) : Numbers();
      break;
    case 6:
      this->Compare = makeSimilarity(this->stage().similarity, level, this->Start);
      break;
    case 7:
      this->compareHere();
      break;
    default:
      this->IsPrepared = true;
      this->beginLevel();
  }
}

bool Refinement::isWorthIt(const Agreement& here) const
{
  if (this->Progress.level == 0 || this->stage().mostDisagreement >= 1.0)
  {
    return true;
  }
  const Grid& rest = this->Pair.rest.grid;
  const RefinementStage& former = this->Settings.stages[this->Progress.level - 1];
  const Grid coarser = coarseGrid(rest, spacingOf(former, rest, this->TissueShare));
  return here.disagreement <= this->stage().mostDisagreement &&
    pointVolume(this->Level.rest.grid) < FinerVolume * pointVolume(coarser);
}

// Ends the level where it is not worth it.
void Refinement::compareHere()
{
  this->Here = this->Compare(this->Controls);
  if (!this->isWorthIt(this->Here))
  {
    this->finishLevel();
    this->Progress.level -= this->Progress.isFinished ? 1 : 0; // of the last one that was used
    return;
  }
  const glm::dvec3& spacing = this->Level.rest.grid.spacing;
  this->LongestStepMm = LongestStepPoints * std::max(spacing.x, std::max(spacing.y, spacing.z));
  this->Level = {};
}

void Refinement::beginLevel()
{
  Agreement& here = this->Here;
  this->Stride = 1.0;
  Agreement atStart = this->Compare(this->StartControls);
  this->Progress.disagreementAtStart = atStart.disagreement;
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

void Refinement::findStep(Trial& trial) const
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

Refinement::Outcome Refinement::tryStep(Trial& trial)
{
  std::vector<glm::vec3> controls = this->Controls;
  for (std::size_t i = 0; i < controls.size(); ++i)
  {
    controls[i] += static_cast<float>(trial.share) * trial.step[i];
  }
  Lattice candidate = this->latticeOf(controls);
  const double kept = this->Settings.guards ? this->Guard.share(this->Bent, candidate) : 1.0;
  if (kept < 1.0 && trial.stiffenings++ < MostStiffenings)
  {
    this->stiffen();
    this->findStep(trial);
    return Outcome::Open;
  }
  if (kept < 1.0)
  {
    candidate = between(this->Bent, candidate, kept);
    controls = turned(candidate.displacements, glm::transpose(candidate.grid.direction));
  }
  Agreement agreement = this->Compare(controls);
  const double energy = this->energyOf(controls, agreement);
  if (energy >= this->Energy)
  {
    trial.share *= 0.5;
    return Outcome::Open;
  }
  const double gain = this->Energy - energy;
  this->Progress.movedMm = trial.share * kept * trial.lengthMm;
  this->Progress.share = std::min(this->Progress.share, kept);
  this->take(candidate, std::move(agreement), energy);
  this->Stride = std::min(LongestStride, StrideGrowth * std::max(1.0, trial.share));
  return gain > Converged * energy ? Outcome::Improved : Outcome::Settled;
}

void Refinement::finishLevel()
{
  this->Compare = {};
  this->Level = {};
  this->PreparedParts = 0;
  this->IsPrepared = false;
  this->StepsOfLevel = 0;
  if (++this->LevelsDone < static_cast<int>(this->Settings.stages.size()))
  {
    this->Progress.level = this->LevelsDone;
  }
  else
  {
    this->Progress.isFinished = true;
    this->Pair = {};
  }
}

void Refinement::tellDone()
{
  const double levels = static_cast<double>(this->Settings.stages.size());
  const double ofLevel = static_cast<double>(this->StepsOfLevel) / this->Settings.mostSteps;
  this->Progress.done = this->Progress.isFinished ? 1.0 : (this->Progress.level + ofLevel) / levels;
}

const RefinementProgress& Refinement::step()
{
  if (this->Progress.isFinished)
  {
    return this->Progress;
  }
  if (!this->IsPrepared)
  {
    this->prepareLevel();
  }
  else if (const Outcome outcome = this->tryStep(); outcome != Outcome::Open)
  {
    ++this->Progress.steps;
    ++this->StepsOfLevel;
    if (outcome == Outcome::Settled || this->StepsOfLevel >= this->Settings.mostSteps)
    {
      this->finishLevel();
    }
  }
  this->tellDone();
  return this->Progress;
}

double Refinement::bytes(
  const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementSettings& settings)
{
  double most = 0.0;
  for (const RefinementStage& stage : settings.stages)
  {
    const Grid level = coarseGrid(rest, spacingOf(stage, rest, LeastTissue));
    // One of the two is smoothed at a time, with the lines that are smoothed beside it.
    const double smoothing = sizeof(float) * 2.0 * std::max(rest.count(), reference.count());
    const double points = static_cast<double>(level.count());
    most = std::max(most,
      smoothing + similarityBytes(stage.similarity, points) + 4.0 * sizeof(float) * points +
        LatticeRows::bytes(lattice.dimensions, level.dimensions));
  }
  return most + 40.0 * sizeof(float) * 3.0 * static_cast<double>(lattice.count());
}
}
