// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Streamlines of TrackVis and of Diffusion Toolkit, DIPY and others (.trk).
///
/// Points are in mm along the axes of a volume, from the corner of its first voxel. The header's
/// vox_to_ras takes them to RAS; its voxel_order names the directions of the axes. Numbers of
/// points (scalars) and of streamlines (properties) keep their names.
#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Common/Parallel.h"
#include "Formats/Files/PackedBytes.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Surfaces/SurfaceFile.h"
#include "Formats/Volumes/RasGrid.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::size_t HeaderBytes = 1000;
constexpr std::string_view Magic = "TRACK";
constexpr std::size_t NameBytes = 20;
constexpr int MostNames = 10;          // as the header has room for
constexpr double SmallestCosine = 0.1; // of an axis with the direction that its letter names
constexpr double EqualCosines = 1e-3;  // that differ by no more
constexpr double EqualSizes = 1e-3;    // of voxels, as a fraction: 0.25 voxels in 256

// The names are those of the format.
struct TrackHeader
{
  const char* bytes = nullptr;
  bool isBigEndian = false;

  template <typename T>
  T at(std::size_t offset) const
  {
    return storedNumber<T>(this->bytes + offset, this->isBigEndian);
  }
  int dim(int axis) const { return this->at<std::int16_t>(6 + 2 * static_cast<std::size_t>(axis)); }
  double voxelSize(int axis) const
  {
    return this->at<float>(12 + 4 * static_cast<std::size_t>(axis));
  }
  int scalars() const { return this->at<std::int16_t>(36); }
  int properties() const { return this->at<std::int16_t>(238); }
  std::string name(std::size_t offset) const { return { this->bytes + offset, NameBytes }; }
  int version() const { return this->at<std::int32_t>(992); }
  bool hasMatrix() const // which the format has since version 2
  {
    return this->version() >= 2 && this->at<float>(440 + 4 * 15) != 0.0f;
  }
  glm::dmat4 voxToRas() const
  {
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 12; ++i)
    {
      matrix[i % 4][i / 4] = this->at<float>(440 + 4 * static_cast<std::size_t>(i));
    }
    return matrix;
  }
  bool hasVoxelOrder() const { return this->bytes[948] != '\0' && this->bytes[948] != ' '; }
  std::string voxelOrder() const
  {
    return this->hasVoxelOrder() ? std::string(this->bytes + 948, 3) : "LPS"; // the default
  }
  int count() const { return this->at<std::int32_t>(988); }
};

void readHeader(const std::vector<char>& bytes, TrackHeader& header)
{
  if (bytes.size() < HeaderBytes || std::string_view(bytes.data(), Magic.size()) != Magic)
  {
    throw Problem(bytes.size() < HeaderBytes ? "has no whole header, which has 1000 bytes"
                                             : "does not begin with TRACK");
  }
  header.bytes = bytes.data();
  header.isBigEndian = true;
  header.isBigEndian = header.at<std::int32_t>(996) == static_cast<std::int32_t>(HeaderBytes);
  const auto size = header.at<std::int32_t>(996);
  const int version = header.version();
  if (size != static_cast<std::int32_t>(HeaderBytes) || version < 1 || version > 3)
  {
    throw Problem("has the version " + std::to_string(version) + " and the header size " +
      std::to_string(size) + "; they must be 1 to 3 and 1000");
  }
  for (const int numbers : { header.scalars(), header.properties() })
  {
    if (numbers < 0)
    {
      throw Problem("has " + std::to_string(numbers) + " numbers for each point or streamline");
    }
  }
  if (header.count() < 0)
  {
    throw Problem(
      "announces " + std::to_string(header.count()) + " streamlines; it must be 0 or more");
  }
}

// Half a voxel less, then voxels, for points in mm from the corner of the first voxel.
glm::dmat4 voxelFromStored(const TrackHeader& header)
{
  glm::dmat4 voxel(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double size = header.voxelSize(axis);
    if (!(size > 0.0 && size < FarthestPoint))
    {
      throw Problem("has voxels of " + roundedText(size) + " mm along axis " +
        std::to_string(axis) + "; it must be more than 0 and less than " +
        numberText(FarthestPoint));
    }
    voxel[axis][axis] = 1.0 / size;
    voxel[3][axis] = -0.5;
  }
  return voxel;
}

