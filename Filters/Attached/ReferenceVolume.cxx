// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/ReferenceVolume.h"
#include "Common/Numbers.h"
#include "Common/SharedArray.h"

#include "Filters/Attached/CarriedGrid.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr const char* GridName = "ReferenceGrid";
constexpr const char* ShowName = "ReferenceShow";
constexpr const char* LabelsName = "ReferenceIsLabels";
constexpr const char* CavityName = "CavityVoxels";
constexpr const char* CavityGridName = "CavityGrid";
constexpr const char* WholeName = "ReferenceWhole";
constexpr int WholeNumbers = 8;

glm::dmat3 turnOf(const glm::dvec3& degrees)
{
  glm::dmat4 turn(1.0);
  for (int axis = 2; axis >= 0; --axis)
  {
    glm::dvec3 about(0.0);
    about[axis] = 1.0;
    turn = glm::rotate(turn, glm::radians(degrees[axis]), about);
  }
  return glm::dmat3(turn);
}

// None without numbers that can be of a whole: those of files may be anything.
std::optional<WholeReference> readWhole(vtkFieldData* fields)
{
  vtkDataArray* numbers = fields->GetArray(WholeName);
  if (!numbers || numbers->GetNumberOfComponents() != 1 ||
    numbers->GetNumberOfTuples() != WholeNumbers)
  {
    return std::nullopt;
  }
  constexpr double mostPoints = 1 << 30; // an integer holds it
  glm::dvec3 indices[2];                 // points, first
  for (int i = 0; i < 6; ++i)
  {
    indices[i / 3][i % 3] = numbers->GetComponent(i, 0);
    if (!isWhole(numbers->GetComponent(i, 0), i < 3 ? 1 : 0, mostPoints))
    {
      return std::nullopt;
    }
  }
  return WholeReference{ glm::ivec3(indices[0]), glm::ivec3(indices[1]),
    { numbers->GetComponent(6, 0), numbers->GetComponent(7, 0) } };
}
}

void attachPlaced(vtkFieldData* fields, const PlacedVoxels& placed, const char* gridName)
{
  fields->AddArray(placed.voxels);
  attachGrid(fields, gridName, placed.grid);
}

PlacedVoxels readPlaced(vtkFieldData* fields, const char* name, const char* gridName)
{
  PlacedVoxels placed;
  vtkDataArray* voxels = fields->GetArray(name);
  if (!voxels || !readGrid(fields, gridName, placed.grid))
  {
    return placed;
  }
  const bool fits = voxels->GetNumberOfTuples() == static_cast<vtkIdType>(placed.grid.count());
  placed.voxels = fits ? voxels : nullptr;
  return placed;
}

vtkSmartPointer<vtkDataArray> asCavityVoxels(const Mask& mask)
{
  vtkNew<vtkUnsignedCharArray> voxels;
  voxels->SetNumberOfTuples(static_cast<vtkIdType>(mask.inside.size()));
  std::copy(mask.inside.begin(), mask.inside.end(), voxels->GetPointer(0));
  return sharedAs(CavityName, voxels); // whose range is found once
}

void attachReference(vtkDataObject* volume, const ReferenceVolume& reference)
{
  vtkFieldData* fields = volume->GetFieldData();
  attachPlaced(fields, reference, GridName);
  if (reference.cavity.voxels)
  {
    attachPlaced(fields, reference.cavity, CavityGridName);
  }
  else
  {
    fields->RemoveArray(CavityName); // those of a reference before this one
    fields->RemoveArray(CavityGridName);
  }
  vtkNew<vtkIntArray> show;
  show->SetName(ShowName);
  show->InsertNextValue(static_cast<int>(reference.show));
  fields->AddArray(show);
  fields->RemoveArray(LabelsName);
  if (reference.isLabels)
  {
    vtkNew<vtkIntArray> labels;
    labels->SetName(LabelsName);
    labels->InsertNextValue(1);
    fields->AddArray(labels);
  }
  fields->RemoveArray(WholeName);
  if (reference.whole)
  {
    vtkNew<vtkDoubleArray> whole;
    whole->SetName(WholeName);
    whole->SetNumberOfValues(WholeNumbers);
    for (int axis = 0; axis < 3; ++axis)
    {
      whole->SetValue(axis, reference.whole->points[axis]);
      whole->SetValue(3 + axis, reference.whole->first[axis]);
    }
    whole->SetValue(6, reference.whole->range.x);
    whole->SetValue(7, reference.whole->range.y);
    fields->AddArray(whole);
  }
}

ReferenceVolume readReference(vtkDataObject* volume)
{
  vtkFieldData* fields = volume->GetFieldData();
  ReferenceVolume reference;
  static_cast<PlacedVoxels&>(reference) = readPlaced(fields, ReferenceVoxelsName, GridName);
  if (reference.voxels)
  {
    reference.cavity = readPlaced(fields, CavityName, CavityGridName);
    vtkDataArray* show = fields->GetArray(ShowName);
    const double shown = show && show->GetNumberOfValues() == 1 ? show->GetComponent(0, 0) : 0.0;
    reference.show = shown == 1.0 ? ReferenceShow::Deformed
      : shown == 2.0              ? ReferenceShow::Reference
                                  : ReferenceShow::Both;
    reference.isLabels = fields->HasArray(LabelsName) != 0;
    reference.whole = readWhole(fields);
  }
  return reference;
}

WholeReference wholeOf(const ReferenceVolume& reference)
{
  if (reference.whole)
  {
    return *reference.whole;
  }
  WholeReference whole{ reference.grid.dimensions, glm::ivec3(0), {} };
  reference.voxels->GetFiniteRange(&whole.range[0], 0);
  return whole;
}

void removeReference(vtkDataObject* volume)
{
  for (const char* name :
    { ReferenceVoxelsName, GridName, ShowName, LabelsName, CavityName, CavityGridName, WholeName })
  {
    volume->GetFieldData()->RemoveArray(name);
  }
}

glm::dvec3 middleOf(const Grid& grid)
{
  return grid.worldFromGrid(glm::dvec3(grid.dimensions - 1) * 0.5);
}

Grid movedRigidly(const Grid& grid, const RigidMotion& motion)
{
  const glm::dmat3 turn = turnOf(motion.rotation);
  Grid moved = grid;
  moved.direction = turn * grid.direction;
  moved.origin = motion.middle + turn * (grid.origin - motion.middle) + motion.translation;
  return moved;
}

RigidMotion followedBy(const RigidMotion& motion, const glm::dmat3& turn, const glm::dvec3& shift)
{
  const glm::dmat3 whole = turn * turnOf(motion.rotation);
  RigidMotion result = motion;
  // [column][row] of the turn about x, then y, then z.
  result.rotation = glm::degrees(glm::dvec3(std::atan2(whole[1][2], whole[2][2]),
    -std::asin(glm::clamp(whole[0][2], -1.0, 1.0)), std::atan2(whole[0][1], whole[0][0])));
  result.translation = turn * (motion.middle + motion.translation) + shift - motion.middle;
  return result;
}
}
