// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Streamlines of the TRX format of DIPY, SCIL and MRtrix' community (.trx): a zip archive, or a
/// folder, of plain arrays. Points are in RAS mm, of the centres of voxels.
///
/// The names are those of the format: header.json, positions, offsets, dpv (numbers of points), dps
/// (of streamlines), groups (numbers of streamlines) and dpg.
#include "Common/Bytes.h"
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Files/ZipFile.h"
#include "Formats/Surfaces/SurfaceFile.h"

#include "vtk_nlohmannjson.h"
#include VTK_NLOHMANN_JSON(json.hpp)

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::size_t MostFiles = 65536;
constexpr double MostNumbers = 1e12;
constexpr std::string_view GroupPrefix = "groups/"; // of the array that says who is in a group

// The kinds of numbers of the format, as they are kept. float16 becomes float32.
const std::map<std::string, NumberType> Types{ { "int8", NumberType::Int8 },
  { "uint8", NumberType::UInt8 }, { "int16", NumberType::Int16 }, { "uint16", NumberType::UInt16 },
  { "int32", NumberType::Int32 }, { "uint32", NumberType::UInt32 }, { "int64", NumberType::Int64 },
  { "uint64", NumberType::UInt64 }, { "float32", NumberType::Float32 },
  { "float64", NumberType::Float64 }, { "float16", NumberType::Float32 } };

// An array of the file.
struct StoredArray
{
  std::string folder; // dpv, dps, groups, dpg/NAME; empty for positions and offsets
  std::string name;
  std::size_t components = 1;
  std::string type;
  std::vector<char> bytes; // in this machine's order

  std::size_t count() const // tuples
  {
    const std::size_t size = this->type == "float16" ? 2 : bytesOf(Types.at(this->type));
    return this->bytes.size() / (size * this->components);
  }
};

// The files of an archive or a folder, by their paths.
class Parts
{
public:
  explicit Parts(const TractSource& source)
  {
    if (std::filesystem::is_directory(source.fileName))
    {
      this->list(source.fileName);
      return;
    }
    this->Packed.emplace(source.fileName);
  }

  std::vector<std::string> names() const
  {
    std::vector<std::string> all;
    if (this->Packed)
    {
      all = this->Packed->names();
    }
    for (const auto& [name, path] : this->Paths)
    {
      all.push_back(name);
    }
    return all;
  }

  std::vector<char> read(const std::string& name) const
  {
    if (const std::optional<std::uint64_t> size =
          this->Packed ? this->Packed->size(name) : std::nullopt)
    {
      requireMemoryFor(*size);
      std::string bytes;
      withBeginning("has the file " + shownWords(name) + " that ",
        [&] { bytes = this->Packed->part(name, 0, *size); });
      return { bytes.begin(), bytes.end() };
    }
    const auto path = this->Paths.find(name);
    if (path == this->Paths.end())
    {
      throw Problem("has no " + name);
    }
    requirePlainFile(path->second);
    std::error_code error;
    const auto size = std::filesystem::file_size(path->second, error);
    throwIfAny(error ? "has the file " + shownWords(name) + " of an unknown size" : "");
    requireMemoryFor(size);
    const std::string text = readBeginning(path->second, static_cast<std::size_t>(size));
    return { text.begin(), text.end() };
  }

private:
  static void requireMemoryFor(std::uintmax_t bytes)
  {
    withBeginning(
      "cannot be read: ", [&] { requireHostMemory("its part", static_cast<double>(bytes)); });
  }

  void list(const std::string& folder)
  {
    std::error_code error;
    constexpr int Deepest = 2; // dpg/GROUP/NAME
    for (std::filesystem::recursive_directory_iterator file(folder, error), end; file != end;
      file.increment(error))
    {
      requireListed(error, this->Paths.size());
      if (file.depth() >= Deepest)
      {
        file.disable_recursion_pending();
      }
      if (file->is_regular_file(error))
      {
        const std::filesystem::path path = file->path();
        this->Paths[path.lexically_relative(folder).generic_string()] = path.string();
      }
    }
    requireListed(error, this->Paths.size()); // an error ends the loop
  }

  static void requireListed(const std::error_code& error, std::size_t files)
  {
    if (error || files > MostFiles)
    {
      throw Problem("is a folder that cannot be listed, or of more than 65536 files");
    }
  }

