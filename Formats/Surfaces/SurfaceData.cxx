// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/SurfaceData.h"

#include "Common/WorldAxes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace brainshift
{
namespace
{
int typeOf(NumberType type)
{
  switch (type)
  {
    case NumberType::UInt8:
      return VTK_UNSIGNED_CHAR;
    case NumberType::Int32:
      return VTK_INT;
    case NumberType::Float64:
      return VTK_DOUBLE;
    default:
      return VTK_FLOAT;
  }
}

void addArrays(vtkDataSetAttributes* attributes, const std::vector<NamedNumbers>& list)
{
  for (const NamedNumbers& numbers : list)
  {
    auto array =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(typeOf(numbers.type)));
    const std::size_t tuple = numbers.components * bytesOf(numbers.type);
    array->SetName(numbers.name.c_str());
    array->SetNumberOfComponents(static_cast<int>(numbers.components));
    array->SetNumberOfTuples(static_cast<vtkIdType>(numbers.bytes.size() / tuple));
    std::copy(
      numbers.bytes.begin(), numbers.bytes.end(), static_cast<char*>(array->GetVoidPointer(0)));
    attributes->AddArray(array);
  }
}

// Lines through points that follow one another.
template <typename ArrayType>
void setLines(vtkPolyData* data, const std::vector<std::int64_t>& firsts)
{
  vtkNew<ArrayType> offsets;
  vtkNew<ArrayType> points;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(firsts.size()));
  std::copy(firsts.begin(), firsts.end(), offsets->GetPointer(0));
  points->SetNumberOfValues(static_cast<vtkIdType>(firsts.back()));
  std::iota(
    points->GetPointer(0), points->GetPointer(0) + firsts.back(), typename ArrayType::ValueType(0));
  vtkNew<vtkCellArray> lines;
  lines->SetData(offsets.Get(), points.Get());
  data->SetLines(lines);
}
}

void setSurface(vtkPolyData* data, const Surface& surface)
{
  const auto count = static_cast<vtkIdType>(surface.points.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const glm::dvec3& point = surface.points[static_cast<std::size_t>(i)];
    points->SetPoint(i, point.x, point.y, point.z);
  }
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(static_cast<vtkIdType>(surface.triangles.size()),
    3 * static_cast<vtkIdType>(surface.triangles.size()));
  for (const glm::ivec3& triangle : surface.triangles)
  {
    const vtkIdType corners[3] = { triangle.x, triangle.y, triangle.z };
    triangles->InsertNextCell(3, corners);
  }
  data->Initialize();
  data->SetPoints(points);
  data->SetPolys(triangles);
  addArrays(data->GetPointData(), surface.numbers);
  attachLabels(data, surface.labels);
  nameWorldAxes(data, surface.knowsWorld ? WorldAxes::RAS : WorldAxes::Unknown);
}

void setTracts(vtkPolyData* data, const Tracts& tracts)
{
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(static_cast<vtkIdType>(tracts.points.size()));
  std::copy(tracts.points.begin(), tracts.points.end(),
    reinterpret_cast<glm::vec3*>(places->GetPointer(0)));
  vtkNew<vtkPoints> points;
  points->SetData(places);
  data->Initialize();
  data->SetPoints(points);
  if (tracts.firsts.back() <= std::numeric_limits<std::int32_t>::max())
  {
    setLines<vtkTypeInt32Array>(data, tracts.firsts);
  }
  else
  {
    setLines<vtkTypeInt64Array>(data, tracts.firsts);
  }
  addArrays(data->GetPointData(), tracts.ofPoints);
  addArrays(data->GetCellData(), tracts.ofStreamlines);
  nameWorldAxes(data, tracts.knowsWorld ? WorldAxes::RAS : WorldAxes::Unknown);
}
}
