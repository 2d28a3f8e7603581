// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Plays a recorded session as if its server sent it again, in real time.
 */
#ifndef BrainShift_Replay_h
#define BrainShift_Replay_h

#include "Tracking/PoseCounter.h"
#include "Tracking/SessionFile.h"

#include <functional>

namespace brainshift
{
class Replay : public PoseSource
{
public:
  /**
   * Begins to play.
   *
   * @param clock   seconds; it never goes back. Empty: the time of the machine.
   */
  explicit Replay(Session session, std::function<double()> clock = {});

  std::vector<Pose> take() override;
  SourceState state() const override;
  double now() const override;

  const std::optional<Placement>& placement() const { return this->Played.placement; }

private:
  const Session Played;
  const std::function<double()> Clock;
  const double Start;
  std::size_t Next = 0;
  PoseCounter Counter;
};
}

#endif
