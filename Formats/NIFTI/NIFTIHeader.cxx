// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/NIFTI/NIFTIHeader.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <map>

namespace brainshift
{
namespace
{
constexpr int NIFTI1Bytes = 348;
constexpr int NIFTI2Bytes = 540;
constexpr int ExtenderBytes = 4; // after the header of a single file: whether extensions follow
constexpr std::int64_t MostTimeSteps = 65536;  // and numbers for a voxel: each takes memory
constexpr double LargestDeflateRatio = 1032.0; // no zlib stream unpacks to more times its size

// Bytes of a voxel for each data type that vtkNIFTIImageReader knows.
const std::map<int, int> VoxelBytes{ { 2, 1 }, { 4, 2 }, { 8, 4 }, { 16, 4 }, { 32, 8 }, { 64, 8 },
  { 128, 3 }, { 256, 1 }, { 512, 2 }, { 768, 4 }, { 1024, 8 }, { 1280, 8 }, { 1792, 16 },
  { 2304, 4 } };

// The first bytes of a file, unpacked.
struct RawHeader
{
  std::array<unsigned char, NIFTI2Bytes> bytes{};
  int count = 0; // bytes that are there
  bool opened = false;
  int version = 0; // 1 or 2; 0: not NIfTI
  bool isBigEndian = false;

  template <typename T>
  T number(int offset) const
  {
    return storedNumber<T>(this->bytes.data() + offset, this->isBigEndian);
  }

  bool hasMagic(int offset, unsigned char digit) const
  {
    const unsigned char* magic = this->bytes.data() + offset;
    return magic[0] == 'n' && (magic[1] == '+' || magic[1] == 'i') && magic[2] == digit &&
      magic[3] == 0;
  }

