// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Writers/WrittenVolume.h"

#include "Common/Bytes.h"
#include "Common/HostMemory.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"

#include "vtk_zlib.h"

#include <glm/gtc/quaternion.hpp>

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <ios>
#include <utility>

namespace brainshift
{
namespace
{
using Kind = VoxelNumber::Kind;

constexpr std::size_t NIFTIBytes = 348;    // sizeof_hdr
constexpr std::size_t ExtensionBytes = 4;  // all zero: no extension follows
constexpr std::int16_t UnknownPlace = 0;   // NIFTI_XFORM_UNKNOWN
constexpr std::int16_t ScannerAnatomy = 1; // NIFTI_XFORM_SCANNER_ANAT
constexpr std::int16_t AlignedAnatomy = 2; // NIFTI_XFORM_ALIGNED_ANAT
constexpr std::int16_t LabelIntent = 1002; // NIFTI_INTENT_LABEL
constexpr char Millimetres = 2;            // NIFTI_UNITS_MM
constexpr int LongestDescription = 79;     // descrip has 80 characters with its zero

constexpr int LongestNIFTISide = 32767;

// Colours of NIfTI have a type of their own: three or four components of 1 byte.
bool isNIFTIColour(const OutgoingVolume& volume)
{
  return volume.type.kind == Kind::Unsigned && volume.type.bytes == 1 &&
    (volume.components() == 3 || volume.components() == 4);
}

// Fields of NIfTI-1 at their places in the header, as nifti1.h gives them.
class NIFTIBytesOfHeader
{
public:
  template <typename Number>
  void set(std::size_t at, Number number)
  {
    std::memcpy(this->Bytes.data() + at, &number, sizeof(Number));
  }

  void setText(std::size_t at, const std::string& text)
  {
    std::memcpy(this->Bytes.data() + at, text.data(), text.size());
  }

