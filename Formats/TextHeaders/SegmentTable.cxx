// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/TextHeaders/SegmentTable.h"

#include "Common/Numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr int MostSegments = 65536;

// Red, green and blue from 0 to 1.
std::array<unsigned char, 3> colorIn(const std::string& text)
{
  std::array<unsigned char, 3> color = Label().color;
  const std::vector<double> shares = numbersIn(text);
  for (std::size_t i = 0; i < 3 && shares.size() == 3; ++i)
  {
    const double share = shares[i] > 0.0 ? std::min(shares[i], 1.0) : 0.0;
    color[i] = static_cast<unsigned char>(std::lround(255.0 * share));
  }
  return color;
}

// A whole number from a text; `otherwise` if it holds none.
int wholeIn(const std::string& text, int otherwise)
{
  const std::vector<double> numbers = numbersIn(text);
  return numbers.size() == 1 &&
      isWhole(numbers[0], std::numeric_limits<int>::min(), std::numeric_limits<int>::max())
    ? static_cast<int>(numbers[0])
    : otherwise;
}

// Names as a list may show them: on one line, and not too long. Letters beyond ASCII stay whole.
std::string shownNames(std::string names)
{
  constexpr std::size_t Most = 200; // bytes
  const bool isLong = names.size() > Most;
  std::size_t end = isLong ? Most : names.size();
  const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(names[i]); };
  while (isLong && end > 0 && (byteAt(end) & 0xc0) == 0x80) // inside a letter of UTF-8
  {
    --end;
  }
  names.resize(end);
  std::replace_if(
    names.begin(), names.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return isLong ? names + "..." : names;
}

template <typename Predicate>
std::string namesWhere(const std::vector<Segment>& segments, const Predicate& isMeant)
{
  constexpr std::size_t Most = 5;
  std::size_t count = 0;
  std::string text;
  for (const Segment& segment : segments)
  {
    if (isMeant(segment) && ++count <= Most)
    {
      text += (count > 1 ? ", " : "") + segment.label.name;
    }
  }
  return shownNames(text) + (count > Most ? " and others" : "");
}
}

std::vector<Segment> segmentsOf(const HeaderText& text)
{
  std::vector<Segment> segments;
  for (int i = 0; i < MostSegments; ++i)
  {
    const std::string prefix = "Segment" + std::to_string(i) + "_";
    const std::string id = text.keyed(prefix + "ID");
    if (id.empty())
    {
      break;
    }
    Label label;
    const std::string name = text.keyed(prefix + "Name");
    label.name = name.empty() ? id : name;
    label.value = wholeIn(text.keyed(prefix + "LabelValue"), 1);
    label.color = colorIn(text.keyed(prefix + "Color"));
    segments.push_back({ label, wholeIn(text.keyed(prefix + "Layer"), 0) });
  }
  return segments;
}

std::vector<Label> labelsIn(const std::vector<Segment>& segments, int layer)
{
  std::vector<Label> labels;
  for (const Segment& segment : segments)
  {
    if (segment.layer == layer)
    {
      labels.push_back(segment.label);
    }
  }
  return labels;
}

std::string namesIn(const std::vector<Segment>& segments, int layer)
{
  return namesWhere(segments, [&](const Segment& segment) { return segment.layer == layer; });
}

std::string namesOutside(const std::vector<Segment>& segments, int layer)
{
  return namesWhere(segments, [&](const Segment& segment) { return segment.layer != layer; });
}
}