  std::optional<ZipFile> Packed;
  std::map<std::string, std::string> Paths;
};

// dpv/fa.float32 or dpv/color.3.uint8. Nothing for header.json and files of others.
std::optional<StoredArray> arrayNamed(const std::string& path)
{
  StoredArray array;
  const std::size_t slash = path.rfind('/');
  array.folder = slash == std::string::npos ? "" : path.substr(0, slash);
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0)
  {
    return {};
  }
  array.type = name.substr(dot + 1);
  name.resize(dot);
  const std::size_t other = name.rfind('.');
  const std::optional<int> components =
    other == std::string::npos ? std::optional<int>() : numberIn<int>(name.substr(other + 1));
  if (components && *components > 0)
  {
    array.components = static_cast<std::size_t>(*components);
    name.resize(other);
  }
  array.name = name;
  const bool isOurs = array.folder.empty() ? name == "positions" || name == "offsets"
                                           : array.folder == "dpv" || array.folder == "dps" ||
      array.folder == "groups" || array.folder.rfind("dpg/", 0) == 0;
  return isOurs ? std::optional(array) : std::nullopt;
}

void readArray(const Parts& parts, const std::string& path, StoredArray& array)
{
  if (array.type != "float16" && Types.count(array.type) == 0)
  {
    throw Problem("has the file " + shownWords(path) + ", whose numbers are of the type " +
      shownWords(array.type) + "; BrainShift reads int8 to int64, uint8 to uint64 and float16 to " +
      "float64");
  }
  array.bytes = parts.read(path);
  const std::size_t size = array.type == "float16" ? 2 : bytesOf(Types.at(array.type));
  if (array.bytes.size() % (size * array.components) != 0)
  {
    throw Problem("has the file " + shownWords(path) + " of " + std::to_string(array.bytes.size()) +
      " bytes, which is no multiple of " + std::to_string(size * array.components));
  }
  toMachineOrder(array.bytes.data(), array.bytes.size() / size, size, false);
}

float floatOfHalf(std::uint16_t half)
{
  const int exponent = half >> 10 & 0x1f;
  const int fraction = half & 0x3ff;
  const float sign = (half & 0x8000) != 0 ? -1.0f : 1.0f;
  constexpr int Special = 31; // infinity, and no number
  if (exponent == Special)
  {
    return fraction == 0 ? sign * std::numeric_limits<float>::infinity()
                         : std::numeric_limits<float>::quiet_NaN();
  }
  return sign *
    (exponent == 0 ? std::ldexp(static_cast<float>(fraction), -24)
                   : std::ldexp(static_cast<float>(fraction + 1024), exponent - 25));
}

// float16 to float32; the others stay.
void widen(StoredArray& array)
{
  if (array.type != "float16")
  {
    return;
  }
  withBeginning("cannot be read: ", [&] {
    requireHostMemory("its part " + array.name, 2.0 * static_cast<double>(array.bytes.size()));
  });
  std::vector<char> wide(2 * array.bytes.size());
  for (std::size_t i = 0; i < array.bytes.size() / 2; ++i)
  {
    std::uint16_t half = 0;
    std::memcpy(&half, array.bytes.data() + 2 * i, sizeof(half));
    const float number = floatOfHalf(half);
    std::memcpy(wide.data() + 4 * i, &number, sizeof(number));
  }
  array.bytes = std::move(wide);
  array.type = "float32";
}

template <typename T>
T numberAt(const StoredArray& array, std::size_t i)
{
  T number{};
  std::memcpy(&number, array.bytes.data() + i * sizeof(T), sizeof(T));
  return number;
}

// A whole number of offsets or groups; above all limits if it is negative.
std::uint64_t wholeAt(const StoredArray& array, std::size_t i)
{
  return array.type == "uint64" || array.type == "int64" ? numberAt<std::uint64_t>(array, i)
    : array.type == "uint32"                             ? numberAt<std::uint32_t>(array, i)
    : array.type == "int32"
    ? static_cast<std::uint64_t>(std::int64_t(numberAt<std::int32_t>(array, i)))
    : throw Problem("has " + array.name + " of the type " + array.type +
        "; they must be whole numbers of 4 or 8 bytes");
}

// What header.json announces.
struct Announced
{
  std::uint64_t vertices = 0;
  std::uint64_t streamlines = 0;
};

