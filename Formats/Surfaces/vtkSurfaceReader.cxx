// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceReader.h"

#include "Common/Guard.h"
#include "Formats/Surfaces/SurfaceData.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkSurfaceReader);
brainshiftGuardRequestsMacro(vtkSurfaceReader);

vtkSurfaceReader::vtkSurfaceReader()
{
  this->SetNumberOfInputPorts(0);
}

void vtkSurfaceReader::AddValueFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->ValueFileNames.emplace_back(fileName);
    this->Modified();
  }
}

void vtkSurfaceReader::ClearValueFileNames()
{
  if (!this->ValueFileNames.empty())
  {
    this->ValueFileNames.clear();
    this->Modified();
  }
}

int vtkSurfaceReader::CanReadFile(const char* fileName)
{
  bool isOne = false;
  const std::string thrown = thrownBy([&] { isOne = fileName && isSurfaceFile(fileName); });
  return thrown.empty() && isOne ? 1 : 0;
}

int vtkSurfaceReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* information = outputs->GetInformationObject(0);
  if (information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1; // the first piece has all triangles
  }
  if (this->FileName.empty())
  {
    throw Problem("FileName is empty; it must name a surface");
  }
  const auto progress = [this](double fraction) {
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute();
  };
  const glm::dvec3 center(this->VolumeCenter[0], this->VolumeCenter[1], this->VolumeCenter[2]);
  Surface surface;
  std::vector<std::string> warnings;
  readSurfaceFiles({ this->FileName, this->ValueFileNames, { this->Volume, center } }, progress,
    surface, warnings);
  for (const std::string& warning : warnings)
  {
    warn(this, warning);
  }
  if (surface.points.empty())
  {
    return 0; // stopped
  }
  setSurface(vtkPolyData::GetData(information), surface);
  return 1;
}

void vtkSurfaceReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "ValueFileNames: " << this->ValueFileNames.size() << "\n"
     << indent << "Volume: " << this->Volume << "\n"
     << indent << "VolumeCenter: " << this->VolumeCenter[0] << " " << this->VolumeCenter[1] << " "
     << this->VolumeCenter[2] << "\n";
}
