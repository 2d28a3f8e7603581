// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMUpright.h"

#include "Common/Parallel.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace brainshift
{
namespace
{
// One image as it lies on the grid.
template <typename T>
struct Placed
{
  const T* numbers = nullptr;
  int columns = 0;
  int rows = 0;
  DICOMShift shift;
  double outside = 0.0;

  double at(int column, int row) const
  {
    const bool isInside = column >= 0 && row >= 0 && column < this->columns && row < this->rows;
    return isInside
      ? static_cast<double>(
          this->numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(this->columns) +
            static_cast<std::size_t>(column)])
      : this->outside;
  }

  // At a point of the grid, bilinear.
  double onGrid(int column, int row) const
  {
    const double x = column - this->shift.columns;
    const double y = row - this->shift.rows;
    const int left = static_cast<int>(std::floor(x));
    const int below = static_cast<int>(std::floor(y));
    const double alongX = x - left;
    const double alongY = y - below;
    const double first =
      (1.0 - alongX) * this->at(left, below) + alongX * this->at(left + 1, below);
    return alongY == 0.0 ? first
                         : (1.0 - alongY) * first +
        alongY *
          ((1.0 - alongX) * this->at(left, below + 1) + alongX * this->at(left + 1, below + 1));
  }
};

template <typename T>
void makeUprightOf(const DICOMResampling& resampling, vtkImageData* images, vtkImageData* grid)
{
  int size[3];
  images->GetDimensions(size);
  const std::size_t count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  const auto* from = static_cast<const T*>(images->GetScalarPointer());
  const double least = images->GetPointData()->GetScalars()->GetRange()[0];
  const auto placed = [&](std::size_t image) {
    return Placed<T>{ from + image * count, size[0], size[1], resampling.shifts[image], least };
  };
  const auto slices = static_cast<std::int64_t>(resampling.slices.size());
  parallelFor(0, slices, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t z = begin; z < end; ++z)
    {
      const DICOMSlice& slice = resampling.slices[z];
      const Placed<T> lower = placed(slice.lower);
      const Placed<T> upper = placed(slice.lower + 1);
      auto* to = static_cast<T*>(grid->GetScalarPointer(0, 0, static_cast<int>(z)));
      for (int row = 0; row < resampling.rows; ++row)
      {
        for (int column = 0; column < resampling.columns; ++column)
        {
          const double mixed = slice.lowerWeight * lower.onGrid(column, row) +
            (1.0 - slice.lowerWeight) * upper.onGrid(column, row);
          *to++ = static_cast<T>(std::is_integral_v<T> ? std::round(mixed) : mixed);
        }
      }
    }
  });
}
}

void makeUpright(const DICOMResampling& resampling, vtkImageData* images, vtkImageData* grid)
{
  switch (images->GetScalarType())
  {
    vtkTemplateMacro(makeUprightOf<VTK_TT>(resampling, images, grid));
  }
}
}
