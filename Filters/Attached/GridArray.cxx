// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/GridArray.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

namespace brainshift
{
namespace
{
constexpr int GridNumbers = 18;
}

void attachGrid(vtkFieldData* fields, const char* name, const Grid& grid)
{
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName(name);
  numbers->SetNumberOfComponents(GridNumbers);
  numbers->SetNumberOfTuples(1);
  for (int i = 0; i < 3; ++i)
  {
    numbers->SetComponent(0, i, grid.dimensions[i]);
    numbers->SetComponent(0, 3 + i, grid.origin[i]);
    numbers->SetComponent(0, 6 + i, grid.spacing[i]);
    for (int column = 0; column < 3; ++column)
    {
      numbers->SetComponent(0, 9 + 3 * i + column, grid.direction[column][i]);
    }
  }
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
  for (int i = 0; i < 3; ++i)
  {
    grid.dimensions[i] = static_cast<int>(numbers->GetComponent(0, i));
    grid.origin[i] = numbers->GetComponent(0, 3 + i);
    grid.spacing[i] = numbers->GetComponent(0, 6 + i);
    for (int column = 0; column < 3; ++column)
    {
      grid.direction[column][i] = numbers->GetComponent(0, 9 + 3 * i + column);
    }
  }
  return true;
}
}
