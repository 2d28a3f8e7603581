// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/GatheredVolume.h"

#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <string>

namespace brainshift
{
namespace
{
constexpr int FirstRank = 0;
constexpr int Tag = 20713; // of our messages, which none of ParaView's may answer

// Cells along an axis of one point count as one.
struct Box
{
  int first[3];
  int count[3];
};

Box boxOf(const int extent[6], bool cells)
{
  Box box{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int points = extent[2 * axis + 1] - extent[2 * axis] + 1;
    box.first[axis] = extent[2 * axis];
    box.count[axis] = cells && points > 1 ? points - 1 : std::max(points, 0);
  }
  return box;
}

// Arrays that are sent: numbers with a name. Ghosts mark what another rank has.
std::vector<vtkDataArray*> sentOf(vtkDataSetAttributes* attributes)
{
  std::vector<vtkDataArray*> arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    if (!name.empty() && name != vtkDataSetAttributes::GhostArrayName())
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

// The array of this name over the whole volume; a new one is filled with 0.
vtkDataArray* wholeLike(vtkDataArray* part, vtkDataSetAttributes* attributes, vtkIdType tuples)
{
  if (vtkDataArray* there = attributes->GetArray(part->GetName()))
  {
    const bool alike = there->GetDataType() == part->GetDataType() &&
      there->GetNumberOfComponents() == part->GetNumberOfComponents();
    return alike ? there : nullptr;
  }
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(part->GetDataType()));
  array->SetName(part->GetName());
  array->SetNumberOfComponents(part->GetNumberOfComponents());
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  attributes->AddArray(array);
  return array;
}

bool isInside(const int extent[6], const int whole[6])
{
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    inside =
      inside && extent[2 * axis] >= whole[2 * axis] && extent[2 * axis + 1] <= whole[2 * axis + 1];
  }
  return inside;
}

void copyInto(vtkImageData* volume, bool cells, vtkDataArray* part, const int extent[6])
{
  if (!isInside(extent, volume->GetExtent()))
  {
    return; // the first rank has no volume
  }
  vtkDataSetAttributes* attributes = volume->GetPointData();
  if (cells)
  {
    attributes = volume->GetCellData();
  }
  const Box from = boxOf(extent, cells);
  const Box to = boxOf(volume->GetExtent(), cells);
  const vtkIdType row = to.count[0];
  vtkDataArray* target = wholeLike(part, attributes, row * to.count[1] * to.count[2]);
  for (int k = 0; target && k < from.count[2]; ++k)
  {
    for (int j = 0; j < from.count[1]; ++j)
    {
      const vtkIdType y = from.first[1] + j - to.first[1];
      const vtkIdType z = from.first[2] + k - to.first[2];
      const vtkIdType start = (z * to.count[1] + y) * row + from.first[0] - to.first[0];
      const vtkIdType source = (static_cast<vtkIdType>(k) * from.count[1] + j) * from.count[0];
      target->InsertTuples(start, from.count[0], source, part);
    }
  }
}

// What goes ahead of a part's arrays: its extent, and how many arrays its points and cells have.
using Head = std::array<int, 8>;
constexpr int PointArrays = 6;
constexpr int CellArrays = 7;
constexpr Head NoPart{ 0, -1, 0, -1, 0, -1, 0, 0 };

void send(vtkMultiProcessController* ranks, vtkImageData* part)
{
  Head head = NoPart;
  std::vector<vtkDataArray*> arrays;
  if (part && part->GetNumberOfPoints() > 0)
  {
    part->GetExtent(head.data());
    arrays = sentOf(part->GetPointData());
    const std::vector<vtkDataArray*> cells = sentOf(part->GetCellData());
    head[PointArrays] = static_cast<int>(arrays.size());
    head[CellArrays] = static_cast<int>(cells.size());
    arrays.insert(arrays.end(), cells.begin(), cells.end());
  }
  ranks->Send(head.data(), head.size(), FirstRank, Tag);
  for (vtkDataArray* array : arrays)
  {
    const int type = array->GetDataType();
    ranks->Send(&type, 1, FirstRank, Tag);
    ranks->Send(array, FirstRank, Tag);
  }
}

bool isTrueOnAny(vtkMultiProcessController* ranks, bool here)
{
  const int own = here;
  int any = 0;
  ranks->AllReduce(&own, &any, 1, vtkCommunicator::MAX_OP);
  return any != 0;
}
}

bool GatheredVolume::changed(vtkImageData* part, const int whole[6])
{
  std::vector<Known> arrays;
  std::vector<int> extents(whole, whole + 6);
  if (part)
  {
    extents.insert(extents.end(), part->GetExtent(), part->GetExtent() + 6);
    for (vtkDataSetAttributes* attributes :
      std::array<vtkDataSetAttributes*, 2>{ part->GetPointData(), part->GetCellData() })
    {
      for (vtkDataArray* array : sentOf(attributes))
      {
        arrays.push_back({ array, array->GetMTime() });
      }
    }
  }
  const bool isChanged = arrays != this->Arrays || extents != this->Extents;
  this->Arrays = arrays;
  this->Extents = extents;
  return isChanged;
}

// Begins with the part of the first rank.
void GatheredVolume::place(vtkImageData* part, const int whole[6])
{
  this->Voxels = vtkSmartPointer<vtkImageData>::New();
  if (!part)
  {
    return;
  }
  this->Voxels->SetExtent(const_cast<int*>(whole));
  for (vtkDataArray* array : sentOf(part->GetPointData()))
  {
    copyInto(this->Voxels, false, array, part->GetExtent());
  }
  for (vtkDataArray* array : sentOf(part->GetCellData()))
  {
    copyInto(this->Voxels, true, array, part->GetExtent());
  }
}

void GatheredVolume::receive(vtkMultiProcessController* ranks, int rank)
{
  Head head = NoPart;
  ranks->Receive(head.data(), head.size(), rank, Tag);
  for (int i = 0; i < head[PointArrays] + head[CellArrays]; ++i)
  {
    int type = VTK_FLOAT;
    ranks->Receive(&type, 1, rank, Tag);
    const auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
    ranks->Receive(array.Get(), rank, Tag);
    copyInto(this->Voxels, i >= head[PointArrays], array, head.data());
  }
}

vtkSmartPointer<vtkImageData> GatheredVolume::gather(
  vtkMultiProcessController* ranks, vtkImageData* part, const int whole[6])
{
  const bool first = ranks->GetLocalProcessId() == FirstRank;
  if (isTrueOnAny(ranks, this->changed(part, whole)))
  {
    if (first)
    {
      this->place(part, whole);
    }
    else
    {
      send(ranks, part);
    }
    for (int rank = FirstRank + 1; first && rank < ranks->GetNumberOfProcesses(); ++rank)
    {
      this->receive(ranks, rank);
    }
  }
  auto volume = vtkSmartPointer<vtkImageData>::New();
  if (first && part)
  {
    volume->ShallowCopy(this->Voxels);
    volume->SetOrigin(part->GetOrigin());
    volume->SetSpacing(part->GetSpacing());
    volume->SetDirectionMatrix(part->GetDirectionMatrix());
    volume->GetFieldData()->ShallowCopy(part->GetFieldData());
    if (vtkDataArray* scalars = part->GetPointData()->GetScalars())
    {
      volume->GetPointData()->SetActiveScalars(scalars->GetName());
    }
  }
  return volume;
}
}
