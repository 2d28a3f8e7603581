// SPDX-License-Identifier: BSD-3-Clause
// Proves that the metadata of a TRANSFORM message is read entry by entry: whichever entry says that
// the tool is not seen, it counts.
#include "Tracking/Message.h"

#include "TestServer.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

using namespace brainshift;

namespace
{
using Entries = std::vector<std::pair<std::string, std::string>>; // key and value

// A message of version 2: an extended header, the pose, a table of entries, and their texts.
MessagePoses posesWith(const Entries& entries)
{
  Bytes table;
  Bytes texts;
  put(table, entries.size(), 2);
  for (const auto& [key, value] : entries)
  {
    put(table, key.size(), 2);
    put(table, 3, 2);
    put(table, value.size(), 4);
    putName(texts, key, key.size());
    putName(texts, value, value.size());
  }
  Bytes body;
  put(body, 12, 2);
  put(body, table.size(), 2);
  put(body, texts.size(), 4);
  put(body, 0, 4);
  for (const Bytes& part : { bodyOf(poseNumbers(5, 6, 7)), table, texts })
  {
    body.insert(body.end(), part.begin(), part.end());
  }
  MessageHeader header;
  header.version = 2;
  header.type = "TRANSFORM";
  header.device = "StylusToReference";
  header.bodyBytes = body.size();
  header.checksum = checksumOf(body);
  return readBody(header, body);
}

void expectSeen(const Entries& entries)
{
  const MessagePoses found = posesWith(entries);
  ASSERT_EQ(found.poses.size(), 1U) << found.problem;
  EXPECT_EQ(found.poses[0].tip, glm::dvec3(5, 6, 7));
  EXPECT_TRUE(found.unseen.empty());
}

void expectUnseen(const Entries& entries)
{
  const MessagePoses found = posesWith(entries);
  EXPECT_TRUE(found.poses.empty());
  EXPECT_EQ(found.unseen, std::vector<std::string>{ "StylusToReference" }) << found.problem;
}
}

TEST(Message, TheSecondEntryMaySayThatTheToolIsNotSeen)
{
  expectSeen({ { "FrameNumber", "1234" }, { "ToolStatus", "OK" } });
  expectUnseen({ { "FrameNumber", "1234" }, { "ToolStatus", "OUT_OF_VIEW" } });
  expectUnseen({ { "Timestamp", "17.5" }, { "FrameNumber", "1234" }, { "Status", "MISSING" } });
}

TEST(Message, AnyStatusCounts)
{
  expectUnseen({ { "ToolStatus", "OK" }, { "ProbeStatus", "MISSING" } });
  expectUnseen({ { "ProbeStatus", "MISSING" }, { "ToolStatus", "OK" } });
  expectSeen({ { "ToolStatus", "OK" }, { "ProbeStatus", "OK" } });
}

TEST(Message, OtherEntriesSayNothing)
{
  expectSeen({ { "StatusText", "MISSING" }, { "", "" }, { "Stat", "MISSING" } });
}
