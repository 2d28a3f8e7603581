// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMSegments.h"

#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMStack.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* SegmentationStorage = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr const char* LabelMapStorage = "1.2.840.10008.5.1.4.1.1.66.7";
constexpr DICOMTag SegmentSequence = 0x00620002;
constexpr int MostSlices = 65535;
constexpr double MostFramePixels = 1 << 26; // 8192 x 8192
// A frame that is farther from its slice, or from its neighbours in the plane, is on no grid.
constexpr double LargestShiftSteps = 0.1;

// A coded term as 3D Slicer writes it: scheme^code^meaning.
std::string termOf(const DICOMDataSet& code, const std::string& characters)
{
  std::string term;
  for (const DICOMTag tag : { 0x00080102, 0x00080100, 0x00080104 })
  {
    std::string word = shownTextOf(code, tag, characters);
    std::replace_if(word.begin(), word.end(), [](char c) { return c == '^' || c == '~'; }, ' ');
    term += (tag == 0x00080102 ? "" : "^") + word;
  }
  return term;
}

// The terms of a segment: category, type, and the type's modifier; and the anatomic region with its
// modifier where one is named.
std::string termsOf(const DICOMDataSet& segment, const std::string& characters)
{
  static const DICOMDataSet None;
  const auto firstOf = [](const DICOMDataSet& set, DICOMTag sequence) -> const DICOMDataSet& {
    const auto& items = itemsOf(set, sequence);
    return items.empty() ? None : items.front();
  };
  const DICOMDataSet& type = firstOf(segment, 0x0062000f);
  const DICOMDataSet& region = firstOf(segment, 0x00082218);
  const std::string terms = termOf(firstOf(segment, 0x00620003), characters) + "~" +
    termOf(type, characters) + "~" + termOf(firstOf(type, 0x00620011), characters);
  const std::string where =
    "~" + termOf(region, characters) + "~" + termOf(firstOf(region, 0x00082220), characters);
  const std::string all = where == "~^^~^^" ? terms : terms + where;
  return all == "^^~^^~^^" ? "" : all;
}

Label labelOf(const DICOMDataSet& segment, const std::string& characters)
{
  Label label;
  const double number = wholeOf(segment, 0x00620004, 0.0);
  if (number < 0.0 || number > 65535.0)
  {
    throw Problem(joined("has a segment with the number ", number, "; it must be up to 65535"));
  }
  label.value = static_cast<int>(number);
  label.name = shownTextOf(segment, 0x00620005, characters);
  label.name = label.name.empty() ? "Segment " + std::to_string(label.value) : label.name;
  const std::vector<int> lab = wholesOf(segment, 0x0062000d);
  label.color = lab.size() == 3 ? rgbOfLab({ lab[0], lab[1], lab[2] }) : label.color;
  label.terms = termsOf(segment, characters);
  return label;
}

// How far the corners of two frames are apart at most, if their first pixels are at one place, mm.
double cornersApart(const DICOMFile& file, const DICOMFrame& a, const DICOMFrame& b)
{
  const auto along = [](const glm::dvec3& unit, double step) { return step * unit; };
  const glm::dvec3 rows = along(a.alongRow, a.spacingMm.x) - along(b.alongRow, b.spacingMm.x);
  const glm::dvec3 columns =
    along(a.alongColumn, a.spacingMm.y) - along(b.alongColumn, b.spacingMm.y);
  return glm::length(rows) * file.columns + glm::length(columns) * file.rows;
}

std::string frameName(std::size_t frame)
{
  return "frame " + std::to_string(frame + 1);
}

