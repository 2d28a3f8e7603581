// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMMosaic.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFrames.h"
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

constexpr DICOMTag ImagePosition = 0x00200032;
constexpr DICOMTag SpacingBetweenSlices = 0x00180088;
constexpr const char* WayOut = ". Convert the scanner's files with dcm2niix";

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
constexpr PrivateName UnitedCount{ 0x0065, 0x50, "Image Private Header" };
constexpr PrivateName UnitedSlices{ 0x0065, 0x51, "Image Private Header" }; // a sequence

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

// Numbers in Siemens' own header, which has texts behind each name. Empty: none.
std::vector<double> numbersInHeader(const std::string& header, const std::string& name)
{
  constexpr std::size_t CountAt = 76; // of values, after the begin of the name
  constexpr std::size_t ItemsAt = 84;
  constexpr std::size_t LengthAt = 4; // of a text, bytes, after the begin of its item
  constexpr std::size_t TextAt = 16;
  constexpr std::int32_t LongestText = 64;
  constexpr std::int32_t MostValues = 3;
  const std::size_t begin = header.find(name + std::string(1, 0));
  std::vector<double> numbers;
  if (begin == std::string::npos)
  {
    return numbers;
  }
  const auto count = storedNumberAt<std::int32_t>(header, begin + CountAt, false);
  std::size_t item = begin + ItemsAt;
  for (std::int32_t i = 0; count && i < std::min(*count, MostValues); ++i)
  {
    const auto length = storedNumberAt<std::int32_t>(header, item + LengthAt, false);
    if (!length || *length < 1 || *length > LongestText ||
      header.size() < item + TextAt + static_cast<std::size_t>(*length))
    {
      break; // items behind the last value are empty
    }
    const auto bytes = static_cast<std::size_t>(*length);
    const std::string text = header.substr(item + TextAt, bytes);
    const auto number = numberIn(trimmed(text.c_str()));
    if (!number || !std::isfinite(*number))
    {
      return {};
    }
    numbers.push_back(*number);
    item += TextAt + (bytes + 3) / 4 * 4; // texts fill words of 4 bytes
  }
  return numbers;
}

// Siemens' own header of an image. Empty: there is none.
std::string imageHeader(const DICOMDataSet& set)
{
  const std::optional<DICOMTag> header = tagOf(set, ImageHeader);
  const auto found = header ? set.elements.find(*header) : set.elements.end();
  return found == set.elements.end() ? std::string() : found->second.bytes;
}

// How many slices a file has as tiles by its private attributes. 0: they do not give a number.
double countOfTiles(const DICOMDataSet& set)
{
  const std::optional<DICOMTag> tag = tagOf(set, SliceCount);
  const double count = tag ? wholeOf(set, *tag, 0.0) : 0.0;
  const std::vector<double> inHeader = numbersInHeader(imageHeader(set), "NumberOfImagesInMosaic");
  return count > 0.0 || inHeader.empty() ? count : inHeader.front();
}

// Programs that cut a mosaic into its slices leave the private attributes as they are.
bool hasRoomFor(const glm::dvec2& tiles, const DICOMDataSet& set)
{
  const double rows = wholeOf(set, Rows, 0.0);
  const double columns = wholeOf(set, Columns, 0.0);
  const std::vector<int> matrix = wholesOf(set, AcquisitionMatrix);
  const double measured =
    matrix.empty() ? 1.0 : static_cast<double>(*std::max_element(matrix.begin(), matrix.end()));
  return std::fmod(rows, tiles.y) == 0.0 && std::fmod(columns, tiles.x) == 0.0 &&
    (rows >= tiles.y * measured || columns >= tiles.x * measured);
}

// The end of a sentence if an image of Siemens is so much larger than what was measured that it may
// be a mosaic, although no attribute names it one, as after private attributes were removed.
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

// Whether a picture is a mosaic: by its ImageType, or by private attributes alone.
bool isMosaic(const DICOMDataSet& set, double slices)
{
  const std::optional<DICOMTag> words = tagOf(set, TypeText);
  const auto isNamed = [&set](DICOMTag tag) {
    return plainText(textOf(set, tag)).find("MOSAIC") != std::string::npos;
  };
  return isNamed(ImageType) ||
    (slices > 1.0 && hasRoomFor(glm::dvec2(std::ceil(std::sqrt(slices))), set)) ||
    (slices == 0.0 && words && isNamed(*words));
}

