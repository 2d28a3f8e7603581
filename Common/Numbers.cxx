// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr std::string_view Blanks = " \t\r\n\v\f";

#ifndef __cpp_lib_to_chars
const char* afterDigits(const char* from, const char* last)
{
  return std::find_if(from, last, [](char c) { return c < '0' || c > '9'; });
}

// Behind the digits, point and power of a number without a sign; `from` if there is none.
const char* afterNumber(const char* from, const char* last)
{
  const char* end = afterDigits(from, last);
  bool hasDigits = end != from;
  if (end != last && *end == '.')
  {
    const char* fraction = afterDigits(end + 1, last);
    hasDigits = hasDigits || fraction != end + 1;
    end = fraction;
  }
  if (hasDigits && end != last && (*end == 'e' || *end == 'E'))
  {
    const bool hasSign = end + 1 != last && (end[1] == '+' || end[1] == '-');
    const char* power = end + (hasSign ? 2 : 1);
    const char* behind = afterDigits(power, last);
    end = behind != power ? behind : end;
  }
  return hasDigits ? end : from;
}

// How many letters of a text a word of small letters takes, in capitals or not; 0: none.
std::size_t lettersOf(std::string_view word, std::string_view text)
{
  const auto isSame = [](char one, char other) { return one == (other | ('a' ^ 'A')); };
  const bool begins =
    text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), isSame);
  return begins ? word.size() : 0;
}

template <typename Number>
std::from_chars_result fromChars(const char* first, const char* last, Number& number)
{
  const bool isBelow = first != last && *first == '-';
  const char* from = first + (isBelow ? 1 : 0);
  const std::string_view text(from, static_cast<std::size_t>(last - from));
  Number found{};
  const char* end = from;
  if (const std::size_t infinity = std::max(lettersOf("infinity", text), lettersOf("inf", text)))
  {
    found = std::numeric_limits<Number>::infinity();
    end += infinity;
  }
  else if (const std::size_t nan = lettersOf("nan", text))
  {
    found = std::numeric_limits<Number>::quiet_NaN();
    end += nan;
  }
  else if ((end = afterNumber(from, last)) != from)
  {
    std::istringstream stream(std::string(from, end));
    stream.imbue(std::locale::classic());
    // The smallest numbers come with a fault that they are inexact.
    if (!(stream >> found) && std::fpclassify(found) != FP_SUBNORMAL)
    {
      return { end, std::errc::result_out_of_range };
    }
  }
  if (end == from)
  {
    return { first, std::errc::invalid_argument };
  }
  number = isBelow ? -found : found;
  return { end, std::errc() };
}
#endif
}

#ifndef __cpp_lib_to_chars
std::from_chars_result from_chars(const char* first, const char* last, double& number)
{
  return fromChars(first, last, number);
}

std::from_chars_result from_chars(const char* first, const char* last, float& number)
{
  return fromChars(first, last, number);
}
#endif

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
