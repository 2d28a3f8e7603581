// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMAttributes.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr std::string_view Padding("\0 \t\r\n", 5);
constexpr DICOMTag SpecificCharacterSet = 0x00080005;

const std::string& bytesOf(const DICOMDataSet& set, DICOMTag tag)
{
  static const std::string None;
  const auto found = set.elements.find(tag);
  return found == set.elements.end() ? None : found->second.bytes;
}

bool continuesLetter(char byte)
{
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// Whether a text is UTF-8 without half letters.
bool isWholeUTF8(const std::string& text)
{
  int rest = 0; // bytes of the letter that follow
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    const bool follows = continuesLetter(letter);
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
  const bool isThere = text.size() >= begin + count;
  return isThere ? numberIn<int>(text.substr(begin, count)).value_or(-1) : -1;
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

// A date or time without the two marks that former versions of the standard put into it.
std::string withoutMarks(std::string text, char mark, std::size_t first, std::size_t second)
{
  for (const std::size_t at : { first, second })
  {
    if (text.size() > at && text[at] == mark)
    {
      text.erase(at, 1);
    }
  }
  return text;
}

// Seconds since midnight of a time (VR TM) of hours alone, with minutes, or with seconds.
std::optional<double> secondsOfDay(const std::string& text)
{
  const std::string time = withoutMarks(text, ':', 2, 4);
  const std::size_t point = std::min(time.find('.'), time.size());
  const int hour = digits(time, 0, 2);
  const int minute = point > 2 ? digits(time, 2, 2) : 0;
  const int second = point > 4 ? digits(time, 4, 2) : 0;
  const bool isWhole = point == 6 || (point == time.size() && (point == 2 || point == 4));
  const bool hasFraction = time.find_first_not_of("0123456789", point + 1) == std::string::npos;
  if (!isWhole || !hasFraction || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
    second < 0 || second > 60) // 60: a leap second
  {
    return {};
  }
  const double fraction =
    point + 1 < time.size() ? numberIn<double>("0" + time.substr(point)).value_or(0.0) : 0.0;
  return 3600.0 * hour + 60.0 * minute + second + fraction;
}
}

std::size_t lettersOf(const std::string& text)
{
  return text.size() -
    static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continuesLetter));
}

std::string firstLettersOf(const std::string& text)
{
  std::size_t letters = 0;
  const auto end = std::find_if(text.begin(), text.end(), [&letters](char byte) {
    letters += continuesLetter(byte) ? 0 : 1;
    return letters > LongestText;
  });
  return std::string(text.begin(), end);
}

std::string textOf(const DICOMDataSet& set, DICOMTag tag)
{
  return trimmed(bytesOf(set, tag), Padding);
}

std::vector<DICOMTag> tagsOf(const DICOMDataSet& set, DICOMTag tag)
{
  const std::string bytes = bytesOf(set, tag);
  std::vector<DICOMTag> tags;
  for (std::size_t place = 0; place + 4 <= bytes.size(); place += 4)
  {
    const auto group = storedNumberAt<std::uint16_t>(bytes, place, set.isBigEndian);
    const auto element = storedNumberAt<std::uint16_t>(bytes, place + 2, set.isBigEndian);
    if (group && element)
    {
      tags.push_back((DICOMTag(*group) << 16) | *element);
    }
  }
  return tags;
}

std::vector<int> wholesOf(const DICOMDataSet& set, DICOMTag tag)
{
  const std::string& bytes = bytesOf(set, tag);
  std::vector<int> numbers;
  for (std::size_t place = 0; place + 2 <= bytes.size(); place += 2)
  {
    numbers.push_back(storedNumber<std::uint16_t>(bytes.data() + place, set.isBigEndian));
  }
  return numbers;
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

std::string charactersOf(const DICOMDataSet& set)
{
  return textOf(set, SpecificCharacterSet);
}

std::string shownTextOf(const DICOMDataSet& set, DICOMTag tag)
{
  return shownTextOf(set, tag, charactersOf(set));
}

std::string shownTextOf(const DICOMDataSet& set, DICOMTag tag, const std::string& characters)
{
  const std::string text = textOf(set, tag);
  const bool isUTF8 = characters == "ISO_IR 192" && isWholeUTF8(text);
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
      shown += utf8OfLatin1({ &letter, 1 });
    }
    else
    {
      shown += '?';
    }
  }
  return firstLettersOf(shown);
}

