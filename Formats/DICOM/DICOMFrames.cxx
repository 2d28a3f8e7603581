// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMFrames.h"

#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace brainshift
{
namespace
{
using Items = std::vector<DICOMDataSet>;
using Notes = std::vector<std::string>;

constexpr double LargestCosineOfAxes = 1e-3; // headers with few digits stay below
constexpr double LargestLengthError = 0.01;  // of a direction
constexpr DICOMTag RealWorldValues = 0x00409096;
constexpr const char* ParametricMapStorage = "1.2.840.10008.5.1.4.1.1.30";
constexpr DICOMName PixelMeasures{ 0x00289110, "PixelMeasuresSequence" };
constexpr DICOMName PlanePosition{ 0x00209113, "PlanePositionSequence" };
constexpr DICOMName PlaneOrientation{ 0x00209116, "PlaneOrientationSequence" };
constexpr DICOMName ValueTransformation{ 0x00289145, "PixelValueTransformationSequence" };
constexpr DICOMName SliceVector{ 0x00540080, "SliceVector" };
constexpr DICOMName FrameOffsets{ 0x3004000c, "GridFrameOffsetVector" };
constexpr DICOMName SliceSpacing{ 0x00180088, "SpacingBetweenSlices" };

// Two distances above 0: rows come first.
bool readSpacing(const DICOMDataSet& set, const DICOMName& name, DICOMFrame& frame)
{
  const std::vector<double> spacing = requiredDecimals(set, name, 2);
  if (spacing.size() != 2)
  {
    return false;
  }
  if (!(spacing[0] > 0.0 && spacing[1] > 0.0))
  {
    throw Problem(joined("has the ", name.keyword, " ", spacing[0], "\\", spacing[1],
      "; both numbers must be above 0 mm"));
  }
  frame.spacingMm = glm::dvec2(spacing[1], spacing[0]);
  return true;
}

// Whether the distances of pixels are there.
bool readMeasures(const DICOMDataSet& set, DICOMFrame& frame)
{
  frame.betweenSlicesMm = std::abs(decimalOf(set, 0x00180088, frame.betweenSlicesMm));
  for (const DICOMTag tag : { 0x00180088, 0x00180050 }) // between slices, thickness
  {
    const double step = std::abs(decimalOf(set, tag, 0.0));
    if (step > 0.0)
    {
      frame.sliceStepMm = step;
      frame.knowsStep = true;
      break;
    }
  }
  return readSpacing(set, { 0x00280030, "PixelSpacing" }, frame);
}

// What stands in for distances that a file does not have.
void guessSpacing(const DICOMDataSet& set, DICOMFrame& frame, Notes& notes)
{
  if (readSpacing(set, { 0x00181164, "ImagerPixelSpacing" }, frame))
  {
    addNote(notes,
      "has no PixelSpacing; the distances are those on the detector "
      "(ImagerPixelSpacing), which are larger than in the patient");
    return;
  }
  const bool hasRatio = readSpacing(set, { 0x00280034, "PixelAspectRatio" }, frame);
  frame.spacingMm = hasRatio ? frame.spacingMm / frame.spacingMm.x : glm::dvec2(1.0);
  addNote(notes,
    std::string("has no PixelSpacing; columns count as 1 mm apart") +
      (hasRatio ? ", rows by its PixelAspectRatio" : ", rows as well"));
}

bool readPosition(const DICOMDataSet& set, DICOMFrame& frame)
{
  const std::vector<double> position =
    requiredDecimals(set, { 0x00200032, "ImagePositionPatient" }, 3);
  if (position.size() == 3)
  {
    frame.position = glm::dvec3(position[0], position[1], position[2]);
  }
  return position.size() == 3;
}

// Whether an image says where it is.
bool readPlane(const DICOMDataSet& set, DICOMFrame& frame, Notes& notes)
{
  const bool hasPosition = readPosition(set, frame);
  return readOrientation(set, frame, notes) && hasPosition;
}

double requiredDecimal(const DICOMDataSet& set, const DICOMName& name, double missing)
{
  const std::vector<double> numbers = requiredDecimals(set, name, 1);
  return numbers.empty() ? missing : numbers.front();
}

void readRescaling(const DICOMDataSet& set, DICOMFrame& frame, Notes& notes)
{
  Rescaling& rescaling = frame.rescaling;
  rescaling.intercept =
    requiredDecimal(set, { 0x00281052, "RescaleIntercept" }, rescaling.intercept);
  const double slope = requiredDecimal(set, { 0x00281053, "RescaleSlope" }, rescaling.slope);
  rescaling.slope = slope != 0.0 ? slope : 1.0;
  if (slope == 0.0)
  {
    addNote(notes, "has the RescaleSlope 0, which counts as 1");
  }
  const std::string unit = textOf(set, 0x00281054); // RescaleType
  frame.quantity = unit.empty() ? frame.quantity : frame.quantity + "\\" + unit;
}

// Real values by another mapping than the one that is shown (RealWorldValueMappingSequence).
void noteRealValues(const DICOMDataSet& mapping, const Rescaling& shown, Notes& notes)
{
  constexpr DICOMTag table = 0x00409212;
  constexpr double rounding = 1e-9; // of 16 letters of a number
  const double slope = doubleOf(mapping, 0x00409225, 1.0);
  const double intercept = doubleOf(mapping, 0x00409224, 0.0);
  const Items& units = itemsOf(mapping, 0x004008ea);
  const std::string unit = units.empty() ? "" : shownWords(textOf(units.front(), 0x00080100));
  const std::string inUnit = unit.empty() || unit == "1" ? "" : " " + unit;
  const std::string end =
    " (RealWorldValueMappingSequence); those of RescaleSlope and RescaleIntercept are shown";
  if (mapping.elements.count(table) > 0)
  {
    addNote(
      notes, "has real values" + (inUnit.empty() ? "" : " in" + inUnit) + " in a table" + end);
  }
  else if (std::abs(slope - shown.slope) > rounding * std::abs(slope) ||
    std::abs(intercept - shown.intercept) > rounding * std::abs(intercept))
  {
    addNote(notes,
      joined("has real values of ", slope, " times the stored ones plus ", intercept, inUnit, end));
  }
}

// The real values of a parametric map: what its stored numbers mean, and in which unit.
void readRealValues(const DICOMDataSet& mapping, DICOMFrame& frame)
{
  if (mapping.elements.count(0x00409212) > 0)
  {
    throw Problem("has the real values of a parametric map in a table "
                  "(RealWorldValueLUTData); BrainShift reads RealWorldValueSlope and "
                  "RealWorldValueIntercept");
  }
  const double slope = doubleOf(mapping, 0x00409225, NAN);
  const double intercept = doubleOf(mapping, 0x00409224, NAN);
  if (!(std::isfinite(slope) && std::isfinite(intercept) && slope != 0.0))
  {
    throw Problem(joined("has real values of ", slope, " times the stored ones plus ", intercept,
      " (RealWorldValueMappingSequence); both must be numbers, and the slope not 0"));
  }
  frame.rescaling = { slope, intercept };
  const Items& units = itemsOf(mapping, 0x004008ea);
  frame.unit = units.empty() ? "" : shownWords(textOf(units.front(), 0x00080100));
  frame.unit = frame.unit == "1" ? "" : frame.unit;
  std::string label = shownWords(textOf(mapping, 0x00283003)); // LUTExplanation, LUTLabel
  label = label.empty() ? shownWords(textOf(mapping, 0x00409210)) : label;
  frame.measured = label + (label.empty() || frame.unit.empty() ? "" : " in ") + frame.unit;
  frame.quantity = label + "\\" + frame.unit;
}

// Of several mappings the first counts in a parametric map, and none in other images.
void readMappings(const Items& mappings, DICOMFrame& frame, Notes& notes)
{
  if (frame.isParametric && !mappings.empty())
  {
    readRealValues(mappings.front(), frame);
    if (mappings.size() > 1)
    {
      addNote(notes,
        joined("has ", mappings.size(),
          " mappings of real values for a frame "
          "(RealWorldValueMappingSequence); the first counts",
          frame.measured.empty() ? "" : ", " + frame.measured));
    }
    return;
  }
  for (const DICOMDataSet& mapping : mappings)
  {
    noteRealValues(mapping, frame.rescaling, notes);
  }
}

// The first number of an attribute that other images may be without.
double countedDecimal(const DICOMDataSet& set, const DICOMName& name, double missing, Notes& notes)
{
  std::vector<double> numbers;
  const std::string problem = problemOf([&] { numbers = requiredDecimals(set, name, 0); });
  if (!problem.empty())
  {
    addNote(notes, problem + ". It counts as " + numberText(missing));
  }
  return numbers.empty() ? missing : numbers.front();
}

// A time that a text says, with a note if it says none.
std::optional<double> toldSeconds(
  const std::optional<double>& seconds, const std::string& text, const char* keyword, Notes& notes)
{
  const std::string begin = joined("has the ", keyword, " ");
  const bool isSaid = std::any_of(notes.begin(), notes.end(),
    [&](const std::string& note) { return note.compare(0, begin.size(), begin) == 0; });
  if (!seconds && !text.empty() && !isSaid) // once, of many frames
  {
    addNote(notes, begin + plainText(text) + ", which is no time. It does not count");
  }
  return seconds;
}

void takeAcquired(double seconds, bool isContentTime, DICOMMoment& moment)
{
  moment.acquiredS = seconds;
  moment.isTimed = true;
  moment.isContentTime = isContentTime;
}

// Of the acquisition; if the file does not say it, of the image.
void readAcquired(const DICOMDataSet& set, DICOMMoment& moment, Notes& notes)
{
  const std::string text = textOf(set, 0x0008002a);
  const std::optional<double> told =
    toldSeconds(secondsOf(text), text, "AcquisitionDateTime", notes);
  Notes unused; // of what would not have counted
  const auto of = [&](DICOMTag dateTag, DICOMTag timeTag, const char* keyword, Notes& said) {
    const std::string date = textOf(set, dateTag);
    const std::string time = textOf(set, timeTag);
    const std::string both = time.empty() ? std::string() : date.empty() ? time : date + " " + time;
    return toldSeconds(secondsOf(date, time), both, keyword, said);
  };
  const std::optional<double> acquired =
    told ? told : of(0x00080022, 0x00080032, "AcquisitionTime", notes);
  const std::optional<double> content =
    of(0x00080023, 0x00080033, "ContentTime", acquired ? unused : notes);
  if (acquired || content)
  {
    takeAcquired(acquired ? *acquired : *content, !acquired, moment);
  }
  if (!dateOf(set, 0x00080023).empty())
  {
    moment.contentS = content.value_or(-1.0);
  }
}

void readMoment(const DICOMDataSet& set, DICOMMoment& moment, Notes& notes)
{
  const auto number = [&](DICOMTag tag, const char* keyword, double missing) {
    return countedDecimal(set, { tag, keyword }, missing, notes);
  };
  moment.temporalPosition = number(0x00200100, "TemporalPositionIdentifier", 0.0);
  moment.triggerMs = number(0x00181060, "TriggerTime", 0.0);
  moment.echo = number(0x00180086, "EchoNumbers", 0.0);
  moment.settings = { number(0x00180081, "EchoTime", 0.0), number(0x00180082, "InversionTime", 0.0),
    number(0x00181314, "FlipAngle", 0.0), number(0x00180060, "KVP", 0.0) };
  moment.bValue = doubleOf(set, 0x00189087, 0.0);
  moment.instance = number(0x00200013, "InstanceNumber", 0.0);
  moment.intervalS =
    1e-3 * number(0x00200110, "TemporalResolution", number(0x00180080, "RepetitionTime", 0.0));
  moment.referenceS = 1e-3 * number(0x00541300, "FrameReferenceTime", 0.0);
}

// The functional groups of a multi-frame file: those of a frame, and those that all frames share.
class Groups
{
public:
  explicit Groups(const DICOMDataSet& set)
    : Shared(itemsOf(set, SharedGroups))
    , PerFrame(itemsOf(set, FrameGroups))
  {
  }

  std::size_t frames() const { return this->PerFrame.size(); }

  // Calls use(data set) with the item of a group, if the frame or all frames have that group.
  template <typename Use>
  void with(int frame, const DICOMTag group, const Use& use) const
  {
    const DICOMDataSet* found = firstOf(this->PerFrame, frame, group);
    found = found ? found : firstOf(this->Shared, 0, group);
    if (found)
    {
      use(*found);
    }
  }

  // Items of a group of the frame, or else of all frames.
  const Items& itemsIn(int frame, const DICOMTag group) const
  {
    static const Items None;
    const bool isThere = static_cast<std::size_t>(frame) < this->PerFrame.size();
    const Items& own = isThere ? itemsOf(this->PerFrame[frame], group) : None;
    return own.empty() && !this->Shared.empty() ? itemsOf(this->Shared.front(), group) : own;
  }

  // Whether the frame and all frames have a group, and the two differ.
  bool areDifferent(int frame, const DICOMTag group) const
  {
    const DICOMDataSet* own = firstOf(this->PerFrame, frame, group);
    const DICOMDataSet* shared = firstOf(this->Shared, 0, group);
    return own && shared && !isSame(*own, *shared);
  }

private:
  static const DICOMDataSet* firstOf(const Items& items, int index, const DICOMTag group)
  {
    const bool isThere = static_cast<std::size_t>(index) < items.size();
    const Items* inner = isThere ? &itemsOf(items[index], group) : nullptr;
    return inner && !inner->empty() ? &inner->front() : nullptr;
  }

  const Items& Shared;
  const Items& PerFrame;
};

void readFrameMoment(const Groups& groups, int index, DICOMMoment& moment, Notes& notes)
{
  groups.with(index, 0x00209111, [&](const DICOMDataSet& content) {
    moment.temporalPosition = wholeOf(content, 0x00209128, 0.0);
    std::optional<double> acquired;
    for (const DICOMName& name : { DICOMName{ 0x00189074, "FrameAcquisitionDateTime" },
           DICOMName{ 0x00189151, "FrameReferenceDateTime" } })
    {
      const std::string text = acquired ? std::string() : textOf(content, name.tag);
      acquired = acquired ? acquired : toldSeconds(secondsOf(text), text, name.keyword, notes);
    }
    if (acquired)
    {
      takeAcquired(*acquired, false, moment);
      moment.isTimedByFrame = true;
    }
  });
  groups.with(index, 0x00209310,
    [&](const DICOMDataSet& time) { moment.offsetS = doubleOf(time, 0x0020930d, 0.0); });
  groups.with(index, 0x00189112, [&](const DICOMDataSet& timing) {
    moment.intervalS = 1e-3 *
      countedDecimal(timing, { 0x00180080, "RepetitionTime" }, 1e3 * moment.intervalS, notes);
    moment.settings[2] =
      countedDecimal(timing, { 0x00181314, "FlipAngle" }, moment.settings[2], notes);
  });
  groups.with(index, 0x00189118,
    [&](const DICOMDataSet& heart) { moment.triggerMs = doubleOf(heart, 0x00209153, 0.0); });
  groups.with(index, 0x00189114,
    [&](const DICOMDataSet& echo) { moment.settings[0] = doubleOf(echo, 0x00189082, 0.0); });
  groups.with(index, 0x00189115, [&](const DICOMDataSet& modifier) {
    moment.settings[1] = doubleOf(modifier, 0x00189079, moment.settings[1]);
  });
  groups.with(index, 0x00189325, [&](const DICOMDataSet& rays) {
    moment.settings[3] = countedDecimal(rays, { 0x00180060, "KVP" }, moment.settings[3], notes);
  });
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
  groups.with(index, 0x00209111,
    [&](const DICOMDataSet& content) { frame.stack = textOf(content, 0x00209056); });
}

// Whether the distances of pixels are there.
bool readFunctionalGroups(const Groups& groups, int index, DICOMFrame& frame, Notes& notes)
{
  bool isMeasured = false;
  bool hasPosition = false;
  bool hasOrientation = false;
  groups.with(index, PixelMeasures.tag,
    [&](const DICOMDataSet& measures) { isMeasured = readMeasures(measures, frame); });
  groups.with(index, PlanePosition.tag,
    [&](const DICOMDataSet& plane) { hasPosition = readPosition(plane, frame); });
  groups.with(index, PlaneOrientation.tag,
    [&](const DICOMDataSet& plane) { hasOrientation = readOrientation(plane, frame, notes); });
  groups.with(index, ValueTransformation.tag,
    [&](const DICOMDataSet& values) { readRescaling(values, frame, notes); });
  readMappings(groups.itemsIn(index, RealWorldValues), frame, notes);
  for (const DICOMName& name :
    { PixelMeasures, PlanePosition, PlaneOrientation, ValueTransformation })
  {
    if (groups.areDifferent(index, name.tag))
    {
      addNote(notes,
        std::string("has a ") + name.keyword +
          " for all frames and another one for single frames, which counts");
    }
  }
  frame.isPlaced = hasPosition && hasOrientation;
  readFrameMoment(groups, index, frame.moment, notes);
  readFrameType(groups, index, frame);
  groups.with(index, 0x0062000a, [&](const DICOMDataSet& segment) {
    frame.segment = static_cast<int>(std::min(wholeOf(segment, 0x0062000b, 0.0), 65536.0));
  });
  return isMeasured;
}

// What frames of old multi-frame files may count, apart from slices.
std::string keywordOf(DICOMTag tag)
{
  static const std::map<DICOMTag, std::string> Known{ { 0x00181063, "FrameTime" },
    { 0x00181065, "FrameTimeVector" }, { 0x00540010, "EnergyWindowVector" },
    { 0x00540020, "DetectorVector" }, { 0x00540030, "PhaseVector" },
    { 0x00540050, "RotationVector" }, { 0x00540060, "RRIntervalVector" },
    { 0x00540070, "TimeSlotVector" }, { 0x00540090, "AngularViewVector" },
    { 0x00540100, "TimeSliceVector" } };
  const auto found = Known.find(tag);
  std::ostringstream text;
  text << std::hex << (tag >> 16) << "," << (tag & 0xffff);
  return found == Known.end() ? "an attribute " + text.str() : found->second;
}

// Frames of nuclear medicine may count rotations, phases or energies in place of slices.
void requireSlices(const DICOMDataSet& set)
{
  const std::vector<DICOMTag> tags = tagsOf(set, 0x00280009);
  const auto isOfSlices = [](DICOMTag tag) {
    return tag == SliceVector.tag || tag == FrameOffsets.tag;
  };
  const bool hasSlices = tags.empty() || std::any_of(tags.begin(), tags.end(), isOfSlices);
  for (const DICOMTag tag : tags)
  {
    std::vector<int> counted = wholesOf(set, tag);
    std::sort(counted.begin(), counted.end());
    const bool isVector = tag >> 16 == 0x0054;
    const bool isOne = isVector && !counted.empty() && counted.front() == counted.back();
    if (!isOfSlices(tag) && !(isOne && hasSlices))
    {
      throw Problem("has frames that count something other than slices (FrameIncrementPointer: " +
        keywordOf(tag) + "), which BrainShift does not read");
    }
  }
}

// Where the frames of nuclear medicine lie, in steps from the first frame.
std::vector<double> stepsOfSlices(const DICOMDataSet& set, std::size_t count, Notes& notes)
{
  std::vector<double> steps;
  const std::vector<int> slices = wholesOf(set, SliceVector.tag);
  if (slices.empty())
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      steps.push_back(static_cast<double>(i));
    }
    return steps;
  }
  if (slices.size() != count || std::set<int>(slices.begin(), slices.end()).size() != count)
  {
    throw Problem(joined("has a SliceVector of ", slices.size(), " numbers for ", count,
      " frames; it must have another number for each frame"));
  }
  if (slices.front() != 1)
  {
    addNote(notes,
      joined("has slice ", slices.front(),
        " as its first frame (SliceVector); ImagePositionPatient counts as the position of this "
        "frame"));
  }
  for (const int slice : slices)
  {
    steps.push_back(slice - slices.front());
  }
  return steps;
}

