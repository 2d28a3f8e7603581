// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Surfaces of FreeSurfer, such as lh.pial: triangles, and maps of values, such as lh.thickness.
///
/// All numbers are big endian. Points are in tkRAS (SurfaceFile.h), unless the tag useRealRAS says
/// that they are in the scanner's RAS. The geometry of the volume follows the triangles, as text.
#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Surfaces/SurfaceFile.h"
#include "Formats/Volumes/RasGrid.h"

#include <utility>

namespace brainshift
{
namespace
{
constexpr std::string_view TriangleMagic = "\xFF\xFF\xFE";
constexpr std::string_view ValueMagic = "\xFF\xFF\xFF"; // also of surfaces of old quadrangles
constexpr std::string_view QuadrangleMagic = "\xFF\xFF\xFD";
constexpr std::size_t LongestLine = 1 << 16; // bytes
constexpr double SmallestCosine = 0.9;       // of nearly the same direction
constexpr double MostDifferentMm = 0.01;     // between two geometries, before it is told

// FreeSurfer's numbers of what may follow the triangles.
constexpr int OldColorTable = 1;
constexpr int UseRealRAS = 2;
constexpr int OldTransform = 30;
constexpr int VolumeGeometry = 20;

// Takes what comes next. All that is asked for must be there.
class Bytes
{
public:
  explicit Bytes(const std::vector<char>& bytes)
    : All(bytes.data(), bytes.size())
  {
  }

  std::size_t left() const { return this->All.size() - this->Place; }
  std::size_t place() const { return this->Place; }
  void skip(std::size_t count) { this->Place += count; }

  template <typename T>
  T number()
  {
    const T found = storedNumber<T>(this->All.data() + this->Place, true);
    this->Place += sizeof(T);
    return found;
  }

