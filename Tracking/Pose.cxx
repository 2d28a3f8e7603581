// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/Pose.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double FarthestMm = 1e6;
constexpr double RotationTolerance = 1e-2; // trackers send float32, some of them rounded
}

std::string problemOf(const Pose& pose)
{
  const glm::dmat3 product = glm::transpose(pose.rotation) * pose.rotation;
  for (int i = 0; i < 3; ++i)
  {
    if (!std::isfinite(pose.tip[i]))
    {
      return "The pose has a number that is not finite";
    }
    if (std::abs(pose.tip[i]) > FarthestMm)
    {
      return "The tip is farther than 1000000 mm";
    }
    for (int j = 0; j < 3; ++j)
    {
      // Not "greater than": NaN is no rotation either.
      if (!(std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) <= RotationTolerance))
      {
        return "The matrix of the pose is not a rotation";
      }
    }
  }
  return glm::determinant(pose.rotation) > 0.0 ? "" : "The matrix of the pose is a reflection";
}

bool isIdentity(const Pose& pose)
{
  return pose.tip == glm::dvec3(0.0) && pose.rotation == glm::dmat3(1.0);
}

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
