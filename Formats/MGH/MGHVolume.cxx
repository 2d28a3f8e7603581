// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/MGH/MGHVolume.h"

#include "Common/Bytes.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Volumes/RasGrid.h"

#include "vtkImageData.h"

#include <cmath>
#include <map>

namespace brainshift
{
namespace
{
constexpr std::size_t HeaderBytes = 284; // voxels follow
constexpr int Version = 1;
constexpr int IntentBits = 8; // what the voxels are stands above the version
constexpr int Warp = 3;       // of FreeSurfer's intents, and its inverse
constexpr int InverseWarp = 4;
constexpr int MostFrames = 65536; // each takes memory for its time

// VTK's types by the numbers of the format.
const std::map<int, int> Types{ { 0, VTK_UNSIGNED_CHAR }, { 1, VTK_INT }, { 3, VTK_FLOAT },
  { 4, VTK_SHORT }, { 10, VTK_UNSIGNED_SHORT } };

glm::dvec3 vectorAt(const char* bytes, std::size_t offset)
{
  return glm::dvec3(storedNumber<float>(bytes + offset, true),
    storedNumber<float>(bytes + offset + 4, true), storedNumber<float>(bytes + offset + 8, true));
}

// The names are those of the format.
struct MGHHeader
{
  std::array<char, HeaderBytes> bytes{};

  int intent() const { return this->begin() >> IntentBits; }
  int version() const { return this->begin() & ((1 << IntentBits) - 1); }
  // Columns, rows, slices, frames.
  int side(int axis) const
  {
    return storedNumber<std::int32_t>(
      this->bytes.data() + 4 + 4 * static_cast<std::size_t>(axis), true);
  }
  int type() const { return storedNumber<std::int32_t>(this->bytes.data() + 20, true); }
  bool goodRASFlag() const { return storedNumber<std::int16_t>(this->bytes.data() + 28, true) > 0; }
  glm::dvec3 spacing() const { return vectorAt(this->bytes.data(), 30); }
  // Of one axis.
  glm::dvec3 direction(int axis) const
  {
    return vectorAt(this->bytes.data(), 42 + 12 * static_cast<std::size_t>(axis));
  }
  // Of the voxel in the middle, at half the sides.
  glm::dvec3 centre() const { return vectorAt(this->bytes.data(), 78); }

private:
  int begin() const { return storedNumber<std::int32_t>(this->bytes.data(), true); }
};

void readBegin(const std::string& fileName, MGHHeader& header)
{
  requirePlainFile(fileName);
  const StoredBytes from{ fileName, 0, beginsLikeGzip(fileName), 0 };
  withBeginning("has no whole header, which has " + std::to_string(HeaderBytes) + " bytes: it ",
    [&] { readBytes(from, header.bytes.data(), HeaderBytes, [](double) { return false; }); });
}

void requireHeader(const MGHHeader& header)
{
  if (header.version() != Version)
  {
    throw Problem("has the version " + std::to_string(header.version()) + "; it must have 1");
  }
  if (header.intent() < 0 || header.intent() >= Warp)
  {
    throw Problem("has the version 1 with the intent " + std::to_string(header.intent()) +
      (header.intent() == Warp || header.intent() == InverseWarp ? " (a warp)" : "") +
      "; BrainShift reads the intents 0 (MRI), 1 (label) and 2 (shape)");
  }
  bool oneVoxel = true;
  for (int axis = 0; axis < 4; ++axis)
  {
    const int side = header.side(axis);
    oneVoxel = oneVoxel && (side == 1 || axis == 3);
    if (side < 1 || (axis == 3 && side > MostFrames))
    {
      throw Problem("has " + std::to_string(side) +
        (axis == 3 ? " frames" : " voxels along axis ") + (axis == 3 ? "" : std::to_string(axis)) +
        "; it must have 1 or more" + (axis == 3 ? ", up to " + std::to_string(MostFrames) : ""));
    }
  }
  if (oneVoxel)
  {
    throw Problem("has 1 voxel; it must have at least 2");
  }
  if (!(Types.count(header.type()) > 0))
  {
    throw Problem("has the type " + std::to_string(header.type()) +
      "; BrainShift reads 0 (uchar), 1 (int), " + "3 (float), 4 (short) and 10 (ushort)");
  }
}

glm::dmat4 worldFromVoxel(const MGHHeader& header)
{
  glm::dmat4 world(1.0);
  // FreeSurfer's default: coronal slices, from right to left and from the head down.
  glm::dmat3 steps(
    glm::dvec3(-1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 1.0, 0.0));
  glm::dvec3 corner(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (header.goodRASFlag())
    {
      steps[axis] = header.direction(axis) * header.spacing()[axis];
    }
    corner -= 0.5 * header.side(axis) * steps[axis];
    world[axis] = glm::dvec4(steps[axis], 0.0);
  }
  world[3] = glm::dvec4(corner + (header.goodRASFlag() ? header.centre() : glm::dvec3(0.0)), 1.0);
  return world;
}

// Seconds between two frames: the repetition time, which follows the voxels; 1 if it is not there.
double secondsOf(StoredBytes from, double bytes, std::vector<std::string>& warnings)
{
  from.unpackedSkip += from.isPacked ? static_cast<std::uint64_t>(bytes) : 0;
  from.offset += from.isPacked ? 0 : static_cast<std::uint64_t>(bytes);
  std::array<char, 4> raw{};
  const bool isRead =
    problemOf([&] { readBytes(from, raw.data(), 4, [](double) { return false; }); }).empty();
  const double milliseconds = isRead ? storedNumber<float>(raw.data(), true) : 0.0;
  if (std::isfinite(milliseconds) && milliseconds > 0.0)
  {
    return milliseconds * 1e-3;
  }
  warnings.push_back(isRead ? joined("has the TR ", milliseconds,
                                " ms, which is no time between frames; they count as 1 s apart")
                            : "names no TR; its frames count as 1 s apart");
  return 1.0;
}
}

bool isMGHFile(const std::string& fileName)
{
  MGHHeader header;
  const bool isRead = problemOf([&] { readBegin(fileName, header); }).empty();
  return isRead && header.version() == Version && header.intent() >= 0 &&
    header.intent() <= InverseWarp && Types.count(header.type()) > 0;
}

void MGHVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  this->Numbers = nullptr; // the file may have changed under its name
  MGHHeader stored;
  readBegin(fileName, stored);
  requireHeader(stored);
  const bool isPacked = beginsLikeGzip(fileName);
  this->From = { fileName, isPacked ? 0 : HeaderBytes, isPacked, isPacked ? HeaderBytes : 0 };
  this->Dimensions = glm::ivec3(stored.side(0), stored.side(1), stored.side(2));
  this->Frames = stored.side(3);
  this->Type = Types.at(stored.type());
  header.dimensions = this->Dimensions;
  header.storedType = this->Type;
  const double bytes = this->Frames * VolumeFile::storedBytes(header);
  requireBytes(this->From, bytes);
  header.worldFromVoxel = worldFromVoxel(stored);
  header.knowsSides = stored.goodRASFlag();
  if (!header.knowsSides)
  {
    header.warnings.push_back("has no positions of its voxels (goodRASFlag is 0); they are shown "
                              "as coronal slices of 1 mm, and their sides are not known");
  }
  else
  {
    warnOfScaledAxes({ glm::length(stored.direction(0)), glm::length(stored.direction(1)),
                       glm::length(stored.direction(2)) },
      header.warnings);
  }
  header.times = evenTimes(static_cast<std::size_t>(this->Frames),
    this->Frames > 1 ? secondsOf(this->From, bytes, header.warnings) : 1.0);
}