// How far frames lie from the first one along the normal, mm: doses say it by offsets, other old
// multi-frame files by a spacing, whose sign says the direction.
std::vector<double> offsetsOfFrames(
  const DICOMDataSet& set, const std::vector<DICOMFrame>& frames, Notes& notes)
{
  std::vector<double> offsets = requiredDecimals(set, FrameOffsets, 0);
  if (!offsets.empty())
  {
    if (offsets.size() != frames.size())
    {
      throw Problem(joined("has a GridFrameOffsetVector of ", offsets.size(), " numbers for ",
        frames.size(), " frames"));
    }
    const double first = offsets.front();
    const DICOMFrame& frame = frames.front();
    if (first != 0.0 && !(glm::cross(frame.alongRow, frame.alongColumn).z > 0.999))
    {
      throw Problem(joined("has a GridFrameOffsetVector that begins with ", first,
        ": positions along z, which only frames in axial planes have; it must begin with 0"));
    }
    std::transform(
      offsets.begin(), offsets.end(), offsets.begin(), [first](double z) { return z - first; });
    return offsets;
  }
  const double step = requiredDecimal(set, SliceSpacing, 0.0);
  if (step == 0.0)
  {
    throw Problem("has " + std::to_string(frames.size()) +
      " frames but no positions of them, and no SpacingBetweenSlices other than 0");
  }
  offsets = stepsOfSlices(set, frames.size(), notes);
  std::transform(
    offsets.begin(), offsets.end(), offsets.begin(), [step](double count) { return count * step; });
  return offsets;
}

