// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/DICOM/DerivedSet.h"

#include <algorithm>
#include <array>
#include <functional>
#include <random>

namespace brainshift
{
namespace
{
constexpr std::size_t PreambleBytes = 128; // before the letters DICM
constexpr DICOMTag PixelData = 0x7fe00010;
constexpr const char* ExplicitLittleEndian = "1.2.840.10008.1.2.1";
constexpr const char* Implementation = "2.25.232384421460108231880706615814198095366";

void append(std::string& bytes, std::uint32_t number, int count)
{
  for (int i = 0; i < count; ++i)
  {
    bytes += static_cast<char>(number >> 8 * i & 255);
  }
}

void appendTag(std::string& bytes, DICOMTag tag)
{
  append(bytes, tag >> 16, 2);
  append(bytes, tag & 0xffff, 2);
}

void appendElements(std::string& bytes, const DerivedSet& set)
{
  for (const auto& [tag, element] : set)
  {
    appendTag(bytes, tag);
    bytes += element.type;
    append(bytes, static_cast<std::uint32_t>(element.bytes.size()), 2);
    bytes += element.bytes;
  }
}

// An element of one of the types with a length of 32 bits.
void appendLongHead(std::string& bytes, DICOMTag tag, const char* type, std::size_t length)
{
  appendTag(bytes, tag);
  bytes += type;
  append(bytes, 0, 2);
  append(bytes, static_cast<std::uint32_t>(length), 4);
}

// The group of the file itself.
std::string metaOf(const DerivedSet& set)
{
  std::string bytes;
  appendLongHead(bytes, 0x00020001, "OB", 2);
  append(bytes, 0x0100, 2); // version 1
  DerivedSet meta;
  meta[0x00020002] = set.at(0x00080016);
  meta[0x00020003] = set.at(0x00080018);
  setText(meta, 0x00020010, "UI", ExplicitLittleEndian);
  setText(meta, 0x00020012, "UI", Implementation);
  setText(meta, 0x00020013, "SH", "BrainShift");
  appendElements(bytes, meta);
  return bytes;
}
}

void setText(DerivedSet& set, DICOMTag tag, const std::string& type, const std::string& text)
{
  std::string padded = text;
  if (padded.size() % 2 == 1)
  {
    padded += type == "UI" ? '\0' : ' ';
  }
  set[tag] = { type, padded };
}

void setWhole(DerivedSet& set, DICOMTag tag, int number)
{
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(number), 2);
  set[tag] = { "US", bytes };
}

std::string newUID()
{
  std::random_device random;
  std::array<std::uint32_t, 4> words{}; // of a number of 128 bits, the highest first
  std::generate(words.begin(), words.end(), std::ref(random));
  words[1] = (words[1] & 0xffff0fff) | 0x4000; // the version: random
  words[2] = (words[2] & 0x3fffffff) | 0x80000000;
  std::string digits;
  while (std::any_of(words.begin(), words.end(), [](std::uint32_t word) { return word > 0; }))
  {
    std::uint64_t rest = 0;
    for (std::uint32_t& word : words) // divides by 10
    {
      rest = rest << 32 | word;
      word = static_cast<std::uint32_t>(rest / 10);
      rest %= 10;
    }
    digits += static_cast<char>('0' + rest);
  }
  std::reverse(digits.begin(), digits.end());
  return "2.25." + digits;
}

std::string fileOf(const DerivedSet& set, const std::vector<std::uint16_t>& pixels)
{
  const std::string meta = metaOf(set);
  std::string length;
  append(length, static_cast<std::uint32_t>(meta.size()), 4);
  std::string bytes(PreambleBytes, '\0');
  bytes += "DICM";
  appendElements(bytes, { { 0x00020000, { "UL", length } } });
  bytes += meta;
  appendElements(bytes, set);
  appendLongHead(bytes, PixelData, "OW", 2 * pixels.size());
  bytes.reserve(bytes.size() + 2 * pixels.size());
  for (const std::uint16_t pixel : pixels)
  {
    append(bytes, pixel, 2);
  }
  return bytes;
}
}
