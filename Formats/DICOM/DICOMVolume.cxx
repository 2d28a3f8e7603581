// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes in DICOM: series of slices, and multi-frame files.
#include "Common/Parallel.h"
#include "Formats/DICOM/DICOMColors.h"
#include "Formats/DICOM/DICOMFolder.h"
#include "Formats/DICOM/DICOMFrames.h"
#include "Formats/DICOM/DICOMPixels.h"
#include "Formats/DICOM/DICOMSegmentVolume.h"
#include "Formats/DICOM/DICOMStack.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>
#include <type_traits>
#include <utility>

namespace brainshift
{
namespace
{
// One image as it lies on the grid.
template <typename T>
struct Placed
{
  const T* numbers = nullptr;
  int columns = 0;
  int rows = 0;
  DICOMShift shift;
  double outside = 0.0;

  double at(int column, int row) const
  {
    const bool isInside = column >= 0 && row >= 0 && column < this->columns && row < this->rows;
    return isInside
      ? static_cast<double>(
          this->numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(this->columns) +
            static_cast<std::size_t>(column)])
      : this->outside;
  }

  // At a point of the grid, bilinear.
  double onGrid(int column, int row) const
  {
    const double x = column - this->shift.columns;
    const double y = row - this->shift.rows;
    const int left = static_cast<int>(std::floor(x));
    const int below = static_cast<int>(std::floor(y));
    const double alongX = x - left;
    const double alongY = y - below;
    const double first =
      (1.0 - alongX) * this->at(left, below) + alongX * this->at(left + 1, below);
    return alongY == 0.0 ? first
                         : (1.0 - alongY) * first +
        alongY *
          ((1.0 - alongX) * this->at(left, below + 1) + alongX * this->at(left + 1, below + 1));
  }
};

template <typename T>
void makeUprightOf(const DICOMResampling& resampling, vtkImageData* images, vtkImageData* grid)
{
  int size[3];
  images->GetDimensions(size);
  const std::size_t count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  const auto* from = static_cast<const T*>(images->GetScalarPointer());
  const double least = images->GetPointData()->GetScalars()->GetRange()[0];
  const auto placed = [&](std::size_t image) {
    return Placed<T>{ from + image * count, size[0], size[1], resampling.shifts[image], least };
  };
  const auto slices = static_cast<std::int64_t>(resampling.slices.size());
  parallelFor(0, slices, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t z = begin; z < end; ++z)
    {
      const DICOMSlice& slice = resampling.slices[z];
      const Placed<T> lower = placed(slice.lower);
      const Placed<T> upper = placed(slice.lower + 1);
      auto* to = static_cast<T*>(grid->GetScalarPointer(0, 0, static_cast<int>(z)));
      for (int row = 0; row < resampling.rows; ++row)
      {
        for (int column = 0; column < resampling.columns; ++column)
        {
          const double mixed = slice.lowerWeight * lower.onGrid(column, row) +
            (1.0 - slice.lowerWeight) * upper.onGrid(column, row);
          *to++ = static_cast<T>(std::is_integral_v<T> ? std::round(mixed) : mixed);
        }
      }
    }
  });
}

// Fills `grid` from `images`, one slice for each image: linear between columns, rows and slices.
// Whole numbers are rounded. Where no image lies, the grid has the least number of all images.
//
// @param grid   allocated, with the size that `resampling` has and the type of the images
void makeUpright(const DICOMResampling& resampling, vtkImageData* images, vtkImageData* grid)
{
  switch (images->GetScalarType())
  {
    vtkTemplateMacro(makeUprightOf<VTK_TT>(resampling, images, grid));
  }
}

constexpr std::int64_t PartsAtOnce = 16; // between two calls of progress

// Frames of one file that one thread reads.
using Part = std::vector<DICOMTarget>;

