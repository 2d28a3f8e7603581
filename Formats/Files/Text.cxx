// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* Replacement = "\xEF\xBF\xBD";

bool isInside(unsigned char byte, int low, int high)
{
  return byte >= low && byte <= high;
}

// How many bytes the letter at the beginning of a text has; 0 if it is none (Unicode, table 3-7).
std::size_t letterBytes(std::string_view text)
{
  const auto at = [&](std::size_t i) {
    return static_cast<unsigned char>(i < text.size() ? text[i] : '\0');
  };
  const unsigned char first = at(0);
  if (first < 0x80)
  {
    return 1;
  }
  const std::size_t count = isInside(first, 0xC2, 0xDF) ? 2
    : isInside(first, 0xE0, 0xEF)                       ? 3
    : isInside(first, 0xF0, 0xF4)                       ? 4
                                                        : 0;
  const int low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const int high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  bool isGood = count > 0 && isInside(at(1), low, high);
  for (std::size_t i = 2; i < count; ++i)
  {
    isGood = isGood && isInside(at(i), 0x80, 0xBF);
  }
  return isGood ? count : 0;
}
}

std::string listText(const glm::dvec3& numbers, const char* between)
{
  std::ostringstream text;
  text.precision(17);
  text << numbers.x << between << numbers.y << between << numbers.z;
  return text.str();
}

std::string trimmed(std::string_view text, std::string_view blanks)
{
  const std::size_t first = text.find_first_not_of(blanks);
  const std::size_t last = text.find_last_not_of(blanks);
  return first == std::string_view::npos ? std::string()
                                         : std::string(text.substr(first, last - first + 1));
}

std::size_t lettersBetween(const std::string& one, const std::string& other)
{
  std::vector<std::size_t> row(other.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j)
  {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= one.size(); ++i)
  {
    std::size_t before = std::exchange(row[0], i);
    for (std::size_t j = 1; j < row.size(); ++j)
    {
      const std::size_t changed = before + (one[i - 1] == other[j - 1] ? 0 : 1);
      before = std::exchange(row[j], std::min({ changed, row[j] + 1, row[j - 1] + 1 }));
    }
  }
  return row.back();
}

std::vector<std::string> wordsIn(std::string_view text)
{
  constexpr std::string_view Blanks = " \t\r\n\v\f";
  std::vector<std::string> words;
  std::size_t begin = text.find_first_not_of(Blanks);
  while (begin != std::string_view::npos)
  {
    const std::size_t end = std::min(text.find_first_of(Blanks, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(Blanks, end);
  }
  return words;
}

std::string withLineFeeds(std::string text)
{
  const std::size_t first = text.find_first_of("\r\n");
  const std::size_t after =
    first == std::string::npos ? first : text.find_first_not_of('\r', first);
  const bool isOld = first != std::string::npos && text[first] == '\r' &&
    (after == std::string::npos || text[after] != '\n');
  if (isOld)
  {
    std::replace(text.begin(), text.end(), '\r', '\n');
  }
  return text;
}

std::string lowerCase(std::string text)
{
  for (char& letter : text)
  {
    letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return text;
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && lowerCase(text.substr(text.size() - end.size())) == end;
}

std::string shownWords(const std::string& words)
{
  constexpr std::size_t MostLetters = 200;
  std::string shown = words.substr(0, MostLetters);
  std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return words.size() > MostLetters ? shown + "..." : shown;
}

std::string twice(const std::string& thing)
{
  return "has the " + thing + " twice";
}

std::string utf8OfLatin1(std::string_view text)
{
  std::string utf8;
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x80)
    {
      utf8 += letter;
      continue;
    }
    utf8 += static_cast<char>(0xc0 | code >> 6);
    utf8 += static_cast<char>(0x80 | (code & 0x3f));
  }
  return utf8;
}

std::string validUtf8(std::string_view text)
{
  std::string valid;
  valid.reserve(text.size());
  while (!text.empty())
  {
    const std::size_t bytes = letterBytes(text);
    valid += bytes > 0 ? text.substr(0, bytes) : std::string_view(Replacement);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return valid;
}
}
