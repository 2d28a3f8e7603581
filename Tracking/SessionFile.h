// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A recorded session of a pointer as a text file. Documentation/tools/pointer.md describes it.
#ifndef BrainShift_SessionFile_h
#define BrainShift_SessionFile_h

#include "Tracking/Pose.h"

#include <functional>
#include <optional>

namespace brainshift
{
/** The rigid transform from the tracker's frame to the image. */
struct Placement
{
  glm::dmat3 rotation{ 1.0 };    ///< imageFromTracker
  glm::dvec3 translation{ 0.0 }; ///< mm
};

struct Session
{
  std::vector<Pose> poses;            ///< In the order of their times.
  std::optional<Placement> placement; ///< Nothing: the pointer was not registered.
};

/** Most poses of a session: 4 hours at 60 a second. */
constexpr std::size_t MostPoses = 1'000'000;

/** Writes a session. The file is replaced only when all of it is on the disk. Returns one sentence
 * without a full stop if it cannot be written. */
std::string writeSession(const std::string& path, const Session& session);

/** Reads a session. Returns one sentence without a full stop if the file is damaged; it then leaves
 * `session` as it was. */
std::string readSession(const std::string& path, Session& session);

/// Plays a recorded session as if its server sent it again, in real time.
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
