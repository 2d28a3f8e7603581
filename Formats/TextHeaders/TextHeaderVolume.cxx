// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/TextHeaders/TextHeaderVolume.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/SegmentTable.h"
#include "Formats/TextHeaders/TextHeaderField.h"
#include "Formats/TextHeaders/TextHeaderFile.h"
#include "Formats/Volumes/OutgoingVolume.h"

#include "vtkImageData.h"
#include "vtkPointData.h"

#include <cmath>

namespace brainshift
{
namespace
{
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

// Whether BrainShift wrote the file for a volume whose sides nobody knew.
bool deniesSides(const HeaderText& text)
{
  const std::string note = text.isNRRD ? text.comments : text.valueOf({ "Comment" });
  return note.find(UnknownSidesNote) != std::string::npos;
}

std::vector<double> timesOf(std::size_t steps, double spacing)
{
  const double step = std::isfinite(spacing) && spacing > 0.0 ? spacing : 1.0;
  std::vector<double> times;
  times.reserve(steps);
  for (std::size_t i = 0; i < steps; ++i)
  {
    times.push_back(static_cast<double>(i) * step);
  }
  return times;
}

// Whether the axis before those of space holds one volume after the other.
bool isSeries(const HeaderAxis& axis)
{
  const bool hasKind = !axis.kind.empty() && axis.kind != "???" && axis.kind != "none";
  return hasKind ? axis.kind == "time" || axis.kind == "list" : axis.count > MostColors;
}

// The layer that a text means, such as "2: vessels" or "2"; 0-based. Below 0: none of `count`.
int layerIn(const std::string& text, int count)
{
  const std::vector<double> numbers = numbersIn(text.substr(0, text.find(':')));
  return numbers.size() == 1 && isWhole(numbers[0], 1, count) ? static_cast<int>(numbers[0]) - 1
                                                              : -1;
}
}

bool isTextHeaderVolume(const std::string& fileName, TextFormat format)
{
  HeaderText text;
  if (!readHeaderText(fileName, text).empty() || text.isNRRD != (format == TextFormat::NRRD))
  {
    return false;
  }
  const std::string dimensionsText = text.valueOf({ text.isNRRD ? "dimension" : "NDims" });
  const std::vector<double> dimensions = numbersIn(dimensionsText);
  const bool hasVoxels = text.fields.count(text.isNRRD ? "sizes" : "DimSize") > 0;
  return hasVoxels && (dimensionsText.empty() || !(dimensions[0] < 3.0));
}

TextHeaderVolume::TextHeaderVolume(TextFormat format)
  : Format(format)
{
}

std::string TextHeaderVolume::noun() const
{
  return this->Format == TextFormat::NRRD ? "NRRD file" : "MetaImage";
}

std::string TextHeaderVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  this->Numbers = nullptr; // the file may have changed under its name
  this->LayerNames.clear();
  std::string problem = readTextHeader(fileName, this->Stored);
  const bool isOpen = problem.empty() || this->Stored.text.bytes > 0;
  if (isOpen && this->Stored.text.isNRRD != (this->Format == TextFormat::NRRD))
  {
    problem =
      this->Stored.text.isNRRD ? "is an NRRD file and no MetaImage" : "does not begin with NRRD";
  }
  problem = problem.empty() ? this->arrange(header) : problem;
  problem = problem.empty() ? numbersProblem(this->Stored) : problem;
  if (!problem.empty())
  {
    return problem;
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
  header.knowsSides = this->Stored.knowsSides && !deniesSides(this->Stored.text);
  header.storedType = this->Stored.numberType;
  header.rescaling = { this->Stored.slope, this->Stored.intercept };
  header.warnings = this->Stored.warnings;
  return this->takeSegments(header);
}

std::string TextHeaderVolume::arrange(VolumeHeader& header)
{
  const std::vector<HeaderAxis>& axes = this->Stored.axes;
  if (this->Stored.spatialAxes() != 3)
  {
    return "has " + std::to_string(this->Stored.spatialAxes()) +
      " axes in space; a volume must have 3";
  }
  const std::size_t first = axes[0].step ? 0 : 1;
  const bool isRow = axes.size() >= first + 3 && axes.size() <= first + 4 && axes[first].step &&
    axes[first + 1].step && axes[first + 2].step;
  if (!isRow)
  {
    return "has " + std::to_string(axes.size()) +
      " axes; a volume must have 3 in space, with at most one before and one after them";
  }
  const bool hasSteps = axes.size() == first + 4;
  for (const HeaderAxis& axis : axes)
  {
    if (!axis.step && axis.count > MostSteps)
    {
      return "has " + std::to_string(axis.count) +
        " numbers along an axis that is none of space; it may have " + std::to_string(MostSteps);
    }
  }
  this->Dimensions = glm::ivec3(axes[first].count, axes[first + 1].count, axes[first + 2].count);
  if (this->Dimensions == glm::ivec3(1))
  {
    return "has 1 voxel; it must have at least 2";
  }
  this->Tuple = first == 1 ? static_cast<std::size_t>(axes[0].count) : 1;
  this->Steps = hasSteps ? static_cast<std::size_t>(axes.back().count) : 1;
  this->TupleIsTime = first == 1 && !hasSteps && isSeries(axes[0]);
  header.dimensions = this->Dimensions;
  header.components = this->TupleIsTime ? 1 : static_cast<int>(this->Tuple);
  header.times = this->TupleIsTime ? timesOf(this->Tuple, axes[0].spacing)
                                   : timesOf(this->Steps, hasSteps ? axes.back().spacing : 1.0);
  return {};
}

std::string TextHeaderVolume::takeSegments(VolumeHeader& header)
{
  this->ShownLayer = 0;
  const std::vector<Segment> segments = segmentsOf(this->Stored.text);
  const bool hasLayers = !segments.empty() && this->Tuple > 1 && this->Steps == 1;
  const int count = hasLayers ? static_cast<int>(this->Tuple) : 0;
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
    return "has " + std::to_string(count) + " layers of segments; Layer is '" +
      shownWords(this->Layer) + "', which is none of them";
  }
  header.labels = labelsIn(segments, this->ShownLayer);
  if (hasLayers && this->Layer.empty())
  {
    const std::string leftOut = namesOutside(segments, 0);
    header.warnings.push_back("has " + std::to_string(count) +
      " layers of segments that overlap; layer 1 is shown" +
      (leftOut.empty() ? "" : ", without " + leftOut) + "; Layer chooses another one");
  }
  return {};
}

