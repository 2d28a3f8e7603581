// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/TextHeader.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace brainshift
{
namespace
{
constexpr double MostFiles = 65536.0;

std::string beside(const std::string& fileName, const std::string& name)
{
  return (std::filesystem::path(fileName).parent_path() / name).string();
}

// The number in the place of %d, %3d or %03d.
std::string numbered(const std::string& pattern, long long number)
{
  const std::size_t begin = pattern.find('%');
  const std::size_t end = pattern.find('d', begin);
  const std::string width = pattern.substr(begin + 1, end - begin - 1);
  std::string digits = std::to_string(number);
  const std::size_t wanted = width.empty() ? 0 : std::stoul(width);
  const char filler = !width.empty() && width[0] == '0' ? '0' : ' ';
  digits.insert(0, wanted > digits.size() ? wanted - digits.size() : 0, filler);
  return pattern.substr(0, begin) + digits + pattern.substr(end + 1);
}

// Whether a name has one %d, %3d or %03d, of at most two digits.
bool isPattern(const std::string& name)
{
  const std::size_t begin = name.find('%');
  const std::size_t end = begin == std::string::npos ? begin : name.find('d', begin);
  return end != std::string::npos && end - begin <= 3 && name.find('%', end) == std::string::npos &&
    std::all_of(name.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
      name.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c >= '0' && c <= '9'; });
}

std::string namePattern(
  const std::string& fileName, const std::vector<std::string>& words, TextHeader& header)
{
  std::vector<double> range;
  for (std::size_t i = 1; i < words.size(); ++i)
  {
    const std::vector<double> number = numbersIn(words[i]);
    range.push_back(number.size() == 1 ? number[0] : std::nan(""));
  }
  range.resize(std::max<std::size_t>(range.size(), 2), std::nan(""));
  const double step = range.size() > 2 ? range[2] : 1.0;
  constexpr double Most = 1e9;
  if (!isWhole(range[0], 0.0, Most) || !isWhole(range[1], 0.0, Most) ||
    !isWhole(std::abs(step), 1.0, Most) || !((range[1] - range[0]) / step >= 0.0))
  {
    return "numbers its data files from, to and by something other than whole numbers: " + words[0];
  }
  const double count = std::floor((range[1] - range[0]) / step) + 1.0;
  if (count > MostFiles)
  {
    return "names " + std::to_string(static_cast<long long>(count)) +
      " data files; it may name 65536";
  }
  for (double i = 0.0; i < count; i += 1.0)
  {
    header.dataFiles.push_back(
      beside(fileName, numbered(words[0], static_cast<long long>(range[0] + i * step))));
  }
  return {};
}
}

double TextHeader::numberCount() const
{
  double count = 1.0;
  for (const HeaderAxis& axis : this->axes)
  {
    count *= static_cast<double>(axis.count);
  }
  return count;
}

double TextHeader::dataBytes() const
{
  return this->numberCount() * vtkDataArray::GetDataTypeSize(this->numberType);
}

int TextHeader::spatialAxes() const
{
  return static_cast<int>(std::count_if(this->axes.begin(), this->axes.end(),
    [](const HeaderAxis& axis) { return axis.step.has_value(); }));
}

std::string nameDataFiles(const std::string& fileName, const std::string& words, TextHeader& header)
{
  header.dataFiles.clear();
  const std::vector<std::string> parts = wordsIn(words);
  if (parts.empty() || (parts.size() == 1 && parts[0] == "LOCAL"))
  {
    header.dataFiles.push_back(fileName);
    header.isLocal = true;
    return {};
  }
  if (parts[0] == "LIST")
  {
    for (const std::string& name : header.text.listed)
    {
      header.dataFiles.push_back(beside(fileName, name));
    }
    return header.dataFiles.empty() || static_cast<double>(header.dataFiles.size()) > MostFiles
      ? "lists " + std::to_string(header.dataFiles.size()) + " data files; it may list 1 to 65536"
      : std::string();
  }
  if (parts.size() > 2 && isPattern(parts[0]))
  {
    return namePattern(fileName, parts, header);
  }
  header.dataFiles.push_back(beside(fileName, words));
  return {};
}
}
