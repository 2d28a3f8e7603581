// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/SurfaceData.h"

#include "Common/Problem.h"
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
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace brainshift
{
namespace
{
struct TypePair
{
  NumberType ours;
  int vtk;
};

// The last of equal ones counts for VTK's other names of a type.
constexpr TypePair Types[] = { { NumberType::Int8, VTK_SIGNED_CHAR },
  { NumberType::UInt8, VTK_UNSIGNED_CHAR }, { NumberType::Int16, VTK_SHORT },
  { NumberType::UInt16, VTK_UNSIGNED_SHORT }, { NumberType::Int32, VTK_INT },
  { NumberType::UInt32, VTK_UNSIGNED_INT }, { NumberType::Int64, VTK_LONG_LONG },
  { NumberType::UInt64, VTK_UNSIGNED_LONG_LONG }, { NumberType::Float32, VTK_FLOAT },
  { NumberType::Float64, VTK_DOUBLE }, { NumberType::Int64, VTK_LONG },
  { NumberType::UInt64, VTK_UNSIGNED_LONG }, { NumberType::Int64, VTK_ID_TYPE },
  { NumberType::Int8, VTK_CHAR } };

int typeOf(NumberType type)
{
  return std::find_if(std::begin(Types), std::end(Types), [&](const TypePair& pair) {
    return pair.ours == type;
  })->vtk;
}

std::optional<NumberType> typeOf(int vtkType)
{
  const auto* found = std::find_if(
    std::begin(Types), std::end(Types), [&](const TypePair& pair) { return pair.vtk == vtkType; });
  return found == std::end(Types) ? std::nullopt : std::optional(found->ours);
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
  nameTemplate(data, surface.space);
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

namespace
{
// Arrays of numbers; others, such as names, give a note.
std::vector<NamedNumbers> numbersOf(
  vtkDataSetAttributes* attributes, std::vector<std::string>& notes)
{
  std::vector<NamedNumbers> list;
  OwnNames own;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    const char* name = attributes->GetAbstractArray(i)->GetName();
    const std::optional<NumberType> type =
      array ? typeOf(array->GetDataType()) : std::optional<NumberType>();
    if (!type)
    {
      notes.push_back(std::string("has no room for the array ") + (name ? name : "without a name"));
      continue;
    }
    const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
    const std::size_t count =
      components * static_cast<std::size_t>(array->GetNumberOfTuples()) * bytesOf(*type);
    const char* bytes = static_cast<const char*>(array->GetVoidPointer(0));
    list.push_back(
      { own.own(name ? name : "unnamed"), *type, components, { bytes, bytes + count } });
  }
  return list;
}

// Tuples in another order.
void arrange(const std::vector<vtkIdType>& order, std::vector<NamedNumbers>& list)
{
  for (NamedNumbers& numbers : list)
  {
    const std::size_t size = numbers.components * bytesOf(numbers.type);
    std::vector<char> bytes(order.size() * size);
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      std::copy_n(
        &numbers.bytes[static_cast<std::size_t>(order[i]) * size], size, &bytes[i * size]);
    }
    numbers.bytes = std::move(bytes);
  }
}
}

Tracts tractsOf(vtkPolyData* data)
{
  if (!data || data->GetNumberOfCells() != data->GetNumberOfLines())
  {
    throw Problem("has " + std::to_string(data ? data->GetNumberOfCells() : 0) +
      " cells, of which " + std::to_string(data ? data->GetNumberOfLines() : 0) +
      " are lines; all must be lines");
  }
  Tracts tracts;
  const WorldAxes axes = worldAxesOf(data);
  const float sign = axes == WorldAxes::LPS ? -1.0f : 1.0f;
  if (axes == WorldAxes::Unknown)
  {
    tracts.notes.emplace_back("is of lines whose world axes are not known; they count as RAS");
  }
  std::vector<vtkIdType> order;
  for (vtkIdType line = 0; line < data->GetNumberOfLines(); ++line)
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    data->GetLines()->GetCellAtId(line, count, points);
    order.insert(order.end(), points, points + count);
    tracts.firsts.push_back(static_cast<std::int64_t>(order.size()));
  }
  for (const vtkIdType point : order)
  {
    double place[3];
    data->GetPoint(point, place);
    tracts.points.emplace_back(sign * place[0], sign * place[1], place[2]);
  }
  tracts.ofPoints = numbersOf(data->GetPointData(), tracts.notes);
  arrange(order, tracts.ofPoints);
  tracts.ofStreamlines = numbersOf(data->GetCellData(), tracts.notes);
  return tracts;
}
}
