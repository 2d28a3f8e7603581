// SPDX-License-Identifier: BSD-3-Clause
// The client hears poses, and whatever a server does ends in one sentence. Each test waits for what
// must come; a client that hangs hangs its test.
#include "Tracking/TrackerClient.h"

#include "TestServer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <optional>
#include <thread>

using namespace brainshift;

namespace
{
using Phase = SourceState::Phase;
using Client = TestServer::Client;

TrackerOptions optionsOf(const TestServer& server)
{
  TrackerOptions options;
  options.port = server.port();
  return options;
}

void waitUntil(const std::function<bool()>& holds)
{
  while (!holds())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

// Poses until there are `count`, or the source ended.
std::vector<Pose> posesOf(PoseSource& source, std::size_t count)
{
  std::vector<Pose> poses;
  waitUntil([&] {
    const bool ended = source.state().phase == Phase::Ended;
    for (const Pose& pose : source.take())
    {
      poses.push_back(pose);
    }
    return poses.size() >= count || ended;
  });
  return poses;
}

// How a client ends that hears these bytes. `stays`: the server does not close the connection.
SourceState endAfter(const Bytes& bytes, bool stays = true)
{
  const TestServer server([&](const Client& client) {
    client.send(bytes);
    if (stays)
    {
      client.stay();
    }
  });
  TrackerOptions options = optionsOf(server);
  options.stallSeconds = 0.1;
  TrackerClient client(options);
  waitUntil([&] { return client.state().phase == Phase::Ended; });
  return client.state();
}

// The state after these bytes and one good pose of "Last" each time, which is the sign to look.
SourceState stateAfter(const std::vector<Bytes>& messages, const std::string& device)
{
  const TestServer server([&](const Client& client) {
    for (const Bytes& message : messages)
    {
      client.send(message);
    }
    // A message that closes the case: its damage is counted.
    TestMessage sign;
    sign.wrongSum = 1;
    client.send(sign.bytes());
    client.stay();
  });
  TrackerOptions options = optionsOf(server);
  options.device = device;
  TrackerClient client(options);
  waitUntil([&] {
    const SourceState state = client.state();
    return state.badChecksums > 0 || state.phase == Phase::Ended;
  });
  return client.state();
}

Bytes toolData(const std::vector<std::pair<std::string, std::array<float, 12>>>& tools)
{
  TestMessage message;
  message.type = "TDATA";
  message.device = "Tracker";
  message.body.clear();
  for (const auto& [name, numbers] : tools)
  {
    putName(message.body, name, 20);
    put(message.body, 2, 1);
    put(message.body, 0, 1);
    const Bytes matrix = bodyOf(numbers);
    message.body.insert(message.body.end(), matrix.begin(), matrix.end());
  }
  return message.bytes();
}
}

TEST(TrackerClient, HearsATransform)
{
  const TestServer server([](const Client& client) {
    client.send(transform(10, -20, 30.5));
    client.stay();
  });
  TrackerClient client(optionsOf(server));
  const std::vector<Pose> poses = posesOf(client, 1);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].device, "StylusToReference");
  EXPECT_EQ(poses[0].tip, glm::dvec3(10, -20, 30.5));
  EXPECT_EQ(poses[0].rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  const SourceState state = client.state();
  EXPECT_EQ(state.phase, Phase::Running);
  EXPECT_TRUE(state.visible);
  EXPECT_EQ(state.poses, 1);
  EXPECT_LE(state.lastSeconds, client.now());
}

TEST(TrackerClient, HearsToolsOfTDATA)
{
  const SourceState state = stateAfter(
    { toolData({ { "Probe", poseNumbers(1, 1, 1) }, { "Stylus", poseNumbers(2, 2, 2) } }) },
    "Stylus");
  EXPECT_EQ(state.poses, 1);
  EXPECT_EQ(state.device, "Stylus");
}

TEST(TrackerClient, ToolThatTDATADoesNotNameIsNotSeen)
{
  const SourceState state = stateAfter({ toolData({ { "Stylus", poseNumbers(2, 2, 2) } }),
                                         toolData({ { "Probe", poseNumbers(1, 1, 1) } }) },
    "Stylus");
  EXPECT_EQ(state.poses, 1);
  EXPECT_FALSE(state.visible);
}