// Plain frames can be read one by one; packed ones and tiles with all others of their file.
std::vector<Part> partsOf(
  const DICOMFolder& folder, const std::vector<DICOMFrame>& frames, vtkImageData* image)
{
  std::vector<Part> parts;
  std::map<std::size_t, std::size_t> packed; // from the file to its part
  for (std::size_t z = 0; z < frames.size(); ++z)
  {
    const DICOMTarget target{ &frames[z], image->GetScalarPointer(0, 0, static_cast<int>(z)) };
    const DICOMFile& file = folder.files[frames[z].file];
    const bool isPlain = file.pixels.isPlain && file.tiles == glm::ivec2(1);
    const auto [known, isNew] = packed.insert({ frames[z].file, parts.size() });
    if (isPlain || isNew)
    {
      parts.push_back({ target });
    }
    else
    {
      parts[known->second].push_back(target);
    }
  }
  return parts;
}

vtkSmartPointer<vtkImageData> imageOf(const glm::ivec3& sides, int type, int components = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(sides.x, sides.y, sides.z);
  image->AllocateScalars(type, components);
  return image;
}

constexpr const char* LayerWord = ", layer "; // after the name of a series of segments

// A file name may name a folder.
class DICOMVolume : public VolumeFile
{
public:
  std::string noun() const override { return "DICOM series"; }
  void readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  Loads loads() const override;
  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  // The choices are the series of a folder.
  std::vector<std::string> choices() const override;
  void choose(const std::string& series) override { this->Series = series; }

  void setResampling(SliceResampling resampling) override { this->Resampling = resampling; }
  void setLuminance(bool luminance) override { this->Luminance = luminance; }
  void setScanProgress(const Progress& progress) override { this->ScanProgress = progress; }
  std::string firstFile() const override;

private:
  // Refuses a file that holds no image, unless a series beside it was asked for.
  void requireImage(const DICOMFolder& folder);
  // The series that was asked for; the end if there is none.
  std::vector<DICOMSeries>::const_iterator chosenOf(const std::vector<DICOMSeries>& all) const;
  // Lays out the segments of a series. Its name in the list becomes those of its layers.
  void readSegments(DICOMSeries chosen, VolumeHeader& header);
  // Chooses the type of the numbers.
  void decideType(VolumeHeader& header);
  // Fills an image with one volume; drops it if `progress` says stop.
  void readImages(const std::vector<DICOMFrame>& frames, const Progress& progress,
    vtkSmartPointer<vtkImageData>& image) const;

  std::string Series;
  SliceResampling Resampling = SliceResampling::WhereNeeded;
  bool Luminance = false; // of colours
  Progress ScanProgress;
  DICOMFolder Folder;
  DICOMStack Stack;
  std::unique_ptr<DICOMSegmentVolume> Segments; // null: the series is none of segments
  std::size_t Layer = 0;                        // of them
  int StoredType = VTK_VOID;                    // VTK_FLOAT: numbers are rescaled as they are read
};

std::vector<std::string> DICOMVolume::choices() const
{
  std::vector<std::string> names;
  names.reserve(this->Folder.series.size());
  for (const DICOMSeries& series : this->Folder.series)
  {
    names.push_back(series.name);
  }
  return names;
}

std::string DICOMVolume::firstFile() const
{
  const bool hasImage = !this->Stack.volumes.empty() && !this->Stack.volumes.front().empty();
  const std::size_t file = hasImage ? this->Stack.volumes.front().front().file : 0;
  return hasImage && file < this->Folder.files.size() ? this->Folder.files[file].path
                                                      : std::string();
}

void DICOMVolume::requireImage(const DICOMFolder& folder)
{
  if (!folder.noImage.empty() && this->Series.empty())
  {
    // No series is offered: ParaView would write the first into the property, and show it.
    this->Folder = DICOMFolder();
    throw Problem(folder.noImage +
      (folder.series.empty() ? ""
                             : ". The folder has " + std::to_string(folder.series.size()) +
            " series of images; open a file of one of them"));
  }
}