  bool isSingleFile() const { return this->bytes[this->version == 1 ? 345 : 5] == '+'; }
  int dataType() const { return this->number<std::int16_t>(this->version == 1 ? 70 : 12); }
  std::int64_t intent() const
  {
    return this->version == 1 ? this->number<std::int16_t>(68) : this->number<std::int32_t>(504);
  }
  double voxelOffset() const
  {
    return this->version == 1 ? this->number<float>(108)
                              : static_cast<double>(this->number<std::int64_t>(168));
  }
  std::int64_t dimension(int axis) const
  {
    return this->version == 1 ? this->number<std::int16_t>(40 + 2 * axis)
                              : this->number<std::int64_t>(16 + 8 * axis);
  }
};

// The other file of a pair .hdr and .img, either of them packed or not: an existing file whose name
// has `wanted` in place of `given`. Names without `given` stay.
std::string siblingOf(
  const std::string& fileName, const std::string& given, const std::string& wanted)
{
  const std::filesystem::path path(fileName);
  const bool named = path.extension() == ".gz";
  std::filesystem::path stem = named ? path.parent_path() / path.stem() : path;
  if (stem.extension() != given)
  {
    return fileName;
  }
  const std::string plain = stem.replace_extension(wanted).string();
  const std::string packed = plain + ".gz";
  std::error_code error;
  const bool packedExists = std::filesystem::exists(packed, error);
  const bool plainExists = std::filesystem::exists(plain, error);
  return packedExists && (named || !plainExists) ? packed : plain;
}

bool isPacked(const std::string& fileName)
{
  gzFile file = gzopen(fileName.c_str(), "rb");
  const bool packed = file && gzdirect(file) == 0;
  gzclose(file);
  return packed;
}

RawHeader readHeader(const std::string& fileName)
{
  RawHeader header;
  const std::string headerName = siblingOf(fileName, ".img", ".hdr");
  if (!isPlainFile(headerName))
  {
    return header; // a pipe would never open
  }
  gzFile file = gzopen(headerName.c_str(), "rb");
  if (!file)
  {
    return header;
  }
  header.opened = true;
  header.count = std::max(0, gzread(file, header.bytes.data(), NIFTI2Bytes));
  gzclose(file);
  if (header.count >= NIFTI1Bytes && header.hasMagic(344, '1'))
  {
    header.version = 1;
  }
  else if (header.count >= NIFTI2Bytes && header.hasMagic(4, '2'))
  {
    header.version = 2;
  }
  const std::int64_t rank = header.version > 0 ? header.dimension(0) : 0;
  header.isBigEndian = rank < 0 || rank > 7; // the standard's test
  return header;
}

void requireHeader(const RawHeader& header)
{
  if (header.count < NIFTI1Bytes)
  {
    throw Problem(
      joined("has ", header.count, " readable bytes; a NIfTI header has ", NIFTI1Bytes));
  }
  if (header.version == 0)
  {
    throw Problem("is not NIfTI: its magic is neither n+1, ni1, n+2 nor ni2");
  }
  if (VoxelBytes.count(header.dataType()) == 0)
  {
    std::string types;
    for (const auto& known : VoxelBytes)
    {
      types += " " + std::to_string(known.first);
    }
    throw Problem(
      joined("has NIfTI data type ", header.dataType(), "; BrainShift reads the types", types));
  }
  const double first = (header.version == 1 ? NIFTI1Bytes : NIFTI2Bytes) + ExtenderBytes;
  if (header.isSingleFile() && !(header.voxelOffset() >= first))
  {
    throw Problem(joined("has its voxels at byte ", header.voxelOffset(),
      " (vox_offset); the first possible byte is ", first));
  }
  if (header.voxelOffset() != std::floor(header.voxelOffset()))
  {
    throw Problem(
      joined("has the vox_offset ", header.voxelOffset(), "; it must be a whole number of bytes"));
  }
}

void requireDimensions(const RawHeader& header)
{
  const std::int64_t rank = header.dimension(0);
  if (rank < 1 || rank > 7)
  {
    throw Problem(joined("has ", rank, " dimensions; it must have from 1 to 7"));
  }
  const std::int64_t intent = header.intent();
  if (intent >= 3000 && intent < 3100)
  {
    throw Problem("is a CIFTI file of values of surfaces and grey matter, and no volume; make a "
                  "volume or a metric (.func.gii) of it by wb_command -cifti-separate");
  }
  bool oneVoxel = true;
  for (int axis = 1; axis <= rank; ++axis)
  {
    const std::int64_t size = header.dimension(axis);
    const std::int64_t limit = axis < 4 ? std::numeric_limits<std::int32_t>::max()
      : axis < 6                        ? MostTimeSteps
                                        : 1;
    oneVoxel = oneVoxel && (size == 1 || axis > 3);
    if (size < 1 || size > limit)
    {
      throw Problem(
        joined("has ", size, " entries in dimension ", axis, "; it must have from 1 to ", limit));
    }
  }
  if (oneVoxel)
  {
    throw Problem("has 1 voxel; it must have at least 2");
  }
}

void requireSize(const RawHeader& header, const std::string& fileName)
{
  double wanted = VoxelBytes.at(header.dataType());
  for (int axis = 1; axis <= header.dimension(0); ++axis)
  {
    wanted *= static_cast<double>(header.dimension(axis));
  }
  wanted += header.voxelOffset();
  const std::string dataName =
    header.isSingleFile() ? fileName : siblingOf(fileName, ".hdr", ".img");
  withBeginning("has no voxels: " + dataName + " ", [&] { requirePlainFile(dataName); });
  std::error_code error;
  const auto stored = std::filesystem::file_size(dataName, error);
  if (error)
  {
    throw Problem("has no voxels: the size of " + dataName + " is not known");
  }
  const bool packed = isPacked(dataName);
  if (static_cast<double>(stored) * (packed ? LargestDeflateRatio : 1.0) < wanted)
  {
    throw Problem(joined("is truncated: ", dataName, " has ", stored, packed ? " packed" : "",
      " bytes where the header announces ", std::setprecision(15), wanted));
  }
}

constexpr double HalfTurnTolerance = 1e-7; // of 1 - |quaternion|^2: float32 rounding of the header

glm::dmat3 rotationFromQuaternion(const glm::dvec3& stored)
{
  const double b = stored.x;
  const double c = stored.y;
  const double d = stored.z;
  const double rest = 1.0 - (b * b + c * c + d * d);
  if (rest < HalfTurnTolerance) // half a turn: the real part is rounding, so leave it out
  {
    const glm::dvec3 n = glm::normalize(stored);
    return 2.0 * glm::outerProduct(n, n) - glm::dmat3(1.0);
  }
  const double a = std::sqrt(rest);
  return glm::dmat3(a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c),
    2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b),
    2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c);
}

