// SPDX-License-Identifier: BSD-3-Clause
#include "MovingQuality.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double InteractiveRate = 1.0;
// ParaView asks for 5 a second while the camera moves. Below 15 a hand sees steps.
constexpr double SmoothRate = 15.0;
constexpr double LeastShareForImage = 0.2; // of a frame's time, however long a stroke takes
// What the window itself takes of it, which no mapper sees: ParaView's smoothing of edges, copies.
constexpr double ShareOfWindow = 0.5;
}

bool isMoving(double rate)
{
  return rate >= InteractiveRate;
}

double allowedSeconds(double rate, double spentSeconds)
{
  const double frame = 1.0 / std::max(rate, SmoothRate);
  return std::max((1.0 - ShareOfWindow) * frame - spentSeconds, LeastShareForImage * frame);
}

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
