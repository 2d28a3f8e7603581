// SPDX-License-Identifier: BSD-3-Clause

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/TextHeader.h"
#include "Formats/Volumes/RasGrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace brainshift
{
namespace
{
constexpr double MostDimensions = 4.0;
constexpr double MostChannels = 65536.0;

// All keys of the format. Any program may add others, which say nothing of places and numbers.
constexpr const char* Keys[] = { "AcquisitionDate", "AnatomicalOrientation", "BinaryData",
  "BinaryDataByteOrderMSB", "CenterOfRotation", "Color", "Comment", "CompressedData",
  "CompressedDataSize", "CompressionLevel", "DimSize", "DistanceUnits", "ElementByteOrderMSB",
  "ElementDataFile", "ElementMax", "ElementMin", "ElementNumberOfChannels", "ElementSize",
  "ElementSpacing", "ElementToIntensityFunctionOffset", "ElementToIntensityFunctionSlope",
  "ElementType", "HeaderSize", "ID", "Modality", "Name", "NDims", "ObjectSubType", "ObjectType",
  "Offset", "Orientation", "Origin", "ParentID", "Position", "Rotation", "SequenceID",
  "TransformMatrix", "TransformType" };

// By the end of an ElementType, after "MET_".
const std::map<std::string, int> MetaTypes{ { "CHAR", VTK_SIGNED_CHAR },
  { "UCHAR", VTK_UNSIGNED_CHAR }, { "SHORT", VTK_SHORT }, { "USHORT", VTK_UNSIGNED_SHORT },
  { "INT", VTK_INT }, { "UINT", VTK_UNSIGNED_INT }, { "LONG", VTK_INT },
  { "ULONG", VTK_UNSIGNED_INT }, { "LONG_LONG", VTK_LONG_LONG },
  { "ULONG_LONG", VTK_UNSIGNED_LONG_LONG }, { "FLOAT", VTK_FLOAT }, { "DOUBLE", VTK_DOUBLE } };

bool isKey(const std::string& name)
{
  return std::any_of(std::begin(Keys), std::end(Keys),
    [&](const char* key) { return lowerCase(key) == lowerCase(name); });
}

// A key that is almost one that counts would count as missing without a word. Beside the key itself
// it is another thing, such as the "toffset" that ITK takes along from NIfTI.
void requireKeys(TextHeader& header)
{
  constexpr std::size_t SlipOfTheHand = 2; // letters
  constexpr std::size_t Shortest = 6;      // letters; shorter names are alike by chance
  for (const std::string& name : header.text.repeated)
  {
    throwIfAny(isKey(name) ? twice("key " + shownWords(name)) : "");
  }
  for (const std::string& name : header.text.names)
  {
    if (isKey(name) && std::find(std::begin(Keys), std::end(Keys), name) == std::end(Keys))
    {
      header.warnings.push_back("has the key '" + shownWords(name) +
        "' in other capitals than MetaImage's; it counts, but other programs may leave it out");
    }
  }
  for (const auto& [name, value] : header.text.fields)
  {
    for (const std::string key : Keys)
    {
      if (!isKey(name) && !header.text.has(key) && key.size() >= Shortest &&
        lettersBetween(name, lowerCase(key)) <= SlipOfTheHand)
      {
        throw Problem("has the key '" + shownWords(name) +
          "', which MetaImage does not define; it must be " + key);
      }
    }
    if (!isKey(name) && name.rfind("element", 0) == 0)
    {
      header.warnings.push_back("has the key '" + shownWords(name) +
        "', which MetaImage does not define; it does not count");
    }
  }
}

// As in ITK, the first letter decides.
bool isTrue(const std::string& value)
{
  return !value.empty() && (value[0] == 'T' || value[0] == 't' || value[0] == '1');
}

void readMetaType(TextHeader& header)
{
  header.typeName = header.text.valueOf({ "ElementType" });
  std::string name = header.typeName;
  const std::string array = "_ARRAY"; // of the channels of a voxel
  if (name.size() > array.size() && name.substr(name.size() - array.size()) == array)
  {
    name.erase(name.size() - array.size());
  }
  const auto type =
    name.compare(0, 4, "MET_") == 0 ? MetaTypes.find(name.substr(4)) : MetaTypes.end();
  if (type == MetaTypes.end())
  {
    throw Problem("has the ElementType " + header.typeName +
      "; BrainShift reads MET_CHAR, MET_SHORT, " +
      "MET_INT, MET_LONG, MET_LONG_LONG, each of them unsigned as well, MET_FLOAT and MET_DOUBLE");
  }
  header.numberType = type->second;
}

// The axes: channels first if there are several, then those of space, then time.
void readAxes(std::size_t dimensions, TextHeader& header)
{
  const std::string channelsText = header.text.valueOf({ "ElementNumberOfChannels" });
  const std::vector<double> channels = numbersIn(channelsText.empty() ? "1" : channelsText);
  if (channels.size() != 1 || !isWhole(channels[0], 1.0, MostChannels))
  {
    throw Problem("has the ElementNumberOfChannels " + channelsText +
      "; it must be a whole number from 1 to 65536");
  }
  if (channels[0] > 1.0)
  {
    header.axes.emplace_back();
    header.axes.back().count = static_cast<std::int64_t>(channels[0]);
    header.axes.back().kind = "vector";
  }
  const std::string sidesText = header.text.valueOf({ "DimSize" });
  const std::vector<double> sides = numbersIn(sidesText);
  if (sides.size() != dimensions)
  {
    throw Problem("has the DimSize '" + sidesText + "'; it must have " +
      std::to_string(dimensions) + " numbers");
  }
  for (const double side : sides)
  {
    if (!isWhole(side, 1.0, LongestAxis))
    {
      throw Problem(
        "has the DimSize " + sidesText + "; each must be a whole number from 1 to 2147483647");
    }
    header.axes.emplace_back();
    header.axes.back().count = static_cast<std::int64_t>(side);
  }
}

// Fields that are names of one thing must not say two.
void requireOneMeaning(const HeaderText& text, const std::vector<std::string>& names)
{
  for (const std::string& name : names)
  {
    const std::string said = text.valueOf({ name });
    if (text.has(name) && said != text.valueOf(names) &&
      numbersIn(said) != numbersIn(text.valueOf(names)))
    {
      std::string sentence = "has the " + names[0] + " " + text.valueOf(names);
      sentence.append(", but the ").append(name).append(" ").append(said);
      throw Problem(sentence.append(", which means the same"));
    }
  }
}

// Millimetres in the unit of the file.
double mmOf(const TextHeader& header)
{
  const std::string unit = header.text.valueOf({ "DistanceUnits" });
  const std::optional<double> mm = unit == "?" ? 1.0 : mmPerUnit(unit);
  if (!mm)
  {
    throw Problem("has the DistanceUnits " + unit + "; they must be um, mm, cm or ?");
  }
  return *mm;
}

// A fourth axis that leans into space, or space into it, cannot be volumes of one place.
void requirePlainTime(const std::vector<double>& turn)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (turn[4 * i + 3] != 0.0 || turn[12 + i] != 0.0 || !(turn[15] > 0.0))
    {
      throw Problem("has a TransformMatrix that mixes time with space; its fourth row and column "
                    "must be 0 0 0 1");
    }
  }
}

