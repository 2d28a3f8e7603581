// SPDX-License-Identifier: BSD-3-Clause
// A session comes back from its file as it was, damaged files are refused, and a replay gives each
// pose at its time.
#include "Tracking/SessionFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace brainshift;

namespace
{
std::string fileNamed(const std::string& name)
{
  const std::filesystem::path folder = std::filesystem::path(BRAINSHIFT_TEST_TEMP) / "tracking";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

// A quarter turn around z.
const glm::dmat3 Turned(0, 1, 0, -1, 0, 0, 0, 0, 1);

Session someSession()
{
  Session session;
  session.poses = { { 5.0, "Stylus to reference", Turned, { 1.0 / 3.0, -2e-7, 3 } },
    { 5.25, "Stylus to reference", glm::dmat3(1.0), { 4, 5, 6 } },
    { 6.0, "Stylus to reference", Turned, { 7, 8, 9 } } };
  session.placement = Placement{ Turned, { 100, 200, 300 } };
  return session;
}

std::string problemWith(const std::string& text)
{
  const std::string path = fileNamed("damaged.txt");
  std::ofstream(path, std::ios::binary) << text;
  Session session;
  return readSession(path, session);
}

const std::string Head = "# BrainShift pointer session 1\n";
const std::string Row = "\t1\t0\t0\t1\t0\t1\t0\t2\t0\t0\t1\t3\n";
}

TEST(Session, ComesBackFromItsFile)
{
  const std::string path = fileNamed("whole.txt");
  const Session written = someSession();
  ASSERT_EQ(writeSession(path, written), "");
  Session read;
  ASSERT_EQ(readSession(path, read), "");
  ASSERT_EQ(read.poses.size(), written.poses.size());
  for (std::size_t i = 0; i < read.poses.size(); ++i)
  {
    EXPECT_EQ(read.poses[i].seconds, written.poses[i].seconds);
    EXPECT_EQ(read.poses[i].device, written.poses[i].device);
    EXPECT_EQ(read.poses[i].rotation, written.poses[i].rotation);
    EXPECT_EQ(read.poses[i].tip, written.poses[i].tip);
  }
  const Placement placement = read.placement.value_or(Placement());
  EXPECT_EQ(placement.rotation, Turned);
  EXPECT_EQ(placement.translation, glm::dvec3(100, 200, 300));
}

TEST(Session, SaysWhatIsDamaged)
{
  EXPECT_EQ(problemWith(Head + "0\tS" + Row), "");
  EXPECT_EQ(problemWith(Head + "1\tS" + Row + "1\tP" + Row), "") << "two tools at one time";
  EXPECT_NE(problemWith("").find("does not begin"), std::string::npos);
  EXPECT_NE(problemWith("# BrainShift pointer session 2\n0\tS" + Row).find("does not begin"),
    std::string::npos);
  EXPECT_NE(problemWith(Head).find("has no pose"), std::string::npos);
  for (const std::string& line : { "0\tS" + Row.substr(2), "x\tS" + Row, "nan\tS" + Row,
         std::string("0\tS\t1\t0\t0\tinf\t0\t1\t0\t2\t0\t0\t1\t3\n"), "0\tS\t9" + Row,
         std::string("some words\n"), "-1\tS" + Row,
         std::string("0\tS\t2\t0\t0\t1\t0\t1\t0\t2\t0\t0\t1\t3\n") })
  {
    EXPECT_NE(problemWith(Head + line).find("Line 2 of "), std::string::npos) << line;
  }
  EXPECT_NE(problemWith(Head + "2\tS" + Row + "1\tS" + Row).find("Line 3 of "), std::string::npos);
  EXPECT_NE(
    problemWith(Head + "# image from tracker\t1\n").find("registration"), std::string::npos);
  EXPECT_NE(problemWith(Head + std::string(5000, 'x')).find("longer"), std::string::npos);
  // Cut off in the middle of a number, the last line would be another pose.
  EXPECT_NE(problemWith(Head + "0\tS" + Row.substr(0, Row.size() - 1)).find("not whole"),
    std::string::npos);
}

TEST(Session, IsNotReadFromWhatIsNoFile)
{
  Session session;
  EXPECT_NE(readSession("/dev/zero", session).find("There is no file"), std::string::npos);
  EXPECT_NE(readSession(BRAINSHIFT_TEST_TEMP, session).find("There is no file"), std::string::npos);
  EXPECT_NE(writeSession(fileNamed("no/folder/file.txt"), someSession()).find("cannot be written"),
    std::string::npos);
}

TEST(Replay, GivesEachPoseAtItsTime)
{
  double time = 1000.0;
  Replay replay(someSession(), [&time] { return time; });
  ASSERT_EQ(replay.take().size(), 1U);
  EXPECT_TRUE(replay.take().empty());
  EXPECT_EQ(replay.state().phase, SourceState::Phase::Running);
  time = 1000.3;
  const std::vector<Pose> second = replay.take();
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].tip, glm::dvec3(4, 5, 6));
  EXPECT_EQ(second[0].seconds, 0.25);
  EXPECT_EQ(replay.state().rate, 2.0);
  EXPECT_NEAR(replay.now() - replay.state().lastSeconds, 0.05, 1e-9);
  time = 1003.0;
  EXPECT_EQ(replay.take().size(), 1U);
  EXPECT_EQ(replay.state().phase, SourceState::Phase::Ended);
  EXPECT_EQ(replay.state().rate, 0.0);
  EXPECT_EQ(replay.state().poses, 3);
}
