// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLandmarkWriter.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Formats/Landmarks/LandmarkPoints.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

vtkStandardNewMacro(vtkLandmarkWriter);
brainshiftGuardRequestsMacro(vtkLandmarkWriter);

int vtkLandmarkWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

void vtkLandmarkWriter::WriteData()
{
  if (!brainshift::isFirstRank())
  {
    this->Problem.clear();
    return; // the first process has what Landmark Reader read
  }
  const auto axes = this->FileAxes == OfTheFormat ? std::nullopt
    : this->FileAxes == RAS                       ? std::optional(brainshift::FileAxes::RAS)
                                                  : std::optional(brainshift::FileAxes::LPS);
  brainshift::LandmarkList list =
    brainshift::landmarksOf(vtkPointSet::SafeDownCast(this->GetInput()));
  this->Problem =
    brainshift::problemOf([&] { brainshift::writeLandmarkFile(this->FileName, axes, list); });
  if (!this->Problem.empty())
  {
    vtkErrorMacro(<< this->Problem << ".");
    this->SetErrorCode(vtkErrorCode::UnknownError);
    return;
  }
  for (const std::string& note : list.notes)
  {
    brainshift::warn(this, std::string("File ") + this->FileName + " " + note);
  }
}

void vtkLandmarkWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "FileAxes: " << this->FileAxes << "\n";
}
