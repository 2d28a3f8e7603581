// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/Resection.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"

namespace brainshift
{
namespace
{
constexpr const char* TumourGridName = "TumourGrid";
constexpr const char* RemovedGridName = "RemovedGrid";

void attach(vtkFieldData* fields, const PlacedVoxels& placed, const char* name, const char* grid)
{
  fields->RemoveArray(name);
  fields->RemoveArray(grid);
  if (placed.voxels)
  {
    attachPlaced(fields, placed, grid);
  }
}
}

void attachResection(vtkDataObject* volume, const Resection& resection)
{
  attach(volume->GetFieldData(), resection.tumour, TumourVoxelsName, TumourGridName);
  attach(volume->GetFieldData(), resection.cavity, RemovedVoxelsName, RemovedGridName);
}

Resection readResection(vtkDataObject* volume)
{
  vtkFieldData* fields = volume->GetFieldData();
  return { readPlaced(fields, TumourVoxelsName, TumourGridName),
    readPlaced(fields, RemovedVoxelsName, RemovedGridName) };
}
}
