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

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

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
  const glm::ivec3 low(index);
  const glm::dvec3 within = index - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::ivec3 at = glm::min(low + side, this->grid.dimensions - 1);
    const glm::dvec3 weight = glm::mix(1.0 - within, within, glm::dvec3(side));
    sum += weight.x * weight.y * weight.z *
      this->scalars->GetComponent(static_cast<vtkIdType>(this->grid.offset(at.x, at.y, at.z)), 0);
  }
  return sum >= this->level;
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
