// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMFile.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMChecks.h"
#include "Formats/DICOM/DICOMColors.h"
#include "Formats/DICOM/DICOMFrames.h"
#include "Formats/DICOM/DICOMMosaic.h"
#include "Formats/DICOM/DICOMSegments.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace brainshift
{
namespace
{
constexpr int PreambleBytes = 128; // before the letters DICM

constexpr int LongestSide = 65535;  // VR US
constexpr int MostFrames = 1000000; // of one file; enhanced files have thousands
// Transfer syntaxes whose pixels are not packed. The third is big-endian, the fourth deflated.
const std::string Plain[] = { "1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2",
  "1.2.840.10008.1.2.1.99" };

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

// Where the bytes of pixels are, and their order.
void placePixels(const DICOMContent& content, DICOMPixelFormat& pixels)
{
  pixels.isPlain = !content.isPacked &&
    std::find(std::begin(Plain), std::end(Plain), content.transferSyntax) != std::end(Plain);
  pixels.isBigEndian = content.set.isBigEndian;
  pixels.areExchanged =
    content.set.isBigEndian && content.areWords && pixels.isPlain && pixels.bitsAllocated <= 8;
  pixels.isDeflated = content.transferSyntax == Plain[3];
  pixels.offset = content.pixelOffset;
  pixels.length = content.pixelLength;
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
  file.space = textOf(set, 0x00200052);
  file.sopClass = textOf(set, 0x00080016);
  file.description = shownTextOf(set, 0x0008103e);
  file.modality = shownTextOf(set, 0x00080060);
  file.date = seriesDateOf(set);
  const double number = decimalOf(set, 0x00200011, 0.0);
  file.seriesNumber = std::abs(number) < 1e9 ? static_cast<int>(number) : 0;
}
}

bool isDICOMFile(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) // a pipe would wait for ever
  {
    return false;
  }
  std::array<char, PreambleBytes + 4> begin{};
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(begin.data(), 8))
  {
    return false;
  }
  // Old files begin at once with an element of group 8 whose length follows.
  const bool isOld = begin[0] == 8 && begin[1] == 0 && begin[3] == 0 &&
    (begin[2] == 0 || begin[2] == 5 || begin[2] == 8 || begin[2] == 0x16);
  stream.read(begin.data() + 8, PreambleBytes - 4);
  return (stream && std::memcmp(begin.data() + PreambleBytes, "DICM", 4) == 0) || isOld;
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
  readFacts(set, file);
  const double rows = wholeOf(set, 0x00280010, 0.0);
  const double columns = wholeOf(set, 0x00280011, 0.0);
  double frames = 1.0;
  const std::string problemOfCount = problemOf([&] {
    const std::vector<double> count = requiredDecimals(set, { 0x00280008, "NumberOfFrames" }, 1);
    frames = count.empty() ? frames : count.front();
  });
  if (rows < 1.0 || columns < 1.0 || rows > LongestSide || columns > LongestSide ||
    !(frames >= 1.0 && frames <= MostFrames))
  {
    return file; // a report, a plan or a directory
  }
  file.rows = static_cast<int>(rows);
  file.columns = static_cast<int>(columns);
  readPixelFormat(set, file.pixels);
  file.pixels.isReal = content.areReal;
  file.problem = problemOf([&] {
    throwIfAny(problemOfCount);
    requireOnce(content.repeated);
    file.segments.kind = segmentKindOf(set);
    requirePixels(set, file.pixels, file.segments.kind);
    readSegments(set, file.segments);
    readColors(content, file);
  });
  placePixels(content, file.pixels);
  if (file.pixels.offset == 0 && file.problem.empty())
  {
    file.problem = "has no PixelData";
  }
  file.standsAlone =
    file.segments.kind != SegmentKind::None || (frames > 1.0 && !describesFrames(set));
  file.smallIsBright = textOf(set, 0x00280004) == "MONOCHROME1" ||
    (textOf(set, 0x00280004) == "MONOCHROME2" && textOf(set, 0x20500020) == "INVERSE");
  const std::vector<std::string> notes = notesOf(set, file);
  file.notes.insert(file.notes.end(), notes.begin(), notes.end());
  const std::string problem = problemOf([&] {
    readDICOMFrames(set, static_cast<int>(frames), file.frames, file.notes);
    cutMosaic(set, file);
  });
  file.problem = file.problem.empty() ? problem : file.problem;
  if (file.problem.empty())
  {
    file.problem = problemOf([&] { requireSegments(file); });
  }
  return file;
}
}
