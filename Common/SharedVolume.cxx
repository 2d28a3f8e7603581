// SPDX-License-Identifier: BSD-3-Clause
#include "Common/SharedVolume.h"

#include "Common/Extent.h"
#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/PiecedArray.h"
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

Extent heldBy(vtkImageData* part)
{
  Extent extent{ 0, -1, 0, -1, 0, -1 };
  if (part && part->GetNumberOfPoints() > 0)
  {
    part->GetExtent(extent.data());
  }
  return extent;
}

// The points or cells of an extent of points, as an extent that counts these: cells by their first
// point. Cells along an axis of one point count as one.
Extent countedOf(const Extent& points, bool cells)
{
  Extent counted = points;
  for (int axis = 0; axis < 3; ++axis)
  {
    counted[2 * axis + 1] -= cells && points[2 * axis + 1] > points[2 * axis] ? 1 : 0;
  }
  return counted;
}

vtkIdType sizeOf(const Extent& counted)
{
  return static_cast<vtkIdType>(pointsIn(counted));
}

// What an extent has beyond another one: up to six boxes, in the same order on all ranks.
std::vector<Extent> beyond(const Extent& extent, const Extent& other)
{
  Extent inner = common(extent, other);
  if (isEmpty(extent) || isEmpty(inner))
  {
    return isEmpty(extent) ? std::vector<Extent>() : std::vector<Extent>{ extent };
  }
  std::vector<Extent> boxes;
  boxes.reserve(6);
  Extent left = extent; // what no box has yet
  for (int axis = 2; axis >= 0; --axis)
  {
    Extent below = left;
    Extent above = left;
    below[2 * axis + 1] = inner[2 * axis] - 1;
    above[2 * axis] = inner[2 * axis + 1] + 1;
    boxes.push_back(below);
    boxes.push_back(above);
    left[2 * axis] = inner[2 * axis];
    left[2 * axis + 1] = inner[2 * axis + 1];
  }
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(), isEmpty), boxes.end());
  return boxes;
}

// Copies values of a box from an array of an extent to an array of another. Extents count values.
void copyBox(const Extent& box, const ArrayPiece& from, const ArrayPiece& to)
{
  const auto at = [](const Extent& e, int x, int y, int z) {
    const vtkIdType row = static_cast<vtkIdType>(z - e[4]) * (e[3] - e[2] + 1) + y - e[2];
    return row * (e[1] - e[0] + 1) + x - e[0];
  };
  for (int z = box[4]; z <= box[5]; ++z)
  {
    for (int y = box[2]; y <= box[3]; ++y)
    {
      to.values->InsertTuples(at(to.layout, box[0], y, z), box[1] - box[0] + 1,
        at(from.layout, box[0], y, z), from.values);
    }
  }
}

