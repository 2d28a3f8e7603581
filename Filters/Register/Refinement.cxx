// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Refinement.h"

#include "Filters/Register/SelfSimilarity.h"
#include "Filters/Register/Sweep.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
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
constexpr int PartsBeforeComparison = 7; // that prepare a level

constexpr int RigidStepsPerStep = 3; // on a level where the volume moves as a whole

// By ultrasound: speckle can be fitted better by bends that are not there. Of what was seen there
// are so many samples at most, so that a step stays short.
constexpr double SpeckleStiffness = 5.0;
constexpr double MostSeenSamples = 0.25e6;

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

double boxVolume(const Grid& grid)
{
  const glm::dvec3 sides = grid.spacing * glm::dvec3(grid.dimensions - 1);
  return sides.x * sides.y * sides.z;
}

bool compareAlike(const RefinementStage& a, const RefinementStage& b)
{
  return a.similarity == b.similarity && a.spacingMm == b.spacingMm &&
    a.mostDisagreement == b.mostDisagreement;
}
}

std::vector<RefinementStage> stagesOf(SimilarityKind kind)
{
  if (kind == SimilarityKind::LinearCombination)
  {
    // Speckle misleads each place on its own, but not all of them together.
    return { { kind, 2.0, 1.0, true }, { kind, 1.0, 1.0, true }, { kind, 1.0 } };
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
  , StartControls(controlsOf(start))
  , Unbent(StartControls)
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
    bend[i] -= this->Unbent[i];
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

std::vector<glm::vec3> Refinement::controlsOf(const Lattice& lattice)
{
  return turned(lattice.displacements, glm::transpose(lattice.grid.direction));
}

void Refinement::take(const Lattice& lattice, Agreement agreement, double energy)
{
  this->Bent = lattice;
  this->Controls = controlsOf(lattice);
  this->Known = std::move(agreement);
  this->Energy = energy;
  this->Progress.disagreement = this->Known.disagreement;
  if (this->isUltrasound())
  {
    const double comparedMm3 = this->Known.samples * this->PointMm3;
    this->Progress.comparedShare = std::min(1.0, comparedMm3 / std::max(1.0, this->SeenMm3));
  }
  // Of the first similarity alone: another one reaches farther, and shares would not compare.
  else if (this->stage().similarity == this->Settings.stages.front().similarity)
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
  const Grid grid = coarseGrid(rest, this->spacingMmOf(stage));
  return this->isUltrasound() ? croppedTo(grid, this->Swept, FarthestMm) : grid;
}

double Refinement::spacingMmOf(const RefinementStage& stage) const
{
  return this->isUltrasound()
    ? std::max(stage.spacingMm, std::cbrt(this->SeenMm3 / MostSeenSamples))
    : spacingOf(stage, this->Pair.rest.grid, this->TissueShare);
}

void Refinement::findSwept()
{
  this->Swept = sweptRegion(this->Pair.reference);
  const double seen = static_cast<double>(
    std::count(this->Swept.inside.begin(), this->Swept.inside.end(), static_cast<char>(1)));
  this->SeenMm3 = std::min(pointVolume(this->Swept.grid) * seen, boxVolume(this->Start.grid));
  this->Stiff = Stiffness(this->Start.grid, this->stiffnessFactor() * this->Progress.stiffness);
}

// The stiffness is a mean over the lattice, and the disagreement one over what a sweep saw. Without
// the factor, a volume would be the softer the less of it was seen.
double Refinement::stiffnessFactor() const
{
  return this->isUltrasound()
    ? SpeckleStiffness * boxVolume(this->Start.grid) / std::max(1.0, this->SeenMm3)
    : 1.0;
}

int Refinement::mostStepsOfLevel() const
{
  return this->Settings.mostSteps * (this->stage().isRigid ? RigidStepsPerStep : 1);
}

// Each part takes about as long as a step, so that whoever calls can do other things in between.
void Refinement::prepareLevel()
{
  if (this->isUltrasound() && this->Swept.inside.empty())
  {
    this->findSwept();
    return;
  }
  const double spacingMm = this->spacingMmOf(this->stage());
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
    case PartsBeforeComparison:
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
  const Grid coarser = coarseGrid(rest, this->spacingMmOf(former));
  return here.disagreement <= this->stage().mostDisagreement &&
    pointVolume(this->gridOf(this->stage())) < FinerVolume * pointVolume(coarser);
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
  const glm::dvec3 spacing = this->gridOf(this->stage()).spacing;
  this->PointMm3 = spacing.x * spacing.y * spacing.z;
  this->LongestStepMm = LongestStepPoints * std::max(spacing.x, std::max(spacing.y, spacing.z));
  this->Level = {};
}

void Refinement::beginLevel()
{
  Agreement& here = this->Here;
  this->Stride = this->firstStride();
  Agreement atStart = this->Compare(this->StartControls);
  this->Progress.disagreementAtStart = atStart.disagreement;
  this->SamplesAtStart = atStart.samples;
  const double energy = this->energyOf(this->Controls, here);
  if (energy > atStart.disagreement)
  {
    const double startEnergy = atStart.disagreement;
    this->Unbent = this->StartControls;
    this->take(this->Start, std::move(atStart), startEnergy);
  }
  else
  {
    this->take(this->Bent, std::move(here), energy);
  }
}

void Refinement::finishLevel()
{
  const RefinementStage& done = this->stage();
  const bool isLast = this->LevelsDone + 1 == static_cast<int>(this->Settings.stages.size());
  // What compares alike need not be prepared again.
  const bool isKept = !isLast && compareAlike(done, this->Settings.stages[this->LevelsDone + 1]);
  this->Compare = isKept ? std::move(this->Compare) : Similarity{};
  this->Level = {};
  this->PreparedParts = isKept ? PartsBeforeComparison : 0;
  this->IsPrepared = false;
  this->StepsOfLevel = 0;
  ++this->LevelsDone;
  if (!isLast)
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
  const double ofLevel = static_cast<double>(this->StepsOfLevel) / this->mostStepsOfLevel();
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
  else if (const Outcome outcome = this->stage().isRigid ? this->moveRigidly() : this->tryStep();
    outcome != Outcome::Open)
  {
    ++this->Progress.steps;
    ++this->StepsOfLevel;
    if (outcome == Outcome::Settled || this->StepsOfLevel >= this->mostStepsOfLevel())
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