std::vector<double> decimalsOf(const DICOMDataSet& set, DICOMTag tag)
{
  const std::string text = textOf(set, tag);
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    const auto number = numberIn(trimmed(text.substr(begin, end - begin), Padding));
    if (!number || !std::isfinite(*number))
    {
      return {};
    }
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

std::vector<double> requiredDecimals(
  const DICOMDataSet& set, const DICOMName& name, std::size_t count)
{
  const std::string text = textOf(set, name.tag);
  const std::vector<double> numbers = decimalsOf(set, name.tag);
  if (!text.empty() && (numbers.empty() || (count > 0 && numbers.size() != count)))
  {
    throw Problem(joined("has the ", name.keyword, " '", shownWords(text), "'; it must have ",
      count > 0 ? std::to_string(count) : std::string("only"),
      count == 1 ? " number" : " numbers"));
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
  const auto number = storedNumberAt<double>(bytesOf(set, tag), 0, set.isBigEndian);
  return number && std::isfinite(*number) ? *number : missing;
}

double wholeOf(const DICOMDataSet& set, DICOMTag tag, double missing)
{
  const std::string& bytes = bytesOf(set, tag);
  if (bytes.size() == sizeof(std::uint32_t))
  {
    return storedNumber<std::uint32_t>(bytes.data(), set.isBigEndian);
  }
  const auto narrow = storedNumberAt<std::uint16_t>(bytes, 0, set.isBigEndian);
  return narrow ? *narrow : missing;
}

std::optional<double> secondsOf(const std::string& date, const std::string& time)
{
  const std::optional<double> seconds = secondsOfDay(time);
  // 00000000 and letters take the place of a date where it was removed.
  if (date.find_first_of("123456789") == std::string::npos || !seconds)
  {
    return seconds;
  }
  const std::string digitsOfDate = withoutMarks(date, '.', 4, 6);
  const int month = digits(digitsOfDate, 4, 2);
  const int day = digits(digitsOfDate, 6, 2);
  const int year = digits(digitsOfDate, 0, 4);
  const bool isDate =
    digitsOfDate.size() == 8 && year > 0 && month >= 1 && month <= 12 && day >= 1 && day <= 31;
  return isDate ? std::optional<double>(*seconds + DayS * daysOf(year, month, day)) : std::nullopt;
}

std::optional<double> secondsOf(const std::string& moment)
{
  const std::size_t sign = moment.find_first_of("+-");
  const std::string offset = sign == std::string::npos ? "+0000" : moment.substr(sign);
  const int hours = digits(offset, 1, 2);
  const int minutes = digits(offset, 3, 2);
  const bool isOffset =
    offset.size() == 5 && hours >= 0 && hours <= 14 && minutes >= 0 && minutes < 60;
  if (moment.size() < 10 || !isOffset)
  {
    return {};
  }
  std::optional<double> seconds =
    secondsOf(moment.substr(0, 8), moment.substr(8, std::min(sign, moment.size()) - 8));
  if (seconds)
  {
    *seconds -= (offset[0] == '-' ? -60.0 : 60.0) * (60 * hours + minutes);
  }
  return seconds;
}

bool isSame(const DICOMDataSet& a, const DICOMDataSet& b)
{
  return std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
    [](const auto& one, const auto& other) {
      const DICOMElement& x = one.second;
      const DICOMElement& y = other.second;
      return one.first == other.first && x.bytes == y.bytes &&
        std::equal(x.items.begin(), x.items.end(), y.items.begin(), y.items.end(), isSame);
    });
}

const std::vector<DICOMDataSet>& itemsOf(const DICOMDataSet& set, DICOMTag tag)
{
  static const std::vector<DICOMDataSet> None;
  const auto found = set.elements.find(tag);
  return found == set.elements.end() ? None : found->second.items;
}
}
