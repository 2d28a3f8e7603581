// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DerivedSegments.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFolder.h"
#include "Formats/DICOM/DICOMSegments.h"
#include "Formats/DICOM/DerivedHeader.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* SegmentationStorage = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr int HighestLabel = 65535;     // VR US
constexpr std::size_t LongestCode = 16; // of VR SH
constexpr double SamePlaceMm = 0.01;    // of a frame and an image of the scan
constexpr double SameDirection = 1e-4;  // sine between them
constexpr DICOMTag CharacterSet = 0x00080005;

// Frames: axes of the volume that run along their rows, their columns, and from one to the next.
struct Frames
{
  Grid grid;                      // mm, LPS
  std::array<int, 3> axis{};      // of the volume
  std::array<bool, 3> reversed{}; // whether they run against it
  glm::ivec3 sides{ 0 };          // columns, rows, slices

  glm::dvec3 direction(int k) const
  {
    return (this->reversed[k] ? -1.0 : 1.0) * this->grid.direction[this->axis[k]];
  }
  double spacing(int k) const { return this->grid.spacing[this->axis[k]]; }

  glm::ivec3 voxel(const glm::ivec3& at) const
  {
    glm::ivec3 index(0);
    for (int k = 0; k < 3; ++k)
    {
      index[this->axis[k]] = this->reversed[k] ? this->sides[k] - 1 - at[k] : at[k];
    }
    return index;
  }

  // The first pixel of a slice.
  glm::dvec3 position(int slice) const
  {
    return this->grid.worldFromGrid(glm::dvec3(this->voxel({ 0, 0, slice })));
  }
};

// One image of the scan.
struct Source
{
  std::string storage;
  std::string instance;
  int frame = 0;       // from 1 on; 0: the file has one
  bool isTile = false; // of a mosaic: not where the file says that its picture lies
  glm::dvec3 position{ 0.0 };
  glm::dvec3 alongRow{ 1.0, 0.0, 0.0 };
  glm::dvec3 alongColumn{ 0.0, 1.0, 0.0 };
};

// The images of the scan's series that `like` leads to.
std::vector<Source> sourcesOf(const std::string& like, const DICOMDataSet& header)
{
  std::vector<Source> sources;
  const std::string series = textOf(header, 0x0020000e);
  const DICOMFolder folder = readDICOMFolder(like, [](double) { return true; });
  for (const DICOMFile& file : folder.files)
  {
    const bool isOfSeries = !series.empty() && file.series == series && !file.sopClass.empty() &&
      !file.instance.empty() && file.segments.kind == SegmentKind::None;
    const bool isMosaic = file.tiles != glm::ivec2(1);
    for (const DICOMFrame& frame : isOfSeries ? file.frames : std::vector<DICOMFrame>())
    {
      if (frame.isPlaced)
      {
        sources.push_back(
          { file.sopClass, file.instance, file.frames.size() > 1 && !isMosaic ? frame.frame + 1 : 0,
            isMosaic, frame.position, frame.alongRow, frame.alongColumn });
      }
    }
  }
  return sources;
}

// Lays frames in the planes of the scan, or in axial ones.
Frames framesOf(const OutgoingVolume& volume, const std::vector<Source>& sources)
{
  Frames frames;
  frames.grid = withReversedXY(volume.grid);
  const Source plane = sources.empty() ? Source() : sources.front();
  const glm::dvec3 wanted[] = { plane.alongRow, plane.alongColumn,
    glm::cross(plane.alongRow, plane.alongColumn) };
  std::set<int> taken;
  for (int k = 0; k < 3; ++k)
  {
    double most = -1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double cosine = glm::dot(frames.grid.direction[axis], wanted[k]);
      if (taken.count(axis) == 0 && std::abs(cosine) > most)
      {
        most = std::abs(cosine);
        frames.axis[k] = axis;
        frames.reversed[k] = cosine < 0.0;
      }
    }
    taken.insert(frames.axis[k]);
    frames.sides[k] = frames.grid.dimensions[frames.axis[k]];
  }
  return frames;
}

void requireLabels(const OutgoingVolume& volume)
{
  if (!volume.knowsSides)
  {
    throw Problem("The world axes of the input are unknown, and a segmentation needs them; set "
                  "World to RAS or LPS if you know them");
  }
  if (volume.components() != 1)
  {
    throw Problem(joined("The input has ", volume.components(),
      " components at each voxel; a segmentation must have 1"));
  }
  double most = 0.0;
  for (vtkIdType i = 0; i < volume.numbers->GetNumberOfTuples(); ++i)
  {
    const double value = volume.numbers->GetComponent(i, 0);
    if (!(value >= 0.0 && value <= HighestLabel && value == std::floor(value)))
    {
      throw Problem(joined("The input has the value ", value,
        "; labels of a segmentation are whole numbers from 0 to ", HighestLabel,
        ". Threshold it before"));
    }
    most = std::max(most, value);
  }
  if (most == 0.0)
  {
    throw Problem("The input has no voxel above 0; a segmentation must have one");
  }
}

