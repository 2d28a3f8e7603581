// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Trust.h"

#include "Common/Numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
// A result fails by one check alone if its figure is so many times its limit.
constexpr double FarBeyond = 1.5;

// From this fraction of the most scatter on, a result is doubtful.
constexpr double DoubtfulScatter = 0.9;

// The least gain of mutual information by another orientation, as a fraction.
constexpr double LeastGain = 0.1;

// Noise has a mutual information of 0.04 to 0.06 nats in any orientation.
constexpr double LeastInformation = 0.1;

// The least fraction by which the cost is less far within the outline than beside a right result. A
// result with less than the second number fails by it alone.
constexpr double LeastGainInside = 0.2;
constexpr double FailedGainInside = 0.15;

std::string inMm(double mm)
{
  return roundedText(mm) + " mm";
}

std::string textOf(const Elsewhere& blocks, const std::string& verb)
{
  const glm::dvec3& at = blocks.middle;
  return roundedText(blocks.ml) + " ml of tissue around " + roundedText(at.x) + " " +
    roundedText(at.y) + " " + roundedText(at.z) + " mm " + verb + " better elsewhere, " +
    inMm(blocks.mm) + " away on average";
}

double timesLimit(const std::optional<double>& figure, double limit)
{
  return figure ? *figure / limit : 0.0;
}
}

const char* nameOf(Trust trust)
{
  constexpr const char* Names[] = { "unchecked", "good", "doubtful", "failed" };
  return Names[static_cast<int>(trust)];
}

void Verdict::lower(Trust to, const std::string& reason)
{
  this->trust = std::max(this->trust, to);
  this->reasons.push_back(reason);
}

namespace
{
// What halves and another metric say, each by its own limit.
void judgeHalvesAndOther(const CheckFigures& figures, const CheckPlan& limits, Verdict& verdict)
{
  const double halves = timesLimit(figures.halvesMm, limits.halvesMm);
  const double other = timesLimit(figures.otherMm, limits.otherMm);
  const bool hasFailed = (halves > 1.0 && other > 1.0) || std::max(halves, other) > FarBeyond;
  const Trust trust = hasFailed ? Trust::Failed : Trust::Doubtful;
  if (halves > 1.0)
  {
    verdict.lower(trust,
      "Halves of what was compared, registered apart from the result, end " +
        inMm(figures.halvesMm.value_or(0.0)) +
        " from each other on average; right results differ by up to " + inMm(limits.halvesMm) +
        ".");
  }
  if (other > 1.0)
  {
    verdict.lower(trust,
      "Another similarity moves the result by " + inMm(figures.otherMm.value_or(0.0)) +
        " on average; it moves right results by up to " + inMm(limits.otherMm) + ".");
  }
}

// Either figure alone tells less than both together.
void judgeScatter(const CheckFigures& figures, const CheckPlan& limits, Verdict& verdict)
{
  const double halves = figures.halvesMm.value_or(0.0);
  const double spread = figures.spreadMm.value_or(0.0);
  const double scatter = std::sqrt(halves * spread);
  if (scatter > DoubtfulScatter * limits.scatterMm)
  {
    verdict.lower(scatter > limits.scatterMm ? Trust::Failed : Trust::Doubtful,
      "Registrations of parts and from places nearby scatter by " + inMm(scatter) +
        "; a result is doubtful above " + inMm(DoubtfulScatter * limits.scatterMm) +
        " and fails above " + inMm(limits.scatterMm) + ". (Halves of what was compared end " +
        inMm(halves) + " from each other on average, searches around the result " + inMm(spread) +
        " from it; their geometric mean counts.)");
  }
}

// Whether another place nearby matches as well.
void judgeRival(const CheckFigures& figures, const CheckPlan& limits, Verdict& verdict)
{
  if (!figures.rivalGain || *figures.rivalGain >= limits.rivalGain)
  {
    return;
  }
  const bool isSecond = verdict.trust == Trust::Doubtful; // of two checks that found a fault
  const bool isBetter = *figures.rivalGain < 0.0;
  verdict.lower(isSecond ? Trust::Failed : Trust::Doubtful,
    "A search from places nearby ends " + inMm(figures.rivalMm) +
      " away on average, where the volumes match " + (isBetter ? "better" : "nearly as well") +
      ": the cost is " + roundedText(100.0 * std::abs(*figures.rivalGain)) + " percent " +
      (isBetter ? "less" : "more") + "; of right results it is at least " +
      roundedText(100.0 * limits.rivalGain) +
      " percent more. Start nearer to the right place, or from several places.");
}
}

Verdict verdictOf(const CheckFigures& figures, const CheckPlan& limits)
{
  Verdict verdict;
  if (!figures.halvesMm && !figures.otherMm)
  {
    verdict.reasons.push_back("The result was not checked, because too little was compared that "
                              "tells where tissue belongs.");
    return verdict;
  }
  verdict.trust = Trust::Good;
  if (limits.scatterMm > 0.0 && figures.halvesMm && figures.spreadMm)
  {
    judgeScatter(figures, limits, verdict);
  }
  else
  {
    judgeHalvesAndOther(figures, limits, verdict);
  }
  judgeRival(figures, limits, verdict);
  return verdict;
}