std::uint64_t countIn(const nlohmann::json& header, const char* key)
{
  const auto found = header.is_object() ? header.find(key) : header.end();
  const bool isNumber = found != header.end() && found->is_number();
  const double number = isNumber ? found->get<double>() : -1.0;
  if (!isWhole(number, 0.0, MostNumbers))
  {
    throw Problem("has no whole number " + std::string(key) + " in its header.json");
  }
  return static_cast<std::uint64_t>(number);
}

Announced readHeader(const Parts& parts)
{
  constexpr std::size_t Longest = 1 << 20;
  const std::vector<char> text = parts.read("header.json");
  throwIfAny(text.size() > Longest ? "has a header.json of more than 1 MiB" : "");
  const nlohmann::json header =
    nlohmann::json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions*/ false);
  throwIfAny(header.is_discarded() ? "has a header.json that is no JSON" : "");
  return { countIn(header, "NB_VERTICES"), countIn(header, "NB_STREAMLINES") };
}

const StoredArray& theOnly(const std::vector<StoredArray>& arrays, const std::string& name)
{
  const StoredArray* found = nullptr;
  for (const StoredArray& array : arrays)
  {
    if (array.folder.empty() && array.name == name)
    {
      throwIfAny(found ? twice("array " + name) : "");
      found = &array;
    }
  }
  if (!found)
  {
    throw Problem("has no " + name);
  }
  return *found;
}

void takePositions(const StoredArray& positions, const Announced& announced, Tracts& tracts)
{
  const bool isReal = positions.type == "float32" || positions.type == "float64";
  if (positions.components != 3 || !isReal || positions.count() != announced.vertices)
  {
    throw Problem(joined("has ", positions.count(), " positions of ", positions.components,
      " components of the type ", positions.type, "; it announces ", announced.vertices,
      " (NB_VERTICES), which must have 3, of float16, float32 or float64"));
  }
  tracts.points.resize(positions.count());
  for (std::size_t i = 0; i < tracts.points.size(); ++i)
  {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::size_t at = 3 * i + static_cast<std::size_t>(axis);
      point[axis] = positions.type == "float64" ? numberAt<double>(positions, at)
                                                : numberAt<float>(positions, at);
    }
    requirePoint(point, "point " + std::to_string(i));
    tracts.points[i] = glm::vec3(point);
  }
}

// The first point of each streamline that has points. `kept` gets which of the file's these are.
void takeOffsets(const StoredArray& offsets, const Announced& announced, Tracts& tracts,
  std::vector<std::size_t>& kept)
{
  const std::size_t count = offsets.count();
  const bool hasEnd = count == announced.streamlines + 1; // as newer files do
  if (offsets.components != 1 || (!hasEnd && count != announced.streamlines))
  {
    throw Problem(joined("has ", count, " offsets of ", offsets.components,
      " components; it "
      "announces ",
      announced.streamlines,
      " streamlines (NB_STREAMLINES), which have one each, "
      "and one more at the end"));
  }
  const std::uint64_t points = tracts.points.size();
  for (std::size_t i = 0; i < announced.streamlines; ++i)
  {
    const std::uint64_t first = wholeAt(offsets, i);
    const std::uint64_t next = i + 1 < count ? wholeAt(offsets, i + 1) : points;
    const bool isFirst = i == 0 ? first == 0 : true;
    const bool isLast = i + 1 == announced.streamlines ? next == points : true;
    if (first > next || next > points || !isFirst || !isLast)
    {
      throw Problem(joined("has the streamline ", i, " from point ", first, " to ", next, " of ",
        points, "; streamlines must follow one another from the first point to the last"));
    }
    if (next > first)
    {
      kept.push_back(i);
      tracts.firsts.push_back(static_cast<std::int64_t>(next));
    }
  }
  throwIfAny(announced.streamlines == 0 && points > 0 ? "has points and no streamlines" : "");
  if (kept.size() < announced.streamlines)
  {
    tracts.notes.push_back("has " + counted(announced.streamlines - kept.size(), "streamline") +
      " without points; left out");
  }
}

NamedNumbers numbersOf(const StoredArray& array, OwnNames& own)
{
  return { own.own(validUtf8(array.name)), Types.at(array.type), array.components, array.bytes };
}

