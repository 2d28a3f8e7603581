// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes in MetaImage (.mha, .mhd) and NRRD (.nrrd, .nhdr) files.
///
/// Three axes must be axes of space. One axis before them is the components of a voxel, or time, or
/// the layers of a segmentation; one after them is time, the layers of an old segmentation, or, if
/// its kind says so, the components of a voxel.
#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/TextHeader.h"
#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtkDataArray.h" // for its smart pointer
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace brainshift
{
namespace
{
// One segment of a file, as 3D Slicer names it. Names such as `Segment0_LabelValue` are Slicer's. A
// file may have several layers, so that segments may overlap. Then each segment has a layer, from
// 0 on. Files of 3D Slicer before 4.11 name no layers: segment i is where component i is 1, or, in
// still older ones, step i of the last of four axes of space.
struct Segment
{
  Label label; // in its layer
  int layer = 0;
};

enum class TextFormat
{
  MetaImage,
  NRRD,
};

constexpr int MostSegments = 65536;

// Red, green and blue from 0 to 1.
std::array<unsigned char, 3> colorIn(const std::string& text)
{
  std::array<unsigned char, 3> color = Label().color;
  const std::vector<double> shares = numbersIn(text);
  for (std::size_t i = 0; i < 3 && shares.size() == 3; ++i)
  {
    const double share = shares[i] > 0.0 ? std::min(shares[i], 1.0) : 0.0;
    color[i] = static_cast<unsigned char>(std::lround(255.0 * share));
  }
  return color;
}

// The coded terms in the tags of a segment (Label::terms): "TerminologyEntry:context~category~type~
// modifier~context of regions~region~modifier of the region|". Empty if there are none.
std::string termsIn(const std::string& tags)
{
  const std::string key = "TerminologyEntry:";
  const std::size_t begin = ("|" + tags).find("|" + key);
  if (begin == std::string::npos)
  {
    return "";
  }
  std::istringstream entry(
    tags.substr(begin + key.size(), tags.find('|', begin) - begin - key.size()));
  std::vector<std::string> parts;
  for (std::string part; std::getline(entry, part, '~');)
  {
    parts.push_back(part);
  }
  if (parts.size() < 4)
  {
    return "";
  }
  parts.resize(7, "^^");
  const std::string terms = parts[1] + "~" + parts[2] + "~" + parts[3];
  const std::string region = parts[5] + "~" + parts[6];
  return terms + (region == "^^~^^" || region == "~" ? "" : "~" + region);
}

// The whole number under a key, such as LabelValue; `otherwise`, with a warning, if it is none.
int wholeUnder(
  const HeaderText& text, const std::string& key, int otherwise, std::vector<std::string>& warnings)
{
  const std::string words = text.keyed(key);
  const std::vector<double> numbers = numbersIn(words);
  if (numbers.size() == 1 &&
    isWhole(numbers[0], std::numeric_limits<int>::min(), std::numeric_limits<int>::max()))
  {
    return static_cast<int>(numbers[0]);
  }
  if (!words.empty())
  {
    warnings.push_back(joined("has the ", key, " ", shownWords(words),
      ", which is no whole number; it counts as ", otherwise, ", so that ",
      "voxels may get the name of another segment; save it again in 3D Slicer"));
  }
  return otherwise;
}

// Names as a list may show them: on one line, and not too long. Letters beyond ASCII stay whole.
std::string shownNames(std::string names)
{
  constexpr std::size_t Most = 200; // bytes
  const bool isLong = names.size() > Most;
  std::size_t end = isLong ? Most : names.size();
  const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(names[i]); };
  while (isLong && end > 0 && (byteAt(end) & 0xc0) == 0x80) // inside a letter of UTF-8
  {
    --end;
  }
  names.resize(end);
  std::replace_if(
    names.begin(), names.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return isLong ? names + "..." : names;
}

template <typename Predicate>
std::string namesWhere(const std::vector<Segment>& segments, const Predicate& isMeant)
{
  constexpr std::size_t Most = 5;
  std::size_t count = 0;
  std::string text;
  for (const Segment& segment : segments)
  {
    if (isMeant(segment) && ++count <= Most)
    {
      text += (count > 1 ? ", " : "") + segment.label.name;
    }
  }
  return shownNames(text) + (count > Most ? " and others" : "");
}

// Segments without layers must have a component each.
void requireOneEach(std::size_t segments, std::size_t layered, std::size_t components)
{
  if (layered > 0 || segments != components)
  {
    throw Problem(joined("has ", segments, " segments in ", components, " layers, of which ",
      segments - layered, " name no layer (Segment0_Layer and so on)"));
  }
}

// Voxels of a layer with the value of two segments could be of either.
void warnOfTwins(const std::vector<Segment>& segments, std::vector<std::string>& warnings)
{
  std::map<std::pair<int, int>, const Segment*> known; // by layer and value
  for (const Segment& segment : segments)
  {
    const auto [first, isNew] = known.insert({ { segment.layer, segment.label.value }, &segment });
    if (!isNew)
    {
      warnings.push_back(joined("has the segments ", shownNames(first->second->label.name), " and ",
        shownNames(segment.label.name), " in one layer, both with the LabelValue ",
        segment.label.value, ", so that its voxels may be of either; give each segment a value of ",
        "its own in 3D Slicer"));
    }
  }
}

// The segments of a header; none if it has none. One without a name gets its ID as the name.
// `components`: layers of the file.
std::vector<Segment> segmentsOf(
  const HeaderText& text, std::size_t components, std::vector<std::string>& warnings)
{
  std::vector<Segment> segments;
  std::size_t layered = 0; // segments that name their layer
  for (int i = 0; i < MostSegments; ++i)
  {
    const std::string prefix = "Segment" + std::to_string(i) + "_";
    const std::string id = text.keyed(prefix + "ID");
    if (id.empty())
    {
      break;
    }
    Label label;
    const std::string name = text.keyed(prefix + "Name");
    label.name = name.empty() ? id : name;
    label.value = wholeUnder(text, prefix + "LabelValue", 1, warnings);
    const std::string color = text.keyed(prefix + "Color");
    label.color = colorIn(color.empty() ? text.keyed(prefix + "DefaultColor") : color);
    label.terms = termsIn(text.keyed(prefix + "Tags"));
    const std::string layer = text.keyed(prefix + "Layer");
    layered += layer.empty() ? 0 : 1;
    segments.push_back({ label, wholeUnder(text, prefix + "Layer", 0, warnings) });
  }
  if (layered < segments.size() && components > 1)
  {
    requireOneEach(segments.size(), layered, components);
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      segments[i].layer = static_cast<int>(i);
    }
  }
  warnOfTwins(segments, warnings);
  return segments;
}

// The labels of one layer.
std::vector<Label> labelsIn(const std::vector<Segment>& segments, int layer)
{
  std::vector<Label> labels;
  for (const Segment& segment : segments)
  {
    if (segment.layer == layer)
    {
      labels.push_back(segment.label);
    }
  }
  return labels;
}

// The first names of segments in a layer, as a message may show them.
std::string namesIn(const std::vector<Segment>& segments, int layer)
{
  return namesWhere(segments, [&](const Segment& segment) { return segment.layer == layer; });
}

// Likewise outside it.
std::string namesOutside(const std::vector<Segment>& segments, int layer)
{
  return namesWhere(segments, [&](const Segment& segment) { return segment.layer != layer; });
}

constexpr std::int64_t MostSteps = 65536; // and numbers for a voxel: each takes memory
constexpr std::int64_t MostColors = 4;    // components of an axis that has no kind

// RAS from the space of a header.
glm::dvec3 rasSigns(HeaderSpace space)
{
  switch (space)
  {
    case HeaderSpace::LPS:
      return glm::dvec3(-1.0, -1.0, 1.0);
    case HeaderSpace::LAS:
      return glm::dvec3(-1.0, 1.0, 1.0);
    default:
      return glm::dvec3(1.0);
  }
}

bool hasNoKind(const HeaderAxis& axis)
{
  return axis.kind.empty() || axis.kind == "???" || axis.kind == "none";
}

// Whether the axis before those of space holds one volume after the other.
bool isSeries(const HeaderAxis& axis)
{
  return hasNoKind(axis) ? axis.count > MostColors : axis.kind == "time" || axis.kind == "list";
}

// Whether the kind of the axis after those of space says that its numbers belong to one voxel, such
// as RGB-color, 3-vector or 3D-symmetric-matrix.
bool holdsComponents(const HeaderAxis& axis)
{
  constexpr const char* Volumes[] = { "time", "list", "domain", "space", "stub", "scalar" };
  return axis.count > 1 && !hasNoKind(axis) &&
    std::find(std::begin(Volumes), std::end(Volumes), axis.kind) == std::end(Volumes);
}

// The numbers of each voxel side by side, from those of one component after the other.
vtkSmartPointer<vtkDataArray> sideBySide(vtkDataArray* numbers, std::size_t components)
{
  auto tuples = vtkSmartPointer<vtkDataArray>::Take(numbers->NewInstance());
  const std::size_t voxels = static_cast<std::size_t>(numbers->GetNumberOfValues()) / components;
  tuples->SetNumberOfComponents(static_cast<int>(components));
  tuples->SetNumberOfTuples(static_cast<vtkIdType>(voxels));
  const auto size = static_cast<std::size_t>(numbers->GetDataTypeSize());
  const auto* from = static_cast<const char*>(numbers->GetVoidPointer(0));
  auto* const to = static_cast<char*>(tuples->GetVoidPointer(0));
  for (std::size_t component = 0; component < components; ++component)
  {
    for (std::size_t voxel = 0; voxel < voxels; ++voxel, from += size)
    {
      std::memcpy(to + (voxel * components + component) * size, from, size);
    }
  }
  return tuples;
}

// The layer that a text means, such as "2: vessels" or "2"; 0-based. Below 0: none of `count`.
int layerIn(const std::string& text, int count)
{
  const std::vector<double> numbers = numbersIn(text.substr(0, text.find(':')));
  return numbers.size() == 1 && isWhole(numbers[0], 1, count) ? static_cast<int>(numbers[0]) - 1
                                                              : -1;
}

// Whether a file begins like a volume of one of the formats, and no image of two dimensions.
bool isTextHeaderVolume(const std::string& fileName, TextFormat format)
{
  HeaderText text;
  const bool isHeader = problemOf([&] { readHeaderText(fileName, text); }).empty();
  if (!isHeader || text.isNRRD != (format == TextFormat::NRRD))
  {
    return false;
  }
  const std::string dimensionsText = text.valueOf({ text.isNRRD ? "dimension" : "NDims" });
  const std::vector<double> dimensions = numbersIn(dimensionsText);
  const bool hasVoxels = text.has(text.isNRRD ? "sizes" : "DimSize");
  return hasVoxels && (dimensionsText.empty() || !(dimensions[0] < 3.0));
}

// The name of a transform of the second picture, if a file holds pictures of a tracked probe as
// PLUS and 3D Slicer record them: Seq_Frame0001_ProbeToTrackerTransform. Empty: it does not.
std::string trackedTransform(const HeaderText& text)
{
  for (const auto* names : { &text.fields, &text.keys })
  {
    for (const auto& [name, value] : *names)
    {
      const std::string lower = lowerCase(name);
      const std::string begin = "seq_frame0001_";
      const std::string end = "transform";
      if (lower.size() > begin.size() + end.size() && lower.compare(0, begin.size(), begin) == 0 &&
        lower.compare(lower.size() - end.size(), end.size(), end) == 0)
      {
        return name;
      }
    }
  }
  return "";
}

// A file of a probe's pictures is no volume.
void refuseTrackedPictures(const HeaderText& text, const std::string& transform)
{
  const std::vector<double> sides = numbersIn(text.valueOf({ text.isNRRD ? "sizes" : "DimSize" }));
  if (transform.empty() || sides.size() != 3)
  {
    return;
  }
  if (!(sides[0] > 0.0))
  {
    throw Problem(joined("holds ", sides[2], " poses of a tracked probe (", shownWords(transform),
      ") and no picture; open it in PLUS or 3D Slicer (SlicerIGT)"));
  }
  throw Problem(joined("holds ", sides[2],
    " pictures of a tracked probe, each at a place of its own (", shownWords(transform),
    "), and no volume; make a volume of them in PLUS or 3D Slicer (SlicerIGT, Volume "
    "Reconstruction)"));
}

class TextHeaderVolume : public VolumeFile
{
public:
  explicit TextHeaderVolume(TextFormat format);

  std::string noun() const override;
  void readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  Loads loads() const override
  {
    return hasNumbersInOneFile(this->Stored) ? Loads::Part : Loads::All;
  }
  bool readsNothingElse() const override
  {
    return hasNumbersInOneFile(this->Stored) && this->Stored.encoding == Encoding::Raw;
  }
  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  // Which layer of a segmentation the next readHeader takes: one of the choices, or its number.
  // Default: empty, the first, with a warning. Other volumes have no layers to choose from.
  void choose(const std::string& name) override { this->Layer = name; }

  // The layers that the last readHeader found, such as "2: vessel, tumour". None if segments cannot
  // overlap.
  std::vector<std::string> choices() const override { return this->LayerNames; }

private:
  // How the axes of the file are used.
  void arrange(VolumeHeader& header);
  // One layer of a segmentation, with its labels.
  void takeSegments(VolumeHeader& header);
  // All numbers, or those of a box. None if `progress` says stop.
  vtkSmartPointer<vtkDataArray> readAll(const Progress& progress) const;
  vtkSmartPointer<vtkDataArray> readPart(
    std::uint64_t skip, const StoredBox& box, const Progress& progress) const;
  // Whether all volumes are read together: they are packed, or their numbers lie side by side.
  bool keepsSeries() const
  {
    if (this->StepsAreComponents)
    {
      return false; // there is one volume
    }
    const bool isApart = this->readsNothingElse() || this->StepsAreLayers;
    return (this->Steps > 1 && !isApart) || (this->TupleIsTime && this->Tuple > 1);
  }
  // Whether one step is read at a time.
  bool readsSteps() const
  {
    return this->loads() == Loads::Part && !this->keepsSeries() && !this->StepsAreComponents;
  }
  // The step along the last axis that has a volume of the series, or the layer that is shown.
  std::size_t stepOf(std::size_t volume) const
  {
    return this->StepsAreLayers ? static_cast<std::size_t>(this->ShownLayer) : volume;
  }
  // Which of the numbers of a voxel are shown.
  int componentOf(std::size_t volume) const
  {
    return this->TupleIsTime ? static_cast<int>(volume)
      : this->StepsAreLayers ? 0
                             : this->ShownLayer;
  }

  TextFormat Format;
  std::string Layer;
  std::vector<std::string> LayerNames;
  int ShownLayer = 0;
  TextHeader Stored;
  glm::ivec3 Dimensions{ 0 };
  std::size_t Tuple = 1;    // numbers of the axis before those of space
  bool TupleIsTime = false; // its numbers are volumes
  std::size_t Steps = 1;    // volumes along the axis after those of space
  bool StepsAreLayers = false;
  bool StepsAreComponents = false; // of the voxels
  // A part of all volumes, kept for the others of a series, and which part it is.
  vtkSmartPointer<vtkDataArray> Numbers;
  std::array<int, 6> Held{};
};

TextHeaderVolume::TextHeaderVolume(TextFormat format)
  : Format(format)
{
}

std::string TextHeaderVolume::noun() const
{
  return this->Format == TextFormat::NRRD ? "NRRD file" : "MetaImage";
}

void TextHeaderVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  this->Numbers = nullptr; // the file may have changed under its name
  this->LayerNames.clear();
  const std::string problem = problemOf([&] { readTextHeader(fileName, this->Stored); });
  const bool isNRRD = this->Stored.text.isNRRD;
  const bool isOpen = problem.empty() || this->Stored.text.bytes > 0;
  if (isOpen && isNRRD != (this->Format == TextFormat::NRRD))
  {
    throw Problem(isNRRD ? "is an NRRD file and no MetaImage" : "does not begin with NRRD");
  }
  const std::string tracked = trackedTransform(this->Stored.text);
  refuseTrackedPictures(this->Stored.text, tracked);
  throwIfAny(problem);
  this->arrange(header);
  requireNumbers(this->Stored);
  warnOfSurplus(this->Stored);
  if (!tracked.empty())
  {
    this->Stored.warnings.push_back(
      "names transforms of its times, such as " + shownWords(tracked) + ", which do not place it");
  }
  const glm::dvec3 signs = rasSigns(this->Stored.space);
  int axis = 0;
  for (const HeaderAxis& along : this->Stored.axes)
  {
    if (along.step)
    {
      header.worldFromVoxel[axis++] = glm::dvec4(signs * *along.step, 0.0);
    }
  }
  header.worldFromVoxel[3] = glm::dvec4(signs * this->Stored.origin, 1.0);
  header.knowsSides = this->Stored.saysSides();
  header.storedType = this->Stored.numberType;
  header.rescaling = { this->Stored.slope, this->Stored.intercept };
  header.warnings = this->Stored.warnings;
  if (!header.knowsSides)
  {
    header.warnings.emplace_back(UnknownSidesWarning);
  }
  if (header.knowsSides && !this->Stored.hasOrigin)
  {
    header.warnings.push_back(std::string("has no ") + (isNRRD ? "space origin" : "Offset") +
      "; its first voxel counts as at 0 0 0");
  }
  this->takeSegments(header);
}

