// SPDX-License-Identifier: BSD-3-Clause
#include "Replay.h"

#include <algorithm>

namespace brainshift
{
// True if `strokes` holds the strokes of the last run, the last of which may differ.
bool Replay::startsAsBefore(const Lattice& base, const std::vector<Stroke>& strokes) const
{
  return this->Base.grid == base.grid && this->Base.kernel == base.kernel &&
    this->Base.displacements == base.displacements && !this->Strokes.empty() &&
    strokes.size() >= this->Strokes.size() &&
    std::equal(this->Strokes.begin(), this->Strokes.end() - 1, strokes.begin());
}

const Lattice& Replay::run(const Lattice& base, const std::vector<Stroke>& strokes)
{
  std::size_t next = 0; // first stroke that is not in BeforeLast yet
  if (this->startsAsBefore(base, strokes))
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
  }
  this->Applied = 0;
  this->Result = this->BeforeLast;
  for (; next < strokes.size(); ++next)
  {
    this->BeforeLast = this->Result;
    applyStroke(this->Result, strokes[next]);
    ++this->Applied;
  }
  this->Strokes = strokes;
  return this->Result;
}
}
