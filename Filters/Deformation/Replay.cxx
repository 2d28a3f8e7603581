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

// True if `strokes` holds the strokes of the last run, the last of which may differ.
bool Replay::startsAsBefore(
  const Lattice& base, const std::vector<Stroke>& strokes, const Guarding& guarding) const
{
  return this->Guarded == guarding && this->Base.grid == base.grid &&
    this->Base.kernel == base.kernel && this->Base.displacements == base.displacements &&
    sameMask(this->Base.mask, base.mask) && !this->Strokes.empty() &&
    strokes.size() >= this->Strokes.size() &&
    std::equal(this->Strokes.begin(), this->Strokes.end() - 1, strokes.begin());
}

// Applies a stroke to the result, which is what was before it. Returns the share of it.
double Replay::apply(const Stroke& stroke)
{
  this->BeforeLast = this->Result;
  applyStroke(this->Result, stroke);
  const double share = this->Guarded.on ? this->Guard.share(this->BeforeLast, this->Result) : 1.0;
  if (share < 1.0)
  {
    this->Result = between(this->BeforeLast, this->Result, share);
  }
  return share;
}

const Lattice& Replay::run(
  const Lattice& base, const std::vector<Stroke>& strokes, const Guarding& guarding)
{
  std::size_t next = 0; // first stroke that is not in BeforeLast yet
  if (this->startsAsBefore(base, strokes, guarding))
  {
    next = this->Strokes.size() - 1;
    if (strokes[next] == this->Strokes[next] && strokes.size() > this->Strokes.size())
    {
      this->BeforeLast = this->Result;
      ++next;
    }
  }
  else
  {
    this->Base = base;
    this->BeforeLast = base;
    this->Guarded = guarding;
    if (guarding.on)
    {
      this->Guard.setBase(base, guarding.samples);
    }
  }
  this->Applied = 0;
  this->Result = this->BeforeLast;
  this->Shares.resize(next);
  for (; next < strokes.size(); ++next)
  {
    this->Shares.push_back(this->apply(strokes[next]));
    ++this->Applied;
  }
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
