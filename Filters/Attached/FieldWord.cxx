// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/FieldWord.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

namespace brainshift
{
void setFieldWord(vtkDataObject* data, const char* name, const std::string& word)
{
  data->GetFieldData()->RemoveArray(name);
  if (!word.empty())
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(word);
    data->GetFieldData()->AddArray(array);
  }
}

std::string fieldWordOf(vtkDataObject* data, const char* name)
{
  auto* array =
    data ? vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name)) : nullptr;
  return array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : "";
}
}