void TextHeaderVolume::arrange(VolumeHeader& header)
{
  const std::vector<HeaderAxis>& axes = this->Stored.axes;
  if (this->Stored.spatialAxes() != 3)
  {
    throw Problem(
      "has " + std::to_string(this->Stored.spatialAxes()) + " axes in space; a volume must have 3");
  }
  const std::size_t first = axes[0].step ? 0 : 1;
  const bool isRow = axes.size() >= first + 3 && axes.size() <= first + 4 && axes[first].step &&
    axes[first + 1].step && axes[first + 2].step;
  if (!isRow)
  {
    throw Problem("has " + std::to_string(axes.size()) +
      " axes; a volume must have 3 in space, with at most one before and one after them");
  }
  const bool hasSteps = axes.size() == first + 4;
  for (const HeaderAxis& axis : axes)
  {
    if (!axis.step && axis.count > MostSteps)
    {
      throw Problem("has " + std::to_string(axis.count) +
        " numbers along an axis that is none of space; it may have " + std::to_string(MostSteps));
    }
  }
  this->Dimensions = glm::ivec3(axes[first].count, axes[first + 1].count, axes[first + 2].count);
  if (this->Dimensions == glm::ivec3(1))
  {
    throw Problem("has 1 voxel; it must have at least 2");
  }
  this->Tuple = first == 1 ? static_cast<std::size_t>(axes[0].count) : 1;
  this->Steps = hasSteps ? static_cast<std::size_t>(axes.back().count) : 1;
  this->TupleIsTime = first == 1 && !hasSteps && isSeries(axes[0]);
  if (this->TupleIsTime && hasNoKind(axes[0]))
  {
    this->Stored.warnings.push_back("does not say what its first axis is (kinds); its " +
      std::to_string(this->Tuple) + " numbers at each voxel count as volumes of a series");
  }
  this->StepsAreComponents = hasSteps && holdsComponents(axes.back());
  if (this->StepsAreComponents && first == 1)
  {
    throw Problem("has the kinds " + this->Stored.text.valueOf({ "kinds" }) +
      ": components of a voxel after the axes of space, and another axis before them; only one of "
      "these may be there");
  }
  this->StepsAreLayers = hasSteps && first == 0 && axes.back().kind == "domain" &&
    !this->Stored.text.keyed("Segment0_ID").empty();
  header.dimensions = this->Dimensions;
  const bool isSeriesOfSteps = hasSteps && !this->StepsAreLayers && !this->StepsAreComponents;
  header.components = this->TupleIsTime ? 1
    : this->StepsAreComponents          ? static_cast<int>(this->Steps)
                                        : static_cast<int>(this->Tuple);
  header.times = this->TupleIsTime ? timesOf(axes[0], this->Stored.warnings)
    : isSeriesOfSteps              ? timesOf(axes.back(), this->Stored.warnings)
                                   : evenTimes(1, 1.0);
}