// Frames of one orientation and size, each above the others.
void requireAligned(const DICOMFile& file, DICOMSegmentGrid& grid)
{
  const DICOMFrame& first = file.frames.front();
  const glm::dvec3 normal = glm::normalize(glm::cross(first.alongRow, first.alongColumn));
  double largestMm = 0.0;
  if (std::none_of(file.frames.begin(), file.frames.end(),
        [](const DICOMFrame& frame) { return frame.isPlaced; }))
  {
    throw Problem("is a segmentation of a picture that has no position in the patient, such as an "
                  "X-ray. Open it in the program that made it");
  }
  for (std::size_t i = 0; i < file.frames.size(); ++i)
  {
    const DICOMFrame& frame = file.frames[i];
    if (!frame.isPlaced)
    {
      throw Problem("has frames of segments without a position in the patient "
                    "(PlanePositionSequence, PlaneOrientationSequence), such as " +
        frameName(i) + "; BrainShift needs it to place them");
    }
    const double apartMm = cornersApart(file, first, frame);
    if (!(apartMm <= LargestUnreportedShiftMm))
    {
      throw Problem(joined("has segments in frames of several orientations or pixel distances: ",
        "the corners of ", frameName(i), " are ", roundedText(apartMm),
        " mm from those of a frame like the first; it may be ", LargestUnreportedShiftMm,
        " mm. Save each orientation as a segmentation of its own"));
    }
    const glm::dvec3 away = frame.position - first.position;
    const double asideMm = glm::length(away - glm::dot(away, normal) * normal);
    if (!(asideMm <= LargestShiftSteps * std::min(first.spacingMm.x, first.spacingMm.y)))
    {
      throw Problem(joined("has segments in frames that are not above each other: ", frameName(i),
        " is ", roundedText(asideMm), " mm beside the normal of the first, of ", LargestShiftSteps,
        " pixels that it may be. Resample the segmentation on an upright grid"));
    }
    largestMm = std::max(largestMm, asideMm);
  }
  if (largestMm > LargestUnreportedShiftMm)
  {
    grid.warnings.push_back(joined("has frames of segments that are up to ", roundedText(largestMm),
      " mm beside the normal of the first; they are shown above each other"));
  }
}

// How far the places are at most from whole steps, in steps; the range is a whole number of them.
// Infinite if a step is no distance of them. `step` becomes the one that fits best.
double misfitOf(const std::vector<double>& placesMm, double& step)
{
  double steps = 0.0;
  for (std::size_t i = 1; i < placesMm.size(); ++i)
  {
    steps += std::round((placesMm[i] - placesMm[i - 1]) / step);
  }
  const double range = placesMm.back() - placesMm.front();
  const double fitted = range / steps;
  double misfit = steps >= 1.0 ? 0.0 : HUGE_VAL;
  double last = -1.0;
  for (const double place : placesMm)
  {
    const double index = (place - placesMm.front()) / fitted;
    const bool isAlone = std::round(index) > last;
    last = std::round(index);
    misfit = isAlone ? std::max(misfit, std::abs(index - last)) : HUGE_VAL;
  }
  step = fitted;
  return misfit;
}

double leastGap(const std::vector<double>& placesMm)
{
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < placesMm.size(); ++i)
  {
    least = std::min(least, placesMm[i] - placesMm[i - 1]);
  }
  return least;
}

// The distance of slices: that of the header if the frames are on it, else the least of frames.
double stepOf(const DICOMFrame& first, const std::vector<double>& placesMm, DICOMSegmentGrid& grid)
{
  if (placesMm.size() == 1)
  {
    if (!first.knowsStep)
    {
      grid.warnings.emplace_back("has one slice and neither SpacingBetweenSlices nor "
                                 "SliceThickness; it counts as 1 mm thick");
    }
    return first.sliceStepMm;
  }
  const double leastMm = leastGap(placesMm);
  const double between = first.betweenSlicesMm;
  double bestMisfit = HUGE_VAL;
  for (double step : { between, leastMm, first.sliceStepMm })
  {
    const double misfit = step > 0.0 ? misfitOf(placesMm, step) : HUGE_VAL;
    bestMisfit = std::min(bestMisfit, misfit);
    if (!(misfit <= LargestShiftSteps))
    {
      continue;
    }
    if (leastMm > 1.5 * step)
    {
      grid.warnings.push_back(joined("has frames of segments that are at least ",
        roundedText(leastMm), " mm apart and slices of ", roundedText(step),
        " mm (SpacingBetweenSlices or SliceThickness), which count: those between have no frame"));
    }
    if (!(between > 0.0) && first.knowsStep && step > 1.5 * first.sliceStepMm)
    {
      grid.warnings.push_back(
        joined("has frames of segments ", roundedText(step), " mm apart, a SliceThickness of ",
          roundedText(first.sliceStepMm), " mm and no SpacingBetweenSlices; each counts as ",
          roundedText(step), " mm thick, too much if slices between them are empty"));
    }
    if (misfit * step > LargestUnreportedShiftMm)
    {
      grid.warnings.push_back(joined("has frames of segments up to ", roundedText(misfit * step),
        " mm from even slices, where they are shown"));
    }
    return step;
  }
  throw Problem(joined("has segments in frames that are on no even grid: they are at least ",
    roundedText(leastMm), " mm apart, and one is ",
    bestMisfit < HUGE_VAL ? roundedText(bestMisfit) : std::string("more than 1"),
    " slices from its place, of ", LargestShiftSteps,
    " that it may be. Resample the segmentation on even slices"));
}

