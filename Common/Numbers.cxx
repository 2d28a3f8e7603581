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

std::string roundedText(double number)
{
  constexpr double thousand = 1000.0;
  char text[32];
  const bool isLong = std::abs(number) >= thousand - 0.5 && std::isfinite(number);
  const std::to_chars_result written = isLong && std::abs(number) < 1e15
    ? std::to_chars(text, text + sizeof(text), number, std::chars_format::fixed, 0)
    : std::to_chars(text, text + sizeof(text), number, std::chars_format::general, 3);
  return { text, written.ptr };
}

std::string percentText(double fraction)
{
  const double percent = 100.0 * fraction;
  if (percent > 0.0 && percent < 1.0)
  {
    return "less than 1 %";
  }
  const double shown = percent < 100.0 ? std::min(std::round(percent), 99.0) : std::round(percent);
  return numberText(shown) + " %";
}
}
