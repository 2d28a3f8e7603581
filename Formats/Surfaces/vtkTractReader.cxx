// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTractReader.h"

#include "Common/Guard.h"
#include "Formats/Surfaces/SurfaceData.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkTractReader);
brainshiftGuardRequestsMacro(vtkTractReader);

vtkTractReader::vtkTractReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkTractReader::CanReadFile(const char* fileName)
{
  bool isOne = false;
  const std::string thrown = thrownBy([&] { isOne = fileName && isTractFile(fileName); });
  return thrown.empty() && isOne ? 1 : 0;
}

int vtkTractReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* information = outputs->GetInformationObject(0);
  if (information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1; // the first piece has all lines
  }
  if (this->FileName.empty())
  {
    throw Problem("FileName is empty; it must name a file of streamlines");
  }
  bool isStopped = false;
  const auto progress = [&](double fraction) {
    this->UpdateProgress(fraction);
    isStopped = this->GetAbortExecute() != 0;
    return !isStopped;
  };
  Tracts tracts;
  std::vector<std::string> warnings;
  readTractFile({ this->FileName, this->Volume }, progress, tracts, warnings);
  for (const std::string& warning : warnings)
  {
    warn(this, warning);
  }
  if (isStopped)
  {
    return 0;
  }
  setTracts(vtkPolyData::GetData(information), tracts);
  return 1;
}

void vtkTractReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Volume: " << this->Volume << "\n";
}