TEST(TrackerClient, TDATAOfOtherToolsHidesNone)
{
  const Bytes others = toolData({ { "Probe", poseNumbers(1, 1, 1) } });
  for (const char* device : { "StylusToReference", "" })
  {
    const SourceState state =
      stateAfter({ transform(1, 2, 3), others, transform(4, 5, 6), others }, device);
    EXPECT_EQ(state.poses, 2) << device;
    EXPECT_TRUE(state.visible) << device;
  }
}

TEST(TrackerClient, PrefersTheStylus)
{
  const TestServer server([](const Client& client) {
    client.send(transform(1, 0, 0, "ProbeToReference"));
    client.send(transform(2, 0, 0, "StylusToReference"));
    client.send(transform(3, 0, 0, "ProbeToReference"));
    client.send(transform(4, 0, 0, "StylusToReference"));
    client.stay();
  });
  TrackerClient client(optionsOf(server));
  const std::vector<Pose> poses = posesOf(client, 3);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].tip.x, 1.0); // until the stylus came
  EXPECT_EQ(poses[1].tip.x, 2.0);
  EXPECT_EQ(poses[2].tip.x, 4.0);
}

// PLUS may send both names of the stylus at once.
TEST(TrackerClient, PrefersTheStylusToItsTip)
{
  const std::array<float, 12> tip = poseNumbers(1, 0, 0);
  const std::array<float, 12> stylus = poseNumbers(2, 0, 0);
  const TestServer server([&](const Client& client) {
    client.send(transform(0, 1, 0, "ProbeToReference"));
    client.send(transform(1, 0, 0, "StylusTipToReference"));
    client.send(
      toolData({ { "ProbeToReference", poseNumbers(0, 1, 0) }, { "StylusTipToReference", tip } }));
    client.send(toolData({ { "StylusTipToReference", tip }, { "StylusToReference", stylus } }));
    client.send(transform(1, 0, 0, "StylusTipToReference"));
    client.send(toolData({ { "StylusToReference", stylus }, { "StylusTipToReference", tip } }));
    client.send(transform(3, 0, 0, "StylusToReference"));
    client.stay();
  });
  TrackerClient client(optionsOf(server));
  std::vector<double> across;
  for (const Pose& pose : posesOf(client, 6))
  {
    across.push_back(pose.tip.x);
  }
  EXPECT_EQ(across, (std::vector<double>{ 0.0, 1.0, 1.0, 2.0, 2.0, 3.0 }));
}

TEST(TrackerClient, HearsTheNamedToolOnly)
{
  const SourceState state =
    stateAfter({ transform(1, 0, 0), transform(2, 0, 0, "Needle"), transform(3, 0, 0) }, "Needle");
  EXPECT_EQ(state.poses, 1);
  EXPECT_EQ(state.device, "Needle");
}

TEST(TrackerClient, NewestPoseWinsInAFlood)
{
  constexpr int count = 10000;
  const TestServer server([](const Client& client) {
    Bytes all;
    for (int i = 1; i <= count; ++i)
    {
      const Bytes one = transform(static_cast<float>(i), 0, 0);
      all.insert(all.end(), one.begin(), one.end());
    }
    client.send(all);
    client.stay();
  });
  TrackerClient client(optionsOf(server));
  waitUntil([&] { return client.state().poses == count; });
  const std::vector<Pose> poses = client.take();
  EXPECT_EQ(poses.size(), 4096U);
  EXPECT_EQ(poses.back().tip.x, count);
  EXPECT_EQ(client.state().overrun, count - 4096);
  EXPECT_TRUE(client.take().empty());
}

TEST(TrackerClient, EndlessFloodEnds)
{
  const TestServer server([](const Client& client) {
    const Bytes one = TestMessage{ "STATUS", "", {} }.bytes();
    Bytes many;
    for (int i = 0; i < 1000; ++i)
    {
      many.insert(many.end(), one.begin(), one.end());
    }
    while (client.send(many))
    {
    }
  });
  TrackerClient client(optionsOf(server));
  waitUntil([&] { return client.state().phase == Phase::Ended; });
  EXPECT_EQ(client.state().problem, "The server sends more than 20000 messages a second");
}