void TextHeaderVolume::takeSegments(VolumeHeader& header)
{
  this->ShownLayer = 0;
  const std::size_t layers = this->StepsAreLayers ? this->Steps : this->Tuple;
  const std::vector<Segment> segments = segmentsOf(this->Stored.text, layers, header.warnings);
  const bool hasLayers =
    !segments.empty() && layers > 1 && (this->Steps == 1 || this->StepsAreLayers);
  const int count = hasLayers ? static_cast<int>(layers) : 0;
  for (int i = 0; i < count; ++i)
  {
    const std::string names = namesIn(segments, i);
    this->LayerNames.push_back(
      std::to_string(i + 1) + (names.empty() ? ": no segment" : ": " + names));
  }
  if (hasLayers)
  {
    this->TupleIsTime = false;
    header.components = 1;
    header.times = { 0.0 };
    this->ShownLayer = this->Layer.empty() ? 0 : layerIn(this->Layer, count);
  }
  if (this->ShownLayer < 0)
  {
    throw Problem("has " + std::to_string(count) + " layers of segments; Layer is '" +
      shownWords(this->Layer) + "', which is none of them");
  }
  header.labels = labelsIn(segments, this->ShownLayer);
  if (hasLayers && this->Layer.empty())
  {
    const std::string leftOut = namesOutside(segments, 0);
    header.warnings.push_back("has " + std::to_string(count) +
      " layers of segments that overlap; layer 1 is shown" +
      (leftOut.empty() ? "" : ", without " + leftOut) + "; Layer chooses another one");
  }
}

