// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMColors.h"

#include "Common/Bytes.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFrames.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace brainshift
{
namespace
{
using Color = std::array<unsigned char, 3>;

constexpr const char* RunLengths = "1.2.840.10008.1.2.5";

// One column of a palette: red, green or blue.
std::vector<unsigned char> columnOf(const DICOMDataSet& set, int index, int& first)
{
  const std::vector<int> facts = wholesOf(set, 0x00281101 + static_cast<DICOMTag>(index));
  const DICOMTag table = 0x00281201 + static_cast<DICOMTag>(index);
  const auto found = set.elements.find(table);
  if (set.elements.count(table + 0x20) > 0)
  {
    const char* names[] = { "Red", "Green", "Blue" };
    throw Problem(joined("has a palette in segments (Segmented", names[index],
      "PaletteColorLookupTableData); BrainShift reads palettes that are tables"));
  }
  const std::string bytes = found == set.elements.end() ? std::string() : found->second.bytes;
  const std::size_t entries =
    facts.size() != 3 ? 0 : static_cast<std::size_t>(facts[0] == 0 ? 65536 : facts[0]);
  const bool areBytes = facts.size() == 3 && facts[2] == 8 && bytes.size() < 2 * entries;
  if (entries == 0 || (facts[2] != 8 && facts[2] != 16) ||
    bytes.size() < (areBytes ? entries : 2 * entries))
  {
    throw Problem(joined("has the PhotometricInterpretation PALETTE COLOR and a palette of ",
      entries, " colours in ", bytes.size(),
      " bytes (RedPaletteColorLookupTableDescriptor and so on); a colour needs 8 or 16 bits"));
  }
  first = facts[1];
  std::vector<unsigned char> column(entries);
  for (std::size_t i = 0; i < entries; ++i)
  {
    const int word = areBytes ? static_cast<unsigned char>(bytes[i])
                              : storedNumber<std::uint16_t>(&bytes[2 * i], set.isBigEndian);
    column[i] = static_cast<unsigned char>(facts[2] == 16 ? word >> 8 : word);
  }
  return column;
}

void readPalette(const DICOMDataSet& set, DICOMFile& file)
{
  std::array<int, 3> first{};
  const std::vector<unsigned char> columns[] = { columnOf(set, 0, first[0]),
    columnOf(set, 1, first[1]), columnOf(set, 2, first[2]) };
  if (columns[1].size() != columns[0].size() || columns[2].size() != columns[0].size() ||
    first[1] != first[0] || first[2] != first[0])
  {
    throw Problem("has palettes of red, green and blue with other numbers of colours or another "
                  "first number");
  }
  file.firstOfPalette = first[0];
  file.palette.resize(columns[0].size());
  for (std::size_t i = 0; i < file.palette.size(); ++i)
  {
    file.palette[i] = { columns[0][i], columns[1][i], columns[2][i] };
  }
}

constexpr DICOMTag SegmentSequence = 0x00620002;
constexpr DICOMTag SegmentNumber = 0x00620004;
constexpr DICOMTag RecommendedDisplayCIELabValue = 0x0062000d;

// Colours are bytes.
void requireBytes(const DICOMContent& content, const DICOMPixelFormat& pixels)
{
  if (pixels.bitsAllocated != 8 || pixels.bitsStored != 8 || pixels.highBit != 7 ||
    pixels.isSigned || pixels.isReal)
  {
    throw Problem(joined("has colours of ", pixels.bitsStored, " bits in ", pixels.bitsAllocated,
      pixels.isSigned ? " with a sign" : "", "; BrainShift reads 8 bits in 8, without a sign"));
  }
  if (content.isPacked && content.transferSyntax != RunLengths)
  {
    throw Problem("has colours packed in a way that BrainShift does not unpack for them (" +
      plainText(content.transferSyntax) +
      "); it reads plain ones and RLE. Unpack it, for example by gdcmconv --raw");
  }
}

unsigned char byteOf(double number)
{
  return static_cast<unsigned char>(std::lround(std::clamp(number, 0.0, 255.0)));
}

// PS3.3, C.7.6.3.1.2
Color rgbOfYbr(const Color& ybr)
{
  const double y = ybr[0];
  const double b = ybr[1] - 128.0;
  const double r = ybr[2] - 128.0;
  return { byteOf(y + 1.402 * r), byteOf(y - 0.344136 * b - 0.714136 * r), byteOf(y + 1.772 * b) };
}

// The entry of a number; those before and after the palette have its first and last colour.
const Color& paletteColor(const DICOMFile& file, int number)
{
  const int last = static_cast<int>(file.palette.size()) - 1;
  return file.palette[static_cast<std::size_t>(std::clamp(number - file.firstOfPalette, 0, last))];
}

Color colorAt(const DICOMFile& file, const unsigned char* stored, std::size_t i)
{
  const DICOMPixelFormat& pixels = file.pixels;
  if (pixels.colors == DICOMColors::Palette)
  {
    std::uint16_t number = stored[i];
    if (pixels.bitsAllocated == 16)
    {
      std::memcpy(&number, stored + 2 * i, 2);
    }
    const int mask = (1 << pixels.bitsStored) - 1;
    return paletteColor(file, number >> (pixels.highBit + 1 - pixels.bitsStored) & mask);
  }
  const auto count = static_cast<std::size_t>(file.rows) * static_cast<std::size_t>(file.columns);
  const std::size_t step = pixels.isPlanar ? count : 1;
  const unsigned char* first = stored + (pixels.isPlanar ? i : 3 * i);
  const Color color{ first[0], first[step], first[2 * step] };
  return pixels.colors == DICOMColors::YBR ? rgbOfYbr(color) : color;
}

// The palette of a map of labels colours those that have no colour of their own.
void colorLabels(const DICOMDataSet& set, DICOMFile& file)
{
  constexpr DICOMTag RedTable = 0x00281201;
  if (set.elements.count(RedTable) == 0 && set.elements.count(RedTable + 0x20) == 0)
  {
    return;
  }
  const std::string problem = problemOf([&] { readPalette(set, file); });
  if (!problem.empty())
  {
    addNote(file.notes, problem + ". Its labels have no colours of it");
    return;
  }
  std::set<int> colored;
  for (const DICOMDataSet& segment : itemsOf(set, SegmentSequence))
  {
    if (wholesOf(segment, RecommendedDisplayCIELabValue).size() == 3)
    {
      colored.insert(static_cast<int>(wholeOf(segment, SegmentNumber, 0.0)));
    }
  }
  for (Label& label : file.segments.labels)
  {
    const bool isColored = colored.count(label.value) > 0;
    label.color = isColored ? label.color : paletteColor(file, label.value);
  }
}
}

void readColors(const DICOMContent& content, DICOMFile& file)
{
  DICOMPixelFormat& pixels = file.pixels;
  const std::string colors = shownWords(textOf(content.set, 0x00280004));
  const double samples = wholeOf(content.set, 0x00280002, 1.0);
  if (file.segments.kind == SegmentKind::LabelMap && colors == "PALETTE COLOR")
  {
    colorLabels(content.set, file);
  }
  if (file.segments.kind != SegmentKind::None)
  {
    return;
  }
  if (colors == "PALETTE COLOR" && samples == 1.0)
  {
    pixels.colors = DICOMColors::Palette;
    if (pixels.isSigned || pixels.isReal || pixels.bitsAllocated > 16)
    {
      throw Problem(joined("has numbers of ", pixels.bitsAllocated, " bits",
        pixels.isSigned ? " with a sign" : "",
        " for a PALETTE COLOR; they must have 8 or 16, without a sign"));
    }
    readPalette(content.set, file);
  }
  else if (samples == 3.0 && (colors == "RGB" || colors == "YBR_FULL"))
  {
    pixels.colors = colors == "RGB" ? DICOMColors::RGB : DICOMColors::YBR;
    pixels.isPlanar =
      wholeOf(content.set, 0x00280006, 0.0) == 1.0 && content.transferSyntax != RunLengths;
    requireBytes(content, pixels);
  }
}

int bytesOfPixel(const DICOMPixelFormat& pixels)
{
  const bool areThree = pixels.colors == DICOMColors::RGB || pixels.colors == DICOMColors::YBR;
  return (areThree ? 3 : 1) * (pixels.bitsAllocated / 8);
}

int componentsOf(const DICOMPixelFormat& pixels)
{
  return pixels.colors == DICOMColors::None || pixels.asLuminance ? 1 : 3;
}

void paintColors(const DICOMFile& file, const unsigned char* stored, void* colors)
{
  auto* to = static_cast<unsigned char*>(colors);
  const auto count = static_cast<std::size_t>(file.rows) * static_cast<std::size_t>(file.columns);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Color color = colorAt(file, stored, i);
    if (file.pixels.asLuminance)
    {
      *to++ = byteOf(0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2]);
    }
    else
    {
      to = std::copy(color.begin(), color.end(), to);
    }
  }
}
}
