// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads transforms that are text: ITK's, elastix' parameter files, and 4 x 4 matrices.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Transforms/TransformRecord.h"

#include <filesystem>
#include <map>

namespace brainshift
{
namespace
{
using Words = std::vector<std::string>;
using Entries = std::map<std::string, Words>; // of a parameter file, by name

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
    return;
  }
  if (records.empty())
  {
    throw Problem("has parameters before its first transform");
  }
  TransformRecord& record = records.back();
  if (!appendNumbers(value, isFixed ? record.fixed : record.parameters))
  {
    throw Problem("has parameters of " + shownWords(record.type) + " that are no numbers");
  }
}

// One line of a parameter file: (Name value value "word").
void readEntry(const std::string& line, Entries& entries)
{
  const std::size_t open = line.find_first_not_of(" \t");
  const std::size_t close = line.rfind(')');
  if (open == std::string::npos || line[open] != '(' || close == std::string::npos)
  {
    return;
  }
  std::size_t at = open + 1;
  Words words;
  while (at < close)
  {
    const bool isQuoted = line[at] == '"';
    const std::size_t from = at + (isQuoted ? 1 : 0);
    const std::size_t to = std::min(line.find_first_of(isQuoted ? "\"" : " \t", from), close);
    if (isQuoted || to > from)
    {
      words.push_back(line.substr(from, to - from));
    }
    at = to + 1;
  }
  if (!words.empty())
  {
    entries[words.front()] = Words(words.begin() + 1, words.end());
  }
}

Entries entriesOf(const std::string& text)
{
  Entries entries;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    readEntry(line, entries);
  }
  return entries;
}

std::string wordOf(const Entries& entries, const std::string& name, const std::string& otherwise)
{
  const auto entry = entries.find(name);
  return entry == entries.end() || entry->second.empty() ? otherwise : entry->second.front();
}

std::vector<double> numbersOf(const Entries& entries, const std::string& name)
{
  std::vector<double> numbers;
  const auto entry = entries.find(name);
  for (const std::string& word : entry == entries.end() ? Words() : entry->second)
  {
    const std::optional<double> number = numberIn(word);
    if (!number)
    {
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

// A name as it stands if there is such a file; else beside the file that names it.
std::string namedFile(const std::string& name, const std::string& fileName)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path beside = fs::path(fileName).parent_path() / fs::path(name).filename();
  return fs::exists(name, error) ? name : beside.string();
}

// The grid of a B-spline in ITK's order: elastix writes the direction by columns.
std::vector<double> splineGrid(const Entries& entries)
{
  std::vector<double> fixed;
  for (const char* name : { "GridSize", "GridOrigin", "GridSpacing" })
  {
    const std::vector<double> numbers = numbersOf(entries, name);
    fixed.insert(fixed.end(), numbers.begin(), numbers.end());
  }
  std::vector<double> columns = numbersOf(entries, "GridDirection");
  if (columns.size() != 9)
  {
    columns = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  }
  for (int row = 0; row < 3; ++row)
  {
    fixed.insert(fixed.end(), { columns[row], columns[3 + row], columns[6 + row] });
  }
  return fixed;
}

// What elastix can do and BrainShift does not.
void requireKnown(const Entries& entries)
{
  const std::string sides = wordOf(entries, "FixedImageDimension", "3") + " and " +
    wordOf(entries, "MovingImageDimension", "3");
  if (sides != "3 and 3")
  {
    throw Problem("is for images of " + shownWords(sides) + " dimensions; it must be for 3");
  }
  if (wordOf(entries, "UseCyclicTransform", "false") == "true")
  {
    throw Problem("holds a cyclic B-spline, which BrainShift does not know");
  }
  const std::string order = wordOf(entries, "BSplineTransformSplineOrder", "3");
  if (order != "3")
  {
    throw Problem("holds a B-spline of order " + shownWords(order) + "; it must be 3");
  }
}

void addElastixOwn(const Entries& entries, const std::string& fileName, const AddFile& addFile,
  PointTransform& transform)
{
  static const std::map<std::string, std::string> typesOfITK{
    { "AffineTransform", "AffineTransform" },
    { "BSplineTransform", "BSplineTransform" },
    { "EulerTransform", "Euler3DTransform" },
    { "RecursiveBSplineTransform", "BSplineTransform" },
    { "SimilarityTransform", "Similarity3DTransform" },
    { "TranslationTransform", "TranslationTransform" },
  };
  const std::string name = wordOf(entries, "Transform", "");
  if (name == "DeformationFieldTransform")
  {
    const std::string file = wordOf(entries, "DeformationFieldFileName", "");
    addFile(namedFile(file, fileName), transform);
    auto* field =
      transform.links.empty() ? nullptr : std::get_if<FieldLink>(&transform.links.back());
    if (field)
    {
      field->isNearest = wordOf(entries, "DeformationFieldInterpolationOrder", "0") == "0";
    }
    return;
  }
  const auto type = typesOfITK.find(name);
  if (type == typesOfITK.end())
  {
    throw Problem(
      "holds elastix' transform " + shownWords(name) + ", which BrainShift does not know");
  }
  TransformRecord record{ type->second + "_double_3_3", numbersOf(entries, "TransformParameters"),
    {} };
  if (type->second == "BSplineTransform")
  {
    record.fixed = splineGrid(entries);
  }
  else if (name != "TranslationTransform")
  {
    record.fixed = numbersOf(entries, "CenterOfRotationPoint");
    if (name == "EulerTransform" && wordOf(entries, "ComputeZYX", "false") == "true")
    {
      record.fixed.resize(4, 1.0);
    }
  }
  addRecords({ record }, transform);
}
}

std::vector<TransformRecord> readITKText(const std::string& text)
{
  std::vector<TransformRecord> records;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    readITKLine(line, records);
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

bool isElastixText(const std::string& text)
{
  return text.find("(Transform \"") != std::string::npos;
}

void addElastixText(const std::string& text, const std::string& fileName, const AddFile& addFile,
  PointTransform& transform)
{
  const Entries entries = entriesOf(text);
  requireKnown(entries);
  const std::string nothing = "NoInitialTransform";
  std::string initial = wordOf(entries, "InitialTransformParameterFileName", nothing);
  initial = wordOf(entries, "InitialTransformParametersFileName", initial); // before elastix 5.1
  if (initial != nothing)
  {
    const std::string how = wordOf(entries, "HowToCombineTransforms", "Compose");
    if (how != "Compose")
    {
      throw Problem("combines its transforms by " + shownWords(how) + "; BrainShift knows Compose");
    }
    addFile(namedFile(initial, fileName), transform);
  }
  addElastixOwn(entries, fileName, addFile, transform);
}
}