std::string orientationReason(
  const Orientation& asItIs, const Orientation& other, const glm::dmat3& axes)
{
  const double now = asItIs.information;
  const double best = other.information;
  if (best <= (1.0 + LeastGain) * now || best < LeastInformation)
  {
    return {};
  }
  return "The reference matches the volume better if it is " + orientationText(other.matrix, axes) +
    ": mutual information " + roundedText(best) + " nats in place of " + roundedText(now) +
    ". Check in which orientation the two volumes were read.";
}

std::string insideReason(const std::optional<double>& gain, double besideMm)
{
  if (!gain || *gain > LeastGainInside)
  {
    return {};
  }
  const std::string percent = roundedText(100.0 * std::abs(*gain));
  return "Far within the outlines the volumes match no better than " + inMm(besideMm) +
    " beside the result: the cost is " + percent +
    (*gain < 0.0 ? " percent more" : " percent less") + "; a result is doubtful below " +
    roundedText(100.0 * LeastGainInside) +
    " percent less, and right ones are far above. The tissue may be another one.";
}

std::string elsewhereReason(const Elsewhere& blocks)
{
  if (!(blocks.ml > 0.0))
  {
    return {};
  }
  return textOf(blocks, "match") +
    ". Bend the volume there by hand, or give the deformation a mask of the tissue that moves, "
    "and refine again.";
}

std::string broughtReason(const Elsewhere& blocks)
{
  return textOf(blocks, "matched") +
    ", so the refinement went on from there. Look at the result. A mask of the tissue that moves "
    "makes it more exact.";
}

std::string movedReason(double mm)
{
  return "The refinement had ended " + inMm(mm) +
    " away on average from a place that matches better, and went on from there.";
}

Verification::Verification(RegisteredPair pair, const Lattice& start, const Lattice& result,
  const RefinementPlan& plan, std::unique_ptr<PyramidLevel> level)
  : Check(std::move(pair), result, plan, std::move(level))
  , Limits(plan.check)
  , IsOfHeads(!plan.fan)
  , Start(start)
  , Result(result)
{
}

// A fan is checked on levels that the refinement has.
double Verification::bytes(
  const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementPlan& plan)
{
  double most = 0.0;
  for (const RefinementLevel& level : { plan.check.halves, plan.check.other })
  {
    if (level.metric && !plan.fan)
    {
      most =
        std::max(most, PyramidLevel::bytes(rest, reference, lattice, withinMemory(level, rest)));
    }
  }
  return most;
}

bool Verification::finishCheck()
{
  this->Found = verdictOf(this->Check.figures(), this->Limits);
  // Of a few samples, chance makes one orientation better than another.
  this->IsFinished = !this->IsOfHeads || this->Found.trust == Trust::Unchecked;
  if (!this->IsFinished)
  {
    this->Inside =
      std::make_unique<InsideCheck>(this->Check.pair(), this->Result, this->Limits.halves);
  }
  return !this->IsFinished;
}

bool Verification::finishInside()
{
  const std::optional<double> gain = this->Inside->gain();
  const std::string reason = insideReason(gain, this->Inside->besideMm());
  if (!reason.empty())
  {
    const bool isSecond = this->Found.trust == Trust::Doubtful; // of two checks that found a fault
    const bool hasFailed = isSecond || *gain < FailedGainInside;
    this->Found.lower(hasFailed ? Trust::Failed : Trust::Doubtful, reason);
  }
  if (this->Limits.blocks.make)
  {
    this->Blocks =
      std::make_unique<BlockCheck>(this->Check.pair(), this->Result, this->Limits.blocks);
  }
  return true;
}

void Verification::finishBlocks()
{
  const std::string reason = elsewhereReason(this->elsewhere());
  if (!reason.empty())
  {
    const bool isSecond = this->Found.trust == Trust::Doubtful;
    this->Found.lower(isSecond ? Trust::Failed : Trust::Doubtful, reason);
  }
  this->Search = std::make_unique<OrientationSearch>(this->Check.pair(), this->Start, this->Result);
}

Controls Verification::motionOfBlocks() const
{
  return this->Blocks ? this->Blocks->motion() : Controls(this->Result.grid.count());
}

void Verification::finishSearch()
{
  const std::string reason = orientationReason(
    this->Search->asItIs(), this->Search->bestOther(), this->Check.pair().rest.grid.direction);
  if (!reason.empty())
  {
    this->Found.lower(Trust::Failed, reason);
  }
  this->IsFinished = true;
}

bool Verification::step()
{
  if (this->IsFinished)
  {
    return false;
  }
  if (!this->Inside)
  {
    return this->Check.step() || this->finishCheck();
  }
  if (this->Inside->step())
  {
    return true;
  }
  if (!this->HasInside)
  {
    this->HasInside = this->finishInside();
    return true;
  }
  if (this->Blocks && this->Blocks->step())
  {
    return true;
  }
  if (!this->Search)
  {
    this->finishBlocks();
    return true;
  }
  if (this->Search->step())
  {
    return true;
  }
  this->finishSearch();
  return false;
}

double Verification::done() const
{
  constexpr double OfCheck = 0.5;
  constexpr double OfBlocks = 0.2;
  const double blocks = this->Search ? 1.0 : (this->Blocks ? this->Blocks->done() : 0.0);
  const double searched = this->Search ? this->Search->done() : 0.0;
  const double done =
    OfCheck * this->Check.done() + OfBlocks * blocks + (1.0 - OfCheck - OfBlocks) * searched;
  return this->IsFinished ? 1.0 : done;
}
}
