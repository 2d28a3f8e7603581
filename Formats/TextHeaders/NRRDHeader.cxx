// SPDX-License-Identifier: BSD-3-Clause

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/TextHeader.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace brainshift
{
namespace
{
constexpr std::size_t MostAxes = 16; // of the format

const std::map<std::string, int> NRRDTypes{ { "signed char", VTK_SIGNED_CHAR },
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

// The space, without "-time", and whether it says where its axes point.
const std::map<std::string, std::pair<HeaderSpace, bool>> Spaces{ { "right-anterior-superior",
                                                                    { HeaderSpace::RAS, true } },
  { "ras", { HeaderSpace::RAS, true } }, { "left-anterior-superior", { HeaderSpace::LAS, true } },
  { "las", { HeaderSpace::LAS, true } }, { "left-posterior-superior", { HeaderSpace::LPS, true } },
  { "lps", { HeaderSpace::LPS, true } }, { "scanner-xyz", { HeaderSpace::RAS, false } },
  { "3d-right-handed", { HeaderSpace::RAS, false } },
  { "3d-left-handed", { HeaderSpace::RAS, false } } };

// What programs write where they know no unit.
const std::set<std::string> NoUnits{ "???", "none", "unknown", "pixel", "pixels", "voxel",
  "voxels" };

// All fields of the format; anything else may be a misspelt one.
const std::set<std::string> Fields{ "axis maxs", "axis mins", "axismaxs", "axismins", "block size",
  "blocksize", "byte skip", "byteskip", "centerings", "centers", "content", "data file", "datafile",
  "dimension", "encoding", "endian", "kinds", "labels", "line skip", "lineskip", "max",
  "measurement frame", "min", "number", "old max", "old min", "oldmax", "oldmin", "sample units",
  "sampleunits", "sizes", "space", "space dimension", "space directions", "space origin",
  "space units", "spacings", "thicknesses", "type", "units" };

// Older names of fields lack the blank.
bool areTwice(const HeaderText& text, const std::string& name)
{
  std::string older = name;
  older.erase(std::remove(older.begin(), older.end(), ' '), older.end());
  return older != name && text.has(name) && text.has(older);
}

void requireKnownFields(TextHeader& header)
{
  for (const std::string& name : header.text.repeated)
  {
    throw Problem(twice("field '" + shownWords(name) + "'"));
  }
  if (header.text.has("centers") && header.text.has("centerings"))
  {
    throw Problem(twice("field 'centers'") + ", the second time as 'centerings'");
  }
  for (const auto& [name, value] : header.text.fields)
  {
    if (Fields.count(name) == 0)
    {
      throw Problem("has the field '" + shownWords(name) + "', which NRRD does not define");
    }
    throwIfAny(areTwice(header.text, name) ? twice("field '" + name + "'") : "");
  }
  if (header.text.has("old min") || header.text.has("oldmin") || header.text.has("old max") ||
    header.text.has("oldmax"))
  {
    header.warnings.emplace_back("names the range of its numbers before they were quantized (old "
                                 "min, old max); the numbers stay as they are");
  }
}

void readSizes(TextHeader& header)
{
  const std::string text = header.text.valueOf({ "sizes" });
  const std::vector<double> sizes = numbersIn(text);
  const bool isGood = !sizes.empty() && sizes.size() <= MostAxes &&
    std::all_of(
      sizes.begin(), sizes.end(), [](double size) { return isWhole(size, 1.0, LongestAxis); });
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
}

// A field with one word for each axis; none of them if the header lacks the field.
std::vector<std::string> wordsOfAxes(
  const TextHeader& header, const char* name, std::vector<std::string> (*split)(const std::string&))
{
  std::vector<std::string> words = split(header.text.valueOf({ name }));
  if (header.text.has(name) && words.size() != header.axes.size())
  {
    throw Problem(std::string("has the ") + name + " " + header.text.valueOf({ name }) +
      "; it must have " + std::to_string(header.axes.size()) + ", one for each axis");
  }
  return words;
}

std::vector<std::string> plainWords(const std::string& text)
{
  return wordsIn(text);
}

void readNRRDType(TextHeader& header)
{
  header.typeName = header.text.valueOf({ "type" });
  const auto type = NRRDTypes.find(lowerCase(header.typeName));
  if (type == NRRDTypes.end())
  {
    throw Problem("has the type " + header.typeName +
      (header.text.has("block size") || header.text.has("blocksize") ? " (with a block size)"
                                                                     : "") +
      "; BrainShift reads whole numbers of 8, 16, 32 and 64 bits, float and double");
  }
  header.numberType = type->second;
}

// A vector in a space; w is time, 0 in a space without it.
using SpaceVector = glm::dvec4;

// The numbers of a vector such as "(1,0,0)" that begins at `begin`, as many as a space has, and its
// end. Nothing if anything else stands there.
std::optional<SpaceVector> vectorAt(
  const std::string& text, std::size_t dimensions, std::size_t begin, std::size_t& end)
{
  end = text.find(')', begin);
  if (text[begin] != '(' || end == std::string::npos)
  {
    return {};
  }
  std::string inside = text.substr(begin + 1, end - begin - 1);
  ++end;
  if (std::count(inside.begin(), inside.end(), ',') + std::size_t(1) != dimensions)
  {
    return {};
  }
  std::replace(inside.begin(), inside.end(), ',', ' ');
  const std::vector<double> numbers = numbersIn(inside);
  if (numbers.size() != dimensions)
  {
    return {};
  }
  return SpaceVector(numbers[0], numbers[1], numbers[2], dimensions > 3 ? numbers[3] : 0.0);
}

// The vectors of a text; one without a value for each "none". False if anything else is there.
bool vectorsIn(
  const std::string& text, std::size_t dimensions, std::vector<std::optional<SpaceVector>>& vectors)
{
  const std::string none = "none";
  std::size_t place = 0;
  while ((place = text.find_first_not_of(" \t", place)) != std::string::npos)
  {
    if (lowerCase(text.substr(place, none.size())) == none)
    {
      vectors.emplace_back();
      place += none.size();
      continue;
    }
    std::size_t end = 0;
    vectors.push_back(vectorAt(text, dimensions, place, end));
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
  if (NoUnits.count(lowerCase(unit)) > 0)
  {
    header.warnings.push_back(
      "measures in the unit '" + shownWords(unit) + "', which counts as mm");
    return 1.0;
  }
  const std::optional<double> mm = mmPerUnit(unit);
  if (!mm)
  {
    throw Problem("measures in the unit '" + shownWords(unit) +
      "'; BrainShift reads nm, um, mm, cm, m, km, in and ft");
  }
  return *mm;
}

// The numbers of a field of axes; NaN where there is none.
std::vector<double> numbersOfAxes(const TextHeader& header, const char* name)
{
  std::vector<double> numbers;
  for (const std::string& word : wordsOfAxes(header, name, plainWords))
  {
    const std::vector<double> found = numbersIn(word);
    const bool isNone = lowerCase(word) == "nan" || word == "???";
    if (!isNone && !(found.size() == 1 && std::isfinite(found[0])))
    {
      throw Problem(std::string("has the ") + name + " " + header.text.valueOf({ name }) +
        "; each must be a finite number or nan");
    }
    numbers.push_back(isNone ? std::nan("") : found[0]);
  }
  numbers.resize(header.axes.size(), std::nan(""));
  return numbers;
}

// What a file says of each axis beside its place in a space.
struct AxisFields
{
  std::vector<double> spacings;
  std::vector<double> least; // axis mins
  std::vector<double> most;  // axis maxs
  std::vector<std::string> units;
  std::vector<std::string> centers; // of samples: cell or node
};

// The first name under which a field is there.
const char* nameOf(const TextHeader& header, const char* name, const char* older)
{
  return header.text.has(older) ? older : name;
}

AxisFields fieldsOfAxes(const TextHeader& header)
{
  AxisFields fields;
  fields.spacings = numbersOfAxes(header, "spacings");
  fields.least = numbersOfAxes(header, nameOf(header, "axis mins", "axismins"));
  fields.most = numbersOfAxes(header, nameOf(header, "axis maxs", "axismaxs"));
  fields.units = wordsOfAxes(header, "units", quotedIn);
  fields.units.resize(header.axes.size());
  fields.centers = wordsOfAxes(header, nameOf(header, "centers", "centerings"), plainWords);
  fields.centers.resize(header.axes.size(), "???");
  for (std::string& center : fields.centers)
  {
    center = lowerCase(center);
  }
  return fields;
}

// Where an axis begins, and the step from one sample to the next, from its ends where the file
// names them. In cells, the ends are half a step outside.
void useEnds(const AxisFields& fields, std::size_t i, double count, double& spacing, double& start)
{
  const bool isNode = fields.centers[i] == "node";
  const double steps = isNode ? count - 1.0 : count;
  if (std::isnan(spacing) && steps > 0.0)
  {
    spacing = (fields.most[i] - fields.least[i]) / steps; // NaN without both
  }
  const double half = isNode || std::isnan(spacing) ? 0.0 : 0.5 * spacing;
  start = !std::isnan(fields.least[i]) ? fields.least[i] + half
    : !std::isnan(fields.most[i]) && !std::isnan(spacing)
    ? fields.most[i] - half - (count - 1.0) * spacing
    : 0.0;
}

// Where the volumes of an axis are that is none of space.
void readVolumes(const AxisFields& fields, std::size_t i, TextHeader& header)
{
  HeaderAxis& axis = header.axes[i];
  double spacing = fields.spacings[i];
  useEnds(fields, i, static_cast<double>(axis.count), spacing, axis.start);
  axis.spacing = std::isnan(spacing) ? std::nullopt : std::optional<double>(spacing);
  axis.unit = fields.units[i];
  const std::string key = "axis " + std::to_string(i) + " index "; // of 3D Slicer's sequences
  if (lowerCase(header.text.keyed(key + "type")) != "text")
  {
    axis.values = numbersIn(header.text.keyed(key + "values"));
  }
}

// The place of axes in space is that of the space; what else is said of them must not contradict.
void requireNoOther(
  const TextHeader& header, const AxisFields& fields, std::size_t i, const std::string& spaceUnit)
{
  constexpr double Rounding = 1e-3; // of a spacing with few digits
  const std::string& unit = fields.units[i];
  if (!unit.empty() && mmPerUnit(unit) != mmPerUnit(spaceUnit))
  {
    throw Problem("has the units \"" + shownWords(unit) +
      "\" for an axis with space directions, "
      "whose unit must be in space units");
  }
  const std::string axis = "axis " + std::to_string(i + 1);
  const glm::dvec3 step = header.axes[i].step.value_or(glm::dvec3(0.0));
  const double length = glm::length(step) / mmPerUnit(spaceUnit).value_or(1.0);
  const double spacing = std::abs(fields.spacings[i]);
  if (std::abs(spacing - length) > Rounding * length) // not where it is NaN
  {
    throw Problem(joined("has the spacings ", header.text.valueOf({ "spacings" }), "; that of ",
      axis, " must be nan or the length of its space directions, ", length));
  }
  const bool hasLeast = !std::isnan(fields.least[i]);
  if (hasLeast || !std::isnan(fields.most[i]))
  {
    throw Problem(joined("has ", hasLeast ? "axis mins" : "axis maxs", " for ", axis,
      ", whose place the space directions and the space origin say; they must be nan"));
  }
  const std::string& kind = header.axes[i].kind;
  const bool isStub = kind == "stub" && header.axes[i].count == 1;
  if (!kind.empty() && kind != "???" && kind != "none" && kind != "space" && kind != "domain" &&
    !isStub)
  {
    throw Problem(joined("has the kinds ", header.text.valueOf({ "kinds" }), "; ", axis,
      " has space directions and must be a domain or space"));
  }
}

// An example of a vector, for errors.
std::string exampleOf(std::size_t dimensions)
{
  return std::to_string(dimensions) + " numbers as in " +
    (dimensions > 3 ? "(1,0,0,0)" : "(1,0,0)");
}

// Units of a space; empty ones if the file does not say them.
std::vector<std::string> unitsOfSpace(const TextHeader& header, std::size_t dimensions)
{
  const std::string text = header.text.valueOf({ "space units" });
  std::vector<std::string> units = quotedIn(text);
  if (units.size() != dimensions && !text.empty())
  {
    throw Problem("has the space units " + text + "; it must have " + std::to_string(dimensions) +
      ", in quotation marks");
  }
  units.resize(dimensions);
  return units;
}

// An axis along the time of a space.
void readTime(const AxisFields& fields, std::size_t i, double step, TextHeader& header)
{
  HeaderAxis& axis = header.axes[i];
  const std::string name = "axis " + std::to_string(i + 1);
  if (!std::isnan(fields.spacings[i]) || !std::isnan(fields.least[i]) ||
    !std::isnan(fields.most[i]))
  {
    throw Problem("has spacings, axis mins or axis maxs for " + name +
      ", whose times the space directions and the space origin say; they must be nan");
  }
  if (i + 1 != header.axes.size())
  {
    throw Problem("has its times along " + name + "; they must be along the last axis");
  }
  axis.kind = "time";
  axis.spacing = step;
}

// Axes that lie in a space: their steps and the origin.
void readDirections(const AxisFields& fields, std::size_t dimensions, TextHeader& header)
{
  const std::string text = header.text.valueOf({ "space directions" });
  std::vector<std::optional<SpaceVector>> steps;
  const bool isGood = vectorsIn(text, dimensions, steps);
  if (isGood && steps.size() + 1 == header.axes.size() && header.axes.size() == 4)
  {
    steps.insert(steps.begin(), std::optional<SpaceVector>()); // some programs leave out "none"
  }
  if (!isGood || steps.size() != header.axes.size())
  {
    throw Problem("has the space directions " + text + "; it must have " +
      std::to_string(header.axes.size()) + ", each of them none or " + exampleOf(dimensions));
  }
  const std::string originText = header.text.valueOf({ "space origin" });
  std::size_t end = 0;
  const std::optional<SpaceVector> origin =
    originText.empty() ? SpaceVector(0.0) : vectorAt(originText, dimensions, 0, end);
  if (!origin)
  {
    throw Problem("has the space origin " + originText + "; it must be " + exampleOf(dimensions));
  }
  header.hasOrigin = !originText.empty();
  const std::vector<std::string> units = unitsOfSpace(header, dimensions);
  const glm::dvec3 mm(mmPer(units[0], header), mmPer(units[1], header), mmPer(units[2], header));
  header.origin = mm * glm::dvec3(*origin);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const std::optional<SpaceVector>& step = steps[i];
    const bool isInSpace = step && glm::dvec3(*step) != glm::dvec3(0.0);
    if (!step)
    {
      readVolumes(fields, i, header);
    }
    else if (isInSpace && step->w != 0.0)
    {
      throw Problem("has the space directions " + text + "; axis " + std::to_string(i + 1) +
        " mixes space with time");
    }
    else if (dimensions > 3 && !isInSpace)
    {
      readTime(fields, i, step->w, header);
      header.axes[i].start = origin->w;
      header.axes[i].unit = units[3];
    }
    else
    {
      header.axes[i].step = mm * glm::dvec3(*step);
      requireNoOther(header, fields, i, units[0]);
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

// Names of axes that say another order than x, y, z.
void requireLabels(const TextHeader& header)
{
  const std::vector<std::string> labels = wordsOfAxes(header, "labels", quotedIn);
  int along = 0;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const std::string label = lowerCase(trimmed(labels[i]));
    const bool isOfTime = label == "t" || label == "time" || label == "frame" || label == "frames";
    const std::size_t axis = label.size() == 1 ? std::string("xyz").find(label) : std::string::npos;
    if (!header.axes[i].step)
    {
      continue;
    }
    if (isOfTime || (axis != std::string::npos && axis != static_cast<std::size_t>(along)))
    {
      throw Problem("has the labels " + header.text.valueOf({ "labels" }) + ", but axis " +
        std::to_string(i + 1) + " counts as " + std::string(1, "xyz"[along]) +
        ": kinds must say which axes are a domain and which are time; a domain must be x, y, z");
    }
    ++along;
  }
}

// Axes that have only spacings and ends.
void readSpacings(const AxisFields& fields, TextHeader& header)
{
  int along = 0;
  bool isBare = false;
  for (std::size_t i = 0; i < header.axes.size(); ++i)
  {
    HeaderAxis& axis = header.axes[i];
    if (!isSpatial(header, i) || along > 2)
    {
      readVolumes(fields, i, header);
      continue;
    }
    const double mm = mmPer(fields.units[i], header);
    double spacing = fields.spacings[i];
    double start = 0.0;
    useEnds(fields, i, static_cast<double>(axis.count), spacing, start);
    glm::dvec3 step(0.0);
    step[along] = std::isnan(spacing) ? 1.0 : spacing * mm;
    isBare = isBare || std::isnan(spacing);
    header.origin[along++] = start * mm;
    axis.step = step;
  }
  if (isBare)
  {
    header.warnings.emplace_back(
      "has neither space directions nor spacings of all axes; voxels count as 1 mm apart there");
  }
  requireLabels(header);
}

// Axes of a space, 3, or 4 with time. ITK writes time as a fourth axis of the space.
std::size_t dimensionsOf(const TextHeader& header, bool hasTime)
{
  const std::string text = header.text.valueOf({ "space dimension" });
  const std::size_t named = hasTime ? 4 : 3;
  if (text.empty())
  {
    return named;
  }
  const std::vector<double> numbers = numbersIn(text);
  const bool isNamed = header.text.has("space");
  const bool isGood = numbers.size() == 1 &&
    (isNamed ? numbers[0] == static_cast<double>(named) : numbers[0] == 3.0 || numbers[0] == 4.0);
  if (!isGood && text == "2")
  {
    throw Problem("has the space dimension 2: it is a picture and no volume; open it in a program "
                  "for pictures");
  }
  if (!isGood)
  {
    throw Problem("has the space dimension " + text + "; it must be " +
      (isNamed ? std::to_string(named) : "3, or 4 with time"));
  }
  return static_cast<std::size_t>(numbers[0]);
}

void readPlace(TextHeader& header)
{
  constexpr std::string_view Time = "-time";
  const std::string spaceText = header.text.valueOf({ "space" });
  const std::string word = lowerCase(spaceText);
  const bool isShort = word == "rast" || word == "last" || word == "lpst";
  const bool hasTime = isShort || endsWith(word, std::string(Time));
  const std::string plain =
    hasTime ? word.substr(0, word.size() - (isShort ? 1 : Time.size())) : word;
  const auto space = Spaces.find(plain);
  if (space == Spaces.end() && !spaceText.empty())
  {
    throw Problem("is in the space " + spaceText +
      "; BrainShift reads right-anterior-superior, left-anterior-superior, " +
      "left-posterior-superior, scanner-xyz, 3D-right-handed and 3D-left-handed, also with -time");
  }
  const std::size_t dimensions = dimensionsOf(header, hasTime);
  header.space = spaceText.empty() ? HeaderSpace::RAS : space->second.first;
  // Old segmentations of 3D Slicer have four axes of space, the last for segments; Slicer counts
  // them as LPS.
  const bool isOldSegmentation =
    spaceText.empty() && dimensions > 3 && !header.text.keyed("Segment0_ID").empty();
  if (spaceText.empty() && dimensions > 3)
  {
    header.space = HeaderSpace::LPS;
  }
  if (spaceText.empty() && dimensions > 3 && !isOldSegmentation)
  {
    header.warnings.emplace_back("names no space for its 4 dimensions, as ITK and SimpleITK write "
                                 "them; it counts as left-posterior-superior-time, as there");
  }
  const AxisFields fields = fieldsOfAxes(header);
  if (header.text.has("space directions"))
  {
    header.knowsSides = isOldSegmentation || (!spaceText.empty() && space->second.second);
    readDirections(fields, dimensions, header);
    header.axes.back().kind = isOldSegmentation ? "domain" : header.axes.back().kind; // no time
    return;
  }
  if (header.text.has("space origin") || header.text.has("space units"))
  {
    throw Problem("has a space origin or space units, but no space directions, without which they "
                  "place nothing");
  }
  header.space = HeaderSpace::RAS;
  readSpacings(fields, header);
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

void readNRRDStorage(const std::string& fileName, TextHeader& header)
{
  const std::string encoding = header.text.valueOf({ "encoding" });
  const auto known = Encodings.find(lowerCase(encoding));
  if (known == Encodings.end())
  {
    throw Problem("has the encoding " + encoding + "; it must be raw, gzip or ascii");
  }
  header.encoding = known->second;
  const std::string endian = lowerCase(header.text.valueOf({ "endian" }));
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
  requireKnownFields(header);
  readSizes(header);
  const std::vector<std::string> kinds = wordsOfAxes(header, "kinds", plainWords);
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    header.axes[i].kind = lowerCase(kinds[i]);
  }
  readNRRDType(header);
  readPlace(header);
  readNRRDStorage(fileName, header);
}
}