// Whether another order of the letters brings each axis that it changes nearer to its direction.
// `along` has the axes of a volume, `directions` which of R, A and S each letter names.
bool isOtherOrder(const glm::dmat3& along, const std::array<int, 3>& directions)
{
  std::array<int, 3> other{ 0, 1, 2 };
  do
  {
    bool isNearer = other != directions;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const glm::dvec3& axisOf = along[static_cast<int>(axis)];
      isNearer = isNearer &&
        (other[axis] == directions[axis] ||
          std::abs(axisOf[other[axis]]) > std::abs(axisOf[directions[axis]]) + EqualCosines);
    }
    if (isNearer)
    {
      return true;
    }
  } while (std::next_permutation(other.begin(), other.end()));
  return false;
}

// Turns the axes around whose letters name the direction against that of the matrix.
void turnAxes(const TrackHeader& header, const glm::dmat4& world, glm::dmat4& voxel)
{
  constexpr std::string_view Letters = "RLAPSI";
  const std::string order = header.voxelOrder();
  glm::dmat3 axes(1.0);
  std::array<int, 3> directions{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const char letter = order[static_cast<std::size_t>(axis)];
    const std::size_t place = Letters.find(letter >= 'a' ? static_cast<char>(letter - 32) : letter);
    if (place == std::string_view::npos)
    {
      throw Problem(
        "has the voxel order " + shownWords(order) + "; it must be 3 of the letters RLAPSI");
    }
    const glm::dvec3 along = glm::normalize(glm::dvec3(world[axis]));
    axes[axis] = along;
    directions[static_cast<std::size_t>(axis)] = static_cast<int>(place / 2);
    const double cosine = along[static_cast<int>(place / 2)] * (place % 2 == 0 ? 1.0 : -1.0);
    if (std::abs(cosine) < SmallestCosine)
    {
      throw Problem("has the voxel order " + shownWords(order) + ", and axis " +
        std::to_string(axis) + " of vox_to_ras does not run along " + letter);
    }
    if (cosine < 0.0 && header.dim(axis) < 1)
    {
      throw Problem("has a volume of " + std::to_string(header.dim(axis)) + " voxels along axis " +
        std::to_string(axis) + ", which its voxel order turns around; it must be 1 or more");
    }
    if (cosine < 0.0)
    {
      for (int column = 0; column < 4; ++column)
      {
        voxel[column][axis] = -voxel[column][axis];
      }
      voxel[3][axis] += header.dim(axis) - 1.0;
    }
  }
  const bool isEach = directions[0] != directions[1] && directions[1] != directions[2] &&
    directions[2] != directions[0];
  if (!isEach || isOtherOrder(axes, directions))
  {
    throw Problem("has the voxel order " + shownWords(order) +
      ", and the axes of vox_to_ras run along these letters in another order");
  }
}

// Which voxels the streamlines were made in, where the header does not say it.
glm::dmat4 givenMatrix(const TrackHeader& header, const std::string& volumeName)
{
  const VolumeGrid grid = withBeginning("has no vox_to_ras, and its volume cannot be read: ",
    [&] { return readVolumeGrid(volumeName); });
  const glm::ivec3 sides(header.dim(0), header.dim(1), header.dim(2));
  if (sides != grid.dimensions)
  {
    throw Problem("was made in a volume of " + std::to_string(sides.x) + " x " +
      std::to_string(sides.y) + " x " + std::to_string(sides.z) + " voxels; " + volumeName +
      " has " + std::to_string(grid.dimensions.x) + " x " + std::to_string(grid.dimensions.y) +
      " x " + std::to_string(grid.dimensions.z));
  }
  return grid.worldFromVoxel;
}

// The size of a voxel is there twice: voxel_size takes points to voxels, the matrix these to mm.
void noteSizes(const TrackHeader& header, const glm::dmat4& world, Tracts& tracts)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double size = header.voxelSize(axis);
    const double column = glm::length(glm::dvec3(world[axis]));
    if (std::abs(size - column) > EqualSizes * column)
    {
      tracts.notes.push_back(joined("has the voxel_size ", size, " mm along axis ", axis,
        ", but the voxels of its ", header.hasMatrix() ? "vox_to_ras" : "Volume", " are ", column,
        " mm long there. voxel_size takes points to voxels, as the format says, so the streamlines "
        "are stretched by ",
        column / size, "; compare them with their volume"));
    }
  }
}