void placeAlongNormal(const DICOMDataSet& set, std::vector<DICOMFrame>& frames, Notes& notes)
{
  requireSlices(set);
  const std::vector<double> offsets = offsetsOfFrames(set, frames, notes);
  const glm::dvec3 normal = glm::cross(frames.front().alongRow, frames.front().alongColumn);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    frames[i].position += offsets[i] * normal;
  }
  // Without positions their order counts.
  std::stable_sort(
    frames.begin(), frames.end(), [&offsets](const DICOMFrame& a, const DICOMFrame& b) {
      return offsets[static_cast<std::size_t>(a.frame)] <
        offsets[static_cast<std::size_t>(b.frame)];
    });
}

// What all frames have in common.
bool readCommon(const DICOMDataSet& set, DICOMFrame& frame, Notes& notes)
{
  frame.type = textOf(set, 0x00080008);
  frame.quantity = textOf(set, 0x00541001); // Units of PET
  readMoment(set, frame.moment, notes);
  const std::vector<double> location = decimalsOf(set, 0x00201041);
  if (location.size() == 1)
  {
    frame.locationMm = location.front();
  }
  const bool isMeasured = readMeasures(set, frame);
  frame.isPlaced = readPlane(set, frame, notes);
  const Items& detectors = itemsOf(set, 0x00540022); // of nuclear medicine
  frame.isPlaced =
    frame.isPlaced || (!detectors.empty() && readPlane(detectors.front(), frame, notes));
  readRescaling(set, frame, notes);
  frame.isParametric = textOf(set, 0x00080016) == ParametricMapStorage;
  if (!frame.isParametric)
  {
    readMappings(itemsOf(set, RealWorldValues), frame, notes);
  }
  const double dose = requiredDecimal(set, { 0x3004000e, "DoseGridScaling" }, 1.0);
  if (dose == 0.0)
  {
    throw Problem("has the DoseGridScaling 0; it must be another number");
  }
  frame.rescaling.slope *= dose;
  return isMeasured;
}
}