std::vector<DICOMSeries>::const_iterator DICOMVolume::chosenOf(
  const std::vector<DICOMSeries>& all) const
{
  const auto named = std::find_if(all.begin(), all.end(), [this](const DICOMSeries& series) {
    const std::string layer = series.name + LayerWord;
    return series.name == this->Series || this->Series.compare(0, layer.size(), layer) == 0;
  });
  // Older states name what is parted now.
  const auto whole = std::find_if(all.begin(), all.end(),
    [this](const DICOMSeries& series) { return series.wholeName == this->Series; });
  return this->Series.empty() ? all.begin() : named == all.end() ? whole : named;
}

// What is to be said of the files of a series, and of images of it that are not shown.
void warnOfFiles(
  const DICOMFolder& folder, const DICOMSeries& chosen, std::vector<std::string>& warnings)
{
  const DICOMFile& first = folder.files[chosen.frames.front().file];
  std::set<std::string> spaces;
  for (const DICOMFrame& frame : chosen.frames)
  {
    const DICOMFile& file = folder.files[frame.file];
    spaces.insert(file.space);
    std::for_each(file.notes.begin(), file.notes.end(),
      [&warnings](const std::string& note) { addNote(warnings, note); });
  }
  if (spaces.size() > 1 && chosen.frames.front().isPlaced)
  {
    warnings.push_back("has images of " + std::to_string(spaces.size()) +
      " frames of reference (FrameOfReferenceUID), whose positions are shown as if they were one");
  }
  std::size_t unplaced = 0;
  std::vector<const DICOMFile*> refused;
  for (const DICOMFile& file : folder.files)
  {
    const bool isOfSeries = file.series == first.series;
    unplaced += isOfSeries && file.problem.empty() && !file.frames.front().isPlaced ? 1 : 0;
    if (isOfSeries && !file.problem.empty())
    {
      refused.push_back(&file);
    }
  }
  if (unplaced > 0 && chosen.frames.front().isPlaced)
  {
    warnings.push_back("has images without a position (ImagePositionPatient, "
                       "ImageOrientationPatient), which are another entry of its list: " +
      std::to_string(unplaced));
  }
  if (!chosen.setting.empty())
  {
    warnings.push_back("has images of several settings at several times; each setting is another "
                       "entry of its list, and this one has " +
      chosen.setting);
  }
  const std::vector<std::string> parted = partedNotes(folder, chosen);
  warnings.insert(warnings.end(), parted.begin(), parted.end());
  if (!refused.empty())
  {
    warnings.push_back("has images that cannot be read and are left out: " +
      std::to_string(refused.size()) + ", the first because it " + refused.front()->problem);
  }
  if (folder.damaged > 0)
  {
    warnings.push_back(
      "has files that are damaged and left out: " + std::to_string(folder.damaged));
  }
}

void DICOMVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  std::error_code error;
  if (!std::filesystem::exists(fileName, error))
  {
    this->Folder = DICOMFolder();
    throw Problem("does not exist");
  }
  DICOMFolder folder = readDICOMFolder(
    fileName, this->ScanProgress ? this->ScanProgress : [](double) { return true; });
  if (folder.isStopped)
  {
    throw Problem("was not read to its end: reading was stopped");
  }
  this->requireImage(folder);
  this->Folder = std::move(folder);
  for (DICOMFile& file : this->Folder.files)
  {
    file.pixels.asLuminance = this->Luminance;
  }
  const std::vector<DICOMSeries>& all = this->Folder.series;
  if (all.empty())
  {
    throw Problem("is neither a DICOM image nor a folder with DICOM images");
  }
  const auto chosen = this->chosenOf(all);
  if (chosen == all.end())
  {
    throw Problem("has no series \"" + this->Series + "\"; it has " + std::to_string(all.size()) +
      ", the first is \"" + all.front().name + "\"; choose one of them as Series");
  }
  const DICOMFile& file = this->Folder.files[chosen->frames.front().file];
  throwIfAny(file.problem);
  this->Segments.reset();
  withBeginning("cannot be read: ", [&] {
    for (const DICOMFrame& frame : chosen->frames)
    {
      requirePixelData(this->Folder.files[frame.file]);
    }
  });
  if (file.segments.kind != SegmentKind::None)
  {
    this->readSegments(*chosen, header);
    return;
  }
  // Colours are not interpolated: nothing is between two entries of a palette.
  const bool areColors = componentsOf(file.pixels) > 1;
  this->Stack = stackOf(
    this->Folder.files, chosen->frames, areColors ? SliceResampling::Never : this->Resampling);
  header.worldFromVoxel = this->Stack.worldFromVoxel;
  const DICOMResampling& upright = this->Stack.resampling;
  header.dimensions = upright.slices.empty()
    ? glm::ivec3(file.columns, file.rows, static_cast<int>(this->Stack.volumes.front().size()))
    : glm::ivec3(upright.columns, upright.rows, static_cast<int>(upright.slices.size()));
  header.times = this->Stack.times;
  header.knowsSides = this->Stack.knowsSides;
  header.warnings = this->Stack.warnings;
  warnOfFiles(this->Folder, *chosen, header.warnings);
  this->decideType(header);
}