  std::string text() const { return { this->Bytes.begin(), this->Bytes.end() }; }

private:
  std::array<char, NIFTIBytes + ExtensionBytes> Bytes{};
};

std::int16_t niftiType(const OutgoingVolume& volume)
{
  if (isNIFTIColour(volume))
  {
    return volume.components() == 3 ? 128 : 2304; // RGB24, RGBA32
  }
  const int bytes = volume.type.bytes;
  switch (volume.type.kind)
  {
    case Kind::Floating:
      return bytes == 4 ? 16 : 64;
    case Kind::Unsigned:
      return bytes == 1 ? 2 : bytes == 2 ? 512 : 768;
    default:
      return bytes == 1 ? 256 : bytes == 2 ? 4 : 8;
  }
}

void setSizes(const OutgoingVolume& volume, NIFTIBytesOfHeader& header)
{
  const bool isVector = !isNIFTIColour(volume) && volume.components() > 1;
  const glm::ivec3 sides = volume.grid.dimensions;
  const int dim[8] = { isVector ? 5 : 3, sides.x, sides.y, sides.z, 1,
    isVector ? volume.components() : 1, 1, 1 };
  for (int i = 0; i < 8; ++i)
  {
    header.set(40 + 2 * i, static_cast<std::int16_t>(dim[i]));
  }
  const int components = isNIFTIColour(volume) ? volume.components() : 1;
  header.set(70, niftiType(volume));
  header.set(72, static_cast<std::int16_t>(8 * volume.type.bytes * components));
}

// The sform holds all; the qform says the same for readers that know rotations only.
void setPlace(const OutgoingVolume& volume, NIFTIBytesOfHeader& header)
{
  const Grid& grid = volume.grid;
  glm::dmat3 rotation = grid.direction;
  const bool isMirrored = glm::determinant(rotation) < 0.0;
  if (isMirrored)
  {
    rotation[2] = -rotation[2]; // qfac says it
  }
  glm::dquat turn = glm::normalize(glm::quat_cast(rotation));
  turn = turn.w < 0.0 ? -turn : turn;
  header.set(76, isMirrored ? -1.0f : 1.0f);
  for (int axis = 0; axis < 3; ++axis)
  {
    header.set(80 + 4 * axis, static_cast<float>(grid.spacing[axis]));
    header.set(268 + 4 * axis, static_cast<float>(grid.origin[axis]));
    for (int column = 0; column < 3; ++column)
    {
      header.set(280 + 16 * axis + 4 * column,
        static_cast<float>(grid.direction[column][axis] * grid.spacing[column]));
    }
    header.set(280 + 16 * axis + 12, static_cast<float>(grid.origin[axis]));
  }
  header.set(256, static_cast<float>(turn.x));
  header.set(260, static_cast<float>(turn.y));
  header.set(264, static_cast<float>(turn.z));
  // Without a code most readers would put a volume that needs its transform somewhere else.
  const std::int16_t atLeast = needsTransform(grid) ? AlignedAnatomy : UnknownPlace;
  const std::int16_t known =
    volume.space == Template::None ? ScannerAnatomy : static_cast<std::int16_t>(volume.space);
  header.set(252, volume.knowsSides ? known : UnknownPlace);
  header.set(254, volume.knowsSides ? known : atLeast);
}

std::string metaImageType(const VoxelNumber& type)
{
  const std::string sign = type.kind == Kind::Unsigned ? "U" : "";
  switch (type.kind)
  {
    case Kind::Floating:
      return type.bytes == 4 ? "MET_FLOAT" : "MET_DOUBLE";
    default:
      return "MET_" + sign + (type.bytes == 1 ? "CHAR" : type.bytes == 2 ? "SHORT" : "INT");
  }
}

std::string nrrdType(const VoxelNumber& type)
{
  if (type.kind == Kind::Floating)
  {
    return type.bytes == 4 ? "float" : "double";
  }
  return (type.kind == Kind::Unsigned ? "uint" : "int") + std::to_string(8 * type.bytes);
}

// What the components of a voxel are, as NRRD names it.
std::string nrrdKind(const OutgoingVolume& volume)
{
  const bool isBytes = volume.type.kind == Kind::Unsigned && volume.type.bytes == 1;
  switch (volume.components()) // a "list" would be a series, a "vector" of 3 a displacement
  {
    case 2:
      return "2-vector";
    case 3:
      return isBytes ? "RGB-color" : "3-color";
    case 4:
      return isBytes ? "RGBA-color" : "4-color";
    default:
      return "vector";
  }
}

// A header of NIfTI-1 with its four bytes for extensions. Sides: up to LongestNIFTISide.
std::string niftiHeader(const OutgoingVolume& volume)
{
  NIFTIBytesOfHeader header;
  header.set(0, static_cast<std::int32_t>(NIFTIBytes));
  header.set(68, volume.isLabelMap && volume.components() == 1 ? LabelIntent : std::int16_t(0));
  setSizes(volume, header);
  setPlace(volume, header);
  header.set(108, static_cast<float>(NIFTIBytes + ExtensionBytes)); // vox_offset
  header.set(112, 1.0f);                                            // scl_slope
  header.set(123, Millimetres);                                     // xyzt_units
  const std::string note = std::string("BrainShift") + (volume.knowsSides ? "" : ", ") +
    (volume.knowsSides ? "" : UnknownSidesNote);
  header.setText(148, note.substr(0, LongestDescription));
  header.setText(344, "n+1");
  return header.text();
}

// A header of MetaImage, up to the numbers.
std::string metaImageHeader(const OutgoingVolume& volume)
{
  const Grid grid = withReversedXY(volume.grid);
  std::ostringstream header;
  header << "ObjectType = Image\nNDims = 3\n";
  const bool looksLikeField = volume.components() == 3 && volume.type.kind == Kind::Floating;
  const bool deniesField = looksLikeField && !volume.isField;
  if (!volume.knowsSides || deniesField)
  {
    header << "Comment = " << (volume.knowsSides ? "" : UnknownSidesNote)
           << (!volume.knowsSides && deniesField ? "; " : "") << (deniesField ? NoFieldNote : "")
           << "\n";
  }
  header << "BinaryData = True\nBinaryDataByteOrderMSB = "
         << (thisMachineIsBigEndian() ? "True" : "False") << "\nCompressedData = False\n"
         << "TransformMatrix = " << listText(grid.direction[0], " ") << " "
         << listText(grid.direction[1], " ") << " " << listText(grid.direction[2], " ") << "\n"
         << "Offset = " << listText(grid.origin, " ") << "\nCenterOfRotation = 0 0 0\n"
         << "ElementSpacing = " << listText(grid.spacing, " ") << "\n"
         << "DimSize = " << listText(glm::dvec3(grid.dimensions), " ") << "\n";
  if (volume.components() > 1)
  {
    header << "ElementNumberOfChannels = " << volume.components() << "\n";
  }
  header << "ElementType = " << metaImageType(volume.type) << "\nElementDataFile = LOCAL\n";
  return header.str();
}

// A header of NRRD, up to the numbers.
std::string nrrdHeader(const OutgoingVolume& volume)
{
  const Grid grid = withReversedXY(volume.grid);
  const bool isVector = volume.components() > 1;
  std::ostringstream header;
  header << "NRRD0004\n";
  if (!volume.knowsSides)
  {
    header << "# " << UnknownSidesNote << "\n";
  }
  header << "type: " << nrrdType(volume.type) << "\ndimension: " << (isVector ? 4 : 3)
         << "\nspace: left-posterior-superior\nsizes:";
  if (isVector)
  {
    header << " " << volume.components();
  }
  header << " " << listText(glm::dvec3(grid.dimensions), " ")
         << "\nspace directions:" << (isVector ? " none" : "");
  for (int axis = 0; axis < 3; ++axis)
  {
    header << " (" << listText(grid.direction[axis] * grid.spacing[axis], ",") << ")";
  }
  header << "\nkinds: " << (isVector ? nrrdKind(volume) + " " : "") << "domain domain domain";
  if (volume.type.bytes > 1)
  {
    header << "\nendian: " << (thisMachineIsBigEndian() ? "big" : "little");
  }
  header << "\nencoding: raw\nspace origin: (" << listText(grid.origin, ",") << ")\n\n";
  return header.str();
}

constexpr std::size_t PieceBytes = std::size_t(1) << 22; // between two reports of progress

// What goes into a file, and how.
struct Contents
{
  std::string header;
  bool isPacked = false;    // with gzip
  bool partsVoxels = false; // all numbers of the first component come first
  bool isKnown = false;     // the format
};

Contents contentsOf(const std::string& fileName, const OutgoingVolume& volume)
{
  const bool isPacked = endsWith(fileName, ".nii.gz");
  if (isPacked || endsWith(fileName, ".nii"))
  {
    return { niftiHeader(volume), isPacked, volume.components() > 1 && !isNIFTIColour(volume),
      true };
  }
  if (endsWith(fileName, ".mha") || endsWith(fileName, ".mhd"))
  {
    return { metaImageHeader(volume), false, false, true };
  }
  if (endsWith(fileName, ".nrrd"))
  {
    return { nrrdHeader(volume), false, false, true };
  }
  return {};
}

void requireSize(const std::string& fileName, const OutgoingVolume& volume)
{
  const glm::ivec3& sides = volume.grid.dimensions;
  const int longest = std::max({ sides.x, sides.y, sides.z, volume.components() });
  const bool isNIFTI = endsWith(fileName, ".nii") || endsWith(fileName, ".nii.gz");
  if (isNIFTI && longest > LongestNIFTISide)
  {
    throw Problem("File " + fileName + " cannot be written: the input has " +
      sizeText(glm::dvec3(sides)) + " voxels of " + std::to_string(volume.components()) +
      " components; NIfTI holds at most " + std::to_string(LongestNIFTISide) + " of each");
  }
}

// A file that takes bytes, plain or packed with gzip. It throws the reason if they are not taken.
class ByteSink
{
public:
  ByteSink(const std::string& fileName, bool pack)
    : Packs(pack)
  {
    errno = 0;
    if (pack)
    {
      this->Packed = gzopen(fileName.c_str(), "wb");
    }
    else
    {
      this->Plain.open(fileName, std::ios::binary);
    }
    require(pack ? this->Packed != nullptr : !!this->Plain);
  }
  ~ByteSink()
  {
    if (this->Packed)
    {
      gzclose(this->Packed);
    }
  }
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;