// ITK takes the offset as the place of the first voxel, whatever the centre is.
void noteCentre(TextHeader& header)
{
  const std::string centre = header.text.valueOf({ "CenterOfRotation" });
  const std::vector<double> numbers = numbersIn(centre);
  if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0.0; }))
  {
    header.warnings.push_back(
      "has the CenterOfRotation " + centre + ", which does not count, as in ITK");
  }
}

// In the unit of the file.
std::vector<double> spacingOf(std::size_t dimensions, TextHeader& header)
{
  const std::string text = header.text.valueOf({ "ElementSpacing", "ElementSize" });
  if (text.empty())
  {
    header.warnings.emplace_back("has no ElementSpacing; its voxels count as 1 mm apart");
    return std::vector<double>(dimensions, 1.0);
  }
  const std::vector<double> spacing = numbersIn(text);
  if (spacing.size() != dimensions)
  {
    throw Problem(
      "has the spacing " + text + "; it must have " + std::to_string(dimensions) + " numbers (mm)");
  }
  return spacing;
}

// The steps of the axes of space. The file names the direction of one axis after the other.
void readPlace(std::size_t dimensions, TextHeader& header)
{
  requireOneMeaning(header.text, { "TransformMatrix", "Rotation", "Orientation" });
  requireOneMeaning(header.text, { "Offset", "Position", "Origin" });
  const std::vector<double> spacing = spacingOf(dimensions, header);
  const std::string turnText =
    header.text.valueOf({ "TransformMatrix", "Rotation", "Orientation" });
  std::vector<double> turn = numbersIn(turnText);
  // MetaIO writes question marks for axes whose sides its caller did not name.
  header.knowsSides =
    !turnText.empty() && header.text.valueOf({ "AnatomicalOrientation" }) != "???";
  if (turnText.empty())
  {
    turn.assign(dimensions * dimensions, 0.0);
    for (std::size_t i = 0; i < dimensions; ++i)
    {
      turn[i * dimensions + i] = 1.0;
    }
  }
  const std::string originText = header.text.valueOf({ "Offset", "Position", "Origin" });
  std::vector<double> origin = numbersIn(originText);
  header.hasOrigin = !originText.empty();
  origin = originText.empty() ? std::vector<double>(dimensions, 0.0) : origin;
  const std::string wanted = "; it must have " + std::to_string(dimensions) + " numbers (mm)";
  if (origin.size() != dimensions)
  {
    throw Problem("has the Offset " + originText + wanted);
  }
  if (turn.size() != dimensions * dimensions)
  {
    throw Problem("has the TransformMatrix " + turnText + "; it must have " +
      std::to_string(dimensions * dimensions) + " numbers");
  }
  const std::size_t first = header.axes.size() - dimensions;
  const double mm = mmOf(header);
  glm::dvec3 lengths(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* const unit = &turn[axis * dimensions];
    const glm::dvec3 direction(unit[0], unit[1], unit[2]);
    lengths[axis] = glm::length(direction);
    header.axes[first + axis].step = direction * (mm * spacing[axis]);
  }
  warnOfScaledAxes(lengths, header.warnings);
  if (dimensions == 4)
  {
    header.axes.back().kind = "time";
    header.axes.back().spacing = spacing[3];
    header.axes.back().start = origin[3];
    requirePlainTime(turn);
  }
  header.origin = mm * glm::dvec3(origin[0], origin[1], origin[2]);
  noteCentre(header);
}

