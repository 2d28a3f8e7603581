// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/WholeExtent.h"

#include "Filters/Attached/DeformableVolume.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace brainshift
{
namespace
{
std::string sidesOf(const int extent[6])
{
  std::string sides;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int side = std::max(extent[2 * axis + 1] - extent[2 * axis] + 1, 0);
    sides += (axis > 0 ? " x " : "") + std::to_string(side);
  }
  return sides;
}
}

void updateWholeExtent(vtkInformation* image)
{
  if (image)
  {
    int whole[6];
    image->Get(Pipeline::WHOLE_EXTENT(), whole);
    image->Set(Pipeline::UPDATE_EXTENT(), whole, 6);
    image->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    image->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    image->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
}

Grid wholeGridOf(vtkInformation* info)
{
  Grid grid;
  const int* whole = info->Get(Pipeline::WHOLE_EXTENT());
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = whole[2 * axis + 1] - whole[2 * axis] + 1;
  }
  if (const double* origin = info->Get(vtkDataObject::ORIGIN()))
  {
    grid.origin = { origin[0], origin[1], origin[2] };
  }
  if (const double* spacing = info->Get(vtkDataObject::SPACING()))
  {
    grid.spacing = { spacing[0], spacing[1], spacing[2] };
  }
  if (const double* rows = info->Get(vtkDataObject::DIRECTION()))
  {
    for (int i = 0; i < 9; ++i)
    {
      grid.direction[i % 3][i / 3] = rows[i];
    }
  }
  grid.origin = grid.worldFromGrid({ whole[0], whole[2], whole[4] });
  return grid;
}

Grid wholeGridOf(vtkImageData* image, vtkInformation* info)
{
  if (image->GetNumberOfPoints() == 0) // a reader gave this process nothing, not even a place
  {
    return wholeGridOf(info);
  }
  int whole[6];
  info->Get(Pipeline::WHOLE_EXTENT(), whole);
  int extent[6];
  image->GetExtent(extent);
  Grid grid = gridOf(image);
  const glm::dvec3 toWholeStart(whole[0] - extent[0], whole[2] - extent[2], whole[4] - extent[4]);
  grid.origin = grid.worldFromGrid(toWholeStart);
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = whole[2 * axis + 1] - whole[2 * axis] + 1;
  }
  return grid;
}

std::string problemOfPart(vtkImageData* image, vtkInformation* information)
{
  int whole[6];
  information->Get(Pipeline::WHOLE_EXTENT(), whole);
  const int* extent = image->GetExtent();
  bool isWhole = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isWhole =
      isWhole && extent[2 * axis] <= whole[2 * axis] && extent[2 * axis + 1] >= whole[2 * axis + 1];
  }
  return isWhole ? std::string()
                 : "The input holds " + sidesOf(extent) + " points; it must hold the " +
      sidesOf(whole) + " points of the whole image";
}

bool isFirstRank()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  return !ranks || ranks->GetLocalProcessId() == 0;
}
}
