// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Replay.h"

#include <algorithm>

namespace brainshift
{
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
}
