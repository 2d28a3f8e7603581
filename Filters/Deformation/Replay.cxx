// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Replay.h"

#include <algorithm>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr int MostNamed = 3;
constexpr double Rounding = 1e-6; // of spacings that went through text

// How finely a stroke bends, mm; 0 if it takes whatever the lattice has.
double finestRadius(const Stroke& stroke)
{
  // Move: the spacing it was made at.
  return stroke.tool == Tool::Stamp ? std::min(stroke.major, stroke.minor) : stroke.major;
}
}

bool Replay::isFor(const Lattice& base, const Guarding& guarding) const
{
  return this->Guarded == guarding && this->Base.grid == base.grid &&
    this->Base.kernel == base.kernel && this->Base.displacements == base.displacements &&
    sameMask(this->Base.mask, base.mask);
}

void Replay::start(const Lattice& base, const Guarding& guarding)
{
  this->Base = base;
  this->Guarded = guarding;
  if (guarding.on)
  {
    this->Guard.setBase(base, guarding.samples);
  }
  this->Strokes.clear();
  this->Checkpoints.clear();
  this->PerCheckpoint = StrokesPerCheckpoint;
  this->BeforeLast = base;
  this->Result = base;
}

// Makes the result that of some of the first `same` strokes, which did not change, of `count` that
// are to be applied. Returns of how many. If it is not of all of the last run, one stroke at least
// is left, so that the lattice before the last one will be known.
std::size_t Replay::goBack(std::size_t same, std::size_t count)
{
  const std::size_t before = this->Strokes.size();
  while (!this->Checkpoints.empty() && this->Checkpoints.back().count > same)
  {
    this->Checkpoints.pop_back();
  }
  if (same == before)
  {
    return same;
  }
  if (same + 1 == before && count >= before)
  {
    this->Result = this->BeforeLast;
    return same;
  }
  const std::size_t most = std::min(same, std::max<std::size_t>(count, 1) - 1);
  const auto after = std::find_if(this->Checkpoints.rbegin(), this->Checkpoints.rend(),
    [&](const Checkpoint& checkpoint) { return checkpoint.count <= most; });
  this->Result = this->Base;
  if (after == this->Checkpoints.rend())
  {
    return 0;
  }
  this->Result.displacements = after->displacements;
  return after->count;
}

// Applies a share of a stroke. What was before it is kept.
void Replay::apply(const Stroke& stroke, double share)
{
  this->BeforeLast = this->Result;
  applyStroke(this->Result, stroke);
  if (share < 1.0)
  {
    this->Result = between(this->BeforeLast, this->Result, share);
  }
}

void Replay::keepCheckpoint(std::size_t count)
{
  const std::size_t bytes = this->Result.displacements.size() * sizeof(glm::vec3);
  if (count % this->PerCheckpoint != 0 || 2 * bytes > MostCheckpointBytes ||
    (!this->Checkpoints.empty() && this->Checkpoints.back().count >= count))
  {
    return;
  }
  this->Checkpoints.push_back({ count, this->Result.displacements });
  if (this->Checkpoints.size() * bytes > MostCheckpointBytes)
  {
    this->PerCheckpoint *= 2;
    this->Checkpoints.erase(
      std::remove_if(this->Checkpoints.begin(), this->Checkpoints.end(),
        [&](const Checkpoint& checkpoint) { return checkpoint.count % this->PerCheckpoint != 0; }),
      this->Checkpoints.end());
  }
}

const Lattice& Replay::run(
  const Lattice& base, const std::vector<Stroke>& strokes, const Guarding& guarding)
{
  if (!this->isFor(base, guarding))
  {
    this->start(base, guarding);
  }
  const std::size_t common = std::min(strokes.size(), this->Strokes.size());
  const std::size_t same = static_cast<std::size_t>(
    std::mismatch(strokes.begin(), strokes.begin() + common, this->Strokes.begin()).first -
    strokes.begin());
  const std::size_t first = this->goBack(same, strokes.size());
  this->Shares.resize(same);
  this->Reaches.resize(same);
  for (std::size_t next = first; next < strokes.size(); ++next)
  {
    if (next < same)
    {
      this->apply(strokes[next], this->Shares[next]);
    }
    else
    {
      this->apply(strokes[next], 1.0);
      const double share =
        this->Guarded.on ? this->Guard.share(this->BeforeLast, this->Result) : 1.0;
      if (share < 1.0)
      {
        this->Result = between(this->BeforeLast, this->Result, share);
      }
      this->Shares.push_back(share);
      this->Reaches.push_back(reachOf(this->BeforeLast, this->Result, strokes[next]));
    }
    this->keepCheckpoint(next + 1);
  }
  this->Applied = static_cast<int>(strokes.size() - first);
  this->Strokes = strokes;
  return this->Result;
}

std::string strokesTooFine(const std::vector<Stroke>& strokes, const Grid& lattice)
{
  const double spacing = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  std::ostringstream named;
  int count = 0;
  for (std::size_t number = 0; number < strokes.size(); ++number)
  {
    const double radius = finestRadius(strokes[number]);
    if (!strokes[number].enabled || radius <= 0.0 || radius >= spacing * (1.0 - Rounding))
    {
      continue;
    }
    if (count < MostNamed)
    {
      named << (count ? ", " : "") << number << " (" << radius << " mm)";
    }
    ++count;
  }
  if (count == 0)
  {
    return {};
  }
  if (count > MostNamed)
  {
    named << " and " << count - MostNamed << " more";
  }
  std::ostringstream sentence;
  sentence << "The lattice is too coarse for the radius of stroke " << named.str()
           << ": its spacing is " << spacing << " mm. Make LatticeDimensions larger";
  return sentence.str();
}
}
