// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/ResultCheck.h"

#include "Filters/Register/RefinementSteps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int MostSteps = 20;          // of a run
constexpr double FarthestStart = 8.0;  // mm and degrees from the result
constexpr double NearestStart = 3.0;   // likewise, of searches that begin near
constexpr double LeastRivalMm = 2.0;   // a place that is nearer is the same
constexpr double LeastSamples = 800.0; // of a run over all of the compared part
constexpr double LeastOfHalf = 200.0;  // samples
constexpr double Finer = 0.5;          // times the spacing, if there are too few samples

// A motion by the spacing of the samples changes the cost by more than this, or they tell nothing.
// Flat tissue has the rounding of its smoothing, which is far below.
constexpr double LeastChange = 1e-6;

// Whether a comparison can move anything: else a run ends where it begins, which looks like a
// perfect result.
bool tellsPosition(const CostAndForces& compared, const Grid& samples)
{
  const double spacing = std::cbrt(pointVolume(samples));
  double weights = 0.0;
  for (std::size_t i = 0; i < compared.forces.size(); i += ForceNumbers)
  {
    weights += weightOf(&compared.forces[i]);
  }
  const double change = weights * spacing * spacing;
  return std::isfinite(compared.cost) && std::isfinite(change) && change > LeastChange;
}
}

ResultCheck::ResultCheck(RegisteredPair pair, const Lattice& result, const RefinementPlan& plan,
  std::unique_ptr<PyramidLevel> level)
  : Pair(std::move(pair))
  , Plan(plan)
  , Region(Pair, plan)
  , Result(result)
  , Now(wanted())
  , Level(std::move(level))
{
  if (this->Level)
  {
    this->Level->become(this->Now);
  }
  this->Run = this->Now.metric ? 0 : Runs;
}

ResultCheck::~ResultCheck() = default;

// A fan has its own limits.
RefinementLevel ResultCheck::wanted() const
{
  const RefinementLevel& level =
    this->isByOther() ? this->Plan.check.other : this->Plan.check.halves;
  return this->Plan.fan ? level : withinMemory(level, this->Pair.rest.grid);
}

bool ResultCheck::step()
{
  if (this->Run == Runs)
  {
    return false;
  }
  if (!this->Region.isFound())
  {
    this->Region.find(this->Pair, this->Result.grid);
  }
  else if (!this->Level || !this->Level->isPrepared())
  {
    this->prepare();
  }
  else if (!this->Step)
  {
    this->begin();
  }
  else
  {
    this->takeStep();
  }
  return this->Run < Runs;
}

void ResultCheck::prepare()
{
  if (!this->Level)
  {
    this->Level = std::make_unique<PyramidLevel>(this->Pair, this->Region, this->Now, this->Result);
    return;
  }
  this->Level->prepare();
}

void ResultCheck::begin()
{
  RefinementSettings settings;
  settings.plan = this->Plan;
  settings.guards = false; // nothing of it is kept
  settings.samples = 0;
  this->State = std::make_unique<RefinementState>(this->Result, settings);
  this->State->setStiffness(1.0);
  this->Steps = 0;
  if (!this->isHalf() && !this->isByOther())
  {
    const int number = this->Run - HalfRuns;
    this->State->moveTo(this->State->startNear(
      this->Region.middle(), number, number > FarRuns ? NearestStart : FarthestStart));
  }
  if (this->isByOther() || this->Weights.empty())
  {
    this->Level->restrictTo({});
    const CostAndForces all = this->Level->compare(this->State->controls);
    if (this->isTooCoarse(all.samples))
    {
      return;
    }
    if (this->Weights.empty())
    {
      this->weigh(all.forces);
    }
  }
  this->Level->restrictTo(this->isHalf() ? this->half() : HalfSpace{});
  CostAndForces here = this->Level->compare(this->State->controls);
  if (here.samples < LeastOfHalf || !tellsPosition(here, this->Level->grid()))
  {
    this->leaveOut();
    return;
  }
  this->State->beginLevel(here, here);
  this->Step = makeStep(this->Plan, this->Now, this->Level->grid());
}

// Makes the level finer, near what counts alone, or gives its metric up where it cannot be.
bool ResultCheck::isTooCoarse(double samples)
{
  if (samples >= LeastSamples)
  {
    return false;
  }
  RefinementLevel finer = this->Now;
  finer.spacingMm *= Finer;
  this->Region.crop(this->Pair, this->Result);
  const bool isFiner = this->Region.grid(finer).spacing != this->Region.grid(this->Now).spacing;
  this->Level = nullptr;
  if (isFiner && this->Region.allowsFiner(finer))
  {
    this->Now = finer;
    return true;
  }
  this->goTo(this->isByOther() ? Runs : OtherRun);
  return true;
}

