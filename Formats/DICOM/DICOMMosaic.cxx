// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMMosaic.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr DICOMTag ImageType = 0x00080008;
constexpr DICOMTag Manufacturer = 0x00080070;
constexpr DICOMTag Rows = 0x00280010;
constexpr DICOMTag Columns = 0x00280011;
constexpr DICOMTag AcquisitionMatrix = 0x00181310;

// A private attribute. Its element counts from the block that its creator took.
struct PrivateName
{
  DICOMTag group;
  DICOMTag element;
  const char* creator;
};
constexpr PrivateName SliceCount{ 0x0019, 0x0a, "SIEMENS MR HEADER" };
constexpr PrivateName ImageHeader{ 0x0029, 0x10, "SIEMENS CSA HEADER" };
constexpr PrivateName TypeText{ 0x0051, 0x16, "SIEMENS MR HEADER" };

// Its tag in a file. None: the file has no such block.
std::optional<DICOMTag> tagOf(const DICOMDataSet& set, const PrivateName& name)
{
  constexpr DICOMTag FirstBlock = 0x10;
  constexpr DICOMTag LastBlock = 0xff;
  for (DICOMTag block = FirstBlock; block <= LastBlock; ++block)
  {
    if (textOf(set, name.group << 16 | block) == name.creator)
    {
      return name.group << 16 | block << 8 | name.element;
    }
  }
  return {};
}

// A number in Siemens' own header, which has text behind each name. 0: none.
double numberInHeader(const std::string& header, const std::string& name)
{
  constexpr std::size_t CountAt = 76;  // of values, after the begin of the name
  constexpr std::size_t LengthAt = 88; // of the first value, bytes
  constexpr std::size_t TextAt = 100;
  constexpr std::int32_t LongestText = 64;
  const std::size_t place = header.find(name + std::string(1, 0));
  if (place == std::string::npos)
  {
    return 0.0;
  }
  const auto count = storedNumberAt<std::int32_t>(header, place + CountAt, false);
  const auto length = storedNumberAt<std::int32_t>(header, place + LengthAt, false);
  if (!count || !length || *count < 1 || *length < 1 || *length > LongestText ||
    header.size() < place + TextAt + static_cast<std::size_t>(*length))
  {
    return 0.0;
  }
  const std::string text = header.substr(place + TextAt, static_cast<std::size_t>(*length));
  return numberIn(trimmed(text.c_str())).value_or(0.0);
}

// Slices that a file says to have as tiles, and where it says so.
struct SaidCount
{
  double slices = 0.0;
  std::string where;
};

SaidCount saidCount(const DICOMDataSet& set)
{
  const std::optional<DICOMTag> count = tagOf(set, SliceCount);
  if (const double slices = count ? wholeOf(set, *count, 0.0) : 0.0; slices > 1.0)
  {
    return { slices, "(0019,xx0a)" };
  }
  const std::optional<DICOMTag> header = tagOf(set, ImageHeader);
  const auto found = header ? set.elements.find(*header) : set.elements.end();
  return found == set.elements.end()
    ? SaidCount()
    : SaidCount{ numberInHeader(found->second.bytes, "NumberOfImagesInMosaic"),
        "(0029,xx10, NumberOfImagesInMosaic)" };
}

// Programs that cut a mosaic into its slices leave the private attributes as they are.
bool hasRoomFor(double slices, const DICOMDataSet& set)
{
  const double tiles = std::ceil(std::sqrt(slices)); // along each side
  const double rows = wholeOf(set, Rows, 0.0);
  const double columns = wholeOf(set, Columns, 0.0);
  const std::vector<int> matrix = wholesOf(set, AcquisitionMatrix);
  const double measured =
    matrix.empty() ? 1.0 : static_cast<double>(*std::max_element(matrix.begin(), matrix.end()));
  return std::fmod(rows, tiles) == 0.0 && std::fmod(columns, tiles) == 0.0 &&
    std::max(rows, columns) >= tiles * measured;
}
}

void requireNoMosaic(const DICOMDataSet& set)
{
  constexpr const char* Tiles = ": its slices are tiles of one picture; convert it with dcm2niix";
  const std::string type = plainText(textOf(set, ImageType));
  if (type.find("MOSAIC") != std::string::npos)
  {
    throw Problem("has the ImageType " + type + Tiles);
  }
  const SaidCount said = saidCount(set);
  if (said.slices > 1.0 && hasRoomFor(said.slices, set))
  {
    throw Problem(joined("is a mosaic of ", said.slices, " slices by Siemens' private attribute ",
      said.where, ", though not by its ImageType", Tiles));
  }
  const std::optional<DICOMTag> text = tagOf(set, TypeText);
  const std::string words = text ? plainText(textOf(set, *text)) : std::string();
  if (said.slices == 0.0 && words.find("MOSAIC") != std::string::npos)
  {
    throw Problem("is a mosaic by Siemens' private attribute (0051,xx16) " + shownWords(words) +
      ", though not by its ImageType" + Tiles);
  }
}

std::string noteOfMosaic(const DICOMDataSet& set)
{
  constexpr int FewestTiles = 3; // along a side; scanners interpolate to twice as many pixels
  const std::vector<int> matrix = wholesOf(set, AcquisitionMatrix);
  const int measured = matrix.empty() ? 0 : *std::max_element(matrix.begin(), matrix.end());
  const int rows = static_cast<int>(wholeOf(set, Rows, 0.0));
  const int columns = static_cast<int>(wholeOf(set, Columns, 0.0));
  const bool isOfSiemens =
    lowerCase(textOf(set, Manufacturer)).find("siemens") != std::string::npos;
  const bool isLarge = measured > 0 && std::min(rows, columns) >= FewestTiles * measured &&
    rows % measured == 0 && columns % measured == 0;
  return isOfSiemens && isLarge
    ? joined("has images of ", columns, " x ", rows, " pixels, of which ", measured,
        " along a side were measured (AcquisitionMatrix): they may be mosaics, whose tiles are the "
        "slices")
    : std::string();
}
}