void DICOMVolume::readSegments(DICOMSeries chosen, VolumeHeader& header)
{
  this->Stack = DICOMStack();
  this->Stack.volumes = { { chosen.frames.front() } };
  const Progress scanProgress =
    this->ScanProgress ? this->ScanProgress : [](double) { return true; };
  this->Segments = std::make_unique<DICOMSegmentVolume>(
    this->Folder.files[chosen.frames.front().file], scanProgress);
  const std::vector<std::string> layers = this->Segments->layerNames();
  std::vector<DICOMSeries>& all = this->Folder.series;
  auto place = std::find_if(all.begin(), all.end(),
    [&chosen](const DICOMSeries& series) { return series.name == chosen.name; });
  this->Layer = 0;
  bool isNamed = this->Series.empty() || this->Series == chosen.name;
  const bool isChosen = !isNamed;
  for (std::size_t i = 0; i < layers.size(); ++i)
  {
    DICOMSeries layer = chosen;
    layer.name = chosen.name + ", " + layers[i];
    layer.wholeName = chosen.name;
    this->Layer = layer.name == this->Series ? i : this->Layer;
    isNamed = isNamed || layer.name == this->Series;
    place = i == 0 ? place : all.insert(place + 1, layer);
    *place = layer;
  }
  if (!isNamed)
  {
    throw Problem("has no series \"" + this->Series + "\"; the segmentation \"" + chosen.name +
      "\" has " + (layers.empty() ? "one layer" : std::to_string(layers.size()) + " layers") +
      "; choose one of them as Series");
  }
  this->Segments->describe(this->Layer, header);
  if (layers.size() > 1 && !isChosen)
  {
    header.warnings.push_back("has " + std::to_string(layers.size()) +
      " layers of segments; layer 1 is shown, without " + this->Segments->namesOutside(0) +
      "; Series chooses another one");
  }
  warnOfFiles(this->Folder, chosen, header.warnings);
}

void DICOMVolume::decideType(VolumeHeader& header)
{
  const DICOMFrame& first = this->Stack.volumes.front().front();
  const int type = storedTypeOf(this->Folder.files[first.file].pixels);
  bool isOne = true;
  for (const std::vector<DICOMFrame>& volume : this->Stack.volumes)
  {
    for (const DICOMFrame& frame : volume)
    {
      isOne = isOne && storedTypeOf(this->Folder.files[frame.file].pixels) == type &&
        frame.rescaling.slope == first.rescaling.slope &&
        frame.rescaling.intercept == first.rescaling.intercept;
    }
  }
  if (!isOne && vtkDataArray::GetDataTypeSize(type) > 2 && type != VTK_FLOAT)
  {
    header.warnings.emplace_back("has numbers of more than 16 bits in images that are rescaled in "
                                 "different ways; they are shown with the 7 digits of float32");
  }
  this->StoredType = isOne ? type : VTK_FLOAT;
  header.storedType = this->StoredType;
  if (this->Folder.files[first.file].pixels.colors != DICOMColors::None)
  {
    this->StoredType = header.storedType = VTK_UNSIGNED_CHAR;
    header.components = componentsOf(this->Folder.files[first.file].pixels);
    return;
  }
  header.unit = first.unit;
  header.smallIsBright = this->Folder.files[first.file].smallIsBright;
  // Numbers that are read as float32 are rescaled image by image.
  header.rescaling = this->StoredType == VTK_FLOAT ? Rescaling() : first.rescaling;
}

