// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDisplacementFieldWriter.h"

#include "Common/Guard.h"
#include "Common/WorldAxes.h"
#include "Formats/Fields/FieldFile.h"
#include "Formats/Fields/FieldImage.h"
#include "Formats/Writers/LeftOut.h"
#include "Formats/Writers/WrittenVolume.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

using namespace brainshift;

vtkStandardNewMacro(vtkDisplacementFieldWriter);
brainshiftGuardRequestsMacro(vtkDisplacementFieldWriter);

int vtkDisplacementFieldWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkDisplacementFieldWriter::WriteData()
{
  this->Problem = sentenceThrownBy(
    "File " + this->FileName + " cannot be written:", [this] { this->WriteImage(); });
  if (!this->Problem.empty())
  {
    vtkErrorMacro(<< this->Problem << ".");
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

void vtkDisplacementFieldWriter::WriteImage()
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  vtkDataArray* array = fieldOf(image);
  if (!array)
  {
    throw brainshift::Problem("The input has no point array of 3 components (mm)");
  }
  if (!isFieldImage(image))
  {
    this->WriteVolume(image);
    return;
  }
  DirectedField field{ gridOf(image), vectorsOf(array), directionOf(image) };
  const WorldAxes said = worldAxesOf(image);
  field.knowsSides = said != WorldAxes::Unknown || this->World == LPS;
  if (this->World == LPS)
  {
    reverseXY(field);
  }
  writeFieldFile(this->FileName, field);
  const std::string file = "File " + this->FileName + ": ";
  if (!field.knowsSides)
  {
    warn(this, file + UnknownSidesWritten + ". Set World to LPS if they are LPS");
  }
  else if (said != WorldAxes::Unknown && (said == WorldAxes::LPS) != (this->World == LPS))
  {
    warn(this,
      file + "The world axes of the input are " + (said == WorldAxes::LPS ? "LPS" : "RAS") +
        ", but World is " + (this->World == LPS ? "LPS" : "RAS") + ", which counts");
  }
}

void vtkDisplacementFieldWriter::WriteVolume(vtkImageData* image)
{
  const WorldAxes world = this->World == LPS ? WorldAxes::LPS : WorldAxes::Unknown;
  OutgoingVolume volume;
  std::string warning;
  takeOut(image, "", world, volume, warning);
  noteLeftOut(this->FileName, image, this->GetInputInformation(0, 0), volume, warning);
  writeVolume(this->FileName, volume, [](double) { return true; });
  if (!warning.empty())
  {
    warn(this, std::string("File ") + this->FileName + ": " + warning);
  }
}

void vtkDisplacementFieldWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "World: " << (this->World == RAS ? "RAS" : "LPS") << "\n";
}
