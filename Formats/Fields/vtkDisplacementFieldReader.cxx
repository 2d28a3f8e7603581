// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDisplacementFieldReader.h"

#include "Common/Guard.h"
#include "Common/WorldAxes.h"
#include "Formats/Fields/FieldFile.h"
#include "Formats/Fields/FieldGap.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

using namespace brainshift;

struct vtkDisplacementFieldReader::State
{
  DirectedField Field;
  bool Good = false;
};

vtkStandardNewMacro(vtkDisplacementFieldReader);
brainshiftGuardRequestsMacro(vtkDisplacementFieldReader);

vtkDisplacementFieldReader::vtkDisplacementFieldReader()
  : Internal(std::make_unique<State>())
{
  this->SetNumberOfInputPorts(0);
}

vtkDisplacementFieldReader::~vtkDisplacementFieldReader() = default;

int vtkDisplacementFieldReader::CanReadFile(const char* fileName)
{
  return fileName && isFieldFile(fileName) ? 1 : 0;
}

int vtkDisplacementFieldReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  State& state = *this->Internal;
  state.Good = false;
  this->Gap.clear();
  this->Problem = sentenceThrownBy("Displacement Field Reader", [&] {
    throwIfAny(
      this->FileName.empty() ? "FileName is empty; it must name a displacement field" : "");
    readFieldFile(this->FileName, state.Field);
  });
  throwIfAny(this->Problem);
  state.Good = true;
  if (this->World == LPS)
  {
    reverseXY(state.Field);
  }
  this->Gap = gapIn(state.Field.grid, state.Field.displacements);
  announce(outputs->GetInformationObject(0), state.Field.grid);
  return 1;
}

int vtkDisplacementFieldReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const State& state = *this->Internal;
  if (!state.Good)
  {
    return 0; // RequestInformation has reported why
  }
  if (!this->Gap.empty())
  {
    warn(this, "Displacement field " + this->FileName + " has " + this->Gap);
  }
  brainshift::Direction direction = state.Field.direction.value_or(brainshift::Direction::Backward);
  if (this->Direction != AsTheFileTells)
  {
    direction =
      this->Direction == Forward ? brainshift::Direction::Forward : brainshift::Direction::Backward;
  }
  vtkImageData* field = vtkImageData::GetData(outputs);
  setField(field, state.Field.grid, state.Field.displacements, direction);
  const WorldAxes known = this->World == LPS ? WorldAxes::LPS : WorldAxes::RAS;
  nameWorldAxes(field, state.Field.knowsSides ? known : WorldAxes::Unknown);
  return 1;
}

void vtkDisplacementFieldReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "World: " << (this->World == RAS ? "RAS" : "LPS") << "\n"
     << indent << "Direction: " << this->Direction << "\n";
}
