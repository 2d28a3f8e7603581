// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/MovingQuality.h"

#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace brainshift
{
namespace
{
constexpr double InteractiveRate = 1.0;
// ParaView asks for 5 frames a second while the camera moves. A hand sees steps below 15; some
// pictures are slower than the average.
constexpr double SmoothRate = 18.0;
constexpr double LeastFractionForImage = 0.16; // of a picture's time, at least
constexpr double LongestPause = 0.5;           // seconds; in a longer pause the hand has rested
}

bool isMoving(double rate)
{
  return rate >= InteractiveRate;
}

double allowedSeconds(double rate, double windowSeconds, double spentSeconds)
{
  const double frame = 1.0 / std::max(rate, SmoothRate);
  return std::max(frame - windowSeconds - spentSeconds, LeastFractionForImage * frame);
}

WindowPace::Time WindowPace::now()
{
  return { vtkTimerLog::GetUniversalTime(), static_cast<double>(std::clock()) / CLOCKS_PER_SEC };
}

void WindowPace::beginPicture()
{
  this->Begin = WindowPace::now();
  this->learn(this->Begin.clock - this->End.clock, this->Begin.processor - this->End.processor);
}

void WindowPace::endPicture()
{
  this->End = WindowPace::now();
}

double WindowPace::spentSeconds() const
{
  return WindowPace::now().clock - this->Begin.clock;
}

void WindowPace::learn(double clock, double processor)
{
  if (clock >= 0.0 && clock < LongestPause) // a clock that is set may run backwards
  {
    this->Window += 0.3 * (std::min(clock, processor) - this->Window);
  }
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
