// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/PoseCounter.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr std::size_t MostWaiting = 4096;
constexpr double RateSeconds = 1.0;
}

void PoseCounter::add(const Pose& pose)
{
  ++this->state.poses;
  this->state.visible = true;
  this->state.device = pose.device;
  this->state.lastSeconds = pose.seconds;
  this->Waiting.push_back(pose);
  if (this->Waiting.size() > MostWaiting)
  {
    this->Waiting.pop_front();
    ++this->state.overrun;
  }
  this->Times.push_back(pose.seconds);
  while (this->Times.front() <= pose.seconds - RateSeconds)
  {
    this->Times.pop_front();
  }
}

std::vector<Pose> PoseCounter::take()
{
  std::vector<Pose> taken(this->Waiting.begin(), this->Waiting.end());
  this->Waiting.clear();
  return taken;
}

SourceState PoseCounter::stateAt(double seconds) const
{
  SourceState now = this->state;
  now.rate = static_cast<double>(std::count_if(this->Times.begin(), this->Times.end(),
               [seconds](double time) { return time > seconds - RateSeconds; })) /
    RateSeconds;
  return now;
}
}
