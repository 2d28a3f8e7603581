// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/Remarks.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <map>
#include <vector>

namespace brainshift
{
bool isNewRemark(vtkDataSet* volume, const std::string& sentence)
{
  using Volumes = std::vector<vtkWeakPointer<vtkAbstractArray>>;
  static std::map<std::string, Volumes> said;
  vtkAbstractArray* ofPoints = volume ? volume->GetPointData()->GetAbstractArray(0) : nullptr;
  vtkAbstractArray* array =
    ofPoints || !volume ? ofPoints : volume->GetCellData()->GetAbstractArray(0);
  if (!array)
  {
    return true;
  }
  Volumes& volumes = said[sentence];
  const auto isDeleted = [](vtkAbstractArray* other) { return !other; };
  volumes.erase(std::remove_if(volumes.begin(), volumes.end(), isDeleted), volumes.end());
  if (std::find(volumes.begin(), volumes.end(), array) != volumes.end())
  {
    return false;
  }
  volumes.emplace_back(array);
  return true;
}
}