void addNote(std::vector<std::string>& notes, const std::string& note)
{
  if (std::find(notes.begin(), notes.end(), note) == notes.end())
  {
    notes.push_back(note);
  }
}

bool describesFrames(const DICOMDataSet& set)
{
  return !itemsOf(set, FrameGroups).empty();
}

bool readOrientation(const DICOMDataSet& set, DICOMFrame& frame, Notes& notes)
{
  const std::vector<double> cosines =
    requiredDecimals(set, { 0x00200037, "ImageOrientationPatient" }, 6);
  if (cosines.size() != 6)
  {
    return false;
  }
  const glm::dvec3 alongRow(cosines[0], cosines[1], cosines[2]);
  const glm::dvec3 alongColumn(cosines[3], cosines[4], cosines[5]);
  const double lengths[] = { glm::length(alongRow), glm::length(alongColumn) };
  if (!(lengths[0] > 0.5 && lengths[1] > 0.5))
  {
    addNote(notes, "has an ImageOrientationPatient without directions, which does not count");
    return false;
  }
  if (std::abs(lengths[0] - 1.0) > LargestLengthError ||
    std::abs(lengths[1] - 1.0) > LargestLengthError)
  {
    addNote(notes,
      joined("has an ImageOrientationPatient whose directions are ", lengths[0], " and ",
        lengths[1], " long; they count as 1"));
  }
  frame.alongRow = alongRow / lengths[0];
  frame.alongColumn = alongColumn / lengths[1];
  const double cosine = glm::dot(frame.alongRow, frame.alongColumn);
  if (!(std::abs(cosine) < LargestCosineOfAxes))
  {
    addNote(notes,
      joined("has an ImageOrientationPatient whose directions are not perpendicular "
             "(cosine ",
        cosine, "), which does not count"));
    return false;
  }
  return true;
}