TEST(TrackerClient, WrongChecksumIsCountedAndLeftOut)
{
  TestMessage wrong;
  wrong.wrongSum = 1;
  const TestServer server([&](const Client& client) {
    client.send(wrong.bytes());
    client.send(transform(7, 0, 0));
    client.stay();
  });
  TrackerClient client(optionsOf(server));
  const std::vector<Pose> poses = posesOf(client, 1);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].tip.x, 7.0);
  EXPECT_EQ(client.state().badChecksums, 1);
}

TEST(TrackerClient, NumbersThatAreNoPoseAreRefused)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::array<float, 12> turned = poseNumbers(1, 2, 3);
  turned[1] = nan;
  std::array<float, 12> scaled = poseNumbers(1, 2, 3);
  scaled[1] = 2.0F;
  std::array<float, 12> mirrored = poseNumbers(1, 2, 3);
  mirrored[8] = -1.0F;
  for (const auto& numbers : { poseNumbers(nan, 0, 0),
         poseNumbers(0, std::numeric_limits<float>::infinity(), 0), poseNumbers(2e6F, 0, 0),
         poseNumbers(0, -2e6F, 0), poseNumbers(0, 0, -2e6F), turned, scaled, mirrored })
  {
    TestMessage message;
    message.body = bodyOf(numbers);
    const SourceState state = stateAfter({ transform(1, 2, 3), message.bytes() }, "");
    EXPECT_EQ(state.poses, 1);
    EXPECT_EQ(state.refused, 1);
    EXPECT_FALSE(state.visible);
  }
}

TEST(TrackerClient, IdentityIsAToolThatIsNotSeen)
{
  TestMessage message;
  message.body = bodyOf({ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 });
  const SourceState state = stateAfter({ transform(1, 2, 3), message.bytes() }, "");
  EXPECT_EQ(state.poses, 1);
  EXPECT_EQ(state.refused, 0);
  EXPECT_FALSE(state.visible);
}

TEST(TrackerClient, HearsVersion2)
{
  TestMessage message;
  message.version = 2;
  const Bytes content = bodyOf(poseNumbers(5, 6, 7));
  for (const char* value : { "OK", "OUT_OF_VIEW" })
  {
    message.body = extended(content, "TransformStatus", value);
    const SourceState state = stateAfter({ message.bytes() }, "");
    EXPECT_EQ(state.poses, std::string(value) == "OK" ? 1 : 0) << value;
    EXPECT_EQ(state.visible, std::string(value) == "OK") << value;
  }
  message.body = extended(content, "", "");
  EXPECT_EQ(stateAfter({ message.bytes() }, "").poses, 1);
}

TEST(TrackerClient, PartsLargerThanTheirMessageEndIt)
{
  TestMessage message;
  message.version = 2;
  for (const std::size_t place : { 0, 2, 4 }) // the sizes of the extended header
  {
    message.body = extended(bodyOf(poseNumbers(5, 6, 7)), "Status", "OK");
    message.body[place] = 0xff;
    EXPECT_NE(endAfter(message.bytes()).problem.find("larger"), std::string::npos) << place;
  }
  message.body = { 1, 2, 3 };
  EXPECT_NE(endAfter(message.bytes()).problem.find("larger"), std::string::npos);
  // The table may lie too; then it says nothing.
  message.body = extended(bodyOf(poseNumbers(5, 6, 7)), "Status", "LOST");
  message.body[12 + 48 + 2] = 0xff;
  EXPECT_EQ(stateAfter({ message.bytes() }, "").poses, 1);
}

TEST(TrackerClient, UnknownVersionEnds)
{
  for (const std::uint64_t version : { 0, 4, 0x4854 }) // "HT" of HTTP
  {
    TestMessage message;
    message.version = version;
    EXPECT_NE(endAfter(message.bytes()).problem.find("version " + std::to_string(version)),
      std::string::npos);
  }
}

