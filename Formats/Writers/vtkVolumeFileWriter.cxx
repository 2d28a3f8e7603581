// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeFileWriter.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Formats/DICOM/DerivedSeries.h"
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
  const std::string thrown = thrownBy([this] { this->Problem = this->WriteImage(); });
  if (!thrown.empty())
  {
    this->Problem = "File " + this->FileName + " cannot be written: " + thrown;
  }
  if (!this->Problem.empty())
  {
    vtkErrorMacro(<< this->Problem << ".");
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

std::string vtkVolumeFileWriter::WriteImage()
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  std::string problem = problemOfPart(image, this->GetInputInformation(0, 0));
  if (problem.empty() && this->FileName.empty())
  {
    problem = "The name of the file to write is missing";
  }
  OutgoingVolume volume;
  std::string warning;
  problem = problem.empty()
    ? takeOut(image, this->PointArray, static_cast<WorldAxes>(this->World), volume, warning)
    : problem;
  if (!problem.empty())
  {
    return problem;
  }
  const auto progress = [this](double share) {
    this->UpdateProgress(share);
    return !this->CheckAbort();
  };
  const bool isSeries = !this->Like.empty() || isSeriesName(this->FileName);
  problem = isSeries ? writeSeries(this->FileName, this->Like, volume, progress)
                     : writeVolume(this->FileName, volume, progress);
  if (problem.empty() && !warning.empty())
  {
    vtkWarningMacro(<< "File " << this->FileName << ": " << warning << ".");
  }
  return problem;
}

void vtkVolumeFileWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Like: " << this->Like << "\n"
     << indent << "PointArray: " << this->PointArray << "\n"
     << indent << "World: " << this->World << "\n";
}
