// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Field arrays of a data object: one word in an array of one string.
#ifndef BrainShift_FieldWord_h
#define BrainShift_FieldWord_h

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <string>

namespace brainshift
{
/** Attaches a word under a name. It replaces the one before. An empty word removes the array. */
inline void setFieldWord(vtkDataObject* data, const char* name, const std::string& word)
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

/** The word under a name; empty without one, and for null. */
inline std::string fieldWordOf(vtkDataObject* data, const char* name)
{
  auto* array =
    data ? vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name)) : nullptr;
  return array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : "";
}
}

#endif