void readDICOMFrames(const DICOMDataSet& set, int count, std::vector<DICOMFrame>& frames,
  std::vector<std::string>& notes)
{
  frames.assign(1, DICOMFrame());
  DICOMFrame frame;
  const bool isMeasured = readCommon(set, frame, notes);
  const Groups groups(set);
  Notes notesOfTime; // for frames without a time of their own
  readAcquired(set, frame.moment, notesOfTime);
  if (groups.frames() != 0 && groups.frames() != static_cast<std::size_t>(count))
  {
    throw Problem("announces " + std::to_string(count) + " frames (NumberOfFrames) and describes " +
      std::to_string(groups.frames()));
  }
  std::vector<DICOMFrame> all(static_cast<std::size_t>(count), frame);
  for (int i = 0; i < count; ++i)
  {
    DICOMFrame& one = all[static_cast<std::size_t>(i)];
    one.frame = i;
    const bool hasOwn = groups.frames() > 0 && readFunctionalGroups(groups, i, one, notes);
    if (!one.moment.isTimedByFrame)
    {
      std::for_each(notesOfTime.begin(), notesOfTime.end(),
        [&](const std::string& note) { addNote(notes, note); });
    }
    if (!isMeasured && !hasOwn)
    {
      guessSpacing(set, one, notes);
    }
  }
  if (groups.frames() == 0 && count > 1)
  {
    placeAlongNormal(set, all, notes);
  }
  frames = std::move(all);
}
}
