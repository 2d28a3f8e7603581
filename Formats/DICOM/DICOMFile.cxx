// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMFile.h"

#include "Formats/DICOM/DICOMAttributes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <sstream>
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

using Items = std::vector<DICOMDataSet>;

constexpr double LargestCosineOfAxes = 1e-3; // headers with few digits stay below

// Rows come first in PixelSpacing.
void readSpacing(const DICOMDataSet& set, DICOMFrame& frame)
{
  constexpr DICOMTag pixelSpacing = 0x00280030;
  constexpr DICOMTag imagerSpacing = 0x00181164;
  std::vector<double> spacing = decimalsOf(set, pixelSpacing);
  spacing = spacing.size() == 2 ? spacing : decimalsOf(set, imagerSpacing);
  if (spacing.size() == 2)
  {
    frame.spacingMm = glm::dvec2(spacing[1], spacing[0]);
  }
  for (const DICOMTag tag : { 0x00180088, 0x00180050 }) // between slices, thickness
  {
    const double step = std::abs(decimalOf(set, tag, 0.0));
    if (step > 0.0)
    {
      frame.sliceStepMm = step;
      break;
    }
  }
}

bool readPosition(const DICOMDataSet& set, DICOMFrame& frame)
{
  const std::vector<double> position = decimalsOf(set, 0x00200032);
  if (position.size() == 3)
  {
    frame.position = glm::dvec3(position[0], position[1], position[2]);
  }
  return position.size() == 3;
}

bool readOrientation(const DICOMDataSet& set, DICOMFrame& frame)
{
  const std::vector<double> cosines = decimalsOf(set, 0x00200037);
  if (cosines.size() != 6)
  {
    return false;
  }
  const glm::dvec3 alongRow(cosines[0], cosines[1], cosines[2]);
  const glm::dvec3 alongColumn(cosines[3], cosines[4], cosines[5]);
  if (!(glm::length(alongRow) > 0.5 && glm::length(alongColumn) > 0.5))
  {
    return false;
  }
  frame.alongRow = glm::normalize(alongRow);
  frame.alongColumn = glm::normalize(alongColumn);
  return std::abs(glm::dot(frame.alongRow, frame.alongColumn)) < LargestCosineOfAxes;
}

// Whether an image says where it is.
bool readPlane(const DICOMDataSet& set, DICOMFrame& frame)
{
  const bool hasPosition = readPosition(set, frame);
  return readOrientation(set, frame) && hasPosition;
}

void readRescaling(const DICOMDataSet& set, DICOMFrame& frame)
{
  frame.rescaling.intercept = decimalOf(set, 0x00281052, frame.rescaling.intercept);
  const double slope = decimalOf(set, 0x00281053, frame.rescaling.slope);
  frame.rescaling.slope = slope != 0.0 ? slope : 1.0;
}

// A date and time in one text (VR DT): the offset from UTC at its end does not count.
double secondsOfMoment(const std::string& moment, double missing)
{
  return moment.size() < 10
    ? missing
    : secondsOf(moment.substr(0, 8), moment.substr(8, moment.find_first_of("+-") - 8), missing);
}

void readMoment(const DICOMDataSet& set, DICOMMoment& moment)
{
  moment.temporalPosition = decimalOf(set, 0x00200100, 0.0);
  moment.triggerMs = decimalOf(set, 0x00181060, 0.0);
  moment.echo = decimalOf(set, 0x00180086, 0.0);
  moment.bValue = doubleOf(set, 0x00189087, 0.0);
  moment.instance = decimalOf(set, 0x00200013, 0.0);
  moment.intervalS = 1e-3 * decimalOf(set, 0x00200110, decimalOf(set, 0x00180080, 0.0));
  moment.acquiredS = secondsOfMoment(textOf(set, 0x0008002a), -1.0);
  for (const DICOMTag time : { 0x00080032, 0x00080033 }) // acquisition, content
  {
    if (moment.acquiredS < 0.0)
    {
      const DICOMTag date = time - 0x10;
      moment.acquiredS = secondsOf(textOf(set, date), textOf(set, time), -1.0);
    }
  }
  moment.acquiredS = std::max(moment.acquiredS, 0.0);
}

// The functional groups of a multi-frame file: those of a frame, and those that all frames share.
class Groups
{
public:
  explicit Groups(const DICOMDataSet& set)
    : Shared(itemsOf(set, 0x52009229))
    , PerFrame(itemsOf(set, 0x52009230))
  {
  }

