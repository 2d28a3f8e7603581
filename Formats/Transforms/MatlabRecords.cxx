// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/TransformBinary.h"

#include "Common/Bytes.h"

#include <cstdint>

namespace brainshift
{
namespace
{
constexpr std::int32_t Doubles = 0; // the header's type: little-endian, a full matrix
constexpr std::int32_t Floats = 10;
constexpr std::int32_t BigEndian = 1000; // is added to it
constexpr std::int32_t LongestName = 256;

// A variable of the file: what level 4 stores before its numbers.
struct Variable
{
  std::int32_t type;
  std::int32_t rows;
  std::int32_t columns;
  std::int32_t isComplex;
  std::int32_t nameLength;
};

std::string headerProblem(const Variable& variable)
{
  const bool good = (variable.type == Doubles || variable.type == Floats) && variable.rows >= 0 &&
    variable.columns >= 0 && variable.isComplex == 0 && variable.nameLength > 0 &&
    variable.nameLength <= LongestName;
  return good ? std::string() : "is no MATLAB file of level 4 with real numbers";
}

// Reads the variable at `at` and moves behind it.
std::string readVariable(
  const std::string& bytes, std::size_t& at, std::string& name, std::vector<double>& numbers)
{
  const std::string tooShort = "ends within a variable";
  if (bytes.size() - at < sizeof(Variable))
  {
    return tooShort;
  }
  const auto first = storedNumber<std::int32_t>(bytes.data() + at, false);
  const bool isBigEndian = first != Doubles && first != Floats;
  std::int32_t words[5];
  for (int i = 0; i < 5; ++i)
  {
    words[i] = storedNumber<std::int32_t>(bytes.data() + at + 4 * i, isBigEndian);
  }
  Variable variable{ words[0] - (isBigEndian ? BigEndian : 0), words[1], words[2], words[3],
    words[4] };
  const std::string problem = headerProblem(variable);
  if (!problem.empty())
  {
    return problem;
  }
  at += sizeof(Variable);
  const std::size_t size = variable.type == Doubles ? sizeof(double) : sizeof(float);
  const auto nameLength = static_cast<std::size_t>(variable.nameLength);
  const std::size_t left = bytes.size() - at;
  const std::size_t count = static_cast<std::size_t>(variable.rows) * variable.columns;
  if (nameLength > left || count > (left - nameLength) / size)
  {
    return tooShort;
  }
  name = std::string(bytes.data() + at, nameLength).c_str(); // a 0 ends it
  at += nameLength;
  numbers.resize(count);
  for (double& number : numbers)
  {
    number = variable.type == Doubles ? storedNumber<double>(bytes.data() + at, isBigEndian)
                                      : storedNumber<float>(bytes.data() + at, isBigEndian);
    at += size;
  }
  return {};
}
}

std::string readMatlabRecords(const std::string& bytes, std::vector<TransformRecord>& records)
{
  std::size_t at = 0;
  while (at < bytes.size())
  {
    std::string name;
    std::vector<double> numbers;
    const std::string problem = readVariable(bytes, at, name, numbers);
    if (!problem.empty())
    {
      return problem;
    }
    if (name != "fixed")
    {
      records.push_back({ name, std::move(numbers), {} });
    }
    else if (!records.empty())
    {
      records.back().fixed = std::move(numbers);
    }
    else
    {
      return "names the fixed parameters of no transform";
    }
  }
  return {};
}
}