// From the first tile to the next one. Only Siemens' normal gives the direction: scanners number
// slices from feet to head or from head to feet.
glm::dvec3 stepOfTiles(const DICOMDataSet& set, const DICOMFrame& first)
{
  constexpr double LeastCosine = 0.999;
  const std::string header = imageHeader(set);
  const std::vector<double> stored = numbersInHeader(header, "SliceNormalVector");
  if (stored.size() != 3)
  {
    throw Problem(std::string("is a mosaic whose order of slices is not known: it has no "
                              "SliceNormalVector in Siemens' private attribute (0029,xx10), which "
                              "anonymizers often remove") +
      WayOut);
  }
  const glm::dvec3 normal = glm::cross(first.alongRow, first.alongColumn);
  const double cosine = glm::dot(normal, glm::dvec3(stored[0], stored[1], stored[2]));
  if (!(std::abs(cosine) > LeastCosine && std::abs(cosine) < 2.0 - LeastCosine))
  {
    throw Problem(
      joined("is a mosaic whose SliceNormalVector, ", stored[0], "\\", stored[1], "\\", stored[2],
        ", is not perpendicular to its ImageOrientationPatient (cosine ", cosine, ")", WayOut));
  }
  std::vector<double> stepMm =
    requiredDecimals(set, { SpacingBetweenSlices, "SpacingBetweenSlices" }, 1);
  stepMm = stepMm.empty() ? numbersInHeader(header, "SpacingBetweenSlices") : stepMm;
  if (stepMm.empty() || !(stepMm.front() > 0.0))
  {
    throw Problem(joined("is a mosaic whose SpacingBetweenSlices is ",
      stepMm.empty() ? std::string("missing") : numberText(stepMm.front()),
      "; it must be above 0 mm", WayOut));
  }
  return std::copysign(stepMm.front(), cosine) * normal;
}

// Tiles along each side of a picture of so many slices.
int tilesAlong(double slices, const DICOMFile& file)
{
  constexpr double MostSlices = 65536.0;
  const int tiles = slices >= 1.0 && slices <= MostSlices && slices == std::floor(slices)
    ? static_cast<int>(std::ceil(std::sqrt(slices)))
    : 0;
  if (tiles == 0)
  {
    throw Problem(joined("is a mosaic, a picture whose tiles are slices, of ",
      slices == 0.0 ? std::string("an unknown number of") : numberText(slices),
      " slices (NumberOfImagesInMosaic in Siemens' private attributes (0019,xx0a) and (0029,xx10), "
      "which anonymizers often remove)",
      WayOut));
  }
  if (file.rows % tiles != 0 || file.columns % tiles != 0)
  {
    throw Problem(joined("is a mosaic of ", slices, " slices in ", file.columns, " x ", file.rows,
      " pixels, which ", tiles, " x ", tiles, " tiles do not divide", WayOut));
  }
  return tiles;
}

// Throws the end of a sentence for what else a picture needs so that its tiles have positions.
void requireTiles(const DICOMDataSet& set, const DICOMFile& file, double slices)
{
  const std::vector<double> inHeader = numbersInHeader(imageHeader(set), "NumberOfImagesInMosaic");
  if (!inHeader.empty() && inHeader.front() != slices)
  {
    throw Problem(joined("is a mosaic of ", slices,
      " slices by the private attribute (0019,xx0a) and of ", inHeader.front(),
      " by NumberOfImagesInMosaic in (0029,xx10); they must be the same", WayOut));
  }
  if (file.frames.size() != 1)
  {
    throw Problem(
      joined("has ", file.frames.size(), " frames that are mosaics; a file has one", WayOut));
  }
  if (!file.frames.front().isPlaced)
  {
    throw Problem(std::string("is a mosaic without ImagePositionPatient and "
                              "ImageOrientationPatient") +
      WayOut);
  }
  if (file.pixels.colors != DICOMColors::None)
  {
    throw Problem(std::string("is a mosaic in colours; it must be grey") + WayOut);
  }
}

// Whether slices with positions of their own are tiles of the picture: by its ImageType, or by the
// private number of slices. A picture that was cut out of a mosaic keeps their positions.
bool isUnitedMosaic(
  const DICOMDataSet& set, bool isNamed, std::size_t slices, const glm::dvec2& tiles)
{
  const std::optional<DICOMTag> count = tagOf(set, UnitedCount);
  const double wanted = static_cast<double>(slices);
  const bool isCounted = count &&
    (decimalsOf(set, *count) == std::vector<double>{ wanted } ||
      wholeOf(set, *count, 0.0) == wanted);
  return isNamed || (isCounted && slices > 1 && hasRoomFor(tiles, set));
}