  std::size_t frames() const { return this->PerFrame.size(); }

  // Calls use(data set) with the item of a group, if the frame or all frames have that group.
  template <typename Use>
  void with(int frame, const DICOMTag group, const Use& use) const
  {
    if (!useFirst(this->PerFrame, frame, group, use))
    {
      useFirst(this->Shared, 0, group, use);
    }
  }

private:
  template <typename Use>
  static bool useFirst(const Items& items, int index, const DICOMTag group, const Use& use)
  {
    if (static_cast<std::size_t>(index) >= items.size())
    {
      return false;
    }
    const Items& inner = itemsOf(items[index], group);
    if (inner.empty())
    {
      return false;
    }
    use(inner.front());
    return true;
  }

  const Items& Shared;
  const Items& PerFrame;
};

void readFrameMoment(const Groups& groups, int index, DICOMMoment& moment)
{
  groups.with(index, 0x00209111, [&](const DICOMDataSet& content) {
    moment.temporalPosition = wholeOf(content, 0x00209128, 0.0);
    for (const DICOMTag tag : { 0x00189074, 0x00189151 })
    {
      const double acquired = secondsOfMoment(textOf(content, tag), -1.0);
      if (acquired >= 0.0)
      {
        moment.acquiredS = acquired;
        break;
      }
    }
  });
  groups.with(index, 0x00189112, [&](const DICOMDataSet& timing) {
    moment.intervalS = 1e-3 * decimalOf(timing, 0x00180080, 1e3 * moment.intervalS);
  });
  groups.with(index, 0x00189118,
    [&](const DICOMDataSet& heart) { moment.triggerMs = doubleOf(heart, 0x00209153, 0.0); });
  groups.with(index, 0x00189114,
    [&](const DICOMDataSet& echo) { moment.echo = doubleOf(echo, 0x00189082, 0.0); });
  groups.with(index, 0x00189117,
    [&](const DICOMDataSet& diffusion) { moment.bValue = doubleOf(diffusion, 0x00189087, 0.0); });
}

void readFrameType(const Groups& groups, int index, DICOMFrame& frame)
{
  // MR, CT, PET
  for (const DICOMTag group : { 0x00189226, 0x00189329, 0x00189751 })
  {
    groups.with(index, group, [&](const DICOMDataSet& set) {
      frame.type = textOf(set, 0x00089007);
      const std::string part = textOf(set, 0x00089208); // MAGNITUDE, PHASE
      frame.type += part.empty() ? part : "\\" + part;
    });
  }
}

void readFunctionalGroups(const Groups& groups, int index, DICOMFrame& frame)
{
  bool hasPosition = false;
  bool hasOrientation = false;
  groups.with(
    index, 0x00289110, [&](const DICOMDataSet& measures) { readSpacing(measures, frame); });
  groups.with(index, 0x00209113,
    [&](const DICOMDataSet& plane) { hasPosition = readPosition(plane, frame); });
  groups.with(index, 0x00209116,
    [&](const DICOMDataSet& plane) { hasOrientation = readOrientation(plane, frame); });
  groups.with(index, 0x00289145, [&](const DICOMDataSet& values) { readRescaling(values, frame); });
  frame.isPlaced = hasPosition && hasOrientation;
  readFrameMoment(groups, index, frame.moment);
  readFrameType(groups, index, frame);
}

// Frames of nuclear medicine may count rotations, phases or energies in place of slices.
void requireSlices(const DICOMDataSet& set)
{
  constexpr DICOMTag pointer = 0x00280009;
  constexpr DICOMTag slices = 0x00540080;
  constexpr DICOMTag offsets = 0x3004000c;
  const auto found = set.elements.find(pointer);
  if (found == set.elements.end())
  {
    return;
  }
  const std::vector<DICOMTag> tags = tagsOf(set, pointer);
  for (const DICOMTag tag : tags)
  {
    if (tag != slices && tag != offsets)
    {
      std::ostringstream text;
      text << "has frames that count something other than slices (FrameIncrementPointer "
           << std::hex << std::setfill('0') << std::setw(4) << (tag >> 16) << "," << std::setw(4)
           << (tag & 0xffff) << "), which BrainShift does not read";
      throw Problem(text.str());
    }
  }
}