  void write(const char* bytes, std::size_t count)
  {
    constexpr std::size_t Piece = 1u << 30; // zlib counts in 32 bits
    while (count > 0)
    {
      const std::size_t piece = std::min(count, Piece);
      errno = 0;
      require(this->Packs
          ? gzwrite(this->Packed, bytes, static_cast<unsigned>(piece)) == static_cast<int>(piece)
          : !!this->Plain.write(bytes, static_cast<std::streamsize>(piece)));
      bytes += piece;
      count -= piece;
    }
  }

  // Some disks say only here that they are full.
  void close()
  {
    errno = 0;
    if (this->Packs)
    {
      require(gzclose(std::exchange(this->Packed, nullptr)) == Z_OK);
    }
    else
    {
      this->Plain.close();
      require(!!this->Plain);
    }
  }

private:
  static void require(bool good) { throwIfAny(good ? std::string() : lastSystemError()); }

  std::ofstream Plain;
  gzFile Packed = nullptr;
  bool Packs;
};

// Receives the fraction that is written. Throws if the user stops.
using Written = std::function<void(double fraction)>;

// Hands the sink all numbers in pieces.
void writeAll(
  const OutgoingVolume& volume, const VolumeLayers& layers, const Written& written, ByteSink& sink)
{
  const auto all = static_cast<double>(volume.bytesOfVolume());
  double done = 0.0;
  for (std::size_t number = 0; number < layers.count; ++number)
  {
    const OutgoingVolume part = layers.bring(number);
    const char* next = part.bytes();
    std::size_t left = part.bytesOfVolume();
    while (left > 0)
    {
      const std::size_t piece = std::min(left, PieceBytes);
      sink.write(next, piece);
      next += piece;
      left -= piece;
      done += static_cast<double>(piece);
      written(done / all);
    }
  }
}

// The same, one component after the other.
void writeParted(const OutgoingVolume& volume, const Written& written, ByteSink& sink)
{
  const std::size_t number = volume.type.bytes;
  const std::size_t voxels = volume.grid.count();
  const std::size_t most = PieceBytes / number;
  std::vector<char> piece;
  const int components = volume.components();
  for (int component = 0; component < components; ++component)
  {
    for (std::size_t first = 0; first < voxels; first += most)
    {
      const std::size_t count = std::min(most, voxels - first);
      piece.resize(count * number);
      const char* from = volume.bytes() + first * volume.bytesOfVoxel() + component * number;
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(piece.data() + i * number, from + i * volume.bytesOfVoxel(), number);
      }
      sink.write(piece.data(), piece.size());
      written((component + static_cast<double>(first + count) / voxels) / components);
    }
  }
}
}

bool partsComponents(const std::string& fileName, const OutgoingVolume& volume)
{
  return contentsOf(fileName, volume).partsVoxels;
}

void writeVolume(
  const std::string& fileName, const OutgoingVolume& volume, const Progress& progress)
{
  writeLayers(fileName, volume, { 1, [&](std::size_t) { return volume; } }, progress);
}

void writeLayers(const std::string& fileName, const OutgoingVolume& volume,
  const VolumeLayers& layers, const Progress& progress)
{
  requireSize(fileName, volume);
  const Contents contents = contentsOf(fileName, volume);
  if (!contents.isKnown)
  {
    throw Problem(
      "The extension of the volume " + fileName + " must be .nii, .nii.gz, .mha, .mhd or .nrrd");
  }
  const Written written = [&](double fraction) {
    throwIfAny(progress(fraction) ? "" : "it was stopped");
  };
  writeWhole(fileName, [&](const std::string& beside) {
    ByteSink sink(beside, contents.isPacked);
    sink.write(contents.header.data(), contents.header.size());
    if (contents.partsVoxels)
    {
      writeParted(volume, written, sink);
    }
    else
    {
      writeAll(volume, layers, written, sink);
    }
    sink.close();
  });
}
}
