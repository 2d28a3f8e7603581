// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/Message.h"

#include "Common/Bytes.h"

#include <igtl_header.h>
#include <igtl_tdata.h>
#include <igtl_transform.h>
#include <igtl_util.h>

namespace brainshift
{
namespace
{
constexpr int NewestVersion = 3;                // of the header
constexpr std::size_t ExtendedHeaderBytes = 12; // 2 sizes of 2 bytes, 1 size and 1 id of 4

// A name in a field that it may fill to the last byte. It goes to the screen and into files.
std::string nameFrom(const char* field, std::size_t size)
{
  std::string name(field, std::find(field, field + size, '\0'));
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return name;
}

// Of a body with an extended header.
struct Parts
{
  const unsigned char* content = nullptr;
  std::size_t contentBytes = 0;
  const unsigned char* meta = nullptr; // its table, then its texts
  std::size_t tableBytes = 0;
  std::size_t textBytes = 0;
};

// Nothing if the sizes contradict each other.
std::optional<Parts> partsOf(const MessageHeader& header, const std::vector<unsigned char>& body)
{
  Parts parts;
  parts.content = body.data();
  parts.contentBytes = body.size();
  if (header.version < 2)
  {
    return parts;
  }
  if (body.size() < ExtendedHeaderBytes)
  {
    return std::nullopt;
  }
  const std::size_t extended = storedNumber<std::uint16_t>(body.data(), true);
  parts.tableBytes = storedNumber<std::uint16_t>(body.data() + 2, true);
  parts.textBytes = storedNumber<std::uint32_t>(body.data() + 4, true);
  const std::size_t around = extended + parts.tableBytes + parts.textBytes;
  if (extended < ExtendedHeaderBytes || around > body.size())
  {
    return std::nullopt;
  }
  parts.content += extended;
  parts.contentBytes -= around;
  parts.meta = parts.content + parts.contentBytes;
  return parts;
}

// In each TRANSFORM of version 2 and later, PLUS reports whether the tool is visible: the value of
// the metadata's key "...Status" is OK, or something else. The table (v3_proposal.md, metadata
// header) has a count (2 bytes) and an entry for each key: length of the key (2 bytes), encoding
// (2), length of the value (4). After the table, each key is followed by its value.
bool reportsUnseen(const Parts& parts)
{
  constexpr std::size_t entryBytes = 8;
  const std::string word = "Status";
  if (parts.tableBytes < 2)
  {
    return false;
  }
  const std::size_t entries = storedNumber<std::uint16_t>(parts.meta, true);
  const unsigned char* text = parts.meta + parts.tableBytes;
  std::size_t left = parts.textBytes;
  for (std::size_t i = 0; i < entries && 2 + (i + 1) * entryBytes <= parts.tableBytes; ++i)
  {
    const unsigned char* entry = parts.meta + 2 + i * entryBytes;
    const std::size_t keyBytes = storedNumber<std::uint16_t>(entry, true);
    const std::size_t valueBytes = storedNumber<std::uint32_t>(entry + 4, true);
    if (keyBytes > left || valueBytes > left - keyBytes)
    {
      return false;
    }
    const std::string key(text, text + keyBytes);
    const std::string value(text + keyBytes, text + keyBytes + valueBytes);
    const bool isStatus =
      key.size() >= word.size() && key.compare(key.size() - word.size(), word.size(), word) == 0;
    if (isStatus && value != "OK")
    {
      return true;
    }
    text += keyBytes + valueBytes;
    left -= keyBytes + valueBytes;
  }
  return false;
}

// The numbers are the columns of a matrix of 3 x 4.
Pose poseFrom(const std::string& device, const float (&numbers)[12])
{
  Pose pose;
  pose.device = device;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      pose.rotation[column][row] = numbers[3 * column + row];
    }
    pose.tip[row] = numbers[9 + row];
  }
  return pose;
}