// Labels by their values: those of the table above 0, and others that voxels have.
std::map<int, Label> labelsOf(const OutgoingSegments& segments)
{
  std::map<int, Label> labels;
  for (const Label& label : segments.labels)
  {
    if (label.value > 0 && label.value <= HighestLabel)
    {
      labels[label.value] = label;
    }
  }
  for (vtkIdType i = 0; i < segments.volume.numbers->GetNumberOfTuples(); ++i)
  {
    const int value = static_cast<int>(segments.volume.numbers->GetComponent(i, 0));
    if (value > 0 && labels.count(value) == 0)
    {
      Label label;
      label.value = value;
      label.name = "Label " + std::to_string(value);
      labels[value] = label;
    }
  }
  return labels;
}

DerivedSet codeOf(const std::string& scheme, const std::string& code, const std::string& meaning)
{
  DerivedSet set;
  setText(set, 0x00080100, "SH", code);
  setText(set, 0x00080102, "SH", scheme);
  setText(set, 0x00080104, "LO", meaning);
  return set;
}

std::vector<std::string> partsOf(const std::string& text, char between)
{
  std::vector<std::string> parts(1);
  for (const char letter : text)
  {
    if (letter == between)
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += letter;
    }
  }
  return parts;
}

// A term of a label, as "scheme^code^meaning". None if a word is missing or too long.
std::vector<DerivedSet> termOf(const std::string& term)
{
  const std::vector<std::string> words = partsOf(term, '^');
  const bool isWhole = words.size() == 3 && !words[0].empty() && !words[1].empty() &&
    !words[2].empty() && words[0].size() <= LongestCode && words[1].size() <= LongestCode &&
    lettersOf(words[2]) <= LongestText;
  return isWhole ? std::vector<DerivedSet>{ codeOf(words[0], words[1], words[2]) }
                 : std::vector<DerivedSet>();
}

void setTerms(const Label& label, DerivedSet& segment)
{
  const std::string tissue = "SCT^85756007^Tissue"; // nothing more is known
  std::vector<std::string> terms = partsOf(label.terms, '~');
  terms.resize(5);
  const bool isKnown = !termOf(terms[0]).empty() && !termOf(terms[1]).empty();
  std::vector<DerivedSet> type = termOf(isKnown ? terms[1] : tissue);
  const std::vector<DerivedSet> modifier = isKnown ? termOf(terms[2]) : std::vector<DerivedSet>();
  if (!modifier.empty())
  {
    setSequence(type.front(), 0x00620011, modifier);
  }
  setSequence(segment, 0x00620003, termOf(isKnown ? terms[0] : tissue));
  setSequence(segment, 0x0062000f, type);
  std::vector<DerivedSet> region = termOf(terms[3]);
  const std::vector<DerivedSet> ofRegion = termOf(terms[4]);
  if (!region.empty() && !ofRegion.empty())
  {
    setSequence(region.front(), 0x00082220, ofRegion);
  }
  if (!region.empty())
  {
    setSequence(segment, 0x00082218, region);
  }
}

std::string shortName(const std::string& name)
{
  std::string text = firstLettersOf(name);
  std::replace_if(
    text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == '\\'; }, ' ');
  return text.empty() ? "Segment" : text;
}

std::vector<DerivedSet> describedSegments(const std::map<int, Label>& labels)
{
  std::vector<DerivedSet> all;
  for (const auto& [value, label] : labels)
  {
    DerivedSet segment;
    setWhole(segment, 0x00620004, static_cast<int>(all.size()) + 1);
    setText(segment, 0x00620005, "LO", shortName(label.name));
    setText(segment, 0x00620008, "CS", "SEMIAUTOMATIC");
    setText(segment, 0x00620009, "LO", "BrainShift");
    const std::array<int, 3> lab = labOfRgb(label.color);
    setWholes(segment, 0x0062000d, "US",
      { static_cast<std::uint32_t>(lab[0]), static_cast<std::uint32_t>(lab[1]),
        static_cast<std::uint32_t>(lab[2]) });
    setTerms(label, segment);
    all.push_back(std::move(segment));
  }
  return all;
}

