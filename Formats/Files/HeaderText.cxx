// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/HeaderText.h"

#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <fstream>

namespace brainshift
{
namespace
{
constexpr std::size_t LongestHeader = 1 << 20; // bytes; what is longer is no header

// The bytes of a file in which a header must end.
std::string readStart(const std::string& fileName, std::string& start)
{
  std::ifstream file(fileName, std::ios::binary);
  if (!file)
  {
    return "cannot be opened";
  }
  start.resize(LongestHeader);
  file.read(&start[0], static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return {};
}

// Whether the lines that follow are names of files.
bool announcesList(const HeaderText& text)
{
  const std::vector<std::string> words =
    wordsIn(text.valueOf({ "data file", "datafile", "ElementDataFile" }));
  return !words.empty() && words[0] == "LIST";
}

// Puts a line under its key. False if it is the last one of a header.
bool takeLine(const std::string& line, HeaderText& text)
{
  const bool isComment = line[0] == '#';
  if (isComment && text.isNRRD)
  {
    text.comments += line + "\n";
  }
  const std::size_t mark = line.find(text.isNRRD ? ':' : '=');
  if (mark == std::string::npos || isComment)
  {
    return true;
  }
  const bool isKey = line.compare(mark, 2, ":=") == 0;
  (isKey ? text.keys : text.fields)[trimmed(line.substr(0, mark))] =
    trimmed(line.substr(isKey ? mark + 2 : mark + 1));
  return text.isNRRD || text.fields.count("ElementDataFile") == 0;
}

// False if the text ends before the header does.
bool splitLines(const std::string& start, HeaderText& text)
{
  bool lists = false;
  for (std::size_t begin = 0; begin < start.size(); begin = text.bytes)
  {
    const std::size_t newLine = start.find('\n', begin);
    if (newLine == std::string::npos && start.size() == LongestHeader)
    {
      return false;
    }
    const std::string line = start.substr(begin, newLine - begin);
    text.bytes = newLine == std::string::npos ? start.size() : newLine + 1;
    if (lists)
    {
      const std::string name = trimmed(line);
      if (!name.empty() && name[0] != '#')
      {
        text.listed.push_back(name);
      }
      continue;
    }
    if (text.isNRRD && trimmed(line).empty())
    {
      return true; // the numbers follow
    }
    const bool isLast = !takeLine(line, text);
    lists = announcesList(text);
    if (isLast && !lists)
    {
      return true;
    }
  }
  return start.size() < LongestHeader;
}

std::string controlProblem(const std::string& header)
{
  const auto isControl = [](char c) {
    return (c >= 0 && c < ' ' && c != '\t' && c != '\r' && c != '\n') || c == '\x7f';
  };
  const auto found = std::find_if(header.begin(), header.end(), isControl);
  return found == header.end() ? std::string()
                               : "has a header with the control character " +
      std::to_string(static_cast<int>(*found)) + "; a header must be text";
}
}

std::string HeaderText::valueOf(const std::vector<std::string>& names) const
{
  for (const std::string& name : names)
  {
    const auto line = this->fields.find(name);
    if (line != this->fields.end())
    {
      return line->second;
    }
  }
  return {};
}

std::string HeaderText::keyed(const std::string& name) const
{
  const auto line = this->keys.find(name);
  return line == this->keys.end() ? std::string() : line->second;
}

std::string readHeaderText(const std::string& fileName, HeaderText& text)
{
  std::string problem = plainFileProblem(fileName);
  std::string start;
  problem = problem.empty() ? readStart(fileName, start) : problem;
  text = HeaderText();
  text.isNRRD = start.compare(0, 4, "NRRD") == 0;
  if (problem.empty() && !splitLines(start, text))
  {
    problem = "has no end of a header in its first " + std::to_string(LongestHeader) + " bytes";
  }
  return problem.empty() ? controlProblem(start.substr(0, text.bytes)) : problem;
}

}
