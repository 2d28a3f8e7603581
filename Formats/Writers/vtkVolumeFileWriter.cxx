// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeFileWriter.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Formats/DICOM/DerivedSegments.h"
#include "Formats/DICOM/DerivedSeries.h"
#include "Formats/Fields/FieldImage.h"
#include "Formats/Writers/LeftOut.h"
#include "Formats/Writers/WrittenVolume.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

using namespace brainshift;

vtkStandardNewMacro(vtkVolumeFileWriter);
brainshiftGuardRequestsMacro(vtkVolumeFileWriter);

namespace
{
// An array of the same type and components: the numbers themselves are not kept.
vtkSmartPointer<vtkDataArray> noneLike(vtkDataArray* array)
{
  auto none = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  none->SetNumberOfComponents(array->GetNumberOfComponents());
  return none;
}
}

int vtkVolumeFileWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkVolumeFileWriter::WriteData()
{
  this->Problem.clear();
  if (!isFirstRank())
  {
    return;
  }
  this->Problem = sentenceThrownBy(
    "File " + this->FileName + " cannot be written:", [this] { this->WriteImage(); });
  if (!this->Problem.empty())
  {
    vtkErrorMacro(<< this->Problem << ".");
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

int vtkVolumeFileWriter::ModifyRequest(vtkInformation* request, int when)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (when == vtkExecutive::BeforeForward && request->Has(Pipeline::REQUEST_UPDATE_EXTENT()))
  {
    guarded(this, [this] {
      if (this->IsInLayers())
      {
        updateExtent(this->GetInputInformation(0, 0), this->Layers().front());
      }
    });
  }
  return this->Superclass::ModifyRequest(request, when);
}

// Whether the image is asked for in layers.
bool vtkVolumeFileWriter::IsInLayers()
{
  vtkInformation* input = this->GetInputInformation(0, 0);
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  const bool isAlone = !ranks || ranks->GetNumberOfProcesses() == 1;
  return input && isAlone && this->Like.empty() && !isSegmentationName(this->FileName) &&
    !isSeriesName(this->FileName) && !isBestAskedWhole(input, this->MemoryLimit);
}

std::vector<Extent> vtkVolumeFileWriter::Layers()
{
  constexpr double bytesInMiB = 1048576.0;
  vtkInformation* input = this->GetInputInformation(0, 0);
  const Extent whole = wholeExtentOf(input);
  const double layers = whole[5] - whole[4] + 1.0;
  const double most =
    this->MemoryLimit * bytesInMiB / (pointsIn(whole) / layers * bytesOfPoint(input));
  const int step = static_cast<int>(std::clamp(most, 1.0, layers));
  std::vector<Extent> parts;
  for (Extent part = whole; part[4] <= whole[5]; part[4] += step)
  {
    part[5] = std::min(part[4] + step - 1, whole[5]);
    parts.push_back(part);
  }
  return parts;
}

// The input may have more than is needed.
OutgoingVolume vtkVolumeFileWriter::TakeLayers(const Extent& extent)
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  if (!holds(extentOf(image), extent))
  {
    bringPart(this->GetInputInformation(0, 0), extent);
  }
  vtkNew<vtkImageData> part;
  part->ShallowCopy(image);
  part->Crop(extent.data());
  OutgoingVolume volume;
  std::string warning; // that of the first layers
  takeOut(part, this->PointArray, static_cast<WorldAxes>(this->World), volume, warning);
  return volume;
}

void vtkVolumeFileWriter::WriteImage()
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  vtkInformation* input = this->GetInputInformation(0, 0);
  bool inLayers = this->IsInLayers();
  requirePart(image, inLayers ? this->Layers().front() : wholeExtentOf(input));
  throwIfAny(this->FileName.empty() ? "The name of the file to write is missing" : "");
  const auto world = static_cast<WorldAxes>(this->World);
  OutgoingVolume volume;
  std::string warning;
  takeOut(image, this->PointArray, world, volume, warning);
  if (inLayers && partsComponents(this->FileName, volume))
  {
    inLayers = false;
    bringPart(input, wholeExtentOf(input));
    warning.clear();
    takeOut(image, this->PointArray, world, volume, warning);
  }
  noteLeftOut(this->FileName, image, input, volume, warning);
  const bool isSegmentation = isSegmentationName(this->FileName);
  const bool isSeries = !isSegmentation && (!this->Like.empty() || isSeriesName(this->FileName));
  noteMeaningLeftOut(volume, isSeries, warning);
  volume.isField = saysField(image);
  const auto progress = [this](double fraction) {
    this->UpdateProgress(fraction);
    return !this->CheckAbort();
  };
  if (isSegmentation)
  {
    writeSegments(this->FileName, this->Like, { volume, attachedLabels(image) }, progress, warning);
  }
  else if (isSeries)
  {
    writeSeries(this->FileName, this->Like, volume, progress);
  }
  else if (inLayers)
  {
    volume.grid = outgoingGrid(image, wholeExtentOf(input).data(), world);
    volume.numbers = noneLike(volume.numbers);
    const std::vector<Extent> layers = this->Layers();
    const auto bring = [&](std::size_t number) { return this->TakeLayers(layers[number]); };
    writeLayers(this->FileName, volume, { layers.size(), bring }, progress);
  }
  else
  {
    writeVolume(this->FileName, volume, progress);
  }
  if (!warning.empty())
  {
    warn(this, std::string("File ") + this->FileName + ": " + warning);
  }
}

void vtkVolumeFileWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Like: " << this->Like << "\n"
     << indent << "PointArray: " << this->PointArray << "\n"
     << indent << "World: " << this->World << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