// Gives a tile the orientation that the picture and its slices have in common.
void orientTile(const DICOMDataSet& set, const std::vector<DICOMDataSet>& slices, DICOMFrame& tile,
  std::vector<std::string>& notes)
{
  constexpr double LeastCosine = 0.99999;
  tile.isPlaced = readOrientation(set, tile, notes);
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    DICOMFrame own;
    if (!readOrientation(slices[i], own, notes))
    {
      continue;
    }
    if (!tile.isPlaced)
    {
      tile.alongRow = own.alongRow;
      tile.alongColumn = own.alongColumn;
      tile.isPlaced = true;
    }
    if (!(glm::dot(own.alongRow, tile.alongRow) > LeastCosine &&
          glm::dot(own.alongColumn, tile.alongColumn) > LeastCosine))
    {
      throw Problem(joined("is a mosaic whose slice ", i + 1,
        " has another ImageOrientationPatient in (0065,xx51) than the picture or the slices before "
        "it; they must be the same",
        WayOut));
    }
  }
  if (!tile.isPlaced)
  {
    throw Problem(std::string("is a mosaic without ImageOrientationPatient") + WayOut);
  }
}

// Divides a mosaic of United Imaging, whose slices have a sequence of their own, with a
// position each. False if the file is none.
bool cutUnitedMosaic(const DICOMDataSet& set, DICOMFile& file)
{
  const std::optional<DICOMTag> tag = tagOf(set, UnitedSlices);
  const auto found = tag ? set.elements.find(*tag) : set.elements.end();
  const bool isNamed = plainText(textOf(set, ImageType)).find("VFRAME") != std::string::npos;
  if (found == set.elements.end() || found->second.items.empty())
  {
    throwIfAny(!isNamed ? ""
                        : std::string("is a mosaic of United Imaging (VFRAME) without the "
                                      "positions of its slices (the sequence (0065,xx51)), which "
                                      "anonymizers often remove") +
          WayOut);
    return false;
  }
  const std::vector<DICOMDataSet>& slices = found->second.items;
  const int count = static_cast<int>(slices.size());
  const int across = static_cast<int>(std::ceil(std::sqrt(count)));
  const glm::ivec2 tiles(across, (count + across - 1) / across);
  if (!isUnitedMosaic(set, isNamed, slices.size(), tiles))
  {
    return false;
  }
  if (file.frames.size() != 1 || file.columns % tiles.x != 0 || file.rows % tiles.y != 0 ||
    file.pixels.colors != DICOMColors::None)
  {
    throw Problem(joined("is a mosaic of ", count, " slices in ", file.frames.size(), " frames of ",
      file.columns, " x ", file.rows, " pixels; it must be one grey frame that ", tiles.x, " x ",
      tiles.y, " tiles divide", WayOut));
  }
  DICOMFrame tile = file.frames.front();
  tile.locationMm.reset();
  orientTile(set, slices, tile, file.notes);
  file.tiles = tiles;
  file.columns /= tiles.x;
  file.rows /= tiles.y;
  file.frames.clear();
  for (const DICOMDataSet& slice : slices)
  {
    const std::vector<double> place = decimalsOf(slice, ImagePosition);
    if (place.size() != 3)
    {
      throw Problem(joined("is a mosaic whose slice ", file.frames.size() + 1,
        " has no ImagePositionPatient in (0065,xx51)", WayOut));
    }
    tile.position = { place[0], place[1], place[2] };
    tile.frame = static_cast<int>(file.frames.size());
    file.frames.push_back(tile);
  }
  return true;
}
}

void cutMosaic(const DICOMDataSet& set, DICOMFile& file)
{
  if (cutUnitedMosaic(set, file))
  {
    return;
  }
  const double slices = countOfTiles(set);
  if (!isMosaic(set, slices))
  {
    if (const std::string note = noteOfMosaic(set); !note.empty())
    {
      addNote(file.notes, note);
    }
    return;
  }
  const int tiles = tilesAlong(slices, file);
  requireTiles(set, file, slices);
  DICOMFrame tile = file.frames.front();
  const glm::dvec3 step = stepOfTiles(set, tile);
  const int pictureColumns = file.columns;
  const int pictureRows = file.rows;
  file.tiles = glm::ivec2(tiles);
  file.columns /= tiles;
  file.rows /= tiles;
  // The position is that of a slice as large as the picture, with the centre of the first slice.
  tile.position += 0.5 * (pictureColumns - file.columns) * tile.spacingMm.x * tile.alongRow +
    0.5 * (pictureRows - file.rows) * tile.spacingMm.y * tile.alongColumn;
  tile.locationMm.reset();
  tile.sliceStepMm = tile.betweenSlicesMm = glm::length(step);
  tile.knowsStep = true;
  file.frames.clear();
  for (int i = 0; i < static_cast<int>(slices); ++i)
  {
    file.frames.push_back(tile);
    file.frames.back().frame = i;
    file.frames.back().position += static_cast<double>(i) * step;
  }
}
}
