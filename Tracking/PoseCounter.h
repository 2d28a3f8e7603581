// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Keeps the newest poses until they are taken, and counts.
 */
#ifndef BrainShift_PoseCounter_h
#define BrainShift_PoseCounter_h

#include "Tracking/Pose.h"

#include <deque>
#include <vector>

namespace brainshift
{
class PoseCounter
{
public:
  /** What is known; who holds the counter sets phase and problem. */
  SourceState state;

  /** A pose came. The oldest one that nobody took makes room for it. */
  void add(const Pose& pose);

  /** Poses of before, as PoseSource::take() says. */
  std::vector<Pose> take();

  /** The state at a time. */
  SourceState stateAt(double seconds) const;

private:
  std::deque<Pose> Waiting;
  std::deque<double> Times; // of poses in the last second
};
}

#endif