glm::dmat4 affine(const glm::dmat3& axes, const glm::dvec3& offset)
{
  return glm::dmat4(glm::dvec4(axes[0], 0.0), glm::dvec4(axes[1], 0.0), glm::dvec4(axes[2], 0.0),
    glm::dvec4(offset, 1.0));
}

constexpr int LengthBits = 0x07; // of xyzt_units
constexpr int TimeBits = 0x38;
constexpr double LongestPlainStep = 100.0; // s; a longer step without a unit may be ms

// Seconds by the unit of time. 0: none is said.
const std::map<int, double> SecondsPerUnit{ { 0, 1.0 }, { 8, 1.0 }, { 16, 1e-3 }, { 24, 1e-6 } };
// Units in the place of those of time.
const std::map<int, const char*> NoTimes{ { 32, "Hz" }, { 40, "ppm" }, { 48, "rad/s" } };

bool isZero(const std::array<glm::dvec4, 3>& rows)
{
  return std::all_of(rows.begin(), rows.end(),
    [](const glm::dvec4& row) { return glm::dvec3(row) == glm::dvec3(0.0); });
}

glm::dmat4 worldBySform(const NIFTIPlacement& placement)
{
  glm::dmat4 world(1.0);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      world[column][row] = placement.mmPerUnit * placement.sformRows[row][column];
    }
  }
  return world;
}

// Without a qform: pixel sizes along the RAS axes.
glm::dmat4 worldByQform(const NIFTIPlacement& placement)
{
  glm::dvec3 size = glm::abs(placement.pixelSize);
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = placement.mmPerUnit * (size[axis] == 0.0 ? 1.0 : size[axis]); // as the standard
  }
  glm::dmat3 axes(1.0);
  glm::dvec3 offset(0.0);
  if (placement.qformCode > 0)
  {
    axes = rotationFromQuaternion(placement.quaternion);
    axes[2] *= placement.qfac < 0.0 ? -1.0 : 1.0;
    offset = placement.mmPerUnit * placement.qformOffset;
  }
  return affine(glm::dmat3(size.x * axes[0], size.y * axes[1], size.z * axes[2]), offset);
}

// The largest distance between the places of a corner of the grid, mm.
double farthestCorner(const glm::dmat4& one, const glm::dmat4& other, const glm::ivec3& dimensions)
{
  double farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec4 voxel(side * (dimensions - 1), 1.0);
    farthest = std::max(farthest, glm::length((one - other) * voxel));
  }
  return farthest;
}

// How a qform contradicts the sform, which counts. Files are rounded: half a voxel and what float32
// loses of a quaternion go without a word.
void noteOtherPlace(
  const NIFTIPlacement& placement, const glm::dmat4& world, std::vector<std::string>& warnings)
{
  constexpr double LostAngle = 1e-3; // rad, near half a turn
  const glm::dmat4 other = worldByQform(placement);
  if (glm::determinant(glm::dmat3(world)) * glm::determinant(glm::dmat3(other)) < 0.0)
  {
    warnings.emplace_back("has a qform that mirrors the volume against its sform: left and "
                          "right are exchanged in one of them; the sform counts");
    return;
  }
  double voxel = glm::length(world[0]);
  double diagonal = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = glm::length(world[axis]);
    voxel = std::min(voxel, side);
    diagonal = std::hypot(diagonal, side * (placement.dimensions[axis] - 1));
  }
  const double distance = farthestCorner(world, other, placement.dimensions);
  if (distance > std::max(0.5 * voxel, LostAngle * diagonal))
  {
    warnings.push_back(joined("has a qform that places its corners up to ", roundedText(distance),
      " mm from where its sform does; the sform counts. If the qform is the right one, make it the "
      "sform, as fslorient -copyqform2sform does"));
  }
}