glm::dmat4 findPlace(const TrackHeader& header, const std::string& volumeName, Tracts& tracts)
{
  glm::dmat4 voxel = voxelFromStored(header);
  if (!header.hasMatrix() && volumeName.empty())
  {
    tracts.knowsWorld = false;
    tracts.notes.emplace_back(
      "has no position of its volume (no vox_to_ras): it is shown as if the first voxel were at 0, "
      "0, 0 mm with axes along x, y and z. Set Volume to the volume in which it was made");
    glm::dmat4 worldFromStored(1.0);
    worldFromStored[3] = glm::dvec4(
      -0.5 * glm::dvec3(header.voxelSize(0), header.voxelSize(1), header.voxelSize(2)), 1.0);
    return worldFromStored;
  }
  const glm::dmat4 world = header.hasMatrix() ? header.voxToRas() : givenMatrix(header, volumeName);
  withBeginning("cannot be placed: ", [&] { requireAffine(world); });
  noteSizes(header, world, tracts);
  turnAxes(header, world, voxel);
  if (!header.hasVoxelOrder())
  {
    tracts.notes.emplace_back(
      "has no voxel_order: LPS counts, the format's default. If its writer "
      "meant the axes of its vox_to_ras, sides may be exchanged; compare it "
      "with its volume");
  }
  const double shear = nearestRasGrid(world, glm::ivec3(1)).shear;
  if (shear > LargestUnreportedShear)
  {
    tracts.notes.push_back(joined("is sheared: the cosine between two axes of its vox_to_ras is ",
      shear, "; the limit is ", LargestUnreportedShear));
  }
  return world * voxel;
}

// The places of the records of streamlines, each with its number of points.
struct Records
{
  std::size_t pointBytes = 12;
  std::size_t propertyBytes = 0;
  std::vector<std::size_t> places; // of the first point
};

void findRecords(
  const std::vector<char>& bytes, const TrackHeader& header, Records& records, Tracts& tracts)
{
  records.pointBytes = 4 * (3 + static_cast<std::size_t>(header.scalars()));
  records.propertyBytes = 4 * static_cast<std::size_t>(header.properties());
  const auto announced = static_cast<std::size_t>(header.count());
  std::size_t place = HeaderBytes;
  std::size_t empty = 0;
  std::size_t count = 0;
  for (; place < bytes.size() && (announced == 0 || count < announced); ++count)
  {
    const std::size_t left = bytes.size() - place;
    const auto points = left < 4 ? -1 : header.at<std::int32_t>(place);
    if (points < 0 ||
      static_cast<double>(left) - 4.0 - static_cast<double>(records.propertyBytes) <
        static_cast<double>(points) * static_cast<double>(records.pointBytes))
    {
      throw Problem("has a damaged streamline " + std::to_string(count) + " of " +
        (left < 4 ? "an unknown number of" : std::to_string(points)) +
        " points: " + std::to_string(left) + " bytes follow");
    }
    if (points > 0)
    {
      records.places.push_back(place + 4);
      tracts.firsts.push_back(tracts.firsts.back() + points);
    }
    empty += points == 0 ? 1 : 0;
    place += 4 + static_cast<std::size_t>(points) * records.pointBytes + records.propertyBytes;
  }
  if (count < announced)
  {
    throw Problem(
      "announces " + counted(announced, "streamline") + " and has " + std::to_string(count));
  }
  if (place < bytes.size())
  {
    tracts.notes.push_back("has " + counted(bytes.size() - place, "byte") + " after its " +
      counted(count, "streamline") + "; left out");
  }
  if (empty > 0)
  {
    tracts.notes.push_back("has " + counted(empty, "streamline") + " without points; left out");
  }
}

// Text in UTF-8 of bytes that may be anything.
std::string plainName(const std::string& name)
{
  std::string plain;
  for (const char letter : name)
  {
    plain += letter >= ' ' && letter <= '~' ? letter : '_';
  }
  return plain;
}

