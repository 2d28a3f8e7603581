// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMSegmentVolume.h"

#include "Formats/DICOM/DICOMPixels.h"
#include "Formats/Files/Text.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace brainshift
{
// Which segments share voxels. Voxels with the same segments have the same number: 0 has none.
class SegmentOverlaps
{
public:
  // The number of voxels that have one segment more.
  std::uint32_t with(std::uint32_t voxel, int segment)
  {
    const auto [known, isNew] =
      this->Next.insert({ { voxel, segment }, static_cast<std::uint32_t>(this->Sets.size()) });
    if (isNew)
    {
      if (this->Sets.size() > MostSets)
      {
        throw Problem("has voxels of more than " + std::to_string(MostSets) +
          " different groups of segments; save the segments in several files");
      }
      for (std::uint32_t set = voxel; set != 0; set = this->Sets[set].first)
      {
        this->Pairs.insert(std::minmax(this->Sets[set].second, segment));
      }
      this->Sets.emplace_back(voxel, segment);
    }
    return known->second;
  }

  bool share(int one, int other) const { return this->Pairs.count(std::minmax(one, other)) > 0; }

private:
  static constexpr std::size_t MostSets = 65536; // damaged files make any number
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> Next;
  std::vector<std::pair<std::uint32_t, int>> Sets{ { 0, 0 } }; // the set without its last segment
  std::set<std::pair<int, int>> Pairs;
};

namespace
{
Problem beyond(const DICOMFile& file, double number, double most)
{
  return Problem(joined(
    file.path, " has the number ", number, " in a frame of a segment; it may ", "have ", most));
}
}

DICOMSegmentVolume::DICOMSegmentVolume(DICOMFile file, const Progress& progress)
  : File(std::move(file))
  , Grid(segmentGridOf(this->File))
  , StoredType(storedTypeOf(this->File.pixels))
  , Type(this->StoredType)
{
  if (this->File.segments.kind == SegmentKind::Binary)
  {
    int most = 0;
    for (const Label& label : this->File.segments.labels)
    {
      most = std::max(most, label.value);
    }
    this->Type = most > 255 ? VTK_UNSIGNED_SHORT : VTK_UNSIGNED_CHAR;
  }
  this->findLayers(progress);
}

template <typename Number, typename Use>
bool DICOMSegmentVolume::visit(const Frames& frames, const Progress& progress, const Use& use) const
{
  const std::size_t pixels =
    static_cast<std::size_t>(this->File.rows) * static_cast<std::size_t>(this->File.columns);
  const std::size_t atOnce =
    std::max<std::size_t>(1, static_cast<std::size_t>(BytesAtOnce) / (pixels * sizeof(Number)));
  std::vector<Number> numbers(std::min(atOnce, frames.size()) * pixels);
  for (std::size_t first = 0; first < frames.size(); first += atOnce)
  {
    const std::size_t last = std::min(first + atOnce, frames.size());
    std::vector<DICOMTarget> targets;
    for (std::size_t i = first; i < last; ++i)
    {
      targets.push_back({ &this->File.frames[frames[i]], &numbers[(i - first) * pixels] });
    }
    readDICOMPixels(this->File, targets, this->StoredType);
    for (std::size_t i = first; i < last; ++i)
    {
      use(frames[i], &numbers[(i - first) * pixels]);
    }
    if (!progress(static_cast<double>(last) / static_cast<double>(frames.size())))
    {
      return false;
    }
  }
  return true;
}

void DICOMSegmentVolume::findOverlaps(const Progress& progress, SegmentOverlaps& overlaps) const
{
  std::map<int, Frames> ofSlice;
  for (std::size_t i = 0; i < this->File.frames.size(); ++i)
  {
    ofSlice[this->Grid.sliceOfFrame[i]].push_back(i);
  }
  Frames shared; // frames of slices with several segments, slice after slice
  for (const auto& slice : ofSlice)
  {
    if (slice.second.size() > 1)
    {
      shared.insert(shared.end(), slice.second.begin(), slice.second.end());
    }
  }
  std::vector<std::uint32_t> voxels;
  int slice = -1;
  const bool isWhole = this->visit<unsigned char>(
    shared, progress, [&](std::size_t frame, const unsigned char* numbers) {
      const std::size_t pixels =
        static_cast<std::size_t>(this->File.rows) * static_cast<std::size_t>(this->File.columns);
      if (this->Grid.sliceOfFrame[frame] != slice)
      {
        slice = this->Grid.sliceOfFrame[frame];
        voxels.assign(pixels, 0);
      }
      for (std::size_t i = 0; i < pixels; ++i)
      {
        voxels[i] =
          numbers[i] ? overlaps.with(voxels[i], this->File.frames[frame].segment) : voxels[i];
      }
    });
  throwIfAny(isWhole ? "" : "was not read to its end: reading was stopped");
}

void DICOMSegmentVolume::findLayers(const Progress& progress)
{
  const SegmentKind kind = this->File.segments.kind;
  const std::vector<Label>& labels = this->File.segments.labels;
  if (kind != SegmentKind::Binary)
  {
    const bool isOne = kind == SegmentKind::LabelMap;
    this->Layers.resize(isOne ? 1 : labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      this->Layers[isOne ? 0 : i].push_back(labels[i].value);
    }
    return;
  }
  SegmentOverlaps overlaps;
  this->findOverlaps(progress, overlaps);
  for (const Label& label : labels)
  {
    const auto free =
      std::find_if(this->Layers.begin(), this->Layers.end(), [&](const std::vector<int>& layer) {
        return std::none_of(layer.begin(), layer.end(),
          [&](int other) { return overlaps.share(other, label.value); });
      });
    if (free == this->Layers.end())
    {
      this->Layers.push_back({ label.value });
    }
    else
    {
      free->push_back(label.value);
    }
  }
}

std::string DICOMSegmentVolume::namesOf(std::size_t layer, bool outside) const
{
  constexpr std::size_t Most = 5;
  std::size_t count = 0;
  std::string names;
  const std::vector<int>& inside = this->Layers[layer];
  for (const Label& label : this->File.segments.labels)
  {
    const bool isInside = std::find(inside.begin(), inside.end(), label.value) != inside.end();
    if (isInside != outside && ++count <= Most)
    {
      names += (count > 1 ? ", " : "") + label.name;
    }
  }
  return names + (count > Most ? " and others" : "");
}

std::vector<std::string> DICOMSegmentVolume::layerNames() const
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < this->Layers.size() && this->Layers.size() > 1; ++i)
  {
    names.push_back(
      joined("layer ", i + 1, " of ", this->Layers.size(), ": ", this->namesOf(i, false)));
  }
  return names;
}

