// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/WorldAxes.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <string>

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "WorldAxes";
constexpr const char* RASName = "RAS";
constexpr const char* LPSName = "LPS";
}

void nameWorldAxes(vtkDataObject* volume, WorldAxes axes)
{
  volume->GetFieldData()->RemoveArray(ArrayName);
  if (axes != WorldAxes::Unknown)
  {
    vtkNew<vtkStringArray> name;
    name->SetName(ArrayName);
    name->InsertNextValue(axes == WorldAxes::RAS ? RASName : LPSName);
    volume->GetFieldData()->AddArray(name);
  }
}

WorldAxes worldAxesOf(vtkDataObject* volume)
{
  auto* array = volume
    ? vtkStringArray::SafeDownCast(volume->GetFieldData()->GetAbstractArray(ArrayName))
    : nullptr;
  const std::string name = array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : "";
  if (name == RASName)
  {
    return WorldAxes::RAS;
  }
  return name == LPSName ? WorldAxes::LPS : WorldAxes::Unknown;
}
}