vtkDataSetAttributes* attributesOf(vtkImageData* volume, bool cells)
{
  if (cells)
  {
    return volume->GetCellData();
  }
  return volume->GetPointData();
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

double bytesOf(const Exchanged& array, const Extent& counted)
{
  return pointsIn(counted) * array.components * vtkDataArray::GetDataTypeSize(array.type);
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

// Values on the way between two ranks: one layer for each message, so that a rank without memory
// for more can still send.
class Layer
{
public:
  explicit Layer(const Exchanged& array)
    : Array(array)
    , Values(zeros(array, 0))
  {
  }

  // Has room for the layers of a box.
  void reserve(Extent box)
  {
    box[5] = std::min(box[4], box[5]);
    if (sizeOf(box) > this->Values->GetNumberOfTuples())
    {
      this->Values = zeros(this->Array, sizeOf(box));
    }
  }

  // Calls move(layer, bytes) for each layer of a box.
  template <typename Move>
  void forEach(const Extent& box, const Move& move) const
  {
    for (int z = box[4]; !isEmpty(box) && z <= box[5]; ++z)
    {
      const Extent layer{ box[0], box[1], box[2], box[3], z, z };
      move(ArrayPiece{ layer, layer, this->Values },
        static_cast<vtkIdType>(bytesOf(this->Array, layer)));
    }
  }

private:
  Exchanged Array;
  vtkSmartPointer<vtkDataArray> Values;
};

// One array while it is exchanged. Extents count its values, points or cells.
class Transfer
{
public:
  // Takes all memory that it needs, or throws. `own`: null, if this rank holds none.
  Transfer(const Exchanged& array, vtkDataArray* own, const std::vector<Extent>& held,
    const std::vector<Extent>& wanted, int rank)
    : Array(array)
    , Own{ held[rank], held[rank], nullptr }
    , Wanted(wanted[rank])
    , Message(array)
  {
    if (own)
    {
      this->Own.values = contiguous(own);
    }
    for (const Extent& box : beyond(wanted[rank], held[rank]))
    {
      this->Lacking.push_back({ box, box, zeros(array, sizeOf(box)) });
    }
    this->Lacks.reserve(held.size());
    this->Held = held;
    for (std::size_t other = 0; other < held.size(); ++other)
    {
      this->Lacks.push_back(beyond(wanted[other], held[other]));
      for (const Extent& box : this->Lacks.back())
      {
        this->Message.reserve(common(box, held[rank]));
      }
      for (const ArrayPiece& piece : this->Lacking)
      {
        this->Message.reserve(common(piece.box, held[other]));
      }
    }
  }

  // What another rank lacks and this one holds.
  void send(vtkMultiProcessController* ranks, int to) const
  {
    for (const Extent& box : this->Lacks[to])
    {
      this->Message.forEach(
        common(box, this->Own.box), [&](const ArrayPiece& layer, vtkIdType bytes) {
          copyBox(layer.box, this->Own, layer);
          ranks->GetCommunicator()->SendVoidArray(
            layer.values->GetVoidPointer(0), bytes, VTK_UNSIGNED_CHAR, to, Tag);
        });
    }
  }

  // The other side of send.
  void receive(vtkMultiProcessController* ranks, int from) const
  {
    for (const ArrayPiece& piece : this->Lacking)
    {
      this->Message.forEach(
        common(piece.box, this->Held[from]), [&](const ArrayPiece& layer, vtkIdType bytes) {
          ranks->GetCommunicator()->ReceiveVoidArray(
            layer.values->GetVoidPointer(0), bytes, VTK_UNSIGNED_CHAR, from, Tag);
          copyBox(layer.box, layer, piece);
        });
    }
  }

  // The wanted values; own ones stay where they are.
  vtkSmartPointer<vtkDataArray> values() const
  {
    std::vector<ArrayPiece> pieces = this->Lacking;
    if (this->Own.values && !isEmpty(common(this->Wanted, this->Own.box)))
    {
      pieces.push_back(this->Own);
    }
    return pieces.empty() ? zeros(this->Array, 0) : arrayOfPieces(this->Wanted, pieces);
  }

  bool ofCells() const { return this->Array.ofCells; }

private:
  Exchanged Array;
  ArrayPiece Own;
  Extent Wanted;
  Layer Message;
  std::vector<ArrayPiece> Lacking;        // of what this rank wants and does not hold
  std::vector<std::vector<Extent>> Lacks; // of each rank
  std::vector<Extent> Held;               // by each rank
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

std::vector<Extent> countedOfAll(const std::vector<Extent>& extents, bool cells)
{
  std::vector<Extent> counted;
  counted.reserve(extents.size());
  for (const Extent& extent : extents)
  {
    counted.push_back(countedOf(extent, cells));
  }
  return counted;
}

// The voxels that ranks lack, while they are exchanged. The ranks' extents are known to all.
class Exchange
{
public:
  Exchange(const std::vector<Extent>& held, const std::vector<Extent>& wanted)
    : Held(held)
    , Wanted(wanted)
  {
  }

  // Bytes that a rank lacks. Known after prepare.
  double bytesOfRank(int rank) const
  {
    double bytes = 0.0;
    for (const Exchanged& array : this->Arrays)
    {
      const Extent wanted = countedOf(this->Wanted[rank], array.ofCells);
      for (const Extent& box : beyond(wanted, countedOf(this->Held[rank], array.ofCells)))
      {
        bytes += bytesOf(array, box);
      }
    }
    return bytes;
  }

  // Takes all memory that an exchange needs, or throws.
  void prepare(vtkImageData* part, const std::vector<Exchanged>& arrays, int rank,
    const std::vector<long long>& machines)
  {
    const Extent& own = this->Wanted[rank];
    this->Arrays = arrays;
    std::vector<ProcessNeed> needs;
    needs.reserve(machines.size());
    for (std::size_t i = 0; i < machines.size(); ++i)
    {
      needs.push_back({ machines[i], this->bytesOfRank(static_cast<int>(i)) });
    }
    const std::string what = "its part of the volume, " +
      sizeText(glm::dvec3(own[1] - own[0] + 1, own[3] - own[2] + 1, own[5] - own[4] + 1)) +
      " voxels,";
    requireHostMemory(what, needs[rank].bytes);
    throwIfAny(sharedMemoryProblem(what, needs, rank, freeMachineMemory()));
    throwIfAny(sentenceThrownBy(what, [&] {
      for (const Exchanged& array : arrays)
      {
        this->Transfers.emplace_back(array, ownValues(part, array),
          countedOfAll(this->Held, array.ofCells), countedOfAll(this->Wanted, array.ofCells), rank);
      }
    }));
  }

  // Pairs of ranks take turns in one order, so that none waits for another in a circle.
  void run(vtkMultiProcessController* ranks)
  {
    const int own = ranks->GetLocalProcessId();
    const int count = ranks->GetNumberOfProcesses();
    for (const Transfer& transfer : this->Transfers)
    {
      for (int a = 0; a < count; ++a)
      {
        for (int b = a + 1; b < count; ++b)
        {
          const int other = own == a ? b : a;
          if (own == a)
          {
            transfer.send(ranks, other);
          }
          if (own == a || own == b)
          {
            transfer.receive(ranks, other);
          }
          if (own == b)
          {
            transfer.send(ranks, other);
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
      attributesOf(image, transfer.ofCells())->AddArray(transfer.values());
    }
    return image;
  }

private:
  const std::vector<Extent>& Held;
  const std::vector<Extent>& Wanted;
  std::vector<Exchanged> Arrays;
  std::vector<Transfer> Transfers;
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
    const Extent extent = heldBy(part);
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
  const Extent held = heldBy(part);
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
  const std::vector<Extent> allHeld = extentsOfAll(ranks, heldBy(part));
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
    this->Received = exchange.bytesOfRank(own);
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