double TextHeaderVolume::storedBytes(const VolumeHeader&) const
{
  return this->Numbers ? 0.0 : this->Stored.dataBytes();
}

std::string TextHeaderVolume::readAll(const Progress& progress, bool& stopped)
{
  auto numbers =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Stored.numberType));
  numbers->SetNumberOfComponents(static_cast<int>(this->Tuple));
  numbers->SetNumberOfTuples(
    static_cast<vtkIdType>(this->Stored.numberCount()) / static_cast<vtkIdType>(this->Tuple));
  const ShareDone hear = [&](double share) {
    stopped = stopped || !progress(share);
    return !stopped;
  };
  std::string problem =
    readNumbers(this->Stored, static_cast<char*>(numbers->GetVoidPointer(0)), hear);
  if (problem.empty() && !stopped)
  {
    this->Numbers = numbers;
  }
  return problem;
}

std::string TextHeaderVolume::load(
  std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  bool stopped = false;
  std::string problem = this->Numbers ? std::string() : this->readAll(progress, stopped);
  if (!problem.empty() || stopped)
  {
    return problem;
  }
  vtkSmartPointer<vtkDataArray> shown = this->Numbers;
  if (this->Steps > 1)
  {
    const vtkIdType count = shown->GetNumberOfValues() / static_cast<vtkIdType>(this->Steps);
    shown =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Stored.numberType));
    shown->SetNumberOfComponents(static_cast<int>(this->Tuple));
    constexpr int OwnedByNumbers = 1;
    shown->SetVoidArray(
      this->Numbers->GetVoidPointer(static_cast<vtkIdType>(volume) * count), count, OwnedByNumbers);
  }
  voxels.image = vtkSmartPointer<vtkImageData>::New();
  voxels.image->SetDimensions(this->Dimensions.x, this->Dimensions.y, this->Dimensions.z);
  voxels.image->GetPointData()->SetScalars(shown);
  voxels.firstComponent = this->TupleIsTime ? static_cast<int>(volume) : this->ShownLayer;
  const bool isSeries = this->Steps > 1 || (this->TupleIsTime && this->Tuple > 1);
  if (!isSeries)
  {
    this->Numbers = nullptr; // a series is kept: its next step comes from it
  }
  return {};
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
