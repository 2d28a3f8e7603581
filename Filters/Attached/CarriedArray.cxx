// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/CarriedArray.h"

#include "Common/ImageGrid.h"
#include "Common/Numbers.h"

#include "vtkCharArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkNew.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <string>
#include <utility>

namespace brainshift
{
namespace
{
// Looks like an ordinary array of type Base to everybody.
template <typename Base>
class SharedArray : public Base
{
public:
  static vtkSmartPointer<vtkDataArray> over(vtkDataArray* source)
  {
    auto array = vtkSmartPointer<SharedArray>::Take(new SharedArray);
    array->InitializeObjectBase();
    array->Source = source;
    array->SetName(source->GetName());
    array->SetNumberOfComponents(source->GetNumberOfComponents());
    array->CopyComponentNames(source);
    array->SetVoidArray(source->GetVoidPointer(0), source->GetNumberOfValues(), 1); // not owned
    array->SetLookupTable(source->GetLookupTable());
    return array;
  }

protected:
  bool ComputeScalarRange(
    double* ranges, const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return ghosts ? this->Base::ComputeScalarRange(ranges, ghosts, ghostsToSkip)
                  : this->kept(ranges, &vtkDataArray::GetRange);
  }
  bool ComputeFiniteScalarRange(
    double* ranges, const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return ghosts ? this->Base::ComputeFiniteScalarRange(ranges, ghosts, ghostsToSkip)
                  : this->kept(ranges, &vtkDataArray::GetFiniteRange);
  }

private:
  using RangeOf = void (vtkDataArray::*)(double[2], int);

  bool kept(double* ranges, RangeOf rangeOf)
  {
    for (int component = 0; component < this->GetNumberOfComponents(); ++component)
    {
      (this->Source->*rangeOf)(ranges + 2 * component, component);
    }
    return true;
  }

  vtkSmartPointer<vtkDataArray> Source; // owns the numbers
};

// Such an array, which keeps its source; the source itself if its memory layout is unusual.
vtkSmartPointer<vtkDataArray> sharedOver(vtkDataArray* source)
{
  if (!source->HasStandardMemoryLayout())
  {
    return source;
  }
  switch (source->GetDataType())
  {
    case VTK_CHAR:
      return SharedArray<vtkCharArray>::over(source);
    case VTK_SIGNED_CHAR:
      return SharedArray<vtkSignedCharArray>::over(source);
    case VTK_UNSIGNED_CHAR:
      return SharedArray<vtkUnsignedCharArray>::over(source);
    case VTK_SHORT:
      return SharedArray<vtkShortArray>::over(source);
    case VTK_UNSIGNED_SHORT:
      return SharedArray<vtkUnsignedShortArray>::over(source);
    case VTK_INT:
      return SharedArray<vtkIntArray>::over(source);
    case VTK_UNSIGNED_INT:
      return SharedArray<vtkUnsignedIntArray>::over(source);
    case VTK_LONG:
      return SharedArray<vtkLongArray>::over(source);
    case VTK_UNSIGNED_LONG:
      return SharedArray<vtkUnsignedLongArray>::over(source);
    case VTK_LONG_LONG:
      return SharedArray<vtkLongLongArray>::over(source);
    case VTK_UNSIGNED_LONG_LONG:
      return SharedArray<vtkUnsignedLongLongArray>::over(source);
    case VTK_FLOAT:
      return SharedArray<vtkFloatArray>::over(source);
    case VTK_DOUBLE:
      return SharedArray<vtkDoubleArray>::over(source);
    default:
      return source;
  }
}

constexpr int GridNumbers = 18;
}

vtkSmartPointer<vtkDataArray> sharedAs(const char* name, vtkDataArray* source)
{
  vtkSmartPointer<vtkDataArray> shared = sharedOver(source);
  if (shared == source) // which keeps its own name
  {
    shared = vtk::TakeSmartPointer(source->NewInstance());
    shared->ShallowCopy(source);
  }
  shared->SetName(name);
  return shared;
}

vtkDataArray* RenamedArray::as(const char* name, vtkDataArray* source)
{
  if (!source)
  {
    return nullptr;
  }
  if (this->Source != source || this->Time != source->GetMTime())
  {
    this->Shared = sharedAs(name, source);
    this->Source = source;
    this->Time = source->GetMTime();
  }
  return this->Shared;
}

SharedArrays::SharedArrays() = default;
SharedArrays::~SharedArrays() = default;

void SharedArrays::share(vtkDataSetAttributes* attributes)
{
  std::vector<Entry> entries;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* source = attributes->GetArray(i);
    // An array without a name could not be put back in its place; ghosts are looked up by identity.
    const std::string name = source && source->GetName() ? source->GetName() : "";
    if (name.empty() || name == vtkDataSetAttributes::GhostArrayName())
    {
      continue;
    }
    const unsigned long long time = source->GetMTime();
    const auto known = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const Entry& entry) { return entry.source == source && entry.time == time; });
    entries.push_back(
      known != this->Entries.end() ? *known : Entry{ source, time, sharedOver(source) });
  }
  for (const Entry& entry : entries)
  {
    attributes->AddArray(entry.shared); // takes the place of the array of this name
  }
  this->Entries = std::move(entries);
}

void attachGrid(vtkFieldData* fields, const char* name, const Grid& grid)
{
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName(name);
  numbers->SetNumberOfComponents(GridNumbers);
  numbers->SetNumberOfTuples(1);
  const glm::dvec3 sides(grid.dimensions);
  const std::array<double, 15> box = boxOf(grid);
  std::copy(box.begin(), box.end(), std::copy_n(&sides.x, 3, numbers->GetPointer(0)));
  fields->AddArray(numbers);
}

bool readGrid(vtkFieldData* fields, const char* name, Grid& grid)
{
  vtkDataArray* numbers = fields->GetArray(name);
  if (!numbers || numbers->GetNumberOfComponents() != GridNumbers ||
    numbers->GetNumberOfTuples() != 1)
  {
    return false;
  }
  double stored[GridNumbers];
  numbers->GetTuple(0, stored);
  constexpr double mostPoints = 1 << 30; // an integer holds it
  if (!std::all_of(stored, stored + 3, [](double side) { return isWhole(side, 1, mostPoints); }))
  {
    return false;
  }
  grid.dimensions = glm::ivec3(glm::dvec3(stored[0], stored[1], stored[2]));
  setBox(grid, stored + 3);
  return problemOfGrid(grid).empty();
}
}
