// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A pull or a pair of landmarks that is switched off has the weight 0. This keeps the weight that
/// it had, so that switching it on restores it while the window is open.
#ifndef BrainShift_FormerWeights_h
#define BrainShift_FormerWeights_h

#include "Filters/Fit/PackedTables.h"

#include <algorithm>
#include <vector>

namespace brainshift
{
class FormerWeights
{
public:
  /// Switches a pair on or off. Its weight is 1 if none is known. Switching on may be undone, so
  /// the weight stays known.
  void setOn(PointPair& pair, bool on)
  {
    if (on == isOn(pair))
    {
      return;
    }
    const auto known = std::find_if(this->Off.begin(), this->Off.end(),
      [&pair](const PointPair& off) { return off.rest == pair.rest; });
    const double weight = known == this->Off.end() ? 1.0 : known->weight;
    if (!on && known != this->Off.end())
    {
      *known = pair;
    }
    else if (!on)
    {
      this->Off.push_back(pair);
    }
    pair.weight = on ? weight : 0.0;
  }

private:
  std::vector<PointPair> Off; ///< As they were.
};
}

#endif
