// SPDX-License-Identifier: BSD-3-Clause
#include "Common/SharedArray.h"

#include "Common/Parallel.h"

#include "vtkCharArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkTypeTraits.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

namespace brainshift
{
namespace
{
enum class Counted
{
  All,   // but NaN
  Finite // neither NaN nor infinite
};
constexpr int CountedKinds = 2;

// The range of each of C components of interleaved numbers, as VTK finds it: reversed where no
// number counts.
template <typename T, int C>
struct Ranges
{
  std::array<T, C> least;
  std::array<T, C> greatest;

  Ranges()
  {
    this->least.fill(vtkTypeTraits<T>::Max());
    this->greatest.fill(vtkTypeTraits<T>::Min());
  }
};

template <Counted Kind, typename T>
bool counts(T value)
{
  if constexpr (Kind == Counted::Finite && std::numeric_limits<T>::has_infinity)
  {
    return std::abs(value) <= std::numeric_limits<T>::max();
  }
  return true;
}

// Comparisons with NaN are false.
template <Counted Kind, typename T>
void widen(T value, T& least, T& greatest)
{
  const bool counted = counts<Kind>(value);
  least = counted && value < least ? value : least;
  greatest = counted && value > greatest ? value : greatest;
}

// Of the tuples `first` up to, but not including, `last`.
template <Counted Kind, int C, typename T>
Ranges<T, C> rangesOfPiece(const T* values, std::int64_t first, std::int64_t last)
{
  constexpr int laneCount = 16 * C; // independent of each other: the compiler makes them vectors
  Ranges<T, laneCount> lanes;
  const T* value = values + C * first;
  const T* const end = values + C * last;
  for (; end - value >= laneCount; value += laneCount)
  {
    for (int i = 0; i < laneCount; ++i)
    {
      widen<Kind>(value[i], lanes.least[i], lanes.greatest[i]);
    }
  }
  for (int i = 0; value + i < end; ++i)
  {
    widen<Kind>(value[i], lanes.least[i], lanes.greatest[i]);
  }
  Ranges<T, C> ranges;
  for (int i = 0; i < laneCount; ++i)
  {
    ranges.least[i % C] = std::min(ranges.least[i % C], lanes.least[i]);
    ranges.greatest[i % C] = std::max(ranges.greatest[i % C], lanes.greatest[i]);
  }
  return ranges;
}

template <Counted Kind, int C, typename T>
void findRanges(const T* values, std::int64_t tuples, double* found)
{
  constexpr std::int64_t grain = 1 << 20; // fewer are read faster than a thread starts
  Ranges<T, C> ranges;
  std::mutex mutex;
  parallelFor(0, tuples, grain, [&](std::int64_t first, std::int64_t last) {
    const Ranges<T, C> piece = rangesOfPiece<Kind, C>(values, first, last);
    const std::lock_guard<std::mutex> lock(mutex);
    for (int i = 0; i < C; ++i)
    {
      ranges.least[i] = std::min(ranges.least[i], piece.least[i]);
      ranges.greatest[i] = std::max(ranges.greatest[i], piece.greatest[i]);
    }
  });
  for (int i = 0; i < C; ++i)
  {
    found[2 * i] = static_cast<double>(ranges.least[i]);
    found[2 * i + 1] = static_cast<double>(ranges.greatest[i]);
  }
}

// False for numbers of components that no volume has.
template <Counted Kind, typename T>
bool findRanges(const T* values, std::int64_t tuples, int components, double* found)
{
  switch (components)
  {
    case 1:
      findRanges<Kind, 1>(values, tuples, found);
      return true;
    case 2:
      findRanges<Kind, 2>(values, tuples, found);
      return true;
    case 3:
      findRanges<Kind, 3>(values, tuples, found);
      return true;
    case 4:
      findRanges<Kind, 4>(values, tuples, found);
      return true;
    default:
      return false;
  }
}

// Looks like an ordinary array of type Base to everybody.
template <typename Base>
class SharedArray : public Base
{
public:
  static vtkSmartPointer<vtkDataArray> over(vtkDataArray* source)
  {
    auto array = vtkSmartPointer<SharedArray>::Take(new SharedArray);
    array->InitializeObjectBase();
    array->Source = source;
    array->ShallowCopy(source); // further copies keep the numbers, too
    array->SetLookupTable(source->GetLookupTable());
    return array;
  }

protected:
  bool ComputeScalarRange(
    double* ranges, const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return ghosts ? this->Base::ComputeScalarRange(ranges, ghosts, ghostsToSkip)
                  : this->template give<Counted::All>(ranges, &vtkDataArray::GetRange);
  }
  bool ComputeFiniteScalarRange(
    double* ranges, const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return ghosts ? this->Base::ComputeFiniteScalarRange(ranges, ghosts, ghostsToSkip)
                  : this->template give<Counted::Finite>(ranges, &vtkDataArray::GetFiniteRange);
  }

private:
  using RangeOf = void (vtkDataArray::*)(double[2], int);

