// SPDX-License-Identifier: BSD-3-Clause
#include "MovingQuality.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
MovingQuality movingQuality(double fullSeconds, double allowedSeconds)
{
  MovingQuality quality;
  const double tooSlow = fullSeconds / allowedSeconds;
  const int scale = static_cast<int>(std::ceil(std::sqrt(std::min(tooSlow, 1e6))));
  quality.imageScale = std::clamp(scale, 1, LargestImageScale);
  double left = tooSlow / (LargestImageScale * LargestImageScale);
  while (left > 1.0 && quality.stepDoublings < MostStepDoublings)
  {
    quality.stepDoublings += 1;
    left *= 0.5;
  }
  return quality;
}
}
