// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/FieldDirection.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "DisplacementDirection";
constexpr const char* ForwardName = "forward";
constexpr const char* BackwardName = "backward";
}

void nameDirection(vtkDataObject* field, Direction direction)
{
  vtkNew<vtkStringArray> name;
  name->SetName(ArrayName);
  name->InsertNextValue(direction == Direction::Forward ? ForwardName : BackwardName);
  field->GetFieldData()->AddArray(name);
}

void forgetDirection(vtkDataObject* field)
{
  field->GetFieldData()->RemoveArray(ArrayName);
}

std::optional<Direction> directionOf(vtkDataObject* field)
{
  auto* array = vtkStringArray::SafeDownCast(field->GetFieldData()->GetAbstractArray(ArrayName));
  const std::string name = array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : "";
  if (name == ForwardName)
  {
    return Direction::Forward;
  }
  return name == BackwardName ? std::optional<Direction>(Direction::Backward) : std::nullopt;
}
}
