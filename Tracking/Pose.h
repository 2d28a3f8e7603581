// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Poses of a tracked tool, and the interface of their sources.
#ifndef BrainShift_Pose_h
#define BrainShift_Pose_h

#include <glm/glm.hpp>

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace brainshift
{
/** One pose of a tool: it takes points of the tool to the tracker's frame. The tool's origin is its
 * tip. */
struct Pose
{
  double seconds = 0.0;       ///< when it came, counted from the start of its source
  std::string device;         ///< "StylusToReference"
  glm::dmat3 rotation{ 1.0 }; ///< trackerFromTool, a rotation
  glm::dvec3 tip{ 0.0 };      ///< mm, tracker's frame
};

/** The reason if numbers are no valid pose: not finite, no rotation, or beyond 1 000 000 mm. Empty
 * if they are one. */
std::string problemOf(const Pose& pose);

/** Whether a pose is exactly the identity, which trackers send for an invisible tool. */
bool isIdentity(const Pose& pose);

/** The state of a source of poses. */
struct SourceState
{
  enum class Phase
  {
    Connecting, ///< or waiting to try again
    Running,
    Ended,
  };

  Phase phase = Phase::Connecting;
  std::string problem; ///< Why it ended or does not run: one sentence without a full stop, or none.
  std::string device;  ///< That the poses belong to. Empty before the first one.
  bool visible = false;      ///< Whether the last message had a pose of the tool.
  double lastSeconds = -1.0; ///< When the last pose came; below 0: none came.
  double rate = 0.0;         ///< Poses in the last second.
  std::int64_t poses = 0;
  std::int64_t badChecksums = 0; ///< Messages with a wrong checksum.
  std::int64_t refused = 0;      ///< Messages whose numbers are no pose.
  std::int64_t overrun = 0;      ///< Poses dropped because take() came too late.
};

/** Poses of one tool, from a server or from a file. */
class PoseSource
{
public:
  virtual ~PoseSource() = default;

  /** The poses that came since the last call, oldest first, 4096 at most. Never waits. */
  virtual std::vector<Pose> take() = 0;

  virtual SourceState state() const = 0;

  /** Seconds since the source was started: the age of a pose is now() - seconds. */
  virtual double now() const = 0;
};

/// Keeps the newest poses until they are taken, and counts.
class PoseCounter
{
public:
  /** The state; the owner of the counter sets phase and problem. */
  SourceState state;

  /** Adds a new pose. If the buffer is full, the oldest pose is dropped. */
  void add(const Pose& pose);

  /** The poses since the last call: see PoseSource::take(). */
  std::vector<Pose> take();

  /** The state at a time. */
  SourceState stateAt(double seconds) const;

private:
  std::deque<Pose> Waiting;
  std::deque<double> Times; // of poses in the last second
};
}

#endif