double DICOMVolume::storedBytes(const VolumeHeader& header) const
{
  if (this->Segments)
  {
    return VolumeFile::storedBytes(header) + DICOMSegmentVolume::BytesAtOnce;
  }
  // Images as they are read, the grid that is made of them, and decoded files of many frames.
  const DICOMFile& file = this->Folder.files[this->Stack.volumes.front().front().file];
  const double numberBytes = vtkDataArray::GetDataTypeSize(header.storedType) * header.components;
  double images = static_cast<double>(this->Stack.volumes.front().size());
  images += file.pixels.isPlain && file.tiles == glm::ivec2(1)
    ? 0.0
    : 2.0 * static_cast<double>(file.frames.size());
  const bool isResampled = !this->Stack.resampling.slices.empty();
  return numberBytes * images * file.columns * file.rows +
    (isResampled ? VolumeFile::storedBytes(header) : 0.0);
}

// A file of packed frames is unpacked as a whole, and upright slices come from all slices.
Loads DICOMVolume::loads() const
{
  const DICOMFile& file = this->Folder.files[this->Stack.volumes.front().front().file];
  const bool isSliceAlone =
    file.frames.size() == 1 || (file.pixels.isPlain && file.tiles == glm::ivec2(1));
  return this->Segments || !this->Stack.resampling.slices.empty() || !isSliceAlone ? Loads::All
                                                                                   : Loads::Slices;
}

void DICOMVolume::readImages(const std::vector<DICOMFrame>& frames, const Progress& progress,
  vtkSmartPointer<vtkImageData>& image) const
{
  const std::vector<Part> parts = partsOf(this->Folder, frames, image);
  const auto count = static_cast<std::int64_t>(parts.size());
  std::vector<std::string> problems(parts.size());
  for (std::int64_t first = 0; first < count; first += PartsAtOnce)
  {
    const std::int64_t last = std::min(first + PartsAtOnce, count);
    parallelFor(first, last, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const DICOMFile& file = this->Folder.files[parts[i].front().frame->file];
        problems[i] = problemOf([&] { readDICOMPixels(file, parts[i], this->StoredType); });
      }
    });
    std::for_each(problems.begin() + first, problems.begin() + last, throwIfAny);
    if (!progress(static_cast<double>(last) / static_cast<double>(count)))
    {
      image = nullptr;
      return;
    }
  }
}

void DICOMVolume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  if (this->Segments)
  {
    this->Segments->load(this->Layer, progress, voxels);
    return;
  }
  const std::vector<DICOMFrame>& all = this->Stack.volumes[volume];
  const DICOMFile& file = this->Folder.files[all.front().file];
  const bool isPart = this->loads() == Loads::Slices;
  const int first = isPart ? voxels.wanted[4] : 0;
  const int end = isPart ? voxels.wanted[5] + 1 : static_cast<int>(all.size());
  const std::vector<DICOMFrame> frames(all.begin() + first, all.begin() + std::max(first, end));
  vtkSmartPointer<vtkImageData> image =
    imageOf({ file.columns, file.rows, end - first }, this->StoredType, componentsOf(file.pixels));
  this->readImages(frames, progress, image);
  if (!image)
  {
    return;
  }
  image->SetExtent(0, file.columns - 1, 0, file.rows - 1, first, end - 1);
  voxels.image = image;
  const DICOMResampling& upright = this->Stack.resampling;
  if (!upright.slices.empty())
  {
    voxels.image = imageOf(
      { upright.columns, upright.rows, static_cast<int>(upright.slices.size()) }, this->StoredType);
    makeUpright(upright, image, voxels.image);
  }
}

}

extern const VolumeFormat VolumesOfDICOM{ "DICOM", leadsToDICOM, makeVolumeFile<DICOMVolume> };
}
