// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Writers/WrittenHeader.h"

#include "Common/Bytes.h"
#include "Formats/Files/Text.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace brainshift
{
namespace
{
using Kind = NumberType::Kind;

constexpr std::size_t NIFTIBytes = 348;    // sizeof_hdr
constexpr std::size_t ExtensionBytes = 4;  // all zero: no extension follows
constexpr std::int16_t ScannerAnatomy = 1; // NIFTI_XFORM_SCANNER_ANAT
constexpr std::int16_t AlignedAnatomy = 2; // NIFTI_XFORM_ALIGNED_ANAT
constexpr char Millimetres = 2;            // NIFTI_UNITS_MM
constexpr int LongestDescription = 79;     // descrip has 80 characters with its zero

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
  // Without a code most readers would put the voxels somewhere else.
  header.set(252, volume.knowsSides ? ScannerAnatomy : std::int16_t(0));
  header.set(254, volume.knowsSides ? ScannerAnatomy : AlignedAnatomy);
}

std::string metaImageType(const NumberType& type)
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

std::string nrrdType(const NumberType& type)
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
  return isBytes && volume.components() == 3 ? "RGB-color"
    : isBytes && volume.components() == 4    ? "RGBA-color"
                                             : "list";
}
}

bool isNIFTIColour(const OutgoingVolume& volume)
{
  return volume.type.kind == Kind::Unsigned && volume.type.bytes == 1 &&
    (volume.components() == 3 || volume.components() == 4);
}

std::string niftiHeader(const OutgoingVolume& volume)
{
  NIFTIBytesOfHeader header;
  header.set(0, static_cast<std::int32_t>(NIFTIBytes));
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

std::string metaImageHeader(const OutgoingVolume& volume)
{
  const Grid grid = withReversedXY(volume.grid);
  std::ostringstream header;
  header << "ObjectType = Image\nNDims = 3\n";
  if (!volume.knowsSides)
  {
    header << "Comment = " << UnknownSidesNote << "\n";
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
}
