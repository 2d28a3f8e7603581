// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTractWriter.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Formats/Surfaces/SurfaceData.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkTractWriter);
brainshiftGuardRequestsMacro(vtkTractWriter);

int vtkTractWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkTractWriter::WriteData()
{
  if (!brainshift::isFirstRank())
  {
    this->Problem.clear();
    return; // the first process has what Tract Reader read
  }
  std::vector<std::string> warnings;
  this->Problem = brainshift::problemOf([&] {
    brainshift::throwIfAny(
      this->FileName.empty() ? "FileName is empty; it must name a file of streamlines" : "");
    const brainshift::Tracts tracts =
      brainshift::withBeginning("Tract file " + this->FileName + " cannot be written: its input ",
        [&] { return brainshift::tractsOf(vtkPolyData::SafeDownCast(this->GetInput())); });
    brainshift::throwIfAny(tracts.points.empty()
        ? "Tract file " + this->FileName + " cannot be written: its input has no streamlines. " +
          "Check that what they are from could be read"
        : "");
    brainshift::writeTractFile(this->FileName, this->Volume, tracts, warnings);
  });
  if (!this->Problem.empty())
  {
    vtkErrorMacro(<< this->Problem << ".");
    this->SetErrorCode(vtkErrorCode::UnknownError);
    return;
  }
  for (const std::string& warning : warnings)
  {
    brainshift::warn(this, warning);
  }
}

void vtkTractWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Volume: " << this->Volume << "\n";
}