// The letters of the sides that the axes come from (as ITK names them) or lead to.
std::string lettersOf(const TextHeader& header, bool leadTo)
{
  std::string letters;
  for (const HeaderAxis& axis : header.axes)
  {
    if (!axis.step)
    {
      continue;
    }
    int largest = 0;
    for (int i = 1; i < 3; ++i)
    {
      largest = std::abs((*axis.step)[i]) > std::abs((*axis.step)[largest]) ? i : largest;
    }
    const bool isForward = (*axis.step)[largest] > 0.0;
    letters += (isForward == leadTo ? "LPS" : "RAI")[largest];
  }
  return letters;
}

// AnatomicalOrientation repeats what the matrix says, in letters that programs choose in two ways.
void compareOrientation(TextHeader& header)
{
  const std::string said = header.text.valueOf({ "AnatomicalOrientation" });
  const bool isNamed = said.size() == 3 && said.find_first_not_of("RLAPIS") == std::string::npos;
  if (!isNamed || said == lettersOf(header, false) || said == lettersOf(header, true))
  {
    return;
  }
  header.warnings.push_back(header.knowsSides
      ? "has the AnatomicalOrientation " + said + ", but its TransformMatrix means " +
        lettersOf(header, false) + " (from where the axes come); the matrix counts"
      : "has the AnatomicalOrientation " + said +
        " but no TransformMatrix; the letters alone are ambiguous and do not count");
}

