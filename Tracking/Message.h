// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Messages of OpenIGTLink: the header, TRANSFORM and TDATA.
///
/// Sources: Tokuda et al., "OpenIGTLink: an open network protocol for image-guided therapy
/// environment", International Journal of Medical Robotics 5 (2009), and the pages in
/// Documents/Protocol of github.com/openigtlink/OpenIGTLink: header.md (58 bytes, CRC of ECMA-182),
/// transform.md, trackingdata.md, and v3_proposal.md for the extended header and the metadata of
/// messages whose header has version 2 or later (protocol version 3).
///
/// libOpenIGTLink swaps the bytes of numbers and computes the checksum. Sizes are checked here,
/// before it reads a byte.
#ifndef BrainShift_Message_h
#define BrainShift_Message_h

#include "Tracking/Pose.h"

#include <array>

namespace brainshift
{
constexpr std::size_t HeaderBytes = 58;

/** Largest body of a message that is read and dropped. */
constexpr std::uint64_t LargestBody = 256ULL << 20;

/** Largest body of a message that is kept: 14000 tools. */
constexpr std::uint64_t LargestKeptBody = 1ULL << 20;

struct MessageHeader
{
  int version = 0;
  std::string type;   ///< "TRANSFORM"
  std::string device; ///< printable characters
  std::uint64_t bodyBytes = 0;
  std::uint64_t checksum = 0;

  /** Whether the body may hold poses. */
  bool hasPoses() const { return this->type == "TRANSFORM" || this->type == "TDATA"; }
};

/** Reads a header. Returns one sentence without a full stop if the stream cannot be followed any
 * more: its version or size is invalid. */
std::string readHeader(const std::array<unsigned char, HeaderBytes>& bytes, MessageHeader& header);

/** The poses and tools of a body. */
struct MessagePoses
{
  bool damaged = false;             ///< The checksum is wrong.
  std::string problem;              ///< One sentence if its size is wrong.
  std::vector<Pose> poses;          ///< Of visible tools. Times are 0.
  std::vector<std::string> unseen;  ///< Tools that the tracker does not see.
  std::vector<std::string> refused; ///< Tools whose numbers are no pose.
};

/** Reads a body that belongs to a header with hasPoses(). */
MessagePoses readBody(const MessageHeader& header, std::vector<unsigned char> body);
}

#endif
