// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMAttributes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace brainshift
{
namespace
{
constexpr std::size_t LongestShownText = 64; // of VR LO
constexpr DICOMTag SpecificCharacterSet = 0x00080005;

const std::string& bytesOf(const DICOMDataSet& set, DICOMTag tag)
{
  static const std::string None;
  const auto found = set.elements.find(tag);
  return found == set.elements.end() ? None : found->second.bytes;
}

std::string trimmed(const std::string& text)
{
  const std::string padding(" \0\t\r\n", 5);
  const std::size_t first = text.find_first_not_of(padding);
  return first == std::string::npos
    ? std::string()
    : text.substr(first, text.find_last_not_of(padding) - first + 1);
}

// Copies a number from its bytes.
template <typename Number>
bool copyNumber(const DICOMDataSet& set, DICOMTag tag, Number& number)
{
  std::string bytes = bytesOf(set, tag).substr(0, sizeof(Number));
  if (bytes.size() < sizeof(Number))
  {
    return false;
  }
  if (set.isBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return true;
}

// Whether a text is UTF-8 without half letters.
bool isWhole(const std::string& text)
{
  int rest = 0; // bytes of the letter that follow
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    const bool follows = (code & 0xc0) == 0x80;
    if (follows != (rest > 0) || code >= 0xf8)
    {
      return false;
    }
    rest = follows ? rest - 1 : code >= 0xf0 ? 3 : code >= 0xe0 ? 2 : code >= 0xc0 ? 1 : 0;
  }
  return rest == 0;
}

// A part of a text of digits as a number, or -1.
int digits(const std::string& text, std::size_t begin, std::size_t count)
{
  int number = -1;
  if (text.size() >= begin + count)
  {
    const char* const last = text.data() + begin + count;
    const auto [end, error] = std::from_chars(text.data() + begin, last, number);
    number = error == std::errc() && end == last ? number : -1;
  }
  return number;
}

// Days since 1970-01-01 in the Gregorian calendar, by counting years from March.
double daysOf(int year, int month, int day)
{
  const int marchYear = month <= 2 ? year - 1 : year;
  const int marchMonth = month <= 2 ? month + 9 : month - 3;
  const int leapDays = marchYear / 4 - marchYear / 100 + marchYear / 400;
  const int monthDays = (153 * marchMonth + 2) / 5;
  return 365.0 * marchYear + leapDays + monthDays + day - 1 - 719468.0;
}
}

std::string textOf(const DICOMDataSet& set, DICOMTag tag)
{
  return trimmed(bytesOf(set, tag));
}

std::string dateOf(const DICOMDataSet& set, DICOMTag tag)
{
  const std::string date = textOf(set, tag);
  const bool isDate = date.size() == 8 && date.find_first_not_of("0123456789") == std::string::npos;
  return isDate ? date.substr(0, 4) + "-" + date.substr(4, 2) + "-" + date.substr(6)
                : std::string();
}

std::string plainText(const std::string& text)
{
  std::string plain = text;
  std::replace_if(
    plain.begin(), plain.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return plain;
}

std::string shownTextOf(const DICOMDataSet& set, DICOMTag tag)
{
  const std::string characters = textOf(set, SpecificCharacterSet);
  const std::string text = textOf(set, tag).substr(0, LongestShownText);
  const bool isUTF8 = characters == "ISO_IR 192" && isWhole(text);
  const bool isLatin = characters == "ISO_IR 100";
  std::string shown;
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f)
    {
      shown += ' ';
    }
    else if (code < 0x80 || isUTF8)
    {
      shown += letter;
    }
    else if (isLatin)
    {
      shown += static_cast<char>(0xc0 | (code >> 6));
      shown += static_cast<char>(0x80 | (code & 0x3f));
    }
    else
    {
      shown += '?';
    }
  }
  return shown;
}

std::vector<double> decimalsOf(const DICOMDataSet& set, DICOMTag tag)
{
  const std::string text = textOf(set, tag);
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    std::string part = trimmed(text.substr(begin, end - begin));
    part.erase(0, part.compare(0, 1, "+") == 0 ? 1 : 0); // from_chars knows no plus
    double number = 0.0;
    const auto [last, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (error != std::errc() || last != part.data() + part.size() || !std::isfinite(number))
    {
      return {};
    }
    numbers.push_back(number);
    begin = end + 1;
  }
  return numbers;
}

double decimalOf(const DICOMDataSet& set, DICOMTag tag, double missing)
{
  const std::vector<double> numbers = decimalsOf(set, tag);
  return numbers.empty() ? missing : numbers.front();
}

double doubleOf(const DICOMDataSet& set, DICOMTag tag, double missing)
{
  double number = 0.0;
  return copyNumber(set, tag, number) && std::isfinite(number) ? number : missing;
}

double wholeOf(const DICOMDataSet& set, DICOMTag tag, double missing)
{
  std::uint32_t wide = 0;
  std::uint16_t narrow = 0;
  if (bytesOf(set, tag).size() == sizeof(wide) && copyNumber(set, tag, wide))
  {
    return wide;
  }
  return copyNumber(set, tag, narrow) ? narrow : missing;
}

double secondsOf(const std::string& date, const std::string& time, double missing)
{
  const int hour = digits(time, 0, 2);
  if (hour < 0)
  {
    return missing;
  }
  double seconds = 3600.0 * hour + 60.0 * std::max(digits(time, 2, 2), 0);
  double rest = 0.0;
  if (time.size() > 4)
  {
    std::from_chars(time.data() + 4, time.data() + time.size(), rest);
  }
  seconds += std::isfinite(rest) ? rest : 0.0;
  const int year = digits(date, 0, 4);
  const int month = digits(date, 4, 2);
  const int day = digits(date, 6, 2);
  const bool isDated = year > 0 && month >= 1 && month <= 12 && day >= 1 && day <= 31;
  return seconds + (isDated ? 86400.0 * daysOf(year, month, day) : 0.0);
}

const std::vector<DICOMDataSet>& itemsOf(const DICOMDataSet& set, DICOMTag tag)
{
  static const std::vector<DICOMDataSet> None;
  const auto found = set.elements.find(tag);
  return found == set.elements.end() ? None : found->second.items;
}
}
