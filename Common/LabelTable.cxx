// SPDX-License-Identifier: BSD-3-Clause
#include "Common/LabelTable.h"

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
constexpr const char* LabelMapName = "IsLabelMap";

// The arrays of a table; all null if one is missing or has another length.
struct Table
{
  vtkIntArray* values = nullptr;
  vtkStringArray* names = nullptr;
  vtkUnsignedCharArray* colors = nullptr;
  vtkStringArray* terms = nullptr; // may be null
};

Table tableOf(vtkDataObject* volume, const std::string& word)
{
  vtkFieldData* fields = volume ? volume->GetFieldData() : nullptr;
  if (!fields)
  {
    return {};
  }
  const auto array = [&](const char* what) {
    return fields->GetAbstractArray((word + what).c_str());
  };
  Table table;
  table.values = vtkIntArray::SafeDownCast(array("Values"));
  table.names = vtkStringArray::SafeDownCast(array("Names"));
  table.colors = vtkUnsignedCharArray::SafeDownCast(array("Colors"));
  const bool isWhole = table.values && table.names && table.colors &&
    table.values->GetNumberOfComponents() == 1 && table.colors->GetNumberOfComponents() == 3 &&
    table.names->GetNumberOfTuples() == table.values->GetNumberOfTuples() &&
    table.colors->GetNumberOfTuples() == table.values->GetNumberOfTuples();
  table.terms = vtkStringArray::SafeDownCast(array("Terms"));
  if (isWhole && table.terms &&
    table.terms->GetNumberOfTuples() != table.values->GetNumberOfTuples())
  {
    table.terms = nullptr;
  }
  return isWhole ? table : Table();
}
}

void attachLabels(vtkDataObject* volume, const std::vector<Label>& labels, const std::string& word)
{
  vtkFieldData* fields = volume->GetFieldData();
  for (const char* what : { "Values", "Names", "Colors", "Terms" })
  {
    fields->RemoveArray((word + what).c_str());
  }
  if (labels.empty())
  {
    return;
  }
  vtkNew<vtkIntArray> values;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkStringArray> terms;
  values->SetName((word + "Values").c_str());
  names->SetName((word + "Names").c_str());
  colors->SetName((word + "Colors").c_str());
  terms->SetName((word + "Terms").c_str());
  bool hasTerms = false;
  colors->SetNumberOfComponents(3);
  for (const Label& label : labels)
  {
    values->InsertNextValue(label.value);
    names->InsertNextValue(label.name);
    colors->InsertNextTypedTuple(label.color.data());
    terms->InsertNextValue(label.terms);
    hasTerms = hasTerms || !label.terms.empty();
  }
  fields->AddArray(values);
  fields->AddArray(names);
  fields->AddArray(colors);
  if (hasTerms)
  {
    fields->AddArray(terms);
  }
}

std::vector<Label> attachedLabels(vtkDataObject* volume, const std::string& word)
{
  const Table table = tableOf(volume, word);
  const vtkIdType count = table.values ? table.values->GetNumberOfTuples() : 0;
  std::vector<Label> labels(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    Label& label = labels[static_cast<std::size_t>(i)];
    label.value = table.values->GetValue(i);
    label.name = table.names->GetValue(i);
    table.colors->GetTypedTuple(i, label.color.data());
    label.terms = table.terms ? table.terms->GetValue(i) : std::string();
  }
  return labels;
}

bool isLabelMap(vtkDataObject* volume)
{
  vtkFieldData* fields = volume ? volume->GetFieldData() : nullptr;
  return fields && (fields->HasArray(LabelMapName) || tableOf(volume, OwnLabels).values);
}

void markLabelMap(vtkDataObject* volume, bool isLabelMap)
{
  vtkFieldData* fields = volume->GetFieldData();
  fields->RemoveArray(LabelMapName);
  if (isLabelMap)
  {
    vtkNew<vtkUnsignedCharArray> mark;
    mark->SetName(LabelMapName);
    mark->InsertNextValue(1);
    fields->AddArray(mark);
  }
}

std::string labelName(vtkDataObject* volume, double value, const std::string& word)
{
  const Table table = tableOf(volume, word);
  const vtkIdType count = table.values ? table.values->GetNumberOfTuples() : 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (table.values->GetValue(i) == value)
    {
      return table.names->GetValue(i);
    }
  }
  return {};
}
}
