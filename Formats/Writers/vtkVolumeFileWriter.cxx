// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeFileWriter.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Formats/DICOM/DerivedSegments.h"
#include "Formats/DICOM/DerivedSeries.h"
#include "Formats/Fields/FieldImage.h"
#include "Formats/Writers/LeftOut.h"
#include "Formats/Writers/WrittenVolume.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

using namespace brainshift;

vtkStandardNewMacro(vtkVolumeFileWriter);
brainshiftGuardRequestsMacro(vtkVolumeFileWriter);

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

void vtkVolumeFileWriter::WriteImage()
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  requireWhole(image, this->GetInputInformation(0, 0));
  throwIfAny(this->FileName.empty() ? "The name of the file to write is missing" : "");
  OutgoingVolume volume;
  std::string warning;
  takeOut(image, this->PointArray, static_cast<WorldAxes>(this->World), volume, warning);
  noteLeftOut(this->FileName, image, this->GetInputInformation(0, 0), volume, warning);
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
     << indent << "World: " << this->World << "\n";
}