double TextHeaderVolume::storedBytes(const VolumeHeader&) const
{
  const double steps = this->readsSteps() ? static_cast<double>(this->Steps)
    : this->StepsAreComponents            ? 0.5 // a second time, side by side
                                          : 1.0;
  return this->Numbers ? 0.0 : this->Stored.dataBytes() / steps;
}

vtkSmartPointer<vtkDataArray> TextHeaderVolume::readPart(
  std::uint64_t skip, const StoredBox& box, const Progress& progress) const
{
  auto numbers =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Stored.numberType));
  numbers->SetNumberOfComponents(static_cast<int>(this->Tuple));
  numbers->SetNumberOfTuples(static_cast<vtkIdType>(box.voxelCount()));
  bool stopped = false;
  readNumbers(
    this->Stored, skip, box, static_cast<char*>(numbers->GetVoidPointer(0)), [&](double fraction) {
      stopped = !progress(fraction);
      return !stopped;
    });
  return stopped ? nullptr : numbers;
}

vtkSmartPointer<vtkDataArray> TextHeaderVolume::readAll(const Progress& progress) const
{
  auto numbers =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Stored.numberType));
  numbers->SetNumberOfComponents(static_cast<int>(this->Tuple));
  numbers->SetNumberOfTuples(
    static_cast<vtkIdType>(this->Stored.numberCount()) / static_cast<vtkIdType>(this->Tuple));
  bool stopped = false;
  readNumbers(this->Stored, static_cast<char*>(numbers->GetVoidPointer(0)), [&](double fraction) {
    stopped = stopped || !progress(fraction);
    return !stopped;
  });
  return stopped ? nullptr : numbers;
}