// Doses place their frames by offsets along the normal, other old multi-frame files by a spacing.
void placeAlongNormal(const DICOMDataSet& set, std::vector<DICOMFrame>& frames)
{
  requireSlices(set);
  const std::vector<double> offsets = decimalsOf(set, 0x3004000c);
  const bool hasStep = set.elements.count(0x00180088) > 0;
  if (offsets.size() != frames.size() && !hasStep)
  {
    throw Problem("has " + std::to_string(frames.size()) + " frames but no positions of them");
  }
  const glm::dvec3 normal = glm::cross(frames.front().alongRow, frames.front().alongColumn);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const double offset = offsets.size() == frames.size()
      ? offsets[i] - offsets.front()
      : static_cast<double>(i) * frames[i].sliceStepMm;
    frames[i].position += offset * normal;
  }
}

// Appends the frames of a file. Throws the end of a sentence if they cannot be read.
void readDICOMFrames(const DICOMDataSet& set, int count, std::vector<DICOMFrame>& frames)
{
  DICOMFrame frame;
  frame.type = textOf(set, 0x00080008);
  readMoment(set, frame.moment);
  readSpacing(set, frame);
  frame.isPlaced = readPlane(set, frame);
  const Items& detectors = itemsOf(set, 0x00540022); // of nuclear medicine
  frame.isPlaced = frame.isPlaced || (!detectors.empty() && readPlane(detectors.front(), frame));
  readRescaling(set, frame);
  frame.rescaling.slope *= decimalOf(set, 0x3004000e, 1.0); // of a dose
  const Groups groups(set);
  if (groups.frames() != 0 && groups.frames() != static_cast<std::size_t>(count))
  {
    frames.assign(1, frame);
    throw Problem("announces " + std::to_string(count) + " frames and describes " +
      std::to_string(groups.frames()));
  }
  frames.assign(count, frame);
  for (int i = 0; i < count; ++i)
  {
    frames[i].frame = i;
    if (groups.frames() > 0)
    {
      readFunctionalGroups(groups, i, frames[i]);
    }
  }
  if (groups.frames() == 0 && count > 1)
  {
    placeAlongNormal(set, frames);
  }
}

void requirePixels(const DICOMDataSet& set, const DICOMFile& file)
{
  const double samples = wholeOf(set, 0x00280002, 1.0);
  const std::string colours = plainText(textOf(set, 0x00280004));
  const int bits = file.pixels.bitsAllocated;
  if (samples != 1.0 || (!colours.empty() && colours != "MONOCHROME2"))
  {
    throw Problem("has the photometric interpretation " + (colours.empty() ? "(none)" : colours) +
      " with " + std::to_string(static_cast<int>(samples)) +
      " samples per pixel; BrainShift reads MONOCHROME2 with 1 sample per pixel");
  }
  if (bits != 8 && bits != 16 && bits != 32)
  {
    throw Problem(
      "has " + std::to_string(bits) + " bits for each pixel; BrainShift reads 8, 16 and 32 bits");
  }
  if (file.pixels.bitsStored < 1 || file.pixels.highBit + 1 < file.pixels.bitsStored ||
    file.pixels.highBit >= bits)
  {
    throw Problem("stores " + std::to_string(file.pixels.bitsStored) + " bits up to bit " +
      std::to_string(file.pixels.highBit) + " of " + std::to_string(bits) + ", which cannot be");
  }
  const std::string type = plainText(textOf(set, 0x00080008));
  if (type.find("MOSAIC") != std::string::npos)
  {
    throw Problem("has the image type " + type +
      ": its slices are tiles of one picture; convert it with dcm2niix");
  }
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
  const double frames = decimalOf(set, 0x00280008, 1.0);
  if (rows < 1.0 || columns < 1.0 || rows > LongestSide || columns > LongestSide ||
    !(frames >= 1.0 && frames <= MostFrames))
  {
    return file; // a report, a plan or a directory
  }
  file.rows = static_cast<int>(rows);
  file.columns = static_cast<int>(columns);
  readPixelFormat(set, file.pixels);
  file.problem = problemOf([&] { requirePixels(set, file); });
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
  file.standsAlone = frames > 1.0 && Groups(set).frames() == 0;
  const std::string problem =
    problemOf([&] { readDICOMFrames(set, static_cast<int>(frames), file.frames); });
  file.problem = file.problem.empty() ? problem : file.problem;
  return file;
}
}
