// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads elastix' parameter files of transforms. README.md lists the entries: each is read, refused
/// by name, or says nothing about the map.
#include "Common/Guard.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Transforms/TransformRecord.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace brainshift
{
namespace
{
using Words = std::vector<std::string>;
using EntriesByName = std::map<std::string, Words>; // of a parameter file, by name

constexpr const char* Nothing = "NoInitialTransform";

// Every entry that decides where a point goes.
constexpr const char* Read[] = { "Transform", "NumberOfParameters", "TransformParameters",
  "UseBinaryFormatForTransformationParameters", "InitialTransformParameterFileName",
  "InitialTransformParametersFileName", "HowToCombineTransforms", "FixedImageDimension",
  "MovingImageDimension", "UseDirectionCosines", "CenterOfRotationPoint", "ComputeZYX", "GridSize",
  "GridIndex", "GridSpacing", "GridOrigin", "GridDirection", "BSplineTransformSplineOrder",
  "UseCyclicTransform", "DeformationFieldFileName", "DeformationFieldInterpolationOrder" };

// A name that is almost one that counts would count as missing without a word.
void requireSpelling(const std::string& name)
{
  constexpr std::size_t SlipOfTheHand = 2; // letters
  if (std::find(std::begin(Read), std::end(Read), name) != std::end(Read))
  {
    return;
  }
  for (const std::string known : Read)
  {
    if (lettersBetween(lowerCase(name), lowerCase(known)) <= SlipOfTheHand)
    {
      throw Problem("has the entry " + shownWords(name) + "; elastix writes " + known);
    }
  }
}

// A line without its comment, which begins with // outside quotes, and without blanks around it.
std::string withoutComment(const std::string& line)
{
  bool isQuoted = false;
  std::size_t end = 0;
  while (end < line.size() && (isQuoted || line.compare(end, 2, "//") != 0))
  {
    isQuoted = isQuoted != (line[end++] == '"');
  }
  return trimmed(line.substr(0, end));
}

// The words of "Name value value "word"", what stands between the brackets of a line.
Words wordsOf(const std::string& inside)
{
  Words words;
  std::size_t at = 0;
  while (at < inside.size())
  {
    const bool isQuoted = inside[at] == '"';
    const std::size_t from = at + (isQuoted ? 1 : 0);
    const std::size_t found = inside.find_first_of(isQuoted ? "\"" : " \t\"", from);
    throwIfAny(isQuoted && found == std::string::npos
        ? "has a line that ends inside quotes: " + shownWords(inside)
        : "");
    const std::size_t to = std::min(found, inside.size());
    if (isQuoted || to > from)
    {
      words.push_back(inside.substr(from, to - from));
    }
    at = to + (isQuoted || (to < inside.size() && inside[to] != '"') ? 1 : 0);
  }
  return words;
}

void readEntry(const std::string& line, EntriesByName& entries)
{
  if (line.empty())
  {
    return;
  }
  if (line.front() != '(' || line.back() != ')')
  {
    throw Problem("has the line " + shownWords(line) + ", which is not between brackets");
  }
  const Words words = wordsOf(line.substr(1, line.size() - 2));
  throwIfAny(words.empty() ? "has a line without a name between its brackets" : "");
  const std::string& name = words.front();
  requireSpelling(name);
  if (!entries.emplace(name, Words(words.begin() + 1, words.end())).second)
  {
    throw Problem(twice("entry " + shownWords(name)));
  }
}

EntriesByName entriesOf(const std::string& text)
{
  EntriesByName entries;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    readEntry(withoutComment(line), entries);
  }
  return entries;
}

bool has(const EntriesByName& entries, const std::string& name)
{
  return entries.count(name) > 0;
}

// The only word of an entry.
std::string wordOf(const EntriesByName& entries, const std::string& name)
{
  const auto entry = entries.find(name);
  if (entry == entries.end())
  {
    throw Problem("has no entry " + name + ", which this transform needs");
  }
  if (entry->second.size() != 1)
  {
    throw Problem("has " + std::to_string(entry->second.size()) + " values in the entry " + name +
      "; it must have 1");
  }
  return entry->second.front();
}

std::string wordOf(
  const EntriesByName& entries, const std::string& name, const std::string& otherwise)
{
  return has(entries, name) ? wordOf(entries, name) : otherwise;
}

bool isTrue(const EntriesByName& entries, const std::string& name, bool otherwise)
{
  const std::string word = wordOf(entries, name, otherwise ? "true" : "false");
  if (word != "true" && word != "false")
  {
    throw Problem("has " + name + " = " + shownWords(word) + "; it must be true or false");
  }
  return word == "true";
}

std::vector<double> numbersOf(const EntriesByName& entries, const std::string& name)
{
  const auto entry = entries.find(name);
  if (entry == entries.end())
  {
    throw Problem("has no entry " + name + ", which this transform needs");
  }
  std::vector<double> numbers;
  for (const std::string& word : entry->second)
  {
    const std::optional<double> number = numberIn(word);
    if (!number || !std::isfinite(*number))
    {
      throw Problem("has " + shownWords(word) + " in the entry " + name + "; it is no number");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<double> numbersOf(
  const EntriesByName& entries, const std::string& name, std::size_t count)
{
  std::vector<double> numbers = numbersOf(entries, name);
  if (numbers.size() != count)
  {
    throw Problem("has " + std::to_string(numbers.size()) + " numbers in the entry " + name +
      "; it must have " + std::to_string(count));
  }
  return numbers;
}

// The file that a name of a parameter file means. A relative one is of its folder first: elastix
// writes names from the folder in which it was started, and the one in which BrainShift runs may
// hold the files of somebody else.
std::string namedFile(const std::string& name, const std::string& fileName)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::path(fileName).parent_path();
  const fs::path beside = folder / fs::path(name).filename();
  for (const fs::path& path : { folder / name, beside }) // an absolute name is its own path
  {
    if (fs::exists(path, error))
    {
      return path.string();
    }
  }
  const fs::path inWorkingFolder = fs::absolute(name, error);
  if (error || !fs::exists(inWorkingFolder, error))
  {
    return beside.string();
  }
  warn(nullptr,
    joined("Transform file ", fileName, " names the file ", shownWords(name),
      ", which is not in its folder; BrainShift takes ", inWorkingFolder.string(),
      ", from the folder in which it was started. Copy the right file beside the one that names "
      "it"));
  return inWorkingFolder.string();
}

// The grid of a B-spline in ITK's order: elastix writes the direction by columns.
std::vector<double> splineGrid(const EntriesByName& entries)
{
  std::vector<double> fixed;
  for (const char* name : { "GridSize", "GridOrigin", "GridSpacing" })
  {
    const std::vector<double> numbers = numbersOf(entries, name, 3);
    fixed.insert(fixed.end(), numbers.begin(), numbers.end());
  }
  const std::vector<double> columns = numbersOf(entries, "GridDirection", 9);
  for (int row = 0; row < 3; ++row)
  {
    fixed.insert(fixed.end(), { columns[row], columns[3 + row], columns[6 + row] });
  }
  const bool hasIndex = has(entries, "GridIndex");
  if (hasIndex && numbersOf(entries, "GridIndex", 3) != std::vector<double>(3, 0.0))
  {
    throw Problem("has a GridIndex other than 0 0 0, which BrainShift does not know");
  }
  const std::string order = wordOf(entries, "BSplineTransformSplineOrder", "3");
  if (order != "3")
  {
    throw Problem("holds a B-spline of order " + shownWords(order) + "; it must be 3");
  }
  if (isTrue(entries, "UseCyclicTransform", false))
  {
    throw Problem("holds a cyclic B-spline, which BrainShift does not know");
  }
  return fixed;
}

// What elastix can do with any transform and BrainShift does not.
void requireKnown(const EntriesByName& entries)
{
  const std::string sides = wordOf(entries, "FixedImageDimension", "3") + " and " +
    wordOf(entries, "MovingImageDimension", "3");
  if (sides != "3 and 3")
  {
    throw Problem("is for images of " + shownWords(sides) + " dimensions; it must be for 3");
  }
  if (isTrue(entries, "UseBinaryFormatForTransformationParameters", false))
  {
    throw Problem("keeps its parameters in another file "
                  "(UseBinaryFormatForTransformationParameters); write them as text");
  }
  if (!isTrue(entries, "UseDirectionCosines", true))
  {
    throw Problem("ignores the directions of its images (UseDirectionCosines false), so its "
                  "millimetres are not those of the world; it must be true");
  }
}

void addField(const EntriesByName& entries, const std::string& fileName, const AddFile& addFile,
  PointTransform& transform)
{
  const std::string order = wordOf(entries, "DeformationFieldInterpolationOrder", "0");
  if (order != "0" && order != "1")
  {
    throw Problem("has DeformationFieldInterpolationOrder " + shownWords(order) +
      "; it must be 0 (nearest) or 1 (linear)");
  }
  addFile(namedFile(wordOf(entries, "DeformationFieldFileName"), fileName), transform);
  auto* field = transform.links.empty() ? nullptr : std::get_if<FieldLink>(&transform.links.back());
  if (!field)
  {
    throw Problem("names a deformation field that says that it is a forward one; elastix' is "
                  "backward");
  }
  field->between = order == "0" ? Between::Nearest : Between::Linear;
}

// The fixed parameters that ITK's transform of a type has.
std::vector<double> fixedOf(const EntriesByName& entries, const std::string& type)
{
  if (type == "TranslationTransform")
  {
    return {};
  }
  if (type == "BSplineTransform")
  {
    return splineGrid(entries);
  }
  if (!has(entries, "CenterOfRotationPoint") && has(entries, "CenterOfRotation"))
  {
    throw Problem("names its centre by an index (CenterOfRotation), as elastix once did; it must "
                  "be CenterOfRotationPoint, in mm");
  }
  std::vector<double> fixed = numbersOf(entries, "CenterOfRotationPoint", 3);
  if (type == "Euler3DTransform" && isTrue(entries, "ComputeZYX", false))
  {
    fixed.push_back(1.0);
  }
  return fixed;
}

void addOwn(const EntriesByName& entries, const std::string& fileName, const AddFile& addFile,
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
  const std::string name = wordOf(entries, "Transform");
  if (name == "DeformationFieldTransform")
  {
    addField(entries, fileName, addFile, transform);
    return;
  }
  const auto type = typesOfITK.find(name);
  if (type == typesOfITK.end())
  {
    throw Problem(
      "holds elastix' transform " + shownWords(name) + ", which BrainShift does not know");
  }
  const TransformRecord record{ type->second + "_double_3_3",
    numbersOf(entries, "TransformParameters"), fixedOf(entries, type->second) };
  const auto count = static_cast<double>(record.parameters.size());
  const bool saysCount = has(entries, "NumberOfParameters");
  if (saysCount && numbersOf(entries, "NumberOfParameters", 1).front() != count)
  {
    throw Problem("has " + std::to_string(record.parameters.size()) +
      " TransformParameters; its NumberOfParameters is " +
      shownWords(wordOf(entries, "NumberOfParameters")));
  }
  addRecords({ record }, transform);
}
}

bool isElastixText(const std::string& text)
{
  return text.find("(Transform \"") != std::string::npos;
}

void addElastixText(const std::string& text, const std::string& fileName, const AddFile& addFile,
  PointTransform& transform)
{
  const EntriesByName entries = entriesOf(text);
  requireKnown(entries);
  std::string initial = wordOf(entries, "InitialTransformParameterFileName", Nothing);
  initial = wordOf(entries, "InitialTransformParametersFileName", initial); // before elastix 5.1
  if (initial != Nothing)
  {
    const std::string how = wordOf(entries, "HowToCombineTransforms"); // the default has changed
    if (how != "Compose")
    {
      throw Problem("combines its transforms by " + shownWords(how) + "; BrainShift knows Compose");
    }
    addFile(namedFile(initial, fileName), transform);
  }
  addOwn(entries, fileName, addFile, transform);
}
}
