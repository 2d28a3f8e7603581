// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/TrackerClient.h"

#include "Tracking/Message.h"

#include <algorithm>
#include <exception>

namespace brainshift
{
namespace
{
constexpr double RetrySeconds = 1.0;
constexpr int MostMessages = 20000; // a second; trackers send up to 1000

// How much a tool is wanted if none is named.
int rankOf(const std::string& device)
{
  return device == "StylusToReference" ? 2 : device == "StylusTipToReference" ? 1 : 0;
}
}

TrackerClient::TrackerClient(const TrackerOptions& options)
  : Options(options)
  , Start(std::chrono::steady_clock::now())
  , Thread([this] { this->run(); })
{
}

TrackerClient::~TrackerClient()
{
  this->Stop.stop();
  this->Thread.join();
}

double TrackerClient::now() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
}

std::vector<Pose> TrackerClient::take()
{
  const std::lock_guard lock(this->Mutex);
  return this->Counter.take();
}

SourceState TrackerClient::state() const
{
  const std::lock_guard lock(this->Mutex);
  return this->Counter.stateAt(this->now());
}

void TrackerClient::setPhase(SourceState::Phase phase, const std::string& problem)
{
  const std::lock_guard lock(this->Mutex);
  this->Counter.state.phase = phase;
  this->Counter.state.problem = problem;
  this->Counter.state.visible = false;
}

void TrackerClient::run()
{
  do
  {
    std::string problem;
    try
    {
      Connection connection(this->Stop);
      problem =
        connection.open(this->Options.host, this->Options.port, this->Options.connectSeconds);
      if (problem.empty() && !this->Stop.waitFor(0.0))
      {
        this->setPhase(SourceState::Phase::Running, {});
        problem = this->listen(connection);
      }
    }
    catch (const std::exception& exception) // out of memory or threads
    {
      problem = std::string("The pointer failed: ") + exception.what();
    }
    this->setPhase(
      this->Options.reconnect ? SourceState::Phase::Connecting : SourceState::Phase::Ended,
      problem);
  } while (this->Options.reconnect && !this->Stop.waitFor(RetrySeconds));
}

std::string TrackerClient::problemOf(Connection::Result result, bool inMessage) const
{
  switch (result)
  {
    case Connection::Result::Closed:
      return inMessage ? "The server closed the connection in the middle of a message"
                       : "The server closed the connection";
    case Connection::Result::Broken:
      return "The server closed the connection in the middle of a message";
    case Connection::Result::Stalled:
      return "The server stopped in the middle of a message";
    default:
      return {};
  }
}

std::string TrackerClient::listen(Connection& connection)
{
  this->FloodSince = this->now();
  this->FloodCount = 0;
  this->InSets.clear();
  while (true)
  {
    std::array<unsigned char, HeaderBytes> bytes{};
    // Between two messages a server may be silent for as long as it likes.
    const auto result = connection.read(bytes.data(), bytes.size(), -this->Options.stallSeconds);
    if (result != Connection::Result::Read)
    {
      return this->problemOf(result, false);
    }
    MessageHeader header;
    std::string problem = readHeader(bytes, header);
    if (problem.empty() && this->isFlood())
    {
      problem = "The server sends more than " + std::to_string(MostMessages) + " messages a second";
    }
    if (problem.empty())
    {
      problem = header.hasPoses() ? this->receiveBody(connection, header)
                                  : this->skip(connection, header.bodyBytes);
    }
    if (!problem.empty() || this->Stop.waitFor(0.0))
    {
      return problem;
    }
  }
}

bool TrackerClient::isFlood()
{
  const double now = this->now();
  if (now - this->FloodSince > 1.0)
  {
    this->FloodSince = now;
    this->FloodCount = 0;
  }
  return ++this->FloodCount > MostMessages;
}

std::string TrackerClient::skip(Connection& connection, std::uint64_t bytes) const
{
  std::array<unsigned char, 65536> dropped{};
  while (bytes > 0)
  {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, dropped.size()));
    const auto result = connection.read(dropped.data(), count, this->Options.stallSeconds);
    if (result != Connection::Result::Read)
    {
      return this->problemOf(result, true);
    }
    bytes -= count;
  }
  return {};
}

std::string TrackerClient::receiveBody(Connection& connection, const MessageHeader& header)
{
  std::vector<unsigned char> body(header.bodyBytes); // readHeader() limits it
  if (!body.empty())
  {
    const auto result = connection.read(body.data(), body.size(), this->Options.stallSeconds);
    if (result != Connection::Result::Read)
    {
      return this->problemOf(result, true);
    }
  }
  const MessagePoses found = readBody(header, std::move(body));
  if (!found.problem.empty())
  {
    return found.problem;
  }
  this->record(found, header.type == "TDATA");
  return {};
}

bool TrackerClient::wants(const std::string& device)
{
  if (!this->Options.device.empty())
  {
    return device == this->Options.device;
  }
  if (this->Followed.empty() || rankOf(device) > rankOf(this->Followed))
  {
    this->Followed = device;
  }
  return device == this->Followed;
}

// `wholeSet`: a TDATA. Once one has named the tool, one that omits it says that it is not seen. A
// server may send this tool by TRANSFORM and others by TDATA.
void TrackerClient::record(const MessagePoses& found, bool wholeSet)
{
  const double now = this->now();
  const auto isWanted = [this](const std::string& device) { return this->wants(device); };
  const std::lock_guard lock(this->Mutex);
  this->Counter.state.badChecksums += found.damaged ? 1 : 0;
  if (found.damaged)
  {
    return;
  }
  // The tool that is wanted most may be the last one of the message, and one that is seen comes
  // first.
  std::for_each(found.poses.begin(), found.poses.end(),
    [&isWanted](const Pose& pose) { isWanted(pose.device); });
  const bool refused = std::any_of(found.refused.begin(), found.refused.end(), isWanted);
  this->Counter.state.refused += refused ? 1 : 0;
  const bool unseen = std::any_of(found.unseen.begin(), found.unseen.end(), isWanted);
  const bool posed = std::any_of(found.poses.begin(), found.poses.end(),
    [&isWanted](const Pose& pose) { return isWanted(pose.device); });
  if (wholeSet && (posed || refused || unseen))
  {
    this->InSets = this->followed();
  }
  if ((wholeSet && this->InSets == this->followed()) || refused || unseen)
  {
    this->Counter.state.visible = false;
  }
  for (Pose pose : found.poses)
  {
    if (this->wants(pose.device))
    {
      pose.seconds = now;
      this->Counter.add(pose);
      break; // a message has one pose of a tool
    }
  }
}
}
