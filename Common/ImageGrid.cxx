// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ImageGrid.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <sstream>

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

Grid gridOf(vtkImageData* image)
{
  int extent[6];
  image->GetExtent(extent);
  return gridOf(image, extent);
}

Grid gridOf(vtkImageData* image, const int extent[6])
{
  Grid grid;
  vtkMatrix3x3* direction = image->GetDirectionMatrix();
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
    grid.origin[axis] = image->GetOrigin()[axis];
    grid.spacing[axis] = image->GetSpacing()[axis];
    for (int column = 0; column < 3; ++column)
    {
      grid.direction[column][axis] = direction->GetElement(axis, column);
    }
  }
  grid.origin = grid.worldFromGrid(glm::dvec3(extent[0], extent[2], extent[4]));
  return grid;
}

namespace
{
// How far the products of axes are from 0, or 1 of an axis with itself.
double missOfRotation(const glm::dmat3& direction)
{
  double most = 0.0;
  const glm::dmat3 products = glm::transpose(direction) * direction;
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      most = std::max(most, std::abs(products[column][row] - (row == column ? 1.0 : 0.0)));
    }
  }
  return most;
}
}

std::string problemOfGrid(const Grid& grid)
{
  const auto isFinite = [](const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const auto isSpacing = [](double mm) { return mm >= ShortestSpacing && mm <= LongestSpacing; };
  const glm::dvec3& spacing = grid.spacing;
  const glm::dvec3& origin = grid.origin;
  std::ostringstream problem;
  if (!isSpacing(spacing.x) || !isSpacing(spacing.y) || !isSpacing(spacing.z))
  {
    problem << "spacing is " << spacing.x << " " << spacing.y << " " << spacing.z
            << " mm; it must be from " << ShortestSpacing << " to " << LongestSpacing << " mm";
  }
  else if (!grid.placesItsPoints())
  {
    problem << "origin is " << origin.x << " " << origin.y << " " << origin.z
            << " mm; it must be finite and at most " << FarthestOriginSpacings
            << " spacings away from 0";
  }
  else if (!isFinite(grid.direction[0]) || !isFinite(grid.direction[1]) ||
    !isFinite(grid.direction[2]))
  {
    problem << "direction holds a number that is not finite";
  }
  else if (!(missOfRotation(grid.direction) <= MostMissOfRotation))
  {
    problem << "direction has axes that are not perpendicular and 1 long: products of them miss "
            << "0 and 1 by up to " << missOfRotation(grid.direction) << "; the limit is "
            << MostMissOfRotation << ". Resample it to perpendicular axes first";
  }
  return problem.str();
}

void requirePosition(const Grid& grid, const std::string& beginning)
{
  if (const std::string problem = problemOfGrid(grid); !problem.empty())
  {
    throw Problem(beginning + problem);
  }
}

void announce(vtkInformation* output, const Grid& grid)
{
  const glm::ivec3 last = grid.dimensions - 1;
  const int whole[6] = { 0, last.x, 0, last.y, 0, last.z };
  const glm::dmat3 rows = glm::transpose(grid.direction);
  output->Set(Pipeline::WHOLE_EXTENT(), whole, 6);
  output->Set(vtkDataObject::ORIGIN(), &grid.origin.x, 3);
  output->Set(vtkDataObject::SPACING(), &grid.spacing.x, 3);
  output->Set(vtkDataObject::DIRECTION(), &rows[0][0], 9);
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
  if (image->GetNumberOfPoints() == 0) // a reader gave this process nothing, not even a position
  {
    return wholeGridOf(info);
  }
  int whole[6];
  info->Get(Pipeline::WHOLE_EXTENT(), whole);
  return gridOf(image, whole);
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

void requireWhole(vtkImageData* image, vtkInformation* information)
{
  throwIfAny(problemOfPart(image, information));
}

bool isFirstRank()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  return !ranks || ranks->GetLocalProcessId() == 0;
}
}