void requireOneFrameEach(const DICOMFile& file, const DICOMSegmentGrid& grid)
{
  std::set<std::pair<int, int>> known;
  for (std::size_t i = 0; i < file.frames.size(); ++i)
  {
    const int segment = file.frames[i].segment;
    if (!known.insert({ grid.sliceOfFrame[i], segment }).second)
    {
      const std::string what =
        segment == 0 ? std::string("two frames") : joined("two frames of segment ", segment);
      throw Problem("has " + what + " at one position (" + frameName(i) +
        " is the second); BrainShift reads one, without times. Save one time alone");
    }
  }
}

// sRGB from linear light, both from 0 to 1, and back.
double encoded(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

double linear(double code)
{
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

const glm::dvec3 White(0.950456, 1.0, 1.088754); // D65

// Columns: red, green, blue.
const glm::dmat3 XYZFromLight(glm::dvec3(0.4124564, 0.2126729, 0.0193339),
  glm::dvec3(0.3575761, 0.7151522, 0.1191920), glm::dvec3(0.1804375, 0.0721750, 0.9503041));

constexpr double Knee = 6.0 / 29.0; // of the cube root of CIELab
}

std::array<unsigned char, 3> rgbOfLab(const std::array<int, 3>& lab)
{
  const double full = 65535.0;
  const double y = (100.0 * lab[0] / full + 16.0) / 116.0;
  const glm::dvec3 roots(
    y + (255.0 * lab[1] / full - 128.0) / 500.0, y, y - (255.0 * lab[2] / full - 128.0) / 200.0);
  glm::dvec3 xyz;
  for (int i = 0; i < 3; ++i)
  {
    const double t = roots[i];
    xyz[i] = White[i] * (t > Knee ? t * t * t : 3.0 * Knee * Knee * (t - 4.0 / 29.0));
  }
  const glm::dvec3 light = glm::inverse(XYZFromLight) * xyz;
  std::array<unsigned char, 3> rgb{};
  for (int i = 0; i < 3; ++i)
  {
    rgb[static_cast<std::size_t>(i)] =
      static_cast<unsigned char>(std::lround(255.0 * encoded(glm::clamp(light[i], 0.0, 1.0))));
  }
  return rgb;
}

std::array<int, 3> labOfRgb(const std::array<unsigned char, 3>& rgb)
{
  const glm::dvec3 light(linear(rgb[0] / 255.0), linear(rgb[1] / 255.0), linear(rgb[2] / 255.0));
  const glm::dvec3 xyz = XYZFromLight * light / White;
  glm::dvec3 roots;
  for (int i = 0; i < 3; ++i)
  {
    const double t = xyz[i];
    roots[i] = t > Knee * Knee * Knee ? std::cbrt(t) : t / (3.0 * Knee * Knee) + 4.0 / 29.0;
  }
  const double numbers[] = { (116.0 * roots.y - 16.0) / 100.0,
    (500.0 * (roots.x - roots.y) + 128.0) / 255.0, (200.0 * (roots.y - roots.z) + 128.0) / 255.0 };
  std::array<int, 3> lab{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    lab[i] = static_cast<int>(std::lround(65535.0 * glm::clamp(numbers[i], 0.0, 1.0)));
  }
  return lab;
}

SegmentKind segmentKindOf(const DICOMDataSet& set)
{
  const std::string storage = textOf(set, 0x00080016);
  if (storage != SegmentationStorage && storage != LabelMapStorage)
  {
    return SegmentKind::None;
  }
  const std::string type = textOf(set, 0x00620001);
  if (type != "BINARY" && type != "FRACTIONAL" && type != "LABELMAP")
  {
    throw Problem("has the SegmentationType '" + shownWords(type) +
      "'; it must be BINARY, FRACTIONAL or LABELMAP");
  }
  return type == "BINARY" ? SegmentKind::Binary
    : type == "LABELMAP"  ? SegmentKind::LabelMap
                          : SegmentKind::Fractional;
}

void readSegments(const DICOMDataSet& set, DICOMSegments& segments)
{
  if (segments.kind == SegmentKind::None)
  {
    return;
  }
  if (wholeOf(set, 0x00209162, 0.0) > 1.0 || wholeOf(set, 0x00209163, 0.0) > 1.0)
  {
    throw Problem(joined("is part ", wholeOf(set, 0x00209162, 0.0), " of a segmentation in ",
      wholeOf(set, 0x00209163, 0.0),
      " files (InConcatenationNumber); BrainShift reads segmentations of one file. Join them"));
  }
  const std::string characters = charactersOf(set);
  std::set<int> numbers;
  for (const DICOMDataSet& item : itemsOf(set, SegmentSequence))
  {
    const Label label = labelOf(item, characters);
    if (label.value == 0 && segments.kind != SegmentKind::LabelMap)
    {
      throw Problem("has a segment without a number (SegmentNumber) in its SegmentSequence");
    }
    if (!numbers.insert(label.value).second)
    {
      throw Problem(joined("has two segments with the number ", label.value, " (SegmentNumber)"));
    }
    segments.labels.push_back(label);
  }
  if (segments.kind == SegmentKind::Fractional)
  {
    const double most = wholeOf(set, 0x0062000e, 0.0);
    if (!(most >= 1.0 && most <= 255.0))
    {
      throw Problem(joined(
        "has fractions up to ", most, " (MaximumFractionalValue); it must be from 1 to 255"));
    }
    segments.most = static_cast<int>(most);
  }
  if (segments.kind == SegmentKind::LabelMap)
  {
    const double background = wholeOf(set, 0x00280120, 0.0); // PixelPaddingValue
    const double most = wholeOf(set, 0x00280100, 8.0) > 8.0 ? 65535.0 : 255.0;
    if (!(background >= 0.0 && background <= most))
    {
      throw Problem(joined(
        "has the PixelPaddingValue ", background, " among labels; it must be from 0 to ", most));
    }
    segments.background = static_cast<int>(background);
  }
}

void requireSegments(const DICOMFile& file)
{
  const DICOMSegments& segments = file.segments;
  if (segments.kind == SegmentKind::None)
  {
    return;
  }
  if (static_cast<double>(file.rows) * file.columns > MostFramePixels)
  {
    throw Problem(joined("has segments in frames of ", file.columns, " x ", file.rows,
      " pixels; BrainShift reads as many as 8192 x 8192 have"));
  }
  if (segments.kind == SegmentKind::LabelMap)
  {
    return; // its pixels name the segments
  }
  for (std::size_t i = 0; i < file.frames.size(); ++i)
  {
    const int number = file.frames[i].segment;
    const bool isKnown = std::any_of(segments.labels.begin(), segments.labels.end(),
      [number](const Label& label) { return label.value == number; });
    if (!isKnown)
    {
      throw Problem(joined("has a frame of segment ", number, " (ReferencedSegmentNumber of ",
        frameName(i), "), which is none of the ", segments.labels.size(),
        " that its SegmentSequence describes"));
    }
  }
}

DICOMSegmentGrid segmentGridOf(const DICOMFile& file)
{
  DICOMSegmentGrid grid;
  requireAligned(file, grid);
  const DICOMFrame& first = file.frames.front();
  const glm::dvec3 normal = glm::normalize(glm::cross(first.alongRow, first.alongColumn));
  const std::vector<double> placesMm = placesOf(file.frames);
  const double step = stepOf(first, placesMm, grid);
  const double slices = std::round((placesMm.back() - placesMm.front()) / step) + 1.0;
  if (!(slices <= MostSlices))
  {
    throw Problem(joined("has frames of segments over ", slices, " slices of ", roundedText(step),
      " mm; it may have ", MostSlices));
  }
  grid.slices = static_cast<int>(slices);
  glm::dvec3 origin = first.position;
  for (const DICOMFrame& frame : file.frames)
  {
    const double height = glm::dot(frame.position, normal) - placesMm.front();
    const int slice = static_cast<int>(std::lround(height / step));
    grid.sliceOfFrame.push_back(std::clamp(slice, 0, grid.slices - 1));
    origin =
      slice == 0 && glm::dot(origin - frame.position, normal) > 0.0 ? frame.position : origin;
  }
  requireOneFrameEach(file, grid);
  const auto ras = [](const glm::dvec3& lps) { return glm::dvec3(-lps.x, -lps.y, lps.z); };
  grid.worldFromVoxel[0] = glm::dvec4(ras(first.spacingMm.x * first.alongRow), 0.0);
  grid.worldFromVoxel[1] = glm::dvec4(ras(first.spacingMm.y * first.alongColumn), 0.0);
  grid.worldFromVoxel[2] = glm::dvec4(ras(step * normal), 0.0);
  grid.worldFromVoxel[3] = glm::dvec4(ras(origin), 1.0);
  return grid;
}
}
