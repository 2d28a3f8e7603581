// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLandmarkReader.h"

#include "Common/Guard.h"
#include "Formats/Landmarks/LandmarkPoints.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkLandmarkReader);
brainshiftGuardRequestsMacro(vtkLandmarkReader);

vtkLandmarkReader::vtkLandmarkReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkLandmarkReader::CanReadFile(const char* fileName)
{
  bool isOne = false;
  const std::string thrown = thrownBy([&] { isOne = fileName && isLandmarkFile(fileName); });
  return thrown.empty() && isOne ? 1 : 0;
}

void vtkLandmarkReader::AddPositionColumn(const char* name)
{
  if (name && *name)
  {
    this->PositionColumns.emplace_back(name);
    this->Modified();
  }
}

void vtkLandmarkReader::ClearPositionColumns()
{
  this->PositionColumns.clear();
  this->Modified();
}

int vtkLandmarkReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* information = outputs->GetInformationObject(0);
  if (information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1; // the first piece has all points
  }
  LandmarkList list;
  this->Problem = "The file needs more memory than is available"; // what holds if this throws
  this->Problem = problemOf([&] {
    throwIfAny(this->FileName.empty() ? "FileName is empty; it must name a file of landmarks" : "");
    TableRule table;
    table.axes = this->TableAxes == LPS ? FileAxes::LPS : FileAxes::RAS;
    table.columns = this->PositionColumns;
    list = readLandmarkFile(this->FileName, this->Volume, table);
  });
  throwIfAny(this->Problem);
  for (const std::string& note : list.notes)
  {
    warn(this, std::string("Landmark file ") + this->FileName + " " + note);
  }
  setLandmarks(vtkPolyData::GetData(information), list);
  return 1;
}

void vtkLandmarkReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Volume: " << this->Volume << "\n"
     << indent << "TableAxes: " << (this->TableAxes == RAS ? "RAS" : "LPS") << "\n"
     << indent << "PositionColumns: " << this->PositionColumns.size() << "\n";
}