void TextHeaderVolume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  const bool isPart = this->loads() == Loads::Part;
  const bool isOne = this->readsSteps();
  vtkSmartPointer<vtkDataArray> numbers =
    !isPart || this->Held == voxels.wanted ? this->Numbers : nullptr;
  if (!numbers)
  {
    this->Numbers = nullptr;
    const std::size_t number = vtkDataArray::GetDataTypeSize(this->Stored.numberType);
    const StoredBox box{ this->Dimensions, voxels.wanted, this->Tuple * number,
      isOne ? 1 : this->Steps };
    const auto ofStep = static_cast<std::uint64_t>(this->Stored.dataBytes()) / this->Steps;
    numbers = isPart ? this->readPart(isOne ? this->stepOf(volume) * ofStep : 0, box, progress)
                     : this->readAll(progress);
  }
  if (!numbers)
  {
    return;
  }
  numbers = this->StepsAreComponents ? sideBySide(numbers, this->Steps) : numbers;
  const auto steps = static_cast<vtkIdType>(isOne || this->StepsAreComponents ? 1 : this->Steps);
  const vtkIdType count = numbers->GetNumberOfValues() / steps;
  const vtkSmartPointer<vtkDataArray> shown = steps > 1
    ? partOf(numbers, static_cast<vtkIdType>(this->stepOf(volume)) * count, count)
    : numbers;
  isPart ? voxels.showWanted(shown) : voxels.show(this->Dimensions, shown);
  voxels.kept = numbers;
  voxels.firstComponent = this->componentOf(volume);
  if (this->keepsSeries())
  {
    this->Numbers = numbers; // the next step comes from it
    this->Held = voxels.wanted;
  }
}

}

extern const VolumeFormat VolumesOfNRRD{ "NRRD",
  [](const std::string& fileName) {
    return isTextHeaderVolume(fileName, TextFormat::NRRD) && !isTextHeaderField(fileName);
  },
  []() -> std::unique_ptr<VolumeFile> {
    return std::make_unique<TextHeaderVolume>(TextFormat::NRRD);
  } };

extern const VolumeFormat VolumesOfMetaImage{ "MetaImage",
  [](const std::string& fileName) {
    return isTextHeaderVolume(fileName, TextFormat::MetaImage) && !isTextHeaderField(fileName);
  },
  []() -> std::unique_ptr<VolumeFile> {
    return std::make_unique<TextHeaderVolume>(TextFormat::MetaImage);
  } };
}
