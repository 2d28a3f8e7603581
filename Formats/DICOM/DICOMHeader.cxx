// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMHeader.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFrames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace brainshift
{
namespace
{
constexpr int LongestSide = 65535;  // VR US
constexpr int MostFrames = 1000000; // of one file; enhanced files have thousands
// Transfer syntaxes whose pixels are not packed. The third is big-endian, the fourth deflated.
const std::string Plain[] = { "1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2",
  "1.2.840.10008.1.2.1.99" };

std::string pixelProblem(const DICOMDataSet& set, const DICOMFile& file)
{
  const double samples = wholeOf(set, 0x00280002, 1.0);
  const std::string colours = plainText(textOf(set, 0x00280004));
  const int bits = file.pixels.bitsAllocated;
  if (samples != 1.0 || (!colours.empty() && colours != "MONOCHROME2"))
  {
    return "has the photometric interpretation " + (colours.empty() ? "(none)" : colours) +
      " with " + std::to_string(static_cast<int>(samples)) +
      " samples per pixel; BrainShift reads MONOCHROME2 with 1 sample per pixel";
  }
  if (bits != 8 && bits != 16 && bits != 32)
  {
    return "has " + std::to_string(bits) +
      " bits for each pixel; BrainShift reads 8, 16 and 32 bits";
  }
  if (file.pixels.bitsStored < 1 || file.pixels.highBit + 1 < file.pixels.bitsStored ||
    file.pixels.highBit >= bits)
  {
    return "stores " + std::to_string(file.pixels.bitsStored) + " bits up to bit " +
      std::to_string(file.pixels.highBit) + " of " + std::to_string(bits) + ", which cannot be";
  }
  const std::string type = plainText(textOf(set, 0x00080008));
  if (type.find("MOSAIC") != std::string::npos)
  {
    return "has the image type " + type +
      ": its slices are tiles of one picture; convert it with dcm2niix";
  }
  return {};
}

void readPixelFormat(const DICOMDataSet& set, DICOMPixelFormat& pixels)
{
  const auto whole = [&set](DICOMTag element, int missing) {
    return static_cast<int>(wholeOf(set, 0x00280000 | element, missing));
  };
  pixels.bitsAllocated = whole(0x0100, 0);
  pixels.bitsStored = whole(0x0101, pixels.bitsAllocated);
  pixels.highBit = whole(0x0102, pixels.bitsStored - 1);
  pixels.isSigned = whole(0x0103, 0) == 1;
}

std::string seriesDateOf(const DICOMDataSet& set)
{
  for (const DICOMTag tag : { 0x00080021, 0x00080022, 0x00080023, 0x00080020 }) // to study
  {
    const std::string date = dateOf(set, tag);
    if (!date.empty())
    {
      return date;
    }
  }
  return {};
}

void readFacts(const DICOMDataSet& set, DICOMFile& file)
{
  file.series = textOf(set, 0x0020000e);
  file.instance = textOf(set, 0x00080018);
  file.description = shownTextOf(set, 0x0008103e);
  file.modality = shownTextOf(set, 0x00080060);
  file.date = seriesDateOf(set);
  const double number = decimalOf(set, 0x00200011, 0.0);
  file.seriesNumber = std::abs(number) < 1e9 ? static_cast<int>(number) : 0;
}
}

DICOMFile readDICOMHeader(const std::string& path)
{
  DICOMFile file;
  file.path = path;
  DICOMBytes bytes(path, DICOMBytes::MostOfHeader);
  DICOMContent content;
  if (!parseDICOM(bytes, content))
  {
    file.isDamaged = true;
    return file;
  }
  const DICOMDataSet& set = content.set;
  const double rows = wholeOf(set, 0x00280010, 0.0);
  const double columns = wholeOf(set, 0x00280011, 0.0);
  const double frames = decimalOf(set, 0x00280008, 1.0);
  if (rows < 1.0 || columns < 1.0 || rows > LongestSide || columns > LongestSide ||
    !(frames >= 1.0 && frames <= MostFrames))
  {
    return file; // a report, a plan or a directory
  }
  file.rows = static_cast<int>(rows);
  file.columns = static_cast<int>(columns);
  readFacts(set, file);
  readPixelFormat(set, file.pixels);
  file.problem = pixelProblem(set, file);
  file.pixels.isPlain = !content.isPacked &&
    std::find(std::begin(Plain), std::end(Plain), content.transferSyntax) != std::end(Plain);
  file.pixels.isBigEndian = set.isBigEndian;
  file.pixels.isDeflated = content.transferSyntax == Plain[3];
  file.pixels.offset = content.pixelOffset;
  file.pixels.length = content.pixelLength;
  if (file.pixels.offset == 0 && file.problem.empty())
  {
    file.problem = "has no pixel data";
  }
  const std::string problem = readDICOMFrames(set, static_cast<int>(frames), file.frames);
  file.problem = file.problem.empty() ? problem : file.problem;
  return file;
}
}