  template <Counted Kind>
  bool give(double* ranges, RangeOf rangeOf)
  {
    auto* shared = dynamic_cast<SharedArray*>(this->Source.Get());
    if (shared && shared->GetPointer(0) == this->GetPointer(0))
    {
      return shared->template give<Kind>(ranges, rangeOf);
    }
    KnownRanges& known = this->Known[static_cast<int>(Kind)];
    const vtkMTimeType time = std::max(this->GetMTime(), this->Source->GetMTime());
    if (known.time != time)
    {
      const int components = this->GetNumberOfComponents();
      known.ranges.resize(2 * static_cast<std::size_t>(components));
      if (!findRanges<Kind>(
            this->GetPointer(0), this->GetNumberOfTuples(), components, known.ranges.data()))
      {
        for (int i = 0; i < components; ++i)
        {
          (this->Source->*rangeOf)(known.ranges.data() + 2 * static_cast<std::size_t>(i), i);
        }
      }
      known.time = time;
    }
    std::copy(known.ranges.begin(), known.ranges.end(), ranges);
    return true;
  }

  struct KnownRanges
  {
    vtkMTimeType time = 0;
    std::vector<double> ranges;
  };
  vtkSmartPointer<vtkDataArray> Source; // whose numbers these are
  std::array<KnownRanges, CountedKinds> Known;
};

// Such an array, which keeps its source; the source itself if its memory layout is unusual.
vtkSmartPointer<vtkDataArray> sharedOver(vtkDataArray* source)
{
  if (!source->HasStandardMemoryLayout())
  {
    return source;
  }
  switch (source->GetDataType())
  {
    case VTK_CHAR:
      return SharedArray<vtkCharArray>::over(source);
    case VTK_SIGNED_CHAR:
      return SharedArray<vtkSignedCharArray>::over(source);
    case VTK_UNSIGNED_CHAR:
      return SharedArray<vtkUnsignedCharArray>::over(source);
    case VTK_SHORT:
      return SharedArray<vtkShortArray>::over(source);
    case VTK_UNSIGNED_SHORT:
      return SharedArray<vtkUnsignedShortArray>::over(source);
    case VTK_INT:
      return SharedArray<vtkIntArray>::over(source);
    case VTK_UNSIGNED_INT:
      return SharedArray<vtkUnsignedIntArray>::over(source);
    case VTK_LONG:
      return SharedArray<vtkLongArray>::over(source);
    case VTK_UNSIGNED_LONG:
      return SharedArray<vtkUnsignedLongArray>::over(source);
    case VTK_LONG_LONG:
      return SharedArray<vtkLongLongArray>::over(source);
    case VTK_UNSIGNED_LONG_LONG:
      return SharedArray<vtkUnsignedLongLongArray>::over(source);
    case VTK_FLOAT:
      return SharedArray<vtkFloatArray>::over(source);
    case VTK_DOUBLE:
      return SharedArray<vtkDoubleArray>::over(source);
    default:
      return source;
  }
}
}

vtkSmartPointer<vtkDataArray> sharedAs(const char* name, vtkDataArray* source)
{
  vtkSmartPointer<vtkDataArray> shared = sharedOver(source);
  if (shared == source) // which keeps its own name
  {
    shared = vtk::TakeSmartPointer(source->NewInstance());
    shared->ShallowCopy(source);
  }
  shared->SetName(name);
  return shared;
}

vtkDataArray* RenamedArray::as(const char* name, vtkDataArray* source)
{
  if (!source)
  {
    return nullptr;
  }
  if (this->Source != source || this->Time != source->GetMTime())
  {
    this->Shared = sharedAs(name, source);
    this->Source = source;
    this->Time = source->GetMTime();
  }
  return this->Shared;
}

SharedArrays::SharedArrays() = default;
SharedArrays::~SharedArrays() = default;

void SharedArrays::share(vtkDataSetAttributes* attributes)
{
  std::vector<Entry> entries;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* source = attributes->GetArray(i);
    // An array without a name could not be put back in its place; ghosts are looked up by identity.
    const std::string name = source && source->GetName() ? source->GetName() : "";
    if (name.empty() || name == vtkDataSetAttributes::GhostArrayName())
    {
      continue;
    }
    const unsigned long long time = source->GetMTime();
    const auto known = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const Entry& entry) { return entry.source == source && entry.time == time; });
    entries.push_back(
      known != this->Entries.end() ? *known : Entry{ source, time, sharedOver(source) });
  }
  for (const Entry& entry : entries)
  {
    attributes->AddArray(entry.shared); // takes the place of the array of this name
  }
  this->Entries = std::move(entries);
}
}