std::string DICOMSegmentVolume::namesOutside(std::size_t layer) const
{
  return this->namesOf(layer, true);
}

void DICOMSegmentVolume::describe(std::size_t layer, VolumeHeader& header) const
{
  const DICOMSegments& segments = this->File.segments;
  header.worldFromVoxel = this->Grid.worldFromVoxel;
  header.dimensions = glm::ivec3(this->File.columns, this->File.rows, this->Grid.slices);
  header.storedType = this->Type;
  header.warnings = this->Grid.warnings;
  if (segments.kind == SegmentKind::Fractional)
  {
    header.rescaling.slope = 1.0 / segments.most;
    return;
  }
  header.isLabelMap = true;
  for (const Label& label : segments.labels)
  {
    const std::vector<int>& inside = this->Layers[layer];
    if (std::find(inside.begin(), inside.end(), label.value) != inside.end())
    {
      header.labels.push_back(label);
    }
  }
}

template <typename Number>
bool DICOMSegmentVolume::paint(
  std::size_t layer, const Progress& progress, vtkImageData* image) const
{
  const SegmentKind kind = this->File.segments.kind;
  const std::vector<int>& inside = this->Layers[layer];
  Frames frames;
  for (std::size_t i = 0; i < this->File.frames.size(); ++i)
  {
    const int segment = this->File.frames[i].segment;
    const bool isInside = std::find(inside.begin(), inside.end(), segment) != inside.end();
    if (kind == SegmentKind::LabelMap || isInside)
    {
      frames.push_back(i);
    }
  }
  const std::size_t pixels =
    static_cast<std::size_t>(this->File.rows) * static_cast<std::size_t>(this->File.columns);
  const auto paintFrame = [&](std::size_t frame, const auto* numbers) {
    auto* to = static_cast<Number*>(image->GetScalarPointer(0, 0, this->Grid.sliceOfFrame[frame]));
    const double most = kind == SegmentKind::LabelMap ? HUGE_VAL : this->File.segments.most;
    for (std::size_t i = 0; i < pixels; ++i)
    {
      if (numbers[i] > most)
      {
        throw beyond(this->File, numbers[i], most);
      }
      const auto number = static_cast<Number>(
        kind == SegmentKind::Binary ? this->File.frames[frame].segment : numbers[i]);
      to[i] = numbers[i] || kind == SegmentKind::LabelMap ? number : to[i];
    }
  };
  return this->StoredType == VTK_UNSIGNED_SHORT
    ? this->visit<unsigned short>(frames, progress, paintFrame)
    : this->visit<unsigned char>(frames, progress, paintFrame);
}

void DICOMSegmentVolume::load(
  std::size_t layer, const Progress& progress, StoredVoxels& voxels) const
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(this->File.columns, this->File.rows, this->Grid.slices);
  image->AllocateScalars(this->Type, 1);
  image->GetPointData()->GetScalars()->Fill(this->File.segments.background);
  const bool isWhole = this->Type == VTK_UNSIGNED_SHORT
    ? this->paint<unsigned short>(layer, progress, image)
    : this->paint<unsigned char>(layer, progress, image);
  voxels.image = isWhole ? image : nullptr;
}
}
