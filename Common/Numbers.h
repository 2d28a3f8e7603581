// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers as text. They have a point, whatever the language of the user. No VTK.
///
/// A plus sign may come before a number. Infinities and NaN are numbers.
#ifndef BrainShift_Numbers_h
#define BrainShift_Numbers_h

#include "Common/Export.h" // for the export macro

#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace brainshift
{
/** A number that nobody knows. */
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

#ifdef __cpp_lib_to_chars
using std::from_chars;
#else
///@{
/** As std::from_chars, which libc++ has for numbers with a point from version 20 on only. */
BRAINSHIFT_COMMON_EXPORT std::from_chars_result from_chars(
  const char* first, const char* last, double& number);
BRAINSHIFT_COMMON_EXPORT std::from_chars_result from_chars(
  const char* first, const char* last, float& number);
template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
std::from_chars_result from_chars(const char* first, const char* last, Integer& number)
{
  return std::from_chars(first, last, number);
}
///@}
#endif

/**
 * Takes the number off with which a text begins. None, and the text stays as it was, if it begins
 * with no number or with one that the type cannot hold.
 */
template <typename Number>
std::optional<Number> takeNumber(std::string_view& text)
{
  const bool hasPlus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  Number number{};
  const auto [last, error] =
    from_chars(text.data() + (hasPlus ? 1 : 0), text.data() + text.size(), number);
  if (error != std::errc())
  {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(last - text.data()));
  return number;
}

/** The number that a whole text is; none if it is anything else, or has spaces around it. */
template <typename Number = double>
std::optional<Number> numberIn(std::string_view text)
{
  const std::optional<Number> number = takeNumber<Number>(text);
  return text.empty() ? number : std::nullopt;
}

/** Appends the numbers of a text between spaces and lines. False if anything else is there. */
BRAINSHIFT_COMMON_EXPORT bool appendNumbers(std::string_view text, std::vector<double>& numbers);

/**
 * The numbers of a text between spaces and lines. What is no number ends the list with NaN, which
 * no position takes: half of a number must not count as a number.
 */
BRAINSHIFT_COMMON_EXPORT std::vector<double> numbersIn(std::string_view text);

/** Whether a number is whole and between two limits. */
BRAINSHIFT_COMMON_EXPORT bool isWhole(double number, double least, double most);

/** The shortest text that reads back as the same number. */
BRAINSHIFT_COMMON_EXPORT std::string numberText(double number);

/**
 * A measured number for a sentence: three digits, or all whole digits if there are more. Numbers
 * that a user set are better shown by numberText.
 */
BRAINSHIFT_COMMON_EXPORT std::string roundedText(double number);

/** A fraction as whole percent: "58 %"; never 0 % or 100 % of what is between them. */
BRAINSHIFT_COMMON_EXPORT std::string percentText(double fraction);
}

#endif