TEST(TrackerClient, OtherMessagesAreDropped)
{
  TestMessage image;
  image.type = "IMAGE";
  image.body.assign(3 << 20, 7);
  TestMessage status;
  status.type = "STATUS";
  status.body.clear();
  const SourceState state = stateAfter({ image.bytes(), status.bytes(), transform(1, 2, 3) }, "");
  EXPECT_EQ(state.poses, 1);
  EXPECT_EQ(state.problem, "");
}

TEST(TrackerClient, LyingSizeEnds)
{
  for (const char* type : { "TRANSFORM", "TDATA", "IMAGE" })
  {
    for (const std::uint64_t size : { std::uint64_t(1) << 40, ~std::uint64_t(0) - 1 })
    {
      TestMessage message;
      message.type = type;
      message.announced = size;
      const std::string problem = endAfter(message.bytes()).problem;
      EXPECT_NE(problem.find(std::to_string(size) + " bytes; the limit is"), std::string::npos)
        << problem;
    }
  }
}

TEST(TrackerClient, WrongSizeEnds)
{
  TestMessage message;
  message.body.push_back(0);
  EXPECT_EQ(endAfter(message.bytes()).problem, "A TRANSFORM message has 49 bytes; it must have 48");
  message.body.clear();
  EXPECT_EQ(endAfter(message.bytes()).problem, "A TRANSFORM message has 0 bytes; it must have 48");
  message.type = "TDATA";
  message.body.assign(69, 0);
  EXPECT_EQ(endAfter(message.bytes()).problem, "A TDATA message has 69 bytes; each tool has 70");
}

TEST(TrackerClient, ServerThatDiesEnds)
{
  const Bytes whole = transform(1, 2, 3);
  EXPECT_EQ(endAfter(whole, false).problem, "The server closed the connection");
  for (const std::size_t part : { std::size_t(10), std::size_t(58), whole.size() - 1 })
  {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(part));
    EXPECT_EQ(
      endAfter(cut, false).problem, "The server closed the connection in the middle of a message");
  }
}

TEST(TrackerClient, ServerThatStallsInAMessageEnds)
{
  const Bytes whole = transform(1, 2, 3);
  TestMessage image;
  image.type = "IMAGE";
  image.announced = 1000;
  for (const Bytes& cut : { Bytes(whole.begin(), whole.begin() + 10),
         Bytes(whole.begin(), whole.end() - 1), image.bytes() })
  {
    EXPECT_EQ(endAfter(cut).problem, "The server stopped in the middle of a message");
  }
}

TEST(TrackerClient, NobodyThereEnds)
{
  int port = 0;
  {
    const TestServer server([](const Client&) {});
    port = server.port();
  }
  TrackerOptions options;
  options.port = port;
  TrackerClient client(options);
  waitUntil([&] { return client.state().phase == Phase::Ended; });
  EXPECT_NE(client.state().problem.find("No server is at 127.0.0.1, port"), std::string::npos);
}

TEST(TrackerClient, StopsWhileItConnectsAndWhileTheServerIsSilent)
{
  TrackerOptions nowhere;
  nowhere.host = "192.0.2.1"; // for documentation: nobody answers
  nowhere.connectSeconds = 1e6;
  {
    const TrackerClient client(nowhere); // its end must not wait for the limit
  }
  const TestServer server([](const Client& client) {
    client.send(Bytes(5, 0));
    client.stay();
  });
  TrackerOptions options = optionsOf(server);
  options.stallSeconds = 1e6;
  const TrackerClient client(options);
  waitUntil([&] { return client.state().phase == Phase::Running; });
}

TEST(TrackerClient, ConnectsAgainOnlyWhenAsked)
{
  std::atomic<int> clients{ 0 };
  const TestServer server([&](const Client& client) {
    ++clients;
    client.send(transform(static_cast<float>(clients), 0, 0));
  });
  TrackerOptions options = optionsOf(server);
  {
    TrackerClient client(options);
    waitUntil([&] { return client.state().phase == Phase::Ended; });
    EXPECT_EQ(clients, 1);
  }
  options.reconnect = true;
  TrackerClient client(options);
  const std::vector<Pose> poses = posesOf(client, 2);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].tip.x, 3.0);
  EXPECT_NE(client.state().phase, Phase::Ended);
}