// Names, and how many numbers each has: nibabel writes that after a byte 0. The rest has `rest`.
std::vector<std::pair<std::string, std::size_t>> namesAt(
  const TrackHeader& header, std::size_t offset, int total, const std::string& rest)
{
  std::vector<std::pair<std::string, std::size_t>> names;
  auto left = static_cast<std::size_t>(total);
  for (std::size_t i = 0; i < MostNames && left > 0; ++i)
  {
    const std::string stored = header.name(offset + NameBytes * i);
    const std::size_t end = std::min(stored.find('\0'), stored.size());
    if (end == 0)
    {
      continue;
    }
    const std::string after = stored.substr(std::min(end + 1, stored.size()));
    const std::vector<double> count = numbersIn(after.substr(0, after.find('\0')));
    const std::size_t taken = count.size() == 1 && isWhole(count[0], 1, static_cast<double>(left))
      ? static_cast<std::size_t>(count[0])
      : 1;
    names.emplace_back(plainName(stored.substr(0, end)), taken);
    left -= taken;
  }
  if (left > 0)
  {
    names.emplace_back(rest, left);
  }
  return names;
}

std::vector<NamedNumbers> emptyNumbers(
  const std::vector<std::pair<std::string, std::size_t>>& names, std::size_t tuples)
{
  std::vector<NamedNumbers> list;
  list.reserve(names.size());
  OwnNames own;
  for (const auto& [name, components] : names)
  {
    list.push_back({ own.own(name), NumberType::Float32, components,
      std::vector<char>(4 * components * tuples) });
  }
  return list;
}

// Numbers that are side by side in the file, to the tuple of each array.
void takeNumbers(const char* from, std::size_t tuple, std::vector<NamedNumbers>& list)
{
  for (NamedNumbers& numbers : list)
  {
    const std::size_t size = 4 * numbers.components;
    std::copy_n(from, size, &numbers.bytes[tuple * size]);
    from += size;
  }
}

// One streamline, of numbers in this machine's order. Returns a point that is nowhere, or -1.
std::int64_t takeStreamline(const std::vector<char>& bytes, const Records& records, std::size_t i,
  const glm::dmat4& worldFromStored, Tracts& tracts)
{
  const char* from = bytes.data() + records.places[i];
  std::int64_t nowhere = -1;
  for (std::int64_t point = tracts.firsts[i]; point < tracts.firsts[i + 1]; ++point)
  {
    glm::vec3 stored;
    std::memcpy(&stored, from, sizeof(stored));
    const glm::dvec3 placed(worldFromStored * glm::dvec4(stored, 1.0));
    for (int axis = 0; axis < 3; ++axis)
    {
      nowhere = std::abs(placed[axis]) <= FarthestPoint ? nowhere : point;
    }
    const auto index = static_cast<std::size_t>(point);
    tracts.points[index] = glm::vec3(placed);
    takeNumbers(from + sizeof(stored), index, tracts.ofPoints);
    from += records.pointBytes;
  }
  takeNumbers(from, i, tracts.ofStreamlines);
  return nowhere;
}

bool isTrackVisFile(const std::string& fileName)
{
  return readUnpackedBeginning(fileName, Magic.size()) == Magic;
}

void readTrackVis(std::vector<char>& bytes, const TractSource& source,
  const FractionDone& fractionDone, Tracts& tracts)
{
  TrackHeader header;
  Records records;
  readHeader(bytes, header);
  const glm::dmat4 world = findPlace(header, source.volumeName, tracts);
  findRecords(bytes, header, records, tracts);
  const auto points = static_cast<std::size_t>(tracts.firsts.back());
  tracts.ofPoints = emptyNumbers(namesAt(header, 38, header.scalars(), "scalars"), points);
  tracts.ofStreamlines =
    emptyNumbers(namesAt(header, 240, header.properties(), "properties"), records.places.size());
  tracts.points.resize(points);
  toMachineOrder(
    bytes.data() + HeaderBytes, (bytes.size() - HeaderBytes) / 4, 4, header.isBigEndian);
  std::atomic<std::int64_t> nowhere{ -1 };
  constexpr std::size_t Block = 1 << 14; // streamlines between two reports of progress
  for (std::size_t first = 0; first < records.places.size(); first += Block)
  {
    const std::size_t last = std::min(first + Block, records.places.size());
    parallelFor(first, last, 256, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t found =
          takeStreamline(bytes, records, static_cast<std::size_t>(i), world, tracts);
        if (found >= 0)
        {
          nowhere = found; // writing what was read would lose that of another thread
        }
      }
    });
    if (!fractionDone(static_cast<double>(last) / static_cast<double>(records.places.size())))
    {
      tracts = Tracts();
      return;
    }
  }
  if (const std::int64_t point = nowhere; point >= 0)
  {
    requirePoint(
      glm::dvec3(tracts.points[static_cast<std::size_t>(point)]), "point " + std::to_string(point));
  }
}