// What does not count of the numbers that worldByQform takes.
void noteQform(const NIFTIPlacement& placement, std::vector<std::string>& warnings)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (const double size = placement.pixelSize[axis]; size <= 0.0)
    {
      warnings.push_back(joined("has the pixdim[", axis + 1, "] ", size,
        size == 0.0 ? ", which counts as 1" : ", whose sign does not count"));
    }
  }
  constexpr double LongestUnit = 1.001; // of decimals that are rounded
  const double length = glm::length(placement.quaternion);
  if (placement.qformCode > 0 && length > LongestUnit)
  {
    warnings.push_back(joined("has a quaternion (quatern_b, quatern_c, quatern_d) of the length ",
      length, ", which counts as one of the length 1"));
  }
  const double qfac = placement.qfac;
  if (placement.qformCode > 0 && qfac != 0.0 && std::abs(qfac) != 1.0)
  {
    warnings.push_back(joined("has the pixdim[0] ", qfac, ", of which only the sign counts"));
  }
}
}

bool isNIFTIFile(const std::string& fileName)
{
  return readHeader(fileName).version > 0;
}

void requireNIFTIFile(const std::string& fileName)
{
  requirePlainFile(fileName);
  const RawHeader header = readHeader(fileName);
  if (!header.opened)
  {
    throw Problem("cannot be opened");
  }
  requireHeader(header);
  requireDimensions(header);
  requireSize(header, fileName);
}

int bytesOfNIFTIVoxel(int dataType)
{
  const auto known = VoxelBytes.find(dataType);
  return known == VoxelBytes.end() ? 0 : known->second;
}

std::optional<double> mmPerNIFTIUnit(int xyztUnits)
{
  switch (xyztUnits & LengthBits)
  {
    case 0: // none is said
    case 2:
      return 1.0;
    case 1: // metre
      return 1000.0;
    case 3: // micrometre
      return 0.001;
    default:
      return std::nullopt;
  }
}

std::vector<double> timesOf(const NIFTITiming& timing, std::vector<std::string>& warnings)
{
  if (timing.volumes <= 1)
  {
    return evenTimes(timing.volumes, 1.0);
  }
  const int code = timing.xyztUnits & TimeBits;
  if (const auto other = NoTimes.find(code); other != NoTimes.end())
  {
    warnings.push_back(joined("has a fourth axis in ", other->second, " (xyzt_units ",
      timing.xyztUnits, "), which is no time; its volumes are numbered 0, 1, 2 and so on"));
    return evenTimes(timing.volumes, 1.0);
  }
  const auto known = SecondsPerUnit.find(code);
  if (known == SecondsPerUnit.end())
  {
    warnings.push_back(joined("has the xyzt_units ", timing.xyztUnits, ", whose unit of time ",
      code, " NIfTI does not know; it counts as s"));
  }
  const double seconds = known == SecondsPerUnit.end() ? 1.0 : known->second;
  if (!std::isfinite(timing.start))
  {
    warnings.push_back(joined("has the toffset ", timing.start, "; it counts as 0"));
  }
  const double start = std::isfinite(timing.start) ? seconds * timing.start : 0.0;
  const double step = std::abs(timing.step);
  if (!(step > 0.0) || !std::isfinite(step))
  {
    warnings.push_back(joined("has the time step ", timing.step,
      " (pixdim[4]), which is none; its volumes count as 1 s apart"));
    return evenTimes(timing.volumes, 1.0, start);
  }
  if (timing.step < 0.0)
  {
    warnings.push_back(joined("has the time step ", timing.step,
      " (pixdim[4]); its volumes count as that far apart, in the order of the file"));
  }
  if (code == 0 && step >= LongestPlainStep)
  {
    warnings.push_back(joined("names no unit of time (xyzt_units ", timing.xyztUnits,
      "); its time step ", step, " counts as s"));
  }
  return evenTimes(timing.volumes, seconds * step, start);
}

bool sformCounts(const NIFTIPlacement& placement)
{
  return placement.sformCode > 0 && !(placement.qformCode > 0 && isZero(placement.sformRows));
}

glm::dmat4 worldFromVoxel(const NIFTIPlacement& placement, std::vector<std::string>& warnings)
{
  if (sformCounts(placement))
  {
    const glm::dmat4 world = worldBySform(placement);
    if (placement.qformCode > 0)
    {
      noteOtherPlace(placement, world, warnings);
    }
    return world;
  }
  if (placement.sformCode > 0)
  {
    warnings.push_back(joined(
      "has the sform_code ", placement.sformCode, " but an sform of zeros; the qform counts"));
  }
  noteQform(placement, warnings);
  return worldByQform(placement);
}
}