// The numbers of those streamlines that are kept.
void keepOnly(const std::vector<std::size_t>& kept, std::size_t all, NamedNumbers& numbers)
{
  if (kept.size() == all)
  {
    return;
  }
  const std::size_t size = numbers.components * bytesOf(numbers.type);
  std::vector<char> bytes(kept.size() * size);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    std::copy_n(&numbers.bytes[kept[i] * size], size, &bytes[i * size]);
  }
  numbers.bytes = std::move(bytes);
}

// Which streamlines are in a group: 1, the others 0.
NamedNumbers membersOf(const StoredArray& group, std::uint64_t streamlines, OwnNames& own)
{
  withBeginning(
    "cannot be read: ", [&] { requireHostMemory("a group", static_cast<double>(streamlines)); });
  NamedNumbers members{ own.own(std::string(GroupPrefix) + validUtf8(group.name)),
    NumberType::UInt8, 1, std::vector<char>(static_cast<std::size_t>(streamlines), 0) };
  for (std::size_t i = 0; i < group.count() * group.components; ++i)
  {
    const std::uint64_t member = wholeAt(group, i);
    if (member >= streamlines)
    {
      throw Problem(joined("has the streamline ", member, " in its group ", shownWords(group.name),
        "; it has the streamlines 0 to ", streamlines - 1));
    }
    members.bytes[static_cast<std::size_t>(member)] = 1;
  }
  return members;
}

void takeNumbers(const std::vector<StoredArray>& arrays, const Announced& announced,
  const std::vector<std::size_t>& kept, Tracts& tracts)
{
  OwnNames ofPoints;
  OwnNames ofStreamlines;
  std::size_t leftOut = 0;
  for (const StoredArray& array : arrays)
  {
    const bool isOfPoints = array.folder == "dpv";
    if (isOfPoints || array.folder == "dps")
    {
      const std::uint64_t wanted = isOfPoints ? announced.vertices : announced.streamlines;
      if (array.count() != wanted)
      {
        throw Problem(joined("has ", array.count(), " tuples in ", array.folder, "/",
          shownWords(array.name), "; it must have ", wanted));
      }
    }
    if (isOfPoints)
    {
      tracts.ofPoints.push_back(numbersOf(array, ofPoints));
    }
    else if (array.folder == "dps" || array.folder == "groups")
    {
      tracts.ofStreamlines.push_back(array.folder == "dps"
          ? numbersOf(array, ofStreamlines)
          : membersOf(array, announced.streamlines, ofStreamlines));
      keepOnly(kept, announced.streamlines, tracts.ofStreamlines.back());
    }
    leftOut += array.folder.rfind("dpg", 0) == 0 ? 1 : 0;
  }
  if (leftOut > 0)
  {
    tracts.notes.push_back("has " + counted(leftOut, "array") + " of whole groups (dpg); left out");
  }
}

bool isTRXFile(const std::string& fileName)
{
  std::error_code error;
  if (std::filesystem::is_directory(fileName, error))
  {
    return isPlainFile((std::filesystem::path(fileName) / "header.json").string()) &&
      endsWith(fileName, ".trx");
  }
  return endsWith(fileName, ".trx") && readBeginning(fileName, 2) == "PK";
}

void readTRX(std::vector<char>& bytes, const TractSource& source, const FractionDone& fractionDone,
  Tracts& tracts)
{
  bytes = {}; // the file is read entry by entry
  const Parts parts(source);
  const Announced announced = readHeader(parts);
  std::vector<StoredArray> arrays;
  const std::vector<std::string> names = parts.names();
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (std::optional<StoredArray> array = arrayNamed(names[i]))
    {
      readArray(parts, names[i], *array);
      widen(*array);
      arrays.push_back(*std::move(array));
    }
    if (!fractionDone(static_cast<double>(i + 1) / static_cast<double>(names.size())))
    {
      return;
    }
  }
  std::vector<std::size_t> kept;
  takePositions(theOnly(arrays, "positions"), announced, tracts);
  takeOffsets(theOnly(arrays, "offsets"), announced, tracts, kept);
  takeNumbers(arrays, announced, kept, tracts);
}

// The name of a type in a file.
std::string nameOf(NumberType type)
{
  for (const auto& [name, known] : Types)
  {
    if (known == type && name != "float16")
    {
      return name;
    }
  }
  return "float32";
}