// Names in letters beyond ASCII need UTF-8. Texts of the patient are put into it where that is
// safe; elsewhere such letters become question marks.
void chooseCharacters(std::map<int, Label>& labels, DerivedSet& header, std::string& warning)
{
  const auto isAscii = [](const std::string& text) { return plainText(text) == text; };
  const bool allAscii = std::all_of(labels.begin(), labels.end(),
    [&](const auto& entry) { return isAscii(entry.second.name) && isAscii(entry.second.terms); });
  const auto found = header.find(CharacterSet);
  const std::string characters =
    found == header.end() ? std::string() : trimmed(found->second.bytes);
  if (allAscii || characters == "ISO_IR 192")
  {
    return;
  }
  const bool isLatin = characters == "ISO_IR 100";
  const bool isPlain = std::all_of(header.begin(), header.end(), [&](const auto& entry) {
    return isAscii(trimmed(entry.second.bytes, std::string_view(" \0", 2)));
  });
  if (!isLatin && !isPlain)
  {
    for (auto& [value, label] : labels)
    {
      label.name = plainText(label.name);
      label.terms = plainText(label.terms);
    }
    warning += (warning.empty() ? "" : ". ") + std::string("Like is in the characters ") +
      shownWords(characters) + ", which lack letters of the labels: they are question marks";
    return;
  }
  for (auto& [tag, element] : header)
  {
    if (isLatin && (element.type == "LO" || element.type == "PN" || element.type == "SH"))
    {
      setText(header, tag, element.type, utf8OfLatin1(element.bytes));
    }
  }
  setText(header, CharacterSet, "CS", "ISO_IR 192");
}

void setFacts(const DICOMDataSet& source, DerivedSet& set)
{
  set.erase(0x00200012); // of an acquisition
  set.erase(0x00200060);
  setText(set, 0x00080008, "CS", "DERIVED\\PRIMARY");
  setText(set, 0x00080016, "UI", SegmentationStorage);
  setText(set, 0x00080018, "UI", newUID());
  setText(set, 0x00080060, "CS", "SEG");
  setText(set, 0x00080070, "LO", "BrainShift");
  setText(set, 0x00081090, "LO", "BrainShift");
  setText(set, 0x00181000, "LO", "none");
  setText(set, 0x00181020, "LO", "BrainShift");
  setNewSeries(source, set);
  setText(set, 0x00200013, "IS", "1");
  setText(set, 0x00700080, "CS", "SEGMENTATION");
  setText(set, 0x00700081, "LO", NotForClinicalUse);
  setText(set, 0x00700084, "PN", "");
  setText(set, 0x00620001, "CS", "BINARY");
  setText(set, 0x00620013, "CS", "NO");
  setText(set, 0x00282110, "CS", "00"); // nothing was lost
}

void setPixelFormat(const Frames& frames, std::size_t count, DerivedSet& set)
{
  setWhole(set, 0x00280002, 1);
  setText(set, 0x00280004, "CS", "MONOCHROME2");
  setText(set, 0x00280008, "IS", std::to_string(count));
  setWhole(set, 0x00280010, frames.sides.y);
  setWhole(set, 0x00280011, frames.sides.x);
  setWhole(set, 0x00280100, 1);
  setWhole(set, 0x00280101, 1);
  setWhole(set, 0x00280102, 0);
  setWhole(set, 0x00280103, 0);
}

// Frames are counted by segment and by position.
void setDimensions(DerivedSet& set)
{
  DerivedSet organisation;
  setText(organisation, 0x00209164, "UI", newUID());
  setSequence(set, 0x00209221, { organisation });
  DerivedSet segment = organisation;
  setWholes(segment, 0x00209165, "AT", { 0x0062000b });
  setWholes(segment, 0x00209167, "AT", { 0x0062000a });
  setText(segment, 0x00209421, "LO", "ReferencedSegmentNumber");
  DerivedSet position = organisation;
  setWholes(position, 0x00209165, "AT", { 0x00200032 });
  setWholes(position, 0x00209167, "AT", { 0x00209113 });
  setText(position, 0x00209421, "LO", "ImagePositionPatient");
  setSequence(set, 0x00209222, { segment, position });
}

std::string numbersText(const std::vector<double>& numbers)
{
  std::string text;
  for (const double number : numbers)
  {
    text += (text.empty() ? "" : "\\") + decimalText(number);
  }
  return text;
}

