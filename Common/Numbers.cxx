// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr std::string_view Blanks = " \t\r\n\v\f";
}

bool appendNumbers(std::string_view text, std::vector<double>& numbers)
{
  while (true)
  {
    text.remove_prefix(std::min(text.find_first_not_of(Blanks), text.size()));
    if (text.empty())
    {
      return true;
    }
    const std::optional<double> number = takeNumber<double>(text);
    const bool isWord = text.empty() || Blanks.find(text.front()) != std::string_view::npos;
    if (!number || !isWord)
    {
      return false;
    }
    numbers.push_back(*number);
  }
}

std::vector<double> numbersIn(std::string_view text)
{
  std::vector<double> numbers;
  if (!appendNumbers(text, numbers))
  {
    numbers.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  return numbers;
}

bool isWhole(double number, double least, double most)
{
  return number >= least && number <= most && number == std::floor(number);
}

std::string numberText(double number)
{
  char text[32];
  const std::to_chars_result written = std::to_chars(text, text + sizeof(text), number);
  return { text, written.ptr };
}
}
