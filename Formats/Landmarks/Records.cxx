// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/Records.h"

#include "Formats/Files/Text.h"
#include "Formats/Landmarks/CoordinateWords.h"

#include <algorithm>

namespace brainshift
{
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

bool isComment(const std::vector<std::string>& values)
{
  return trimmed(values[0]).compare(0, 1, "#") == 0;
}

// Spreadsheets add empty columns at the end.
CommentEntry commentEntry(const std::vector<std::string>& values, char separator)
{
  std::string line = trimmed(values[0]);
  std::size_t count = values.size();
  while (count > 1 && trimmed(values[count - 1]).empty())
  {
    --count;
  }
  for (std::size_t i = 1; i < count; ++i)
  {
    line += separator + values[i];
  }
  const std::string words = trimmed(line, "# \t");
  const std::size_t mark = line.find_first_of("=:");
  return mark == std::string::npos
    ? CommentEntry{ "", "", words }
    : CommentEntry{ keyOf(line.substr(0, mark)), trimmed(line.substr(mark + 1)), words };
}
}