void readScale(TextHeader& header)
{
  for (const auto& [name, number] :
    { std::pair<const char*, double*>{ "ElementToIntensityFunctionSlope", &header.slope },
      { "ElementToIntensityFunctionOffset", &header.intercept } })
  {
    const std::string text = header.text.valueOf({ name });
    const std::vector<double> found = numbersIn(text);
    if (!text.empty() && (found.size() != 1 || !std::isfinite(found[0])))
    {
      throw Problem(std::string("has the ") + name + " " + text + "; it must be a finite number");
    }
    *number = text.empty() ? *number : found[0];
  }
  // Of 0 every voxel would have the same value. It stands for no scaling, as in NIfTI.
  if (header.slope == 0.0)
  {
    header.slope = 1.0;
    header.warnings.emplace_back("has the ElementToIntensityFunctionSlope 0, which counts as 1");
  }
}

void readMetaStorage(const std::string& fileName, TextHeader& header)
{
  const std::vector<std::string> orders{ "BinaryDataByteOrderMSB", "ElementByteOrderMSB" };
  header.isBigEndian = isTrue(header.text.valueOf(orders));
  if (header.text.has(orders[1]) &&
    isTrue(header.text.valueOf({ orders[1] })) != header.isBigEndian)
  {
    throw Problem("has an ElementByteOrderMSB other than its BinaryDataByteOrderMSB");
  }
  const bool isPacked = isTrue(header.text.valueOf({ "CompressedData" }));
  // As in ITK, an image is binary if the file does not say it.
  const bool isBinary =
    !header.text.has("BinaryData") || isTrue(header.text.valueOf({ "BinaryData" }));
  header.encoding = !isBinary ? Encoding::Text : isPacked ? Encoding::Packed : Encoding::Raw;
  const std::string skipText = header.text.valueOf({ "HeaderSize" });
  const std::vector<double> skip = numbersIn(skipText.empty() ? "0" : skipText);
  if (skip.size() != 1 || !isWhole(skip[0], -1.0, 1e15))
  {
    throw Problem("has the HeaderSize " + skipText + "; it must be a whole number, -1 or more");
  }
  const std::string dataFile = header.text.valueOf({ "ElementDataFile" });
  if (dataFile.empty())
  {
    throw Problem("names no ElementDataFile");
  }
  header.isAtEnd = skip[0] < 0.0;
  header.fileSkip = header.isAtEnd ? 0 : static_cast<std::uint64_t>(skip[0]);
  if (header.isAtEnd && header.encoding != Encoding::Raw)
  {
    throw Problem("has the HeaderSize -1 before numbers that are packed or text; they must be raw");
  }
  nameDataFiles(fileName, dataFile, header);
}
}

void fromMetaImage(const std::string& fileName, TextHeader& header)
{
  const std::string object = header.text.valueOf({ "ObjectType" });
  if (!object.empty() && lowerCase(object) != "image")
  {
    throw Problem("has the ObjectType " + object + "; it must be Image");
  }
  const std::string dimensionsText = header.text.valueOf({ "NDims" });
  const std::vector<double> dimensions = numbersIn(dimensionsText.empty() ? "3" : dimensionsText);
  if (dimensions.size() != 1 || !isWhole(dimensions[0], 3.0, MostDimensions))
  {
    throw Problem("has the NDims " + dimensionsText + "; it must be 3, or 4 with time");
  }
  const auto count = static_cast<std::size_t>(dimensions[0]);
  requireKeys(header);
  header.space = HeaderSpace::LPS;
  readAxes(count, header);
  readMetaType(header);
  readPlace(count, header);
  readScale(header);
  readMetaStorage(fileName, header);
  compareOrientation(header);
}
}
