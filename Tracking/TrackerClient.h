// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Receives the poses of a tool from an OpenIGTLink server.
///
/// A thread of its own connects and reads, so the window never waits for the server. It opens no
/// port and sends nothing. Each error of the server becomes one sentence (SourceState::problem).
#ifndef BrainShift_TrackerClient_h
#define BrainShift_TrackerClient_h

#include "Tracking/Connection.h"
#include "Tracking/Pose.h"

#include <chrono>
#include <mutex>
#include <thread>

namespace brainshift
{
struct MessageHeader;
struct MessagePoses;

struct TrackerOptions
{
  std::string host = "127.0.0.1"; ///< "localhost" is 127.0.0.1 and needs no name server.
  int port = 18944;               ///< 1 to 65535
  /** The tool. Empty: StylusToReference, else StylusTipToReference, else the first one that is
   * named. */
  std::string device;
  bool reconnect = false;      ///< Tries again a second after the connection ended.
  double connectSeconds = 5.0; ///< that a server may take to answer
  double stallSeconds = 5.0;   ///< that a server may be silent within a message
};

class TrackerClient : public PoseSource
{
public:
  /** Begins to connect. */
  explicit TrackerClient(const TrackerOptions& options);
  /** Ends within a fraction of a second, whatever the server does. */
  ~TrackerClient() override;

  std::vector<Pose> take() override;
  SourceState state() const override;
  double now() const override;

private:
  void run();
  std::string listen(Connection& connection); // why it ended
  std::string receiveBody(Connection& connection, const MessageHeader& header);
  std::string skip(Connection& connection, std::uint64_t bytes) const;
  std::string problemOf(Connection::Result result, bool inMessage) const;
  void record(const MessagePoses& found, bool wholeSet);
  bool wants(const std::string& device);
  bool isFlood();
  void setPhase(SourceState::Phase phase, const std::string& problem);

  const TrackerOptions Options;
  const std::chrono::steady_clock::time_point Start;
  StopSignal Stop;
  const std::string& followed() const
  {
    return this->Options.device.empty() ? this->Followed : this->Options.device;
  }

  std::string Followed; // the tool; only the thread knows
  std::string InSets;   // the tool that TDATA named; only the thread knows
  double FloodSince = 0.0;
  int FloodCount = 0;
  mutable std::mutex Mutex;
  PoseCounter Counter; // behind the mutex
  std::thread Thread;  // last: it uses the others
};
}

#endif