// A number as float32. `isExact` becomes false if it is another one then.
template <typename T>
float floatOf(const char* bytes, bool& isExact)
{
  T number{};
  std::memcpy(&number, bytes, sizeof(T));
  const auto found = static_cast<float>(number);
  isExact = isExact &&
    (static_cast<long double>(found) == static_cast<long double>(number) || !(number == number));
  return found;
}

float floatOf(const NamedNumbers& numbers, std::size_t i, bool& isExact)
{
  const char* bytes = numbers.bytes.data() + i * bytesOf(numbers.type);
  switch (numbers.type)
  {
    case NumberType::Int8:
      return floatOf<std::int8_t>(bytes, isExact);
    case NumberType::UInt8:
      return floatOf<std::uint8_t>(bytes, isExact);
    case NumberType::Int16:
      return floatOf<std::int16_t>(bytes, isExact);
    case NumberType::UInt16:
      return floatOf<std::uint16_t>(bytes, isExact);
    case NumberType::Int32:
      return floatOf<std::int32_t>(bytes, isExact);
    case NumberType::UInt32:
      return floatOf<std::uint32_t>(bytes, isExact);
    case NumberType::Int64:
      return floatOf<std::int64_t>(bytes, isExact);
    case NumberType::UInt64:
      return floatOf<std::uint64_t>(bytes, isExact);
    case NumberType::Float64:
      return floatOf<double>(bytes, isExact);
    default:
      return floatOf<float>(bytes, isExact);
  }
}

// The bytes of a header that is written.
struct NewHeader
{
  std::vector<char> bytes = std::vector<char>(HeaderBytes, '\0');

  template <typename T>
  void put(std::size_t offset, T number)
  {
    std::memcpy(this->bytes.data() + offset, &number, sizeof(T));
  }
  void putText(std::size_t offset, const std::string& text)
  {
    std::copy(text.begin(), text.end(), this->bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  }
};

// Names of up to 10 arrays, as nibabel writes them: how many numbers each has follows a byte 0. The
// arrays beyond, and shortened names, give notes. Returns the numbers of one point or streamline.
std::size_t putNames(
  NewHeader& header, std::size_t offset, std::vector<NamedNumbers>& list, TractNotes& notes)
{
  std::size_t total = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    if (i >= MostNames)
    {
      notes.push_back(
        "has room for 10 arrays of a kind, and leaves out " + list[i].name + "; .trx keeps it");
      continue;
    }
    const std::string count =
      list[i].components > 1 ? std::string(1, '\0') + std::to_string(list[i].components) : "";
    const std::string name = plainName(list[i].name).substr(0, NameBytes - count.size());
    if (name != list[i].name)
    {
      notes.push_back("has room for " + std::to_string(NameBytes) +
        " plain letters of a name: the array " + list[i].name + " is called " + name);
    }
    header.putText(offset + NameBytes * i, name + count);
    total += list[i].components;
  }
  list.resize(std::min<std::size_t>(list.size(), MostNames));
  if (total > static_cast<std::size_t>(std::numeric_limits<std::int16_t>::max()))
  {
    throw Problem("has " + std::to_string(total) +
      " numbers in the arrays of a kind; a file of TrackVis can have 32767. Write .trx");
  }
  return total;
}

void putNumbers(
  const std::vector<NamedNumbers>& list, std::size_t tuple, bool& isExact, std::vector<float>& to)
{
  for (const NamedNumbers& numbers : list)
  {
    for (std::size_t i = 0; i < numbers.components; ++i)
    {
      to.push_back(floatOf(numbers, tuple * numbers.components + i, isExact));
    }
  }
}