// A name without what parts a path and its type.
std::string fileNameOf(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == '/' || c == '.'; }, '_');
  return name.empty() ? "unnamed" : name;
}

template <typename T>
void addNumber(std::vector<char>& bytes, T number)
{
  char stored[sizeof(T)];
  std::memcpy(stored, &number, sizeof(T));
  bytes.insert(bytes.end(), stored, stored + sizeof(T));
}

// Gives arrays of a folder names of their own in the file, and notes those that are others.
class FileNames
{
public:
  FileNames(const std::string& prefix, TractNotes& notes)
    : Prefix(prefix)
    , Notes(notes)
  {
  }

  // `rest`: what follows the name, components and type.
  std::string of(const std::string& name, const std::string& rest)
  {
    const std::string stored = this->Names.own(fileNameOf(name));
    if (stored != name)
    {
      this->Notes.push_back("calls the array " + shownWords(name) + " " + shownWords(stored));
    }
    return this->Prefix + stored + rest;
  }

private:
  std::string Prefix;
  TractNotes& Notes;
  OwnNames Names;
};

NamedBytes partOf(FileNames& names, const NamedNumbers& numbers)
{
  const std::string components =
    numbers.components > 1 ? "." + std::to_string(numbers.components) : "";
  return { names.of(numbers.name, components + "." + nameOf(numbers.type)), numbers.bytes };
}

NamedBytes groupOf(FileNames& names, const NamedNumbers& numbers)
{
  NamedBytes group{ names.of(numbers.name.substr(GroupPrefix.size()), ".uint32"), {} };
  for (std::size_t i = 0; i < numbers.bytes.size(); ++i)
  {
    if (numbers.bytes[i] != 0)
    {
      addNumber(group.bytes, static_cast<std::uint32_t>(i));
    }
  }
  return group;
}

std::string headerOf(const Tracts& tracts, const TractBox& box)
{
  nlohmann::json header;
  header["DIMENSIONS"] = { box.dimensions.x, box.dimensions.y, box.dimensions.z };
  header["VOXEL_TO_RASMM"] = nlohmann::json::array();
  for (int row = 0; row < 4; ++row)
  {
    header["VOXEL_TO_RASMM"].push_back({ box.worldFromVoxel[0][row], box.worldFromVoxel[1][row],
      box.worldFromVoxel[2][row], box.worldFromVoxel[3][row] });
  }
  header["NB_VERTICES"] = tracts.points.size();
  header["NB_STREAMLINES"] = tracts.firsts.size() - 1;
  return header.dump();
}

void writeTRX(
  const std::string& fileName, const Tracts& tracts, const TractBox& box, TractNotes& notes)
{
  throwIfAny(
    thisMachineIsBigEndian() ? "such files are little-endian, and this machine is not" : "");
  const std::string header = headerOf(tracts, box);
  std::vector<NamedBytes> parts{ { "header.json", { header.begin(), header.end() } } };
  const auto* positions = reinterpret_cast<const char*>(tracts.points.data());
  parts.push_back(
    { "positions.3.float32", { positions, positions + tracts.points.size() * sizeof(glm::vec3) } });
  parts.push_back({ "offsets.uint64", {} });
  for (const std::int64_t first : tracts.firsts)
  {
    addNumber(parts.back().bytes, static_cast<std::uint64_t>(first));
  }
  FileNames ofPoints("dpv/", notes);
  FileNames ofStreamlines("dps/", notes);
  FileNames ofGroups(std::string(GroupPrefix), notes);
  for (const NamedNumbers& numbers : tracts.ofPoints)
  {
    parts.push_back(partOf(ofPoints, numbers));
  }
  for (const NamedNumbers& numbers : tracts.ofStreamlines)
  {
    const bool isGroup = numbers.name.rfind(GroupPrefix, 0) == 0 &&
      numbers.type == NumberType::UInt8 && numbers.components == 1;
    parts.push_back(isGroup ? groupOf(ofGroups, numbers) : partOf(ofStreamlines, numbers));
  }
  writeWholeStream(fileName, [&](std::ostream& file) { writeZip(parts, file); });
}
}

extern const TractFormat TractsOfTRX{ isTRXFile, readTRX, ".trx", writeTRX };
}