double MGHVolume::storedBytes(const VolumeHeader& header) const
{
  const int frames = this->keepsFrames() ? this->Frames : 1;
  return this->Numbers ? 0.0 : frames * VolumeFile::storedBytes(header);
}

void MGHVolume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  const std::size_t frames = this->keepsFrames() ? static_cast<std::size_t>(this->Frames) : 1;
  vtkSmartPointer<vtkDataArray> numbers = this->Held == voxels.wanted ? this->Numbers : nullptr;
  const auto size = static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(this->Type));
  const StoredBox box{ this->Dimensions, voxels.wanted, size, frames };
  if (!numbers)
  {
    this->Numbers = nullptr;
    StoredBytes from = this->From;
    if (!this->keepsFrames())
    {
      from.offset += volume * size * static_cast<std::size_t>(this->Dimensions.x) *
        static_cast<std::size_t>(this->Dimensions.y) * static_cast<std::size_t>(this->Dimensions.z);
    }
    numbers = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Type));
    numbers->SetNumberOfTuples(static_cast<vtkIdType>(box.voxelCount()));
    auto* const to = static_cast<char*>(numbers->GetVoidPointer(0));
    bool stopped = false;
    readBox(from, box, to, [&](double fraction) {
      stopped = !progress(fraction);
      return !stopped;
    });
    if (stopped)
    {
      return;
    }
    toMachineOrder(to, box.voxelCount(), size, true);
  }
  const auto count = static_cast<vtkIdType>(box.voxelCount() / frames);
  voxels.showWanted(
    frames > 1 ? partOf(numbers, static_cast<vtkIdType>(volume) * count, count) : numbers);
  if (this->keepsFrames())
  {
    this->Numbers = numbers;
    this->Held = voxels.wanted;
  }
}

extern const VolumeFormat VolumesOfMGH{ "MGH", isMGHFile, makeVolumeFile<MGHVolume> };
}