  // False if the line has no end, or one that is too far away.
  bool line(std::string& text)
  {
    const std::size_t end = this->All.substr(this->Place, LongestLine).find('\n');
    if (end == std::string_view::npos)
    {
      return false;
    }
    text = this->All.substr(this->Place, end);
    this->Place += end + 1;
    return true;
  }

private:
  std::string_view All;
  std::size_t Place = 0;
};

Problem damagedGeometry(const std::string& line)
{
  return Problem("has a damaged volume geometry after its triangles: " + shownWords(line));
}

// The eight lines from "valid" to "cras". No frame if the file says that it is not valid.
void readGeometry(Bytes& bytes, std::optional<VolumeFrame>& frame)
{
  constexpr std::array<const char*, 8> Names{ "valid", "filename", "volume", "voxelsize", "xras",
    "yras", "zras", "cras" };
  VolumeFrame found;
  bool isValid = false;
  for (std::size_t i = 0; i < Names.size(); ++i)
  {
    std::string line;
    if (!bytes.line(line))
    {
      throw Problem("ends within its volume geometry");
    }
    const std::size_t equals = line.find('=');
    const std::vector<std::string> words = wordsIn(line.substr(0, equals));
    if (equals == std::string::npos || words.size() != 1 || words[0] != Names[i])
    {
      throw damagedGeometry(line);
    }
    const std::string value = line.substr(equals + 1);
    if (i == 0)
    {
      const std::vector<double> numbers = numbersIn(value.substr(0, value.find('#')));
      if (numbers.size() != 1 || !isWhole(numbers[0], 0, 1))
      {
        throw damagedGeometry(line);
      }
      isValid = numbers[0] == 1.0;
    }
    if (i >= 4)
    {
      const std::vector<double> numbers = numbersIn(value);
      if (numbers.size() != 3)
      {
        throw damagedGeometry(line);
      }
      const std::array<glm::dvec3*, 4> vectors{ &found.xRas, &found.yRas, &found.zRas,
        &found.cRas };
      *vectors[i - 4] = glm::dvec3(numbers[0], numbers[1], numbers[2]);
    }
  }
  frame = isValid ? std::optional<VolumeFrame>(found) : std::nullopt;
}

// What follows the triangles, up to the geometry.
void readTags(Bytes& bytes, std::optional<VolumeFrame>& frame, bool& isInScanner)
{
  while (bytes.left() >= 8)
  {
    const auto tag = bytes.number<std::int32_t>();
    if (tag == VolumeGeometry)
    {
      readGeometry(bytes, frame);
      return;
    }
    if (tag == UseRealRAS)
    {
      isInScanner = bytes.number<std::int32_t>() != 0;
      continue;
    }
    if (tag == OldColorTable || (tag != OldTransform && bytes.left() < 8))
    {
      return; // no geometry is known to follow
    }
    const std::int64_t length =
      tag == OldTransform ? bytes.number<std::int32_t>() : bytes.number<std::int64_t>();
    if (length < 0 || static_cast<std::uint64_t>(length) > bytes.left())
    {
      throw Problem("has a damaged tag " + std::to_string(tag) +
        " after its triangles: its length is " + std::to_string(length) + ", and " +
        std::to_string(bytes.left()) + " bytes follow");
    }
    bytes.skip(static_cast<std::size_t>(length));
  }
}

void requireMagic(const std::vector<char>& bytes)
{
  const std::string_view begin(bytes.data(), std::min<std::size_t>(bytes.size(), 3));
  if (begin == TriangleMagic)
  {
    return;
  }
  if (begin == ValueMagic && bytes.size() > 3 && bytes[3] == '\xff')
  {
    throw Problem("is a flat patch of FreeSurfer, and no surface of triangles; open the surface");
  }
  if (begin == ValueMagic)
  {
    throw Problem(
      "is a map of values of FreeSurfer, and no surface; open the surface, and name this "
      "file as one of its Value File Names");
  }
  throw Problem(begin == QuadrangleMagic
      ? "is a FreeSurfer surface of quadrangles; BrainShift reads triangles"
      : begin.substr(0, 2) == "\x1f\x8b"
      ? "is packed by gzip; unpack it"
      : "does not begin like a FreeSurfer surface (FF FF FE) and is no GIFTI file");
}

// Throws unless so many numbers of 4 bytes can follow.
void requireSize(const Bytes& bytes, double numbers, const std::string& what)
{
  if (!(4.0 * numbers <= static_cast<double>(bytes.left())))
  {
    throw Problem(
      "announces " + what + ", and has only " + std::to_string(bytes.left()) + " bytes for them");
  }
}

void readMesh(Bytes& bytes, Surface& surface)
{
  std::string line;
  bytes.skip(TriangleMagic.size());
  if (!bytes.line(line) || !bytes.line(line) || bytes.left() < 8)
  {
    throw Problem("ends within its header");
  }
  const auto points = bytes.number<std::int32_t>();
  const auto triangles = bytes.number<std::int32_t>();
  const std::string what =
    std::to_string(points) + " points and " + std::to_string(triangles) + " triangles";
  if (points < 1 || triangles < 0)
  {
    throw Problem("announces " + what + "; it must have 1 point or more");
  }
  requireSize(bytes, 3.0 * points + 3.0 * triangles, what);
  surface.points.resize(static_cast<std::size_t>(points));
  for (glm::dvec3& point : surface.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = bytes.number<float>();
    }
  }
  surface.triangles.resize(static_cast<std::size_t>(triangles));
  for (glm::ivec3& triangle : surface.triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      triangle[corner] = bytes.number<std::int32_t>();
    }
  }
}

// How far two geometries place the points from each other, mm.
double differenceMm(const Surface& surface, const glm::dmat4& one, const glm::dmat4& other)
{
  double largest = 0.0;
  for (const glm::dvec3& point : surface.points)
  {
    largest = std::max(largest,
      glm::distance(
        glm::dvec3(one * glm::dvec4(point, 1.0)), glm::dvec3(other * glm::dvec4(point, 1.0))));
  }
  return largest;
}

// Whether the axes of a volume are nearly those that FreeSurfer gives its own.
bool isConformed(const VolumeFrame& frame)
{
  const VolumeFrame own;
  return glm::dot(frame.xRas, own.xRas) > SmallestCosine &&
    glm::dot(frame.yRas, own.yRas) > SmallestCosine &&
    glm::dot(frame.zRas, own.zRas) > SmallestCosine;
}

// Whether a file begins like a surface of triangles.
bool isFreeSurferSurface(const std::string& fileName)
{
  return readBeginning(fileName, TriangleMagic.size()) == TriangleMagic;
}

