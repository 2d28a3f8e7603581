// SPDX-License-Identifier: BSD-3-Clause
#include "Common/SharedVolume.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/RankAgreement.h"

#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <sstream>
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
    if (!name.empty() && name != vtkDataSetAttributes::GhostArrayName() &&
      array->GetDataType() != VTK_BIT)
    {
      arrays.push_back(array);
    }
  }
  return arrays;
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

// An array that ranks exchange.
struct Exchanged
{
  bool ofCells;
  int type; // of VTK
  int components;
  std::string name;

  bool isLike(vtkDataArray* array) const
  {
    return array->GetDataType() == this->type &&
      array->GetNumberOfComponents() == this->components && array->GetName() == this->name;
  }
};

// The first rank that has some of the volume; the number of ranks if none has.
int firstHolder(const std::vector<Extent>& held)
{
  return static_cast<int>(std::find_if_not(held.begin(), held.end(), isEmpty) - held.begin());
}

// That rank, if another one wants voxels and has none, not even their names; else -1.
int lenderOf(const std::vector<Extent>& held, const std::vector<Extent>& wanted)
{
  const int first = firstHolder(held);
  for (std::size_t i = 0; i < held.size() && first < static_cast<int>(held.size()); ++i)
  {
    if (isEmpty(held[i]) && !isEmpty(wanted[i]))
    {
      return first;
    }
  }
  return -1;
}

// The arrays of the first rank that has some of the volume, known to all ranks.
std::vector<Exchanged> exchangedBy(
  vtkMultiProcessController* ranks, vtkImageData* part, const std::vector<Extent>& held)
{
  const int first = firstHolder(held);
  std::ostringstream own;
  if (ranks->GetLocalProcessId() == first)
  {
    for (const bool cells : { false, true })
    {
      for (vtkDataArray* array : sentOf(attributesOf(part, cells)))
      {
        own << cells << ' ' << array->GetDataType() << ' ' << array->GetNumberOfComponents() << ' '
            << array->GetName() << '\0';
      }
    }
  }
  const bool isHeld = first < static_cast<int>(held.size());
  std::vector<Exchanged> arrays;
  std::istringstream lines(isHeld ? textOf(ranks, own.str(), first) : std::string());
  for (std::string line; std::getline(lines, line, '\0');)
  {
    Exchanged array{};
    std::istringstream words(line);
    words >> array.ofCells >> array.type >> array.components;
    words.get(); // the space before the name
    std::getline(words, array.name, '\0');
    arrays.push_back(array);
  }
  return arrays;
}

