// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Traces/TissueSurface.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace brainshift
{
bool TissueRegion::contains(const glm::dvec3& rest) const
{
  const glm::dvec3 index = this->grid.gridFromWorld(rest);
  const glm::dvec3 last(this->grid.dimensions - 1);
  if (!glm::all(glm::greaterThanEqual(index, glm::dvec3(0.0))) ||
    !glm::all(glm::lessThanEqual(index, last)))
  {
    return false;
  }
  double sum = 0.0;
  forEachCorner(this->grid, index, [&](const glm::ivec3& at, double weight) {
    sum += weight *
      this->scalars->GetComponent(static_cast<vtkIdType>(this->grid.offset(at.x, at.y, at.z)), 0);
  });
  return sum >= this->level;
}

bool TissueSource::find(vtkDataArray* scalars, const Grid& grid, bool isLabel, double level)
{
  if (scalars == this->Scalars && scalars->GetMTime() == this->Time && grid == this->ScalarsGrid &&
    isLabel == this->IsLabel && level == this->Level)
  {
    return false;
  }
  this->Region = isLabel ? TissueRegion{ grid, maskOfLabel(scalars, static_cast<int>(level)), 0.5 }
                         : TissueRegion{ grid, scalars, level };
  this->Scalars = scalars;
  this->Time = scalars->GetMTime();
  this->ScalarsGrid = grid;
  this->IsLabel = isLabel;
  this->Level = level;
  return true;
}

vtkDataArray* scalarsOf(vtkImageData* image, const std::string& name)
{
  vtkPointData* arrays = image->GetPointData();
  if (vtkDataArray* named = name.empty() ? nullptr : arrays->GetArray(name.c_str()))
  {
    return named;
  }
  return arrays->GetScalars() ? arrays->GetScalars() : arrays->GetArray(0);
}

vtkSmartPointer<vtkDataArray> maskOfLabel(vtkDataArray* labels, int label)
{
  auto mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mask->SetNumberOfTuples(labels->GetNumberOfTuples());
  for (vtkIdType i = 0; i < labels->GetNumberOfTuples(); ++i)
  {
    mask->SetValue(i, labels->GetComponent(i, 0) == label);
  }
  return mask;
}

TriangleMesh surfaceOf(const TissueRegion& tissue)
{
  // In index space: the filter knows no direction matrix in VTK 9.3.
  vtkNew<vtkImageData> image;
  const glm::ivec3& sides = tissue.grid.dimensions;
  image->SetDimensions(sides.x, sides.y, sides.z);
  image->GetPointData()->SetScalars(tissue.scalars);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, tissue.level);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();

  vtkPolyData* surface = contour->GetOutput();
  TriangleMesh mesh;
  mesh.points.resize(surface->GetNumberOfPoints());
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    double index[3];
    surface->GetPoint(point, index);
    mesh.points[point] = tissue.grid.worldFromGrid({ index[0], index[1], index[2] });
  }
  const auto isFinite = [&](vtkIdType point) {
    const glm::dvec3& p = mesh.points[point];
    return std::isfinite(p.x + p.y + p.z);
  };
  mesh.triangles.reserve(surface->GetNumberOfPolys());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfPolys(); ++cell)
  {
    surface->GetPolys()->GetCellAtId(cell, corners);
    const vtkIdType* id = corners->GetPointer(0);
    if (isFinite(id[0]) && isFinite(id[1]) && isFinite(id[2]))
    {
      mesh.triangles.emplace_back(id[0], id[1], id[2]);
    }
  }
  return mesh;
}
}
