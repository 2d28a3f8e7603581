// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Refinement.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
// Bytes of a control point: lists of displacements and forces.
constexpr double BytesPerControl = 40.0 * sizeof(float) * 3.0;

// Of so many positions near the start, the search begins from the one with the least cost.
constexpr int ComparedForStart = 8;

constexpr double Unknown = -1.0; // cost

void sortByCost(std::vector<RigidPosition>& positions)
{
  std::sort(positions.begin(), positions.end(),
    [](const RigidPosition& a, const RigidPosition& b) { return a.cost < b.cost; });
}
}

Refinement::Refinement(
  RegisteredPair pair, const Lattice& start, const RefinementSettings& settings)
  : Pair(std::move(pair))
  , Settings(settings)
  , State(start, settings)
  , Region(Pair, settings.plan)
{
  this->State.setStiffness(this->Region.stiffness());
  this->Shown = this->State.progress;
}

void Refinement::beginAt(const Lattice& lattice, const Controls& motion)
{
  this->State.moveTo(lattice);
  this->State.moveTo(this->State.candidateAt(motion, 1.0).lattice);
  this->BeganElsewhere = true;
}

const RefinementProgress& Refinement::step()
{
  if (this->Shown.isFinished)
  {
    return this->Shown;
  }
  if (!this->Region.isFound())
  {
    this->Region.find(this->Pair, this->State.start.grid);
    this->State.setStiffness(this->Region.stiffness());
  }
  else if (!this->Here)
  {
    this->prepareLevel();
  }
  else if (!this->Step)
  {
    this->beginLevel();
  }
  else if (!this->Near.empty())
  {
    this->compareNear();
  }
  else
  {
    this->takeStep();
  }
  this->report();
  return this->Shown;
}

void Refinement::prepareLevel()
{
  if (!this->Level)
  {
    this->Level =
      std::make_unique<PyramidLevel>(this->Pair, this->Region, this->level(), this->State.start);
  }
  if (!this->Level->isPrepared())
  {
    this->Level->prepare();
    return;
  }
  this->Here = std::make_unique<CostAndForces>(this->Level->compare(this->State.controls));
  if (!std::isfinite(this->Here->cost))
  {
    this->State.progress.cost = this->Here->cost;
    this->State.progress.isFinished = true;
    this->Level = nullptr;
    return;
  }
  const std::vector<RefinementLevel>& levels = this->Settings.plan.levels;
  if (this->Index > 0 &&
    !this->Region.isWorthwhile(this->level(), levels[this->Index - 1], this->Here->cost))
  {
    this->finishLevel();
  }
}

void Refinement::beginLevel()
{
  if (!this->AtStart)
  {
    const bool isThere = this->State.controls == this->State.startControls;
    this->AtStart = std::make_unique<CostAndForces>(
      isThere ? *this->Here : this->Level->compare(this->State.startControls));
  }
  if (this->Index == 0 && this->Found.empty() && this->Open.empty())
  {
    this->findStarts();
  }
  this->State.setStiffness(this->level().stiffness * this->Region.stiffness());
  this->Step = makeStep(this->Settings.plan, this->level(), this->Level->grid());
  this->LastUsed = this->Index;
  this->State.beginLevel(std::move(*this->Here), *this->AtStart);
  if (!this->level().isRigid && !this->BeganElsewhere)
  {
    this->State.returnIfWorse(*this->AtStart);
  }
  this->reportOverlap();
}

void Refinement::findStarts()
{
  const int starts = this->level().isRigid ? std::clamp(this->Settings.starts, 1, MostStarts) : 1;
  for (int number = 1; number <= ComparedForStart * (starts - 1); ++number)
  {
    this->Near.push_back(this->State.startNear(this->Region.middle(), number));
    this->Near.back().cost = Unknown;
  }
}

// Compares a position near the start. Once all are compared, the search begins from the best.
void Refinement::compareNear()
{
  const auto next = std::find_if(this->Near.begin(), this->Near.end(),
    [](const RigidPosition& position) { return position.cost == Unknown; });
  next->cost = this->Level->compare(next->controls).cost;
  if (next + 1 != this->Near.end())
  {
    return;
  }
  sortByCost(this->Near);
  this->Near.resize(this->Near.size() / ComparedForStart);
  std::reverse(this->Near.begin(), this->Near.end()); // the last one begins
  this->Open = std::move(this->Near);
  this->Near.clear();
}