HalfSpace ResultCheck::half() const
{
  HalfSpace half;
  half.normal = this->Pair.rest.grid.direction[this->Run / 2];
  half.normal *= this->Run % 2 ? -1.0 : 1.0;
  half.offsetMm = glm::dot(half.normal, this->Middle);
  return half;
}

void ResultCheck::weigh(const ControlForces& forces)
{
  const Grid& grid = this->Result.grid;
  double sum = 0.0;
  for (int k = 0; k < grid.dimensions.z; ++k)
  {
    for (int j = 0; j < grid.dimensions.y; ++j)
    {
      for (int i = 0; i < grid.dimensions.x; ++i)
      {
        const double weight = weightOf(&forces[this->Weights.size() * ForceNumbers]);
        this->Weights.push_back(weight);
        this->Middle += weight * grid.worldFromGrid({ i, j, k });
        sum += weight;
      }
    }
  }
  this->Middle /= std::max(sum, std::numeric_limits<double>::min());
}

void ResultCheck::takeStep()
{
  const StepOutcome outcome = this->Step->attempt(*this->State, *this->Level);
  if (outcome == StepOutcome::Settled || ++this->Steps == MostSteps)
  {
    this->finishRun();
  }
}

// The mean over the control points that samples move; absent if they move none.
std::optional<double> ResultCheck::motionMm(const Controls& a, const Controls& b) const
{
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += this->Weights[i] * glm::distance(a[i], b[i]);
    weights += this->Weights[i];
  }
  const double mean = sum / weights;
  return weights > 0.0 && std::isfinite(mean) ? std::optional<double>(mean) : std::nullopt;
}

void ResultCheck::leaveOut()
{
  this->State->controls.clear();
  this->finishRun();
}

void ResultCheck::finishHalf(const Controls& found)
{
  if (this->Run % 2 == 0)
  {
    this->FirstHalf = found;
  }
  else if (!found.empty() && !this->FirstHalf.empty())
  {
    if (const std::optional<double> mm = this->motionMm(found, this->FirstHalf))
    {
      this->SumOfHalves += *mm;
      ++this->Axes;
      this->Figures.halvesMm = this->SumOfHalves / this->Axes;
    }
  }
}

void ResultCheck::finishRival()
{
  const double cost = this->State->known.cost;
  if (this->Run == HalfRuns)
  {
    this->Cost = cost;
    return;
  }
  const Controls& from = this->State->startControls;
  const Controls& found = this->State->controls;
  const std::optional<double> mm = this->motionMm(found, from);
  const bool beganNear = this->Run - HalfRuns > FarRuns;
  if (mm && (beganNear || *mm <= LeastRivalMm))
  {
    this->addToSpread(*mm);
  }
  if (!(this->Cost > 0.0) || beganNear) // also rejects NaN
  {
    return;
  }
  const double gain = cost / this->Cost - 1.0;
  if (mm && *mm > LeastRivalMm && (!this->Figures.rivalGain || gain < *this->Figures.rivalGain))
  {
    this->Figures.rivalGain = gain;
    this->Figures.rivalMm = *mm;
    this->Figures.rivalMotion.resize(found.size());
    std::transform(
      found.begin(), found.end(), from.begin(), this->Figures.rivalMotion.begin(), std::minus<>());
  }
}

void ResultCheck::addToSpread(double mm)
{
  this->SumOfSquares += std::pow(std::min(mm, LeastRivalMm), 2.0);
  ++this->Ends;
  this->Figures.spreadMm = std::sqrt(this->SumOfSquares / this->Ends);
}

void ResultCheck::finishRun()
{
  const Controls& found = this->State->controls;
  if (this->isHalf())
  {
    this->finishHalf(found);
  }
  else if (!found.empty() && this->isByOther())
  {
    this->Figures.otherMm = this->motionMm(found, this->State->startControls);
  }
  else if (!found.empty())
  {
    this->finishRival();
  }
  this->goTo(this->Run + 1);
}

// Runs that the plan does not ask for are left out.
void ResultCheck::goTo(int run)
{
  const CheckPlan& check = this->Plan.check;
  this->Run = run == HalfRuns && check.rivalGain <= 0.0 ? OtherRun : run;
  if (this->isByOther() && !check.other.metric)
  {
    this->Run = Runs;
  }
  if (this->Run >= OtherRun)
  {
    this->Level = nullptr; // another metric, or the end
    this->Now = this->wanted();
  }
  else if (run == HalfRuns)
  {
    this->Now.part = Part::Quickest; // of a search
    this->Level->become(this->Now);
  }
  this->Step = nullptr;
  this->State = nullptr;
}
}