// The letters of the axes that run nearest to each; voxel_order must fit vox_to_ras.
std::string lettersOf(const glm::dmat4& worldFromVoxel, const glm::ivec3& dimensions)
{
  const RasGrid grid = nearestRasGrid(worldFromVoxel, dimensions);
  std::string letters = "RAS";
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto ras = static_cast<std::size_t>(axis);
    letters[static_cast<std::size_t>(grid.voxelAxis[ras])] =
      grid.reversed[ras] ? "LPI"[axis] : "RAS"[axis];
  }
  return letters;
}

NewHeader headerOf(const TractBox& box, const Tracts& tracts)
{
  NewHeader header;
  header.putText(0, std::string(Magic));
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto place = static_cast<std::size_t>(axis);
    if (box.dimensions[axis] > std::numeric_limits<std::int16_t>::max())
    {
      throw Problem("Volume has " + std::to_string(box.dimensions[axis]) +
        " voxels along an axis; a file of TrackVis can name 32767");
    }
    header.put(6 + 2 * place, static_cast<std::int16_t>(box.dimensions[axis]));
    header.put(
      12 + 4 * place, static_cast<float>(glm::length(glm::dvec3(box.worldFromVoxel[axis]))));
  }
  for (int i = 0; i < 16; ++i)
  {
    header.put(
      440 + 4 * static_cast<std::size_t>(i), static_cast<float>(box.worldFromVoxel[i % 4][i / 4]));
  }
  header.putText(948, lettersOf(box.worldFromVoxel, box.dimensions));
  if (std::max(tracts.firsts.size(), tracts.points.size()) >
    static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw Problem("has " + std::to_string(tracts.points.size()) +
      " points; a file of TrackVis can count 2147483647. Write .trx");
  }
  header.put(988, static_cast<std::int32_t>(tracts.firsts.size() - 1));
  header.put(992, std::int32_t(2));
  header.put(996, static_cast<std::int32_t>(HeaderBytes));
  return header;
}

void writeTrackVis(
  const std::string& fileName, const Tracts& tracts, const TractBox& box, TractNotes& notes)
{
  withBeginning("Volume places nothing: ", [&] { requireAffine(box.worldFromVoxel); });
  NewHeader header = headerOf(box, tracts);
  std::vector<NamedNumbers> ofPoints = tracts.ofPoints;
  std::vector<NamedNumbers> ofStreamlines = tracts.ofStreamlines;
  header.put(36, static_cast<std::int16_t>(putNames(header, 38, ofPoints, notes)));
  header.put(238, static_cast<std::int16_t>(putNames(header, 240, ofStreamlines, notes)));
  TrackHeader stored; // the places that a reader will find
  stored.bytes = header.bytes.data();
  stored.isBigEndian = thisMachineIsBigEndian();
  const glm::dmat4 storedFromWorld = glm::inverse(stored.voxToRas() * voxelFromStored(stored));
  bool isExact = true;
  writeWholeStream(fileName, [&](std::ostream& file) {
    file.write(header.bytes.data(), static_cast<std::streamsize>(header.bytes.size()));
    std::vector<float> numbers;
    for (std::size_t line = 0; line + 1 < tracts.firsts.size(); ++line)
    {
      const auto count = static_cast<std::int32_t>(tracts.firsts[line + 1] - tracts.firsts[line]);
      numbers.clear();
      for (std::int64_t i = tracts.firsts[line]; i < tracts.firsts[line + 1]; ++i)
      {
        const auto point = static_cast<std::size_t>(i);
        const glm::dvec3 place(storedFromWorld * glm::dvec4(tracts.points[point], 1.0));
        numbers.insert(numbers.end(),
          { static_cast<float>(place.x), static_cast<float>(place.y),
            static_cast<float>(place.z) });
        putNumbers(ofPoints, point, isExact, numbers);
      }
      putNumbers(ofStreamlines, line, isExact, numbers);
      file.write(reinterpret_cast<const char*>(&count), sizeof(count));
      file.write(reinterpret_cast<const char*>(numbers.data()),
        static_cast<std::streamsize>(4 * numbers.size()));
    }
  });
  if (!isExact)
  {
    notes.emplace_back("holds all numbers as float32, which rounds some; .trx keeps their types");
  }
}
}

extern const TractFormat TractsOfTrackVis{ isTrackVisFile, readTrackVis, ".trk", writeTrackVis };
}