void Refinement::begin(const RigidPosition& position)
{
  this->State.moveTo(position);
  this->Step = nullptr;
  this->Here = nullptr;
  this->StepsOfLevel = 0;
}

void Refinement::takeStep()
{
  const StepOutcome outcome = this->Step->attempt(this->State, *this->Level);
  this->reportOverlap();
  if (outcome == StepOutcome::Open)
  {
    return;
  }
  ++this->State.progress.steps;
  ++this->StepsOfLevel;
  if (outcome == StepOutcome::Settled ||
    this->StepsOfLevel >= this->Settings.mostStepsOf(this->level()))
  {
    this->finishPosition();
  }
}

void Refinement::reportOverlap()
{
  // Of one support alone: with another one, overlaps would not compare.
  const Support& first = this->Settings.plan.levels.front().metric->support;
  const Support& here = this->level().metric->support;
  if (here.along == first.along && here.across == first.across)
  {
    this->State.progress.overlap = this->Region.overlap(this->State.known, this->Level->grid());
  }
}

// A search that began at a random position may still be far from the best result.
const Refinement::Result* Refinement::better() const
{
  return this->Best && (!this->Step || this->Best->cost <= this->State.known.cost) ? &*this->Best
                                                                                   : nullptr;
}

void Refinement::report()
{
  const double levels = static_cast<double>(this->Settings.plan.levels.size());
  const double positions = static_cast<double>(this->Found.size() + this->Open.size() + 1);
  const double part = static_cast<double>(this->Found.size()) +
    static_cast<double>(this->StepsOfLevel) / this->Settings.mostStepsOf(this->level());
  this->Shown = this->State.progress;
  this->Shown.done = this->Shown.isFinished ? 1.0 : (this->Index + part / positions) / levels;
  if (const Result* best = this->better())
  {
    this->Shown.cost = best->cost;
    this->Shown.overlap = best->overlap;
  }
}

void Refinement::finishPosition()
{
  this->Found.push_back(this->State.position());
  if (!this->Best || this->State.known.cost < this->Best->cost)
  {
    this->Best = { this->State.bent, this->State.known.cost, this->State.progress.overlap };
  }
  if (this->Open.empty())
  {
    this->finishLevel();
    return;
  }
  const RigidPosition next = this->Open.back();
  this->Open.pop_back();
  this->begin(next);
}

void Refinement::finishLevel()
{
  const std::vector<RefinementLevel>& levels = this->Settings.plan.levels;
  const std::size_t next = static_cast<std::size_t>(this->Index) + 1;
  if (this->Found.size() > 1)
  {
    sortByCost(this->Found);
    this->Open.assign(this->Found.begin() + 1,
      this->Found.begin() + std::min<std::size_t>(this->level().kept, this->Found.size()));
    this->begin(this->Found.front());
  }
  else
  {
    this->begin(this->State.position());
  }
  this->Found.clear();
  this->AtStart = nullptr;
  if (this->Best)
  {
    this->State.progress.cost = this->Best->cost;
    this->State.progress.overlap = this->Best->overlap;
    this->Best = std::nullopt;
  }
  if (next == levels.size())
  {
    this->State.progress.isFinished = true;
    this->State.progress.level = this->LastUsed;
    if (!this->level().isComparedLike(this->Settings.plan.check.halves))
    {
      this->Level = nullptr;
    }
    return;
  }
  if (this->level().isComparedLike(levels[next])) // most of it is prepared
  {
    this->Level->become(levels[next]);
  }
  else
  {
    this->Level = nullptr;
  }
  ++this->Index;
  this->State.progress.level = this->Index;
}

double Refinement::bytes(
  const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementSettings& settings)
{
  double most = 0.0;
  for (const RefinementLevel& level : settings.plan.levels)
  {
    most = std::max(most, PyramidLevel::bytes(rest, reference, lattice, level));
  }
  return most + BytesPerControl * static_cast<double>(lattice.count());
}
}
