// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/LandmarkPoints.h"

#include "Common/WorldAxes.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* LabelName = "Label";
constexpr const char* TimeName = "Time";

using NumberMember = std::pair<const char*, double Landmark::*>;
constexpr std::array<NumberMember, 3> Numbers{ {
  { "Number", &Landmark::number },
  { TimeName, &Landmark::time },
  { "Deviation", &Landmark::deviation },
} };

void addLabels(vtkPolyData* points, const LandmarkList& list)
{
  if (std::all_of(list.points.begin(), list.points.end(),
        [](const Landmark& point) { return point.label.empty(); }))
  {
    return;
  }
  vtkNew<vtkStringArray> labels;
  labels->SetName(LabelName);
  labels->SetNumberOfValues(static_cast<vtkIdType>(list.points.size()));
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    labels->SetValue(static_cast<vtkIdType>(i), list.points[i].label);
  }
  points->GetPointData()->AddArray(labels);
}

void addNumbers(vtkPolyData* points, const LandmarkList& list, const NumberMember& member)
{
  if (std::all_of(list.points.begin(), list.points.end(),
        [&](const Landmark& point) { return std::isnan(point.*member.second); }))
  {
    return;
  }
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName(member.first);
  numbers->SetNumberOfValues(static_cast<vtkIdType>(list.points.size()));
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    numbers->SetValue(static_cast<vtkIdType>(i), list.points[i].*member.second);
  }
  points->GetPointData()->AddArray(numbers);
}
}

void setLandmarks(vtkPolyData* points, const LandmarkList& list)
{
  const auto count = static_cast<vtkIdType>(list.points.size());
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  positions->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const glm::dvec3& position = list.points[static_cast<std::size_t>(i)].position;
    positions->SetPoint(i, position.x, position.y, position.z);
    vertices->InsertNextCell(1, &i);
  }
  points->Initialize();
  points->SetPoints(positions);
  points->SetVerts(vertices);
  addLabels(points, list);
  for (const NumberMember& member : Numbers)
  {
    addNumbers(points, list, member);
  }
  vtkDataArray* times = points->GetPointData()->GetArray(TimeName);
  if (times && !list.timeUnit.empty()) // the array keeps it through filters
  {
    times->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), list.timeUnit.c_str());
  }
  nameWorldAxes(points, WorldAxes::RAS);
}

LandmarkList landmarksOf(vtkPointSet* points)
{
  LandmarkList list;
  const WorldAxes known = worldAxesOf(points);
  const FileAxes axes = known == WorldAxes::LPS ? FileAxes::LPS : FileAxes::RAS;
  // The file will name axes that nothing says. Points that the user made, which are of no patient,
  // cannot be told from those of a volume without sides, so both get the note, once, on saving.
  if (known == WorldAxes::Unknown)
  {
    list.notes.emplace_back("is of points whose world axes are not known; they count as RAS");
  }
  list.points.resize(static_cast<std::size_t>(points->GetNumberOfPoints()));
  vtkPointData* arrays = points->GetPointData();
  vtkAbstractArray* labels = arrays->GetAbstractArray(LabelName);
  vtkDataArray* times = arrays->GetArray(TimeName);
  if (times && times->HasInformation() && times->GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
  {
    list.timeUnit = times->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  }
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    glm::dvec3 position(0.0);
    points->GetPoint(id, &position.x);
    list.points[i].position = inAxes(axes, position);
    if (labels && labels->GetNumberOfComponents() == 1)
    {
      list.points[i].label = labels->GetVariantValue(id).ToString();
    }
    for (const NumberMember& member : Numbers)
    {
      vtkDataArray* numbers = arrays->GetArray(member.first);
      if (numbers && numbers->GetNumberOfComponents() == 1)
      {
        list.points[i].*member.second = numbers->GetComponent(id, 0);
      }
    }
  }
  return list;
}
}
