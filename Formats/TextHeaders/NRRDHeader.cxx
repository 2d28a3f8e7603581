// SPDX-License-Identifier: BSD-3-Clause

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/TextHeader.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr double LongestSide = 2147483647.0;
constexpr std::size_t MostAxes = 16; // of the format

const std::map<std::string, int> Types{ { "signed char", VTK_SIGNED_CHAR },
  { "int8", VTK_SIGNED_CHAR }, { "int8_t", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR },
  { "unsigned char", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
  { "uint8_t", VTK_UNSIGNED_CHAR }, { "short", VTK_SHORT }, { "short int", VTK_SHORT },
  { "signed short", VTK_SHORT }, { "signed short int", VTK_SHORT }, { "int16", VTK_SHORT },
  { "int16_t", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
  { "unsigned short", VTK_UNSIGNED_SHORT }, { "unsigned short int", VTK_UNSIGNED_SHORT },
  { "uint16", VTK_UNSIGNED_SHORT }, { "uint16_t", VTK_UNSIGNED_SHORT }, { "int", VTK_INT },
  { "signed int", VTK_INT }, { "int32", VTK_INT }, { "int32_t", VTK_INT },
  { "uint", VTK_UNSIGNED_INT }, { "unsigned int", VTK_UNSIGNED_INT },
  { "uint32", VTK_UNSIGNED_INT }, { "uint32_t", VTK_UNSIGNED_INT }, { "longlong", VTK_LONG_LONG },
  { "long long", VTK_LONG_LONG }, { "long long int", VTK_LONG_LONG },
  { "signed long long", VTK_LONG_LONG }, { "signed long long int", VTK_LONG_LONG },
  { "int64", VTK_LONG_LONG }, { "int64_t", VTK_LONG_LONG }, { "ulonglong", VTK_UNSIGNED_LONG_LONG },
  { "unsigned long long", VTK_UNSIGNED_LONG_LONG },
  { "unsigned long long int", VTK_UNSIGNED_LONG_LONG }, { "uint64", VTK_UNSIGNED_LONG_LONG },
  { "uint64_t", VTK_UNSIGNED_LONG_LONG }, { "float", VTK_FLOAT }, { "double", VTK_DOUBLE } };

const std::map<std::string, Encoding> Encodings{ { "raw", Encoding::Raw },
  { "gzip", Encoding::Packed }, { "gz", Encoding::Packed }, { "txt", Encoding::Text },
  { "text", Encoding::Text }, { "ascii", Encoding::Text } };

// The space, and whether it says where its axes point.
const std::map<std::string, std::pair<HeaderSpace, bool>> Spaces{ { "right-anterior-superior",
                                                                    { HeaderSpace::RAS, true } },
  { "RAS", { HeaderSpace::RAS, true } }, { "left-anterior-superior", { HeaderSpace::LAS, true } },
  { "LAS", { HeaderSpace::LAS, true } }, { "left-posterior-superior", { HeaderSpace::LPS, true } },
  { "LPS", { HeaderSpace::LPS, true } }, { "scanner-xyz", { HeaderSpace::RAS, false } },
  { "3D-right-handed", { HeaderSpace::RAS, false } },
  { "3D-left-handed", { HeaderSpace::RAS, false } } };

const std::map<std::string, double> MmPerUnit{ { "mm", 1.0 }, { "millimeter", 1.0 },
  { "millimeters", 1.0 }, { "cm", 10.0 }, { "m", 1000.0 }, { "um", 1e-3 }, { "micron", 1e-3 },
  { "microns", 1e-3 }, { "\xc2\xb5m", 1e-3 }, { "nm", 1e-6 }, { "", 1.0 } };

void readSizes(TextHeader& header)
{
  const std::string text = header.text.valueOf({ "sizes" });
  const std::vector<double> sizes = numbersIn(text);
  const bool isGood = !sizes.empty() && sizes.size() <= MostAxes &&
    std::all_of(
      sizes.begin(), sizes.end(), [](double size) { return isWhole(size, 1.0, LongestSide); });
  if (!isGood)
  {
    throw Problem(
      "has the sizes " + text + "; it must have 3 to 5 whole numbers from 1 to 2147483647");
  }
  const std::string dimension = header.text.valueOf({ "dimension" });
  if (numbersIn(dimension) != std::vector<double>{ static_cast<double>(sizes.size()) })
  {
    throw Problem(
      "has the dimension " + dimension + " but " + std::to_string(sizes.size()) + " sizes");
  }
  for (const double size : sizes)
  {
    header.axes.emplace_back();
    header.axes.back().count = static_cast<std::int64_t>(size);
  }
  const std::vector<std::string> kinds = wordsIn(header.text.valueOf({ "kinds" }));
  for (std::size_t i = 0; i < kinds.size() && kinds.size() == header.axes.size(); ++i)
  {
    header.axes[i].kind = kinds[i];
  }
}

void readType(TextHeader& header)
{
  header.typeName = header.text.valueOf({ "type" });
  const auto type = Types.find(header.typeName);
  if (type == Types.end())
  {
    throw Problem("has the type " + header.typeName +
      "; BrainShift reads whole numbers of 8, 16, 32 and 64 bits, float and double");
  }
  header.numberType = type->second;
}

// The three numbers of a vector such as "(1,0,0)" that begins at `begin`, and its end. Nothing if
// anything else stands there.
std::optional<glm::dvec3> vectorAt(const std::string& text, std::size_t begin, std::size_t& end)
{
  end = text.find(')', begin);
  if (text[begin] != '(' || end == std::string::npos)
  {
    return {};
  }
  std::string inside = text.substr(begin + 1, end - begin - 1);
  ++end;
  if (std::count(inside.begin(), inside.end(), ',') != 2)
  {
    return {};
  }
  std::replace(inside.begin(), inside.end(), ',', ' ');
  const std::vector<double> numbers = numbersIn(inside);
  if (numbers.size() != 3)
  {
    return {};
  }
  return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

// The vectors of a text; one without a value for each "none". False if anything else is there.
bool vectorsIn(const std::string& text, std::vector<std::optional<glm::dvec3>>& vectors)
{
  const std::string none = "none";
  std::size_t place = 0;
  while ((place = text.find_first_not_of(" \t", place)) != std::string::npos)
  {
    if (text.compare(place, none.size(), none) == 0)
    {
      vectors.emplace_back();
      place += none.size();
      continue;
    }
    std::size_t end = 0;
    vectors.push_back(vectorAt(text, place, end));
    if (!vectors.back())
    {
      return false;
    }
    place = end;
  }
  return true;
}

// The texts between quotation marks.
std::vector<std::string> quotedIn(const std::string& text)
{
  std::vector<std::string> found;
  std::size_t begin = 0;
  while ((begin = text.find('"', begin)) != std::string::npos)
  {
    const std::size_t end = text.find('"', begin + 1);
    if (end == std::string::npos)
    {
      break;
    }
    found.push_back(text.substr(begin + 1, end - begin - 1));
    begin = end + 1;
  }
  return found;
}

double mmPer(const std::string& unit, TextHeader& header)
{
  const auto known = MmPerUnit.find(unit);
  if (known == MmPerUnit.end())
  {
    header.warnings.push_back(
      "measures in the unit '" + shownWords(unit) + "', which counts as mm");
    return 1.0;
  }
  return known->second;
}

// Axes that lie in a space: their steps and the origin.
void readDirections(TextHeader& header)
{
  const std::string text = header.text.valueOf({ "space directions" });
  std::vector<std::optional<glm::dvec3>> steps;
  const bool isGood = vectorsIn(text, steps);
  if (isGood && steps.size() + 1 == header.axes.size() && header.axes.size() == 4)
  {
    steps.insert(steps.begin(), std::optional<glm::dvec3>()); // some programs leave out "none"
  }
  if (!isGood || steps.size() != header.axes.size())
  {
    throw Problem("has the space directions " + text + "; it must have " +
      std::to_string(header.axes.size()) + ", each of them none or 3 numbers as in (1,0,0)");
  }
  const std::string originText = header.text.valueOf({ "space origin" });
  std::size_t end = 0;
  const std::optional<glm::dvec3> origin =
    originText.empty() ? glm::dvec3(0.0) : vectorAt(originText, 0, end);
  if (!origin)
  {
    throw Problem("has the space origin " + originText + "; it must be 3 numbers as in (1,0,0)");
  }
  header.hasOrigin = !originText.empty();
  const std::vector<std::string> units = quotedIn(header.text.valueOf({ "space units" }));
  glm::dvec3 mm(1.0);
  for (std::size_t i = 0; i < 3 && units.size() == 3; ++i)
  {
    mm[static_cast<int>(i)] = mmPer(units[i], header);
  }
  header.origin = mm * *origin;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (const std::optional<glm::dvec3>& step = steps[i])
    {
      header.axes[i].step = mm * *step;
    }
  }
}

// Whether an axis is one of space, in a file without directions.
bool isSpatial(const TextHeader& header, std::size_t axis)
{
  const std::string& kind = header.axes[axis].kind;
  if (!kind.empty() && kind != "???")
  {
    return kind == "domain" || kind == "space";
  }
  return axis < 3; // without kinds, a fourth axis is a list
}

// Axes that have only spacings.
void readSpacings(TextHeader& header)
{
  const std::vector<std::string> words = wordsIn(header.text.valueOf({ "spacings" }));
  const std::vector<std::string> units = quotedIn(header.text.valueOf({ "units" }));
  int along = 0;
  for (std::size_t i = 0; i < header.axes.size(); ++i)
  {
    HeaderAxis& axis = header.axes[i];
    const bool isGiven =
      words.size() == header.axes.size() && words[i] != "nan" && words[i] != "NaN";
    const double spacing = isGiven ? numbersIn(words[i])[0] : 0.0;
    if (!isSpatial(header, i) || along > 2)
    {
      axis.spacing = spacing;
      continue;
    }
    const double mm = units.size() == header.axes.size() ? mmPer(units[i], header) : 1.0;
    glm::dvec3 step(0.0);
    step[along++] = isGiven ? spacing * mm : 1.0;
    axis.step = step;
  }
}

void readPlace(TextHeader& header)
{
  const std::string spaceText = header.text.valueOf({ "space" });
  const auto space = Spaces.find(spaceText);
  if (space == Spaces.end() && !spaceText.empty())
  {
    throw Problem("is in the space " + spaceText +
      "; BrainShift reads right-anterior-superior, left-anterior-superior, " +
      "left-posterior-superior, scanner-xyz, 3D-right-handed and 3D-left-handed");
  }
  header.space = spaceText.empty() ? HeaderSpace::RAS : space->second.first;
  if (header.text.fields.count("space directions") > 0)
  {
    header.knowsSides = !spaceText.empty() && space->second.second;
    readDirections(header);
    return;
  }
  header.space = HeaderSpace::RAS;
  readSpacings(header);
}

void readSkips(TextHeader& header)
{
  double skips[2] = {};
  const std::vector<std::string> names[2] = { { "line skip", "lineskip" },
    { "byte skip", "byteskip" } };
  for (int i = 0; i < 2; ++i)
  {
    const std::string text = header.text.valueOf(names[i]);
    const std::vector<double> found = numbersIn(text.empty() ? "0" : text);
    const double least = i == 1 && header.encoding == Encoding::Raw ? -1.0 : 0.0;
    if (found.size() != 1 || !isWhole(found[0], least, 1e15))
    {
      throw Problem("has " + names[i][0] + " " + text + "; it must be a whole number, " +
        (least < 0.0 ? "-1" : "0") + " or more");
    }
    skips[i] = found[0];
  }
  header.isAtEnd = skips[1] < 0.0;
  header.lineSkip = static_cast<std::uint64_t>(skips[0]);
  const auto bytes = static_cast<std::uint64_t>(std::max(skips[1], 0.0));
  (header.encoding == Encoding::Packed ? header.unpackedSkip : header.fileSkip) = bytes;
}

void readStorage(const std::string& fileName, TextHeader& header)
{
  const std::string encoding = header.text.valueOf({ "encoding" });
  const auto known = Encodings.find(encoding);
  if (known == Encodings.end())
  {
    throw Problem("has the encoding " + encoding + "; it must be raw, gzip or ascii");
  }
  header.encoding = known->second;
  const std::string endian = header.text.valueOf({ "endian" });
  header.isBigEndian = endian == "big";
  const bool hasOrder = header.encoding != Encoding::Text && header.numberType != VTK_SIGNED_CHAR &&
    header.numberType != VTK_UNSIGNED_CHAR;
  if (hasOrder && endian != "big" && endian != "little")
  {
    throw Problem("has the endian '" + endian + "'; it must be little or big");
  }
  readSkips(header);
  nameDataFiles(fileName, header.text.valueOf({ "data file", "datafile" }), header);
}
}

void fromNRRD(const std::string& fileName, TextHeader& header)
{
  readSizes(header);
  readType(header);
  readPlace(header);
  readStorage(fileName, header);
}
}