void setShared(const Frames& frames, DerivedSet& set)
{
  const glm::dvec3 row = frames.direction(0);
  const glm::dvec3 column = frames.direction(1);
  DerivedSet orientation;
  setText(orientation, 0x00200037, "DS",
    numbersText({ row.x, row.y, row.z, column.x, column.y, column.z }));
  DerivedSet measures;
  setText(measures, 0x00180050, "DS", decimalText(frames.spacing(2)));
  setText(measures, 0x00180088, "DS", decimalText(frames.spacing(2)));
  setText(measures, 0x00280030, "DS", numbersText({ frames.spacing(1), frames.spacing(0) }));
  DerivedSet shared;
  setSequence(shared, 0x00209116, { orientation });
  setSequence(shared, 0x00289110, { measures });
  setSequence(set, 0x52009229, { shared });
}

DerivedSet imageOf(const Source& source)
{
  DerivedSet image;
  setText(image, 0x00081150, "UI", source.storage);
  setText(image, 0x00081155, "UI", source.instance);
  return image;
}

// The image of the scan in whose plane a frame is, in a sequence; empty if there is none.
std::vector<DerivedSet> derivationOf(
  const Frames& frames, int slice, const std::vector<Source>& sources)
{
  const glm::dvec3 normal = glm::cross(frames.direction(0), frames.direction(1));
  const glm::dvec3 place = frames.position(slice);
  const auto source = std::find_if(sources.begin(), sources.end(), [&](const Source& one) {
    const glm::dvec3 other = glm::cross(one.alongRow, one.alongColumn);
    return glm::length(glm::cross(normal, other)) < SameDirection &&
      std::abs(glm::dot(one.position - place, normal)) < SamePlaceMm;
  });
  if (source == sources.end())
  {
    return {};
  }
  DerivedSet image = imageOf(*source);
  if (source->frame > 0)
  {
    setText(image, 0x00081160, "IS", std::to_string(source->frame));
  }
  setText(image, 0x0028135a, "CS", source->isTile ? "NO" : "YES"); // SpatialLocationsPreserved
  setSequence(
    image, 0x0040a170, { codeOf("DCM", "121322", "Source image for image processing operation") });
  DerivedSet derivation;
  setSequence(derivation, 0x00082112, { image });
  setSequence(derivation, 0x00089215, { codeOf("DCM", "113076", "Segmentation") });
  return { derivation };
}

void setReferences(const DICOMDataSet& source, const std::vector<Source>& sources, DerivedSet& set)
{
  std::vector<DerivedSet> instances;
  std::set<std::string> known;
  for (const Source& one : sources)
  {
    if (known.insert(one.instance).second)
    {
      instances.push_back(imageOf(one));
    }
  }
  if (!instances.empty())
  {
    DerivedSet series;
    setText(series, 0x0020000e, "UI", textOf(source, 0x0020000e));
    setSequence(series, 0x0008114a, instances);
    setSequence(set, 0x00081115, { series });
  }
}

// Bits in a row, the lowest of a byte first. Frames begin where the last one ended.
class Bits
{
public:
  void add(bool isSet)
  {
    if (this->Count % 8 == 0)
    {
      this->Bytes += '\0';
    }
    if (isSet)
    {
      this->Bytes.back() = static_cast<char>(this->Bytes.back() | 1 << this->Count % 8);
    }
    ++this->Count;
  }

  // An even number of bytes, as the standard wants.
  std::string take()
  {
    this->Bytes.append(this->Bytes.size() % 2, '\0');
    return std::move(this->Bytes);
  }

private:
  std::string Bytes;
  std::uint64_t Count = 0;
};

// The labels of a slice, row by row.
std::vector<int> labelsOfSlice(const OutgoingVolume& volume, const Frames& frames, int slice)
{
  std::vector<int> labels;
  for (int row = 0; row < frames.sides.y; ++row)
  {
    for (int column = 0; column < frames.sides.x; ++column)
    {
      const glm::ivec3 at = frames.voxel({ column, row, slice });
      labels.push_back(static_cast<int>(volume.numbers->GetComponent(
        static_cast<vtkIdType>(volume.grid.offset(at.x, at.y, at.z)), 0)));
    }
  }
  return labels;
}

// Slices that each label has.
std::map<int, std::set<int>> slicesOf(const OutgoingVolume& volume, const Frames& frames)
{
  std::map<int, std::set<int>> slices;
  for (int slice = 0; slice < frames.sides.z; ++slice)
  {
    const std::vector<int> labels = labelsOfSlice(volume, frames, slice);
    for (const int label : std::set<int>(labels.begin(), labels.end()))
    {
      slices[label].insert(slice);
    }
  }
  slices.erase(0);
  return slices;
}

