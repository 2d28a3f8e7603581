// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/LabelTable.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

namespace brainshift
{
namespace
{
constexpr const char* ValuesName = "LabelValues";
constexpr const char* NamesName = "LabelNames";
constexpr const char* ColorsName = "LabelColors";
}

void attachLabels(vtkDataObject* volume, const std::vector<Label>& labels)
{
  vtkFieldData* fields = volume->GetFieldData();
  for (const char* name : { ValuesName, NamesName, ColorsName })
  {
    fields->RemoveArray(name);
  }
  if (labels.empty())
  {
    return;
  }
  vtkNew<vtkIntArray> values;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkUnsignedCharArray> colors;
  values->SetName(ValuesName);
  names->SetName(NamesName);
  colors->SetName(ColorsName);
  colors->SetNumberOfComponents(3);
  for (const Label& label : labels)
  {
    values->InsertNextValue(label.value);
    names->InsertNextValue(label.name);
    colors->InsertNextTypedTuple(label.color.data());
  }
  fields->AddArray(values);
  fields->AddArray(names);
  fields->AddArray(colors);
}

std::vector<Label> labelsOf(vtkDataObject* volume)
{
  vtkFieldData* fields = volume ? volume->GetFieldData() : nullptr;
  if (!fields)
  {
    return {};
  }
  auto* values = vtkIntArray::SafeDownCast(fields->GetAbstractArray(ValuesName));
  auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray(NamesName));
  auto* colors = vtkUnsignedCharArray::SafeDownCast(fields->GetAbstractArray(ColorsName));
  if (!values || !names || !colors || colors->GetNumberOfComponents() != 3 ||
    names->GetNumberOfTuples() != values->GetNumberOfTuples() ||
    colors->GetNumberOfTuples() != values->GetNumberOfTuples())
  {
    return {};
  }
  std::vector<Label> labels(static_cast<std::size_t>(values->GetNumberOfTuples()));
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    Label& label = labels[static_cast<std::size_t>(i)];
    label.value = values->GetValue(i);
    label.name = names->GetValue(i);
    colors->GetTypedTuple(i, label.color.data());
  }
  return labels;
}
}