// This rank's values of an array; null: it has none.
vtkDataArray* ownValues(vtkImageData* part, const Exchanged& array)
{
  if (!part || part->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  vtkDataArray* own = attributesOf(part, array.ofCells)->GetArray(array.name.c_str());
  if (!own || !array.isLike(own))
  {
    throw Problem("its part of the volume has no array \"" + array.name +
      "\" like that of the first rank with voxels");
  }
  return own;
}

double bytesOf(const Exchanged& array, const Extent& extent)
{
  return static_cast<double>(tuplesOf(extent, array.ofCells)) * array.components *
    vtkDataArray::GetDataTypeSize(array.type);
}

// An array of zeros. It throws where memory is refused: VTK would print a line of its own.
vtkSmartPointer<vtkDataArray> zeros(const Exchanged& array, vtkIdType tuples)
{
  const auto values = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(array.type));
  values->SetName(array.name.c_str());
  values->SetNumberOfComponents(array.components);
  const vtkIdType numbers = tuples * array.components;
  void* memory = std::calloc(std::max<vtkIdType>(numbers, 1), values->GetDataTypeSize());
  if (!memory)
  {
    throw std::bad_alloc();
  }
  values->SetVoidArray(memory, numbers, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  return values;
}

// Values on the way between two ranks: one layer of points or cells for each message, so that a
// rank without memory for more can still send.
class Layer
{
public:
  explicit Layer(const Exchanged& array)
    : Array(array)
  {
  }

  // Has room for the layers of an extent.
  void reserve(const Extent& extent)
  {
    const Extent layer{ extent[0], extent[1], extent[2], extent[3], 0, 0 };
    const vtkIdType tuples = isEmpty(extent) ? 0 : tuplesOf(layer, this->Array.ofCells);
    if (!this->Values || tuples > this->Values->GetNumberOfTuples())
    {
      this->Values = zeros(this->Array, tuples);
    }
  }

  // Calls move(layer, bytes) for each layer of an extent.
  template <typename Move>
  void forEach(const Extent& extent, const Move& move)
  {
    const IndexRange range = rangeOf(extent.data(), this->Array.ofCells);
    for (int k = 0; k < range.count[2]; ++k)
    {
      Extent layer = extent;
      layer[4] = layer[5] = range.first[2] + k;
      move(layer, static_cast<vtkIdType>(bytesOf(this->Array, layer)));
    }
  }

  vtkDataArray* values() const { return this->Values; }

private:
  const Exchanged& Array;
  vtkSmartPointer<vtkDataArray> Values;
};

// One array while it is exchanged.
struct Transfer
{
  Exchanged array;
  vtkDataArray* own = nullptr;          // of `held`
  vtkSmartPointer<vtkDataArray> target; // of `wanted`
  Extent held{};
  Extent wanted{};

  // What moves from one extent to another; empty: nothing.
  Extent moved(const Extent& from, const Extent& to) const
  {
    const Extent both = common(from, to);
    const bool moves = !isEmpty(both) && (!this->array.ofCells || hasCells(both, from));
    return moves ? both : Extent{ 0, -1, 0, -1, 0, -1 };
  }

  void keep() const
  {
    const Extent kept = this->moved(this->held, this->wanted);
    if (!isEmpty(kept))
    {
      Copy{ this->own, this->held, this->target, this->wanted }.run(kept, this->array.ofCells);
    }
  }

  void send(vtkMultiProcessController* ranks, Layer& layer, const Extent& to, int rank) const
  {
    layer.forEach(this->moved(this->held, to), [&](const Extent& extent, vtkIdType bytes) {
      Copy{ this->own, this->held, layer.values(), extent }.run(extent, this->array.ofCells);
      ranks->GetCommunicator()->SendVoidArray(
        layer.values()->GetVoidPointer(0), bytes, VTK_UNSIGNED_CHAR, rank, Tag);
    });
  }

  void receive(vtkMultiProcessController* ranks, Layer& layer, const Extent& from, int rank) const
  {
    layer.forEach(this->moved(from, this->wanted), [&](const Extent& extent, vtkIdType bytes) {
      ranks->GetCommunicator()->ReceiveVoidArray(
        layer.values()->GetVoidPointer(0), bytes, VTK_UNSIGNED_CHAR, rank, Tag);
      Copy{ layer.values(), extent, this->target, this->wanted }.run(extent, this->array.ofCells);
    });
  }
};

// The range of each component of all values and of their magnitude, finite ones alone.
WholeRanges rangesOf(
  vtkMultiProcessController* ranks, vtkImageData* part, const std::vector<Exchanged>& arrays)
{
  std::vector<double> own; // with the least negated, so that one maximum finds all
  for (const Exchanged& array : arrays)
  {
    vtkDataArray* values = ownValues(part, array);
    constexpr int magnitude = -1; // as VTK numbers it
    for (int component = 0; component <= array.components; ++component)
    {
      double range[2] = { 1e300, -1e300 };
      if (values)
      {
        values->GetFiniteRange(range, component < array.components ? component : magnitude);
      }
      own.push_back(-range[0]);
      own.push_back(range[1]);
    }
  }
  std::vector<double> all = own;
  ranks->AllReduce(own.data(), all.data(), own.size(), vtkCommunicator::MAX_OP);
  WholeRanges ranges;
  auto range = all.begin();
  for (const Exchanged& array : arrays)
  {
    std::vector<std::array<double, 2>> components(array.components + 1);
    for (std::array<double, 2>& component : components)
    {
      component = { -range[0], range[1] };
      range += 2;
    }
    ranges[{ array.ofCells, array.name }] = components;
  }
  return ranges;
}

std::vector<Extent> extentsOfAll(vtkMultiProcessController* ranks, const Extent& own)
{
  std::vector<Extent> all(ranks->GetNumberOfProcesses());
  ranks->AllGather(own.data(), all[0].data(), 6);
  return all;
}

std::vector<long long> machinesOfAll(vtkMultiProcessController* ranks)
{
  const long long own = machineNumber();
  std::vector<long long> all(ranks->GetNumberOfProcesses());
  ranks->AllGather(&own, all.data(), 1);
  return all;
}

// Takes all memory that an exchange needs, or throws. The ranks' extents are known to all.
class Exchange
{
public:
  Exchange(const std::vector<Extent>& held, const std::vector<Extent>& wanted)
    : Held(held)
    , Wanted(wanted)
  {
  }

  void prepare(vtkImageData* part, const std::vector<Exchanged>& arrays, int rank,
    const std::vector<long long>& machines)
  {
    const Extent& own = this->Wanted[rank];
    std::vector<ProcessNeed> needs;
    for (std::size_t i = 0; i < machines.size(); ++i)
    {
      const Extent& wanted = this->Wanted[i];
      needs.push_back({ machines[i], 0.0 });
      for (const Exchanged& array : arrays)
      {
        needs[i].bytes += isEmpty(wanted) ? 0.0 : bytesOf(array, wanted);
      }
    }
    const std::string what = "its part of the volume, " +
      sizeText(glm::dvec3(own[1] - own[0] + 1, own[3] - own[2] + 1, own[5] - own[4] + 1)) +
      " voxels,";
    requireHostMemory(what, needs[rank].bytes);
    throwIfAny(sharedMemoryProblem(what, needs, rank, freeMachineMemory()));
    throwIfAny(sentenceThrownBy(what, [&] {
      this->Arrays = arrays;
      for (const Exchanged& array : this->Arrays)
      {
        this->take(array, ownValues(part, array), rank);
      }
    }));
  }

  // Pairs of ranks take turns in one order, so that none waits for another in a circle.
  void run(vtkMultiProcessController* ranks)
  {
    const int own = ranks->GetLocalProcessId();
    const int count = ranks->GetNumberOfProcesses();
    for (std::size_t i = 0; i < this->Transfers.size(); ++i)
    {
      const Transfer& transfer = this->Transfers[i];
      transfer.keep();
      for (int a = 0; a < count; ++a)
      {
        for (int b = a + 1; b < count; ++b)
        {
          const int other = own == a ? b : a;
          if (own == a)
          {
            transfer.send(ranks, this->Layers[i], this->Wanted[other], other);
          }
          if (own == a || own == b)
          {
            transfer.receive(ranks, this->Layers[i], this->Held[other], other);
          }
          if (own == b)
          {
            transfer.send(ranks, this->Layers[i], this->Wanted[other], other);
          }
        }
      }
    }
  }

  vtkSmartPointer<vtkImageData> volume(int rank) const
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetExtent(const_cast<int*>(this->Wanted[rank].data()));
    for (const Transfer& transfer : this->Transfers)
    {
      attributesOf(image, transfer.array.ofCells)->AddArray(transfer.target);
    }
    return image;
  }

private:
  void take(const Exchanged& array, vtkDataArray* own, int rank)
  {
    Transfer transfer{ array, own, nullptr, this->Held[rank], this->Wanted[rank] };
    const bool wants = !isEmpty(transfer.wanted);
    transfer.target = zeros(array, wants ? tuplesOf(transfer.wanted, array.ofCells) : 0);
    Layer layer(array);
    layer.reserve({ 0, -1, 0, -1, 0, -1 });
    for (std::size_t other = 0; other < this->Held.size(); ++other)
    {
      layer.reserve(transfer.moved(transfer.held, this->Wanted[other]));
      layer.reserve(transfer.moved(this->Held[other], transfer.wanted));
    }
    this->Transfers.push_back(transfer);
    this->Layers.push_back(layer);
  }

  const std::vector<Extent>& Held;
  const std::vector<Extent>& Wanted;
  std::vector<Exchanged> Arrays;
  std::vector<Transfer> Transfers;
  std::vector<Layer> Layers;
};
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

