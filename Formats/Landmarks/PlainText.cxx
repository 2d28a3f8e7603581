// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/PlainText.h"

#include "Formats/Files/PlainFile.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

namespace brainshift
{
namespace
{
constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";
constexpr const char* Replacement = "\xEF\xBF\xBD";

void dropMark(std::string& text)
{
  if (text.compare(0, ByteOrderMark.size(), ByteOrderMark) == 0)
  {
    text.erase(0, ByteOrderMark.size());
  }
}

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

std::string readPlainText(const std::string& fileName, std::size_t limit, std::string& text)
{
  const std::string problem = plainFileProblem(fileName);
  if (!problem.empty())
  {
    return problem;
  }
  std::ifstream file(fileName, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (size < 0)
  {
    return "cannot be read";
  }
  if (static_cast<std::size_t>(size) > limit)
  {
    return "has " + std::to_string(size) + " bytes; the limit is " + std::to_string(limit);
  }
  text.resize(static_cast<std::size_t>(size));
  file.seekg(0);
  if (!file.read(text.data(), size))
  {
    return "cannot be read";
  }
  dropMark(text);
  if (text.find('\0') != std::string::npos)
  {
    return "has a byte 0; it must be text in UTF-8";
  }
  return {};
}

std::string readBeginning(const std::string& fileName, std::size_t bytes)
{
  std::string text;
  if (plainFileProblem(fileName).empty())
  {
    std::ifstream file(fileName, std::ios::binary);
    text.resize(bytes);
    file.read(text.data(), static_cast<std::streamsize>(bytes));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    dropMark(text);
  }
  return text;
}

std::string trimmed(std::string_view text)
{
  constexpr const char* Blank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(Blank);
  const std::size_t last = text.find_last_not_of(Blank);
  return first == std::string_view::npos ? std::string()
                                         : std::string(text.substr(first, last - first + 1));
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

std::optional<double> numberIn(std::string_view text)
{
  const std::string word = trimmed(text);
  const bool hasPlus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  const char* const begin = word.data() + (hasPlus ? 1 : 0);
  const char* const end = word.data() + word.size();
  double number = 0.0;
  const std::from_chars_result found = std::from_chars(begin, end, number);
  return found.ec == std::errc() && found.ptr == end ? std::optional<double>(number) : std::nullopt;
}

std::string numberText(double number)
{
  char text[32];
  const std::to_chars_result written = std::to_chars(text, text + sizeof(text), number);
  return { text, written.ptr };
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

void RecordReader::takeQuoted(std::string& value)
{
  this->IsOpen = true;
  for (++this->Place; this->Place < this->Text.size(); ++this->Place)
  {
    const char letter = this->Text[this->Place];
    if (letter == '"' && this->Text.substr(this->Place + 1, 1) != "\"")
    {
      ++this->Place;
      this->IsOpen = false;
      return;
    }
    this->Place += letter == '"' ? 1 : 0; // two quotes stand for one
    this->NextLine += letter == '\n' ? 1 : 0;
    value += letter;
  }
}

void RecordReader::take(std::vector<std::string>& values)
{
  values.assign(1, {});
  this->Line = this->NextLine;
  while (this->Place < this->Text.size())
  {
    const char letter = this->Text[this->Place];
    if (letter == '"' && trimmed(values.back()).empty())
    {
      values.back().clear();
      this->takeQuoted(values.back());
      continue;
    }
    ++this->Place;
    if (letter == '\n')
    {
      ++this->NextLine;
      return;
    }
    if (letter == this->Separator)
    {
      values.emplace_back();
    }
    else if (letter != '\r')
    {
      values.back() += letter;
    }
  }
}

bool RecordReader::next(std::vector<std::string>& values)
{
  while (this->Place < this->Text.size())
  {
    this->take(values);
    if (std::any_of(values.begin(), values.end(),
          [](const std::string& value) { return !trimmed(value).empty(); }))
    {
      return true;
    }
  }
  return false;
}

std::string recordValue(const std::string& value, char separator)
{
  const std::string special = std::string("\"\r\n") + separator;
  if (value.find_first_of(special) == std::string::npos && trimmed(value) == value)
  {
    return value;
  }
  std::string quoted = "\"";
  for (const char letter : value)
  {
    quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return quoted + '"';
}
}
