// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/SharedVolume.h"

#include "Common/ImageGrid.h"

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
constexpr int Tag = 20713; // of our messages, which none of ParaView's may answer

// Cells along an axis of one point count as one.
struct IndexRange
{
  int first[3];
  int count[3];
};

IndexRange rangeOf(const int extent[6], bool cells)
{
  IndexRange box{};
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

// The array of this name over the wanted extent; a new one is filled with 0.
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

Extent extentOf(vtkImageData* part)
{
  Extent extent{ 0, -1, 0, -1, 0, -1 };
  if (part && part->GetNumberOfPoints() > 0)
  {
    part->GetExtent(extent.data());
  }
  return extent;
}

bool isEmpty(const Extent& extent)
{
  return extent[1] < extent[0] || extent[3] < extent[2] || extent[5] < extent[4];
}

Extent common(const Extent& a, const Extent& b)
{
  Extent both{};
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::max(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::min(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

// Copies values of one extent from an array of an extent to an array of another.
struct Copy
{
  vtkDataArray* from;
  Extent fromExtent;
  vtkDataArray* to;
  Extent toExtent;

  void run(const Extent& extent, bool cells) const
  {
    const IndexRange copied = rangeOf(extent.data(), cells);
    const IndexRange source = rangeOf(this->fromExtent.data(), cells);
    const IndexRange target = rangeOf(this->toExtent.data(), cells);
    const auto startIn = [&](const IndexRange& range, int j, int k) {
      const vtkIdType y = copied.first[1] + j - range.first[1];
      const vtkIdType z = copied.first[2] + k - range.first[2];
      return (z * range.count[1] + y) * range.count[0] + copied.first[0] - range.first[0];
    };
    for (int k = 0; k < copied.count[2]; ++k)
    {
      for (int j = 0; j < copied.count[1]; ++j)
      {
        this->to->InsertTuples(
          startIn(target, j, k), copied.count[0], startIn(source, j, k), this->from);
      }
    }
  }
};

vtkIdType tuplesOf(const Extent& extent, bool cells)
{
  const IndexRange range = rangeOf(extent.data(), cells);
  return static_cast<vtkIdType>(range.count[0]) * range.count[1] * range.count[2];
}

vtkDataSetAttributes* attributesOf(vtkImageData* volume, bool cells)
{
  if (cells)
  {
    return volume->GetCellData();
  }
  return volume->GetPointData();
}

void copyInto(vtkImageData* volume, bool cells, vtkDataArray* values, const Extent& extent)
{
  const Extent wanted = extentOf(volume);
  vtkDataArray* target = wholeLike(values, attributesOf(volume, cells), tuplesOf(wanted, cells));
  if (target)
  {
    Copy{ values, extent, target, wanted }.run(extent, cells);
  }
}

// Whether an extent has cells of a part: an extent of one layer of points has none, but in a part
// of one layer.
bool hasCells(const Extent& extent, const Extent& part)
{
  bool has = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    has = has && (extent[2 * axis + 1] > extent[2 * axis] || part[2 * axis + 1] == part[2 * axis]);
  }
  return has;
}

// Calls visit(array, cells) for copies of a part's arrays over an extent within it.
template <typename Visit>
void forEachCopy(vtkImageData* part, const Extent& extent, const Visit& visit)
{
  const Extent held = extentOf(part);
  for (const bool cells : { false, true })
  {
    for (vtkDataArray* array : sentOf(attributesOf(part, cells)))
    {
      if (!cells || hasCells(extent, held))
      {
        auto copy = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(array->GetDataType()));
        copy->SetName(array->GetName());
        copy->SetNumberOfComponents(array->GetNumberOfComponents());
        copy->SetNumberOfTuples(tuplesOf(extent, cells));
        Copy{ array, held, copy, extent }.run(extent, cells);
        visit(copy.Get(), cells);
      }
    }
  }
}

// What goes ahead of arrays: their extent, and how many arrays its points and cells have.
using Head = std::array<int, 8>;
constexpr int PointArrays = 6;
constexpr int CellArrays = 7;

void send(vtkMultiProcessController* ranks, vtkImageData* part, const Extent& wanted, int rank)
{
  const Extent extent = common(extentOf(part), wanted);
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  Head head{};
  std::copy(extent.begin(), extent.end(), head.begin());
  if (!isEmpty(extent))
  {
    forEachCopy(part, extent, [&](vtkDataArray* array, bool cells) {
      arrays.emplace_back(array);
      ++head[cells ? CellArrays : PointArrays];
    });
  }
  ranks->Send(head.data(), head.size(), rank, Tag);
  for (vtkDataArray* array : arrays)
  {
    const int type = array->GetDataType();
    ranks->Send(&type, 1, rank, Tag);
    ranks->Send(array, rank, Tag);
  }
}

void receive(vtkMultiProcessController* ranks, vtkImageData* volume, int rank)
{
  Head head{};
  ranks->Receive(head.data(), head.size(), rank, Tag);
  Extent extent{};
  std::copy_n(head.begin(), extent.size(), extent.begin());
  for (int i = 0; i < head[PointArrays] + head[CellArrays]; ++i)
  {
    int type = VTK_FLOAT;
    ranks->Receive(&type, 1, rank, Tag);
    const auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
    ranks->Receive(array.Get(), rank, Tag);
    copyInto(volume, i >= head[PointArrays], array, extent);
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

WholeVolume SharedVolume::wholeOf(
  vtkMultiProcessController* ranks, vtkImageData* part, const Extent& whole)
{
  const int count = ranks->GetNumberOfProcesses();
  const int own = part && part->GetNumberOfPoints() > 0 ? ranks->GetLocalProcessId() : count;
  int first = count;
  ranks->AllReduce(&own, &first, 1, vtkCommunicator::MIN_OP);
  WholeVolume volume;
  if (first == count)
  {
    return volume;
  }
  volume.extent = whole;
  Grid& grid = volume.grid;
  if (own == first)
  {
    const Grid held = gridOf(part);
    const Extent extent = extentOf(part);
    grid = held;
    grid.origin = held.worldFromGrid(
      glm::dvec3(whole[0] - extent[0], whole[2] - extent[2], whole[4] - extent[4]));
  }
  ranks->Broadcast(volume.extent.data(), 6, first);
  ranks->Broadcast(&grid.origin.x, 3, first);
  ranks->Broadcast(&grid.spacing.x, 3, first);
  ranks->Broadcast(&grid.direction[0].x, 9, first);
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = volume.extent[2 * axis + 1] - volume.extent[2 * axis] + 1;
  }
  return volume;
}

bool SharedVolume::changed(vtkImageData* part, const Extent& whole, const Extent& wanted)
{
  std::vector<Known> arrays;
  const Extent held = extentOf(part);
  std::vector<int> extents(whole.begin(), whole.end());
  extents.insert(extents.end(), held.begin(), held.end());
  extents.insert(extents.end(), wanted.begin(), wanted.end());
  for (const bool cells : { false, true })
  {
    for (vtkDataArray* array :
      part ? sentOf(attributesOf(part, cells)) : std::vector<vtkDataArray*>())
    {
      arrays.push_back({ array, array->GetMTime() });
    }
  }
  const bool isChanged = arrays != this->Arrays || extents != this->Extents;
  this->Arrays = arrays;
  this->Extents = extents;
  return isChanged;
}

// Pairs of ranks take turns in one order, so that none waits for another in a circle.
void SharedVolume::exchange(
  vtkMultiProcessController* ranks, vtkImageData* part, const Extent& wanted)
{
  const int own = ranks->GetLocalProcessId();
  const int count = ranks->GetNumberOfProcesses();
  std::vector<Extent> all(count);
  ranks->AllGather(wanted.data(), all[0].data(), 6);
  this->Voxels = vtkSmartPointer<vtkImageData>::New();
  this->Voxels->SetExtent(const_cast<int*>(wanted.data()));
  const Extent kept = common(extentOf(part), wanted);
  if (!isEmpty(kept))
  {
    forEachCopy(part, kept,
      [&](vtkDataArray* array, bool cells) { copyInto(this->Voxels, cells, array, kept); });
  }
  for (int a = 0; a < count; ++a)
  {
    for (int b = a + 1; b < count; ++b)
    {
      if (own == a)
      {
        send(ranks, part, all[b], b);
        receive(ranks, this->Voxels, b);
      }
      else if (own == b)
      {
        receive(ranks, this->Voxels, a);
        send(ranks, part, all[a], a);
      }
    }
  }
}

vtkSmartPointer<vtkImageData> SharedVolume::share(vtkMultiProcessController* ranks,
  vtkImageData* part, const WholeVolume& whole, const Extent& wanted)
{
  if (isTrueOnAny(ranks, this->changed(part, whole.extent, wanted)))
  {
    this->exchange(ranks, part, wanted);
  }
  auto volume = vtkSmartPointer<vtkImageData>::New();
  if (isEmpty(wanted) || !part)
  {
    return volume;
  }
  volume->ShallowCopy(this->Voxels);
  // VTK's origin is where the point 0, 0, 0 would be.
  const Extent& first = whole.extent;
  const glm::dvec3 origin = whole.grid.worldFromGrid(-glm::dvec3(first[0], first[2], first[4]));
  const glm::dmat3 rows = glm::transpose(whole.grid.direction);
  volume->SetOrigin(&origin.x);
  volume->SetSpacing(&whole.grid.spacing.x);
  volume->SetDirectionMatrix(&rows[0][0]);
  volume->GetFieldData()->ShallowCopy(part->GetFieldData());
  if (vtkDataArray* scalars = part->GetPointData()->GetScalars())
  {
    volume->GetPointData()->SetActiveScalars(scalars->GetName());
  }
  return volume;
}
}
