// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/PlainText.h"

#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <fstream>

namespace brainshift
{
namespace
{
constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";

void dropMark(std::string& text)
{
  if (text.compare(0, ByteOrderMark.size(), ByteOrderMark) == 0)
  {
    text.erase(0, ByteOrderMark.size());
  }
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
