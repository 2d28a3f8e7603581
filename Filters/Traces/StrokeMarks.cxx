// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Traces/StrokeMarks.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkTypeUInt64Array.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace brainshift
{
namespace
{
constexpr const char* MarksName = "FFDStrokeMarks";

std::uint64_t ofBytes(std::uint64_t mark, const void* bytes, std::size_t count)
{
  const char* at = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < count; done += sizeof(std::uint64_t))
  {
    std::uint64_t word = 0;
    std::memcpy(&word, at + done, std::min(sizeof(word), count - done));
    mark = mixed(mark, word);
  }
  return mark;
}

template <typename Number>
std::uint64_t ofNumbers(std::uint64_t mark, const std::vector<Number>& numbers)
{
  return ofBytes(mixed(mark, numbers.size()), numbers.data(), numbers.size() * sizeof(Number));
}
}

// Multiplies by an odd number near 2^64 / 1.618, then brings the high bits down.
std::uint64_t mixed(std::uint64_t mark, std::uint64_t number)
{
  const std::uint64_t product = (mark ^ number) * 0x9e3779b97f4a7c15U;
  return product ^ (product >> 32U);
}

StrokeMarks StrokeMarker::marksOf(
  const Lattice& start, const std::vector<double>& settings, const std::vector<double>& strokes)
{
  if (start.mask != this->Mask)
  {
    this->Mask = start.mask;
    this->MaskMark = this->Mask ? ofNumbers(this->Mask->perCell, this->Mask->values) : 0;
  }
  const Grid& grid = start.grid;
  std::uint64_t mark = mixed(this->MaskMark, static_cast<std::uint64_t>(start.kernel));
  mark = ofBytes(mark, &grid.dimensions, sizeof(grid.dimensions));
  mark = ofBytes(mark, &grid.origin, sizeof(grid.origin));
  mark = ofBytes(mark, &grid.spacing, sizeof(grid.spacing));
  mark = ofBytes(mark, &grid.direction, sizeof(grid.direction));
  StrokeMarks marks{ ofNumbers(ofNumbers(mark, start.displacements), settings) };
  for (std::size_t first = 0; first + NumbersPerStroke <= strokes.size(); first += NumbersPerStroke)
  {
    marks.push_back(ofBytes(marks.back(), &strokes[first], NumbersPerStroke * sizeof(double)));
  }
  return marks;
}

void attachMarks(vtkDataObject* volume, const StrokeMarks& marks)
{
  vtkNew<vtkTypeUInt64Array> array;
  array->SetName(MarksName);
  array->SetNumberOfValues(static_cast<vtkIdType>(marks.size()));
  std::copy(marks.begin(), marks.end(), array->GetPointer(0));
  volume->GetFieldData()->AddArray(array);
}

void forgetMarks(vtkDataObject* volume)
{
  volume->GetFieldData()->RemoveArray(MarksName);
}

StrokeMarks readMarks(vtkDataObject* volume)
{
  auto array =
    vtkTypeUInt64Array::SafeDownCast(volume->GetFieldData()->GetAbstractArray(MarksName));
  return array
    ? StrokeMarks(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
    : StrokeMarks();
}

void StrokeCurve::note(const StrokeMarks& marks, std::uint64_t how, double figure)
{
  this->Values.clear();
  if (marks.empty())
  {
    return;
  }
  this->Known[mixed(marks.back(), how)] = figure;
  for (const std::uint64_t mark : marks)
  {
    const auto found = this->Known.find(mixed(mark, how));
    this->Values.push_back(
      found == this->Known.end() ? std::numeric_limits<double>::quiet_NaN() : found->second);
  }
}
}
