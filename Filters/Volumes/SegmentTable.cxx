// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Volumes/SegmentTable.h"

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
}

SegmentTable segmentsOf(const HeaderText& text)
{
  SegmentTable table;
  for (int i = 0; i < MostSegments; ++i)
  {
    const std::string segment = "Segment" + std::to_string(i) + "_";
    const std::string id = text.keyed(segment + "ID");
    if (id.empty())
    {
      break;
    }
    Label label;
    const std::string name = text.keyed(segment + "Name");
    label.name = name.empty() ? id : name;
    label.value = wholeIn(text.keyed(segment + "LabelValue"), 1);
    label.color = colorIn(text.keyed(segment + "Color"));
    if (wholeIn(text.keyed(segment + "Layer"), 0) == 0)
    {
      table.labels.push_back(label);
    }
    else
    {
      table.leftOut.push_back(label.name);
    }
  }
  return table;
}
}
