// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMVolume.h"

#include "Common/Parallel.h"
#include "Formats/DICOM/DICOMDirectory.h"
#include "Formats/DICOM/DICOMPixels.h"
#include "Formats/DICOM/DICOMUpright.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::int64_t PartsAtOnce = 16; // between two calls of progress

// Frames of one file that one thread reads.
using Part = std::vector<DICOMTarget>;

// Plain frames can be read one by one; packed ones are decoded with all others of their file.
std::vector<Part> partsOf(
  const DICOMFolder& folder, const std::vector<DICOMFrame>& frames, vtkImageData* image)
{
  std::vector<Part> parts;
  std::map<std::size_t, std::size_t> packed; // from the file to its part
  for (std::size_t z = 0; z < frames.size(); ++z)
  {
    const DICOMTarget target{ &frames[z], image->GetScalarPointer(0, 0, static_cast<int>(z)) };
    const bool isPlain = folder.files[frames[z].file].pixels.isPlain;
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

vtkSmartPointer<vtkImageData> imageOf(int columns, int rows, std::size_t slices, int type)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, static_cast<int>(slices));
  image->AllocateScalars(type, 1);
  return image;
}
}

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

std::string DICOMVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  std::error_code error;
  if (!std::filesystem::exists(fileName, error))
  {
    this->Folder = DICOMFolder();
    return "does not exist";
  }
  DICOMFolder folder = readDICOMFolder(
    fileName, this->ScanProgress ? this->ScanProgress : [](double) { return true; });
  if (folder.isStopped)
  {
    return "was not read to its end: reading was stopped";
  }
  this->Folder = std::move(folder);
  const std::vector<DICOMSeries>& all = this->Folder.series;
  if (all.empty())
  {
    return "is neither a DICOM image nor a folder with DICOM images";
  }
  const auto chosen = this->Series.empty()
    ? all.begin()
    : std::find_if(all.begin(), all.end(),
        [this](const DICOMSeries& series) { return series.name == this->Series; });
  if (chosen == all.end())
  {
    return "has no series \"" + this->Series + "\"; it has " + std::to_string(all.size()) +
      ", the first is \"" + all.front().name + "\"";
  }
  const DICOMFile& file = this->Folder.files[chosen->frames.front().file];
  if (!file.problem.empty())
  {
    return file.problem;
  }
  for (const DICOMFrame& frame : chosen->frames)
  {
    const std::string problem = pixelDataProblem(this->Folder.files[frame.file]);
    if (!problem.empty())
    {
      return "cannot be read: " + problem;
    }
  }
  this->Stack = stackOf(this->Folder.files, chosen->frames, this->Resamples);
  header.worldFromVoxel = this->Stack.worldFromVoxel;
  const DICOMResampling& upright = this->Stack.resampling;
  header.dimensions = upright.slices.empty()
    ? glm::ivec3(file.columns, file.rows, static_cast<int>(this->Stack.volumes.front().size()))
    : glm::ivec3(upright.columns, upright.rows, static_cast<int>(upright.slices.size()));
  header.times = this->Stack.times;
  header.knowsSides = this->Stack.knowsSides;
  header.warnings = this->Stack.warnings;
  if (this->Folder.damaged > 0)
  {
    header.warnings.push_back(
      "has files that are damaged and left out: " + std::to_string(this->Folder.damaged));
  }
  this->decideType(header);
  return {};
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
  this->StoredType = isOne ? type : VTK_FLOAT;
  header.storedType = this->StoredType;
  header.rescaling = isOne ? first.rescaling : Rescaling();
}

double DICOMVolume::storedBytes(const VolumeHeader& header) const
{
  // Images as they are read, the grid that is made of them, and decoded files of many frames.
  const DICOMFile& file = this->Folder.files[this->Stack.volumes.front().front().file];
  const double numberBytes = vtkDataArray::GetDataTypeSize(header.storedType);
  double images = static_cast<double>(this->Stack.volumes.front().size());
  images += file.pixels.isPlain ? 0.0 : 2.0 * static_cast<double>(file.frames.size());
  const bool isResampled = !this->Stack.resampling.slices.empty();
  return numberBytes * images * file.columns * file.rows +
    (isResampled ? VolumeFile::storedBytes(header) : 0.0);
}

std::string DICOMVolume::readImages(
  std::size_t volume, const Progress& progress, vtkSmartPointer<vtkImageData>& image) const
{
  const std::vector<Part> parts = partsOf(this->Folder, this->Stack.volumes[volume], image);
  const auto count = static_cast<std::int64_t>(parts.size());
  std::vector<std::string> problems(parts.size());
  for (std::int64_t first = 0; first < count; first += PartsAtOnce)
  {
    const std::int64_t last = std::min(first + PartsAtOnce, count);
    parallelFor(first, last, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const DICOMFile& file = this->Folder.files[parts[i].front().frame->file];
        problems[i] = readDICOMPixels(file, parts[i], this->StoredType);
      }
    });
    const auto problem = std::find_if(problems.begin() + first, problems.begin() + last,
      [](const std::string& text) { return !text.empty(); });
    if (problem != problems.begin() + last)
    {
      return *problem;
    }
    if (!progress(static_cast<double>(last) / static_cast<double>(count)))
    {
      image = nullptr;
      return {};
    }
  }
  return {};
}

std::string DICOMVolume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  const std::vector<DICOMFrame>& frames = this->Stack.volumes[volume];
  const DICOMFile& file = this->Folder.files[frames.front().file];
  vtkSmartPointer<vtkImageData> image =
    imageOf(file.columns, file.rows, frames.size(), this->StoredType);
  const std::string problem = this->readImages(volume, progress, image);
  if (!problem.empty() || !image)
  {
    return problem;
  }
  voxels.image = image;
  const DICOMResampling& upright = this->Stack.resampling;
  if (!upright.slices.empty())
  {
    voxels.image = imageOf(upright.columns, upright.rows, upright.slices.size(), this->StoredType);
    makeUpright(upright, image, voxels.image);
  }
  return {};
}

extern const VolumeFormat VolumesOfDICOM{ "DICOM", leadsToDICOM, makeVolumeFile<DICOMVolume> };
}