void sortIn(const Pose& pose, MessagePoses& found)
{
  if (!problemOf(pose).empty())
  {
    found.refused.push_back(pose.device);
  }
  else if (isIdentity(pose))
  {
    found.unseen.push_back(pose.device);
  }
  else
  {
    found.poses.push_back(pose);
  }
}

void readTransform(const MessageHeader& header, const Parts& parts, MessagePoses& found)
{
  if (parts.contentBytes != IGTL_TRANSFORM_SIZE)
  {
    found.problem = "A TRANSFORM message has " + std::to_string(parts.contentBytes) +
      " bytes; it must have " + std::to_string(IGTL_TRANSFORM_SIZE);
    return;
  }
  float numbers[12];
  std::memcpy(numbers, parts.content, sizeof(numbers));
  igtl_transform_convert_byte_order(numbers);
  if (reportsUnseen(parts))
  {
    found.unseen.push_back(header.device);
  }
  else
  {
    sortIn(poseFrom(header.device, numbers), found);
  }
}

void readTools(const Parts& parts, MessagePoses& found)
{
  if (parts.contentBytes % IGTL_TDATA_ELEMENT_SIZE != 0)
  {
    found.problem = "A TDATA message has " + std::to_string(parts.contentBytes) +
      " bytes; each tool has " + std::to_string(IGTL_TDATA_ELEMENT_SIZE);
    return;
  }
  static_assert(sizeof(igtl_tdata_element) == IGTL_TDATA_ELEMENT_SIZE);
  std::vector<igtl_tdata_element> tools(parts.contentBytes / IGTL_TDATA_ELEMENT_SIZE);
  if (tools.empty())
  {
    return;
  }
  std::memcpy(tools.data(), parts.content, parts.contentBytes);
  igtl_tdata_convert_byte_order(tools.data(), static_cast<int>(tools.size()));
  for (const igtl_tdata_element& tool : tools)
  {
    float numbers[12]; // a copy: those of the element may be unaligned
    std::memcpy(numbers, tool.transform, sizeof(numbers));
    sortIn(poseFrom(nameFrom(tool.name, sizeof(tool.name)), numbers), found);
  }
}
}

std::string readHeader(const std::array<unsigned char, HeaderBytes>& bytes, MessageHeader& header)
{
  static_assert(sizeof(igtl_header) == HeaderBytes);
  igtl_header raw;
  std::memcpy(&raw, bytes.data(), sizeof(raw));
  igtl_header_convert_byte_order(&raw);
  // OpenIGTLink 1.11 and 3.0 call the field differently.
  header.version = static_cast<int>(storedNumber<std::uint16_t>(bytes.data(), true));
  header.type = nameFrom(raw.name, sizeof(raw.name));
  header.device = nameFrom(raw.device_name, sizeof(raw.device_name));
  header.bodyBytes = raw.body_size;
  header.checksum = raw.crc;
  if (header.version < 1 || header.version > NewestVersion)
  {
    return "The server sends messages of version " + std::to_string(header.version) +
      "; OpenIGTLink has versions 1 to " + std::to_string(NewestVersion);
  }
  const std::uint64_t limit = header.hasPoses() ? LargestKeptBody : LargestBody;
  if (header.bodyBytes > limit)
  {
    return "The server announces a message " + header.type + " of " +
      std::to_string(header.bodyBytes) + " bytes; the limit is " + std::to_string(limit);
  }
  return {};
}

MessagePoses readBody(const MessageHeader& header, std::vector<unsigned char> body)
{
  MessagePoses found;
  if (crc64(body.data(), body.size(), 0) != header.checksum)
  {
    found.damaged = true;
    return found;
  }
  const std::optional<Parts> parts = partsOf(header, body);
  if (!parts)
  {
    found.problem = "A message " + header.type + " has parts that are larger than its " +
      std::to_string(body.size()) + " bytes";
  }
  else if (header.type == "TRANSFORM")
  {
    readTransform(header, *parts, found);
  }
  else
  {
    readTools(*parts, found);
  }
  return found;
}
}