// Sets worldFromStored of a surface in tkRAS, and notes it if the volume is not known. `own` is the
// geometry that the file names.
void placeByVolume(
  const std::optional<VolumeFrame>& own, const GivenVolume& given, Surface& surface)
{
  VolumeFrame frame;
  frame.cRas = given.cRas;
  frame = given.fileName.empty() ? frame : frameOf(readVolumeGrid(given.fileName));
  surface.worldFromStored = scannerFromSurface(own.value_or(frame));
  withBeginning("its volume geometry is wrong: ", [&] { requireAffine(surface.worldFromStored); });
  const bool isGiven = !given.fileName.empty() || given.cRas != glm::dvec3(0.0);
  if (own && isGiven)
  {
    const double mm = differenceMm(surface, surface.worldFromStored, scannerFromSurface(frame));
    if (mm > MostDifferentMm)
    {
      surface.notes.push_back(joined("contains the geometry of its volume, which is used; the "
                                     "given volume would place it up to ",
        mm, " mm away"));
    }
  }
  if (!own && !given.fileName.empty() && !isConformed(frame))
  {
    surface.notes.emplace_back(
      "is placed by a volume whose axes are not those of FreeSurfer's own volumes (left, down, "
      "front), so the surface may be mirrored or rotated. Volume must be orig.mgz or T1.mgz of the "
      "subject's folder, not the scan");
  }
  surface.knowsWorld = own || isGiven;
  if (!surface.knowsWorld)
  {
    surface.notes.emplace_back(
      "has no position of its volume (its volume geometry is not valid): it is shown as if the "
      "centre of the volume were at 0, 0, 0 mm. Set Volume to the volume it was made from, or "
      "Volume Center to that volume's c_ras");
  }
}

void readFreeSurferSurface(
  const std::vector<char>& bytes, const GivenVolume& given, Surface& surface)
{
  requireMagic(bytes);
  Bytes rest(bytes);
  readMesh(rest, surface);
  std::optional<VolumeFrame> frame;
  bool isInScanner = false;
  readTags(rest, frame, isInScanner);
  if (!isInScanner)
  {
    withBeginning("cannot be placed: ", [&] { placeByVolume(frame, given, surface); });
  }
}

// Whether bytes begin like a map of values.
bool beginsLikeFreeSurferValues(const std::vector<char>& bytes)
{
  return bytes.size() >= ValueMagic.size() &&
    std::string_view(bytes.data(), ValueMagic.size()) == ValueMagic;
}

void readFreeSurferValues(const std::vector<char>& bytes, NamedNumbers& numbers)
{
  Bytes rest(bytes);
  rest.skip(ValueMagic.size());
  if (rest.left() < 12)
  {
    throw Problem("ends within its header");
  }
  const auto points = rest.number<std::int32_t>();
  rest.number<std::int32_t>(); // triangles
  const auto components = rest.number<std::int32_t>();
  const std::string what =
    std::to_string(components) + " values for each of " + std::to_string(points) + " points";
  if (points < 1 || components < 1)
  {
    throw Problem("announces " + what + "; it must have 1 or more");
  }
  const double count = static_cast<double>(points) * components;
  requireSize(rest, count, what);
  numbers.type = NumberType::Float32;
  numbers.components = static_cast<std::size_t>(components);
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(rest.place());
  numbers.bytes.assign(first, first + static_cast<std::ptrdiff_t>(4.0 * count));
  toMachineOrder(numbers.bytes.data(), numbers.bytes.size() / 4, 4, true);
}

void addFreeSurferValues(const std::vector<char>& bytes, const std::string& name, Surface& surface)
{
  NamedNumbers numbers;
  readFreeSurferValues(bytes, numbers);
  const std::size_t tuples = numbers.bytes.size() / (4 * numbers.components);
  if (tuples != surface.points.size())
  {
    surface.notes.push_back("has values of " + counted(tuples, "point") + "; the surface has " +
      std::to_string(surface.points.size()) + ", so they are left out");
    return;
  }
  numbers.name = surface.names.own(name);
  surface.numbers.push_back(std::move(numbers));
}
}

extern const SurfaceFormat SurfacesOfFreeSurfer{ isFreeSurferSurface, readFreeSurferSurface,
  addFreeSurferValues, beginsLikeFreeSurferValues,
  "map of values of FreeSurfer, such as lh.thickness" };
}
