// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads transforms that are text: ITK's, and 4 x 4 matrices.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Transforms/TransformRecord.h"

namespace brainshift
{
namespace
{
void readITKLine(const std::string& line, std::vector<TransformRecord>& records)
{
  const auto follows = [&line](const std::string& key, std::string_view& value) {
    const bool found = line.rfind(key, 0) == 0;
    value = std::string_view(line).substr(found ? key.size() : 0);
    return found;
  };
  std::string_view value;
  if (follows("Transform:", value))
  {
    std::istringstream type{ std::string(value) };
    records.emplace_back();
    type >> records.back().type;
    return;
  }
  const bool isFixed = follows("FixedParameters:", value);
  if (!isFixed && !follows("Parameters:", value))
  {
    const bool saysNothing = line.empty() || line.front() == '#';
    throwIfAny(saysNothing ? ""
                           : "has the line " + shownWords(line) +
          "; it must begin with Transform:, Parameters: or FixedParameters:");
    return;
  }
  if (records.empty())
  {
    throw Problem("has parameters before its first transform");
  }
  TransformRecord& record = records.back();
  std::vector<double>& numbers = isFixed ? record.fixed : record.parameters;
  throwIfAny(numbers.empty()
      ? ""
      : twice((isFixed ? "line FixedParameters: of " : "line Parameters: of ") +
          shownWords(record.type)));
  if (!appendNumbers(value, numbers))
  {
    throw Problem("has parameters of " + shownWords(record.type) + " that are no numbers");
  }
}

}

std::vector<TransformRecord> readITKText(const std::string& text)
{
  std::vector<TransformRecord> records;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    readITKLine(trimmed(line), records);
  }
  return records;
}

std::optional<std::vector<double>> matrixText(const std::string& text)
{
  constexpr std::size_t LongestText = 4096;
  std::vector<double> numbers;
  if (text.size() > LongestText || !appendNumbers(text, numbers) || numbers.size() != 16)
  {
    return {};
  }
  return numbers;
}
}
