// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/CarriedGrid.h"

#include "Common/ImageGrid.h"
#include "Common/Numbers.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>

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