std::string SharedVolume::exchange(vtkMultiProcessController* ranks, vtkImageData* part,
  const Extent& wanted, const std::string& problem)
{
  const vtkTimerLogScope shown("Exchange voxels between MPI ranks"); // in ParaView's Timer Log
  const std::vector<Extent> allHeld = extentsOfAll(ranks, extentOf(part));
  const std::vector<Extent> allWanted = extentsOfAll(ranks, wanted);
  const std::vector<Exchanged> arrays = exchangedBy(ranks, part, allHeld);
  const std::vector<long long> machines = machinesOfAll(ranks);
  const int own = ranks->GetLocalProcessId();
  Exchange exchange(allHeld, allWanted);
  std::string refused = problem;
  if (refused.empty())
  {
    refused = sentenceThrownBy(
      "its part of the volume", [&] { exchange.prepare(part, arrays, own, machines); });
  }
  refused = problemOnAny(ranks, refused);
  if (refused.empty())
  {
    exchange.run(ranks);
    this->Voxels = exchange.volume(own);
    this->Lender = lenderOf(allHeld, allWanted);
    this->Ranges = rangesOf(ranks, part, arrays);
  }
  return refused;
}

vtkSmartPointer<vtkImageData> SharedVolume::share(vtkMultiProcessController* ranks,
  vtkImageData* part, const WholeVolume& whole, const Extent& wanted, std::string& problem)
{
  if (isTrueOnAny(ranks, this->changed(part, whole.extent, wanted) || !problem.empty()))
  {
    problem = this->exchange(ranks, part, wanted, problem);
    if (!problem.empty())
    {
      this->Extents.clear(); // the next time is another try
      return nullptr;
    }
  }
  const Said said = this->lend(ranks, part);
  auto volume = vtkSmartPointer<vtkImageData>::New();
  if (isEmpty(wanted))
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
  volume->GetFieldData()->ShallowCopy(said.fields);
  volume->GetPointData()->SetActiveScalars(said.scalars.c_str());
  return volume;
}

// A rank that holds no voxels may not know the rest, either: it gets what the first rank with some
// says. Its own counts more, as far as it goes.
SharedVolume::Said SharedVolume::lend(vtkMultiProcessController* ranks, vtkImageData* part) const
{
  Said said{ vtkSmartPointer<vtkFieldData>::New(), "" };
  vtkDataArray* scalars = part ? part->GetPointData()->GetScalars() : nullptr;
  said.scalars = scalars && scalars->GetName() ? scalars->GetName() : "";
  if (this->Lender >= 0)
  {
    vtkNew<vtkPolyData> sent; // without points
    if (ranks->GetLocalProcessId() == this->Lender)
    {
      sent->GetFieldData()->ShallowCopy(part->GetFieldData());
    }
    ranks->Broadcast(sent, this->Lender);
    said.fields->ShallowCopy(sent->GetFieldData());
    const std::string theirs = textOf(ranks, said.scalars, this->Lender);
    said.scalars = said.scalars.empty() ? theirs : said.scalars;
  }
  for (int i = 0; part && i < part->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    said.fields->AddArray(part->GetFieldData()->GetAbstractArray(i));
  }
  return said;
}
}