// Frames of one segment after the other: their groups and their pixels.
std::string setFrames(const OutgoingVolume& volume, const Frames& frames,
  const std::map<int, Label>& labels, const std::vector<Source>& sources, DerivedSet& set)
{
  const std::map<int, std::set<int>> slices = slicesOf(volume, frames);
  std::set<int> places;
  std::size_t count = 0;
  for (const auto& [label, ofLabel] : slices)
  {
    places.insert(ofLabel.begin(), ofLabel.end());
    count += ofLabel.size();
  }
  const double bytes =
    static_cast<double>(count) * frames.sides.x * static_cast<double>(frames.sides.y) / 8.0;
  if (std::max(frames.sides.x, frames.sides.y) > HighestLabel ||
    bytes > std::numeric_limits<std::uint32_t>::max() - 2.0)
  {
    throw Problem(joined("The input has ", count, " frames of ", frames.sides.x, " x ",
      frames.sides.y, " pixels; DICOM holds at most 65535 on each side and 4 GiB of bits"));
  }
  std::vector<DerivedSet> groups;
  Bits bits;
  std::uint32_t segment = 0;
  for (const auto& entry : labels)
  {
    ++segment;
    const auto ofLabel = slices.find(entry.first);
    for (const int slice : ofLabel == slices.end() ? std::set<int>() : ofLabel->second)
    {
      const auto place =
        static_cast<std::uint32_t>(std::distance(places.begin(), places.find(slice))) + 1;
      const glm::dvec3 at = frames.position(slice);
      DerivedSet content;
      DerivedSet plane;
      DerivedSet identity;
      DerivedSet group;
      setWholes(content, 0x00209157, "UL", { segment, place });
      setText(plane, 0x00200032, "DS", numbersText({ at.x, at.y, at.z }));
      setWhole(identity, 0x0062000b, static_cast<int>(segment));
      setSequence(group, 0x00089124, derivationOf(frames, slice, sources));
      setSequence(group, 0x00209111, { content });
      setSequence(group, 0x00209113, { plane });
      setSequence(group, 0x0062000a, { identity });
      groups.push_back(std::move(group));
      for (const int label : labelsOfSlice(volume, frames, slice))
      {
        bits.add(label == entry.first);
      }
    }
  }
  setSequence(set, 0x52009230, groups);
  setPixelFormat(frames, groups.size(), set);
  return bits.take();
}

// Names that shortName cuts.
void noteNames(const std::map<int, Label>& labels, std::string& warning)
{
  std::size_t count = 0;
  std::string first;
  for (const auto& [value, label] : labels)
  {
    const bool isLong = lettersOf(label.name) > LongestText;
    count += isLong ? 1 : 0;
    first = isLong && first.empty() ? shortName(label.name) : first;
  }
  if (count > 0)
  {
    warning += (warning.empty() ? "" : ". ") +
      joined(count, count == 1 ? " name is" : " names are", " longer than the ", LongestText,
        " letters of a SegmentLabel and cut, the first to '", first, "'");
  }
}

void noteNumbers(const std::map<int, Label>& labels, std::string& warning)
{
  int number = 0;
  for (const auto& entry : labels)
  {
    if (entry.first != ++number)
    {
      warning += (warning.empty() ? "" : ". ") +
        joined("Segments are numbered from 1 to ", labels.size(), ": label ", entry.first,
          " became segment ", number, labels.size() > 1 ? ", and so on" : "");
      return;
    }
  }
}
}

bool isSegmentationName(const std::string& fileName)
{
  return endsWith(lowerCase(fileName), ".seg.dcm");
}

void writeSegments(const std::string& fileName, const std::string& like,
  const OutgoingSegments& segments, const Progress& progress, std::string& warning)
{
  requireLabels(segments.volume);
  DICOMDataSet source;
  readLike(like, source);
  const std::vector<Source> sources = sourcesOf(like, source);
  const Frames frames = framesOf(segments.volume, sources);
  std::map<int, Label> labels = labelsOf(segments);
  DerivedSet set = studyHeader(source);
  chooseCharacters(labels, set, warning);
  noteNumbers(labels, warning);
  noteNames(labels, warning);
  setFacts(source, set);
  setSequence(set, 0x00620002, describedSegments(labels));
  setDimensions(set);
  setShared(frames, set);
  setReferences(source, sources, set);
  const std::string pixels = setFrames(segments.volume, frames, labels, sources, set);
  throwIfAny(progress(0.5) ? "" : "it was stopped");
  const std::string bytes = fileOf(set, pixels);
  writeWholeStream(fileName, [&](std::ostream& file) {
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}
}
