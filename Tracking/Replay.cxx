// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/Replay.h"

#include <chrono>
#include <utility>

namespace brainshift
{
namespace
{
double machineSeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}

Replay::Replay(Session session, std::function<double()> clock)
  : Played(std::move(session))
  , Clock(clock ? std::move(clock) : machineSeconds)
  , Start(this->Clock())
{
  this->Counter.state.phase = SourceState::Phase::Running;
}

double Replay::now() const
{
  return this->Clock() - this->Start;
}

std::vector<Pose> Replay::take()
{
  // From the first pose on: a recording may begin long after its server.
  const std::vector<Pose>& poses = this->Played.poses;
  const double now = this->now();
  for (; this->Next < poses.size(); ++this->Next)
  {
    Pose pose = poses[this->Next];
    pose.seconds -= poses.front().seconds;
    if (pose.seconds > now)
    {
      return this->Counter.take();
    }
    this->Counter.add(pose);
  }
  this->Counter.state.phase = SourceState::Phase::Ended;
  this->Counter.state.problem = "The recorded session is at its end";
  return this->Counter.take();
}

SourceState Replay::state() const
{
  return this->Counter.stateAt(this->now());
}
}
