// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DerivedPixels.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double Lowest = -32768.0; // of 16 bits with a sign
constexpr double Highest = 32767.0;
constexpr double HighestUnsigned = 65535.0;
constexpr double MostPixels = 2147483647.0; // of a slice, whose bytes are counted in 32 bits

// Lowest and highest number, and whether all are whole.
struct Range
{
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool isFinite = true;
  bool isWhole = true;
};

Range rangeOf(vtkDataArray* numbers)
{
  Range range;
  for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
  {
    const double value = numbers->GetComponent(i, 0);
    range.isFinite = range.isFinite && std::isfinite(value);
    range.isWhole = range.isWhole && value == std::floor(value);
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

// The nearest numbers that the file holds, so that what is stored fits what is written.
double asWritten(double number)
{
  return std::strtod(decimalText(number).c_str(), nullptr);
}

void chooseRescaling(const Range& range, DerivedPixels& pixels)
{
  pixels.isSigned = range.low < 0.0 || range.high <= Highest;
  const double most = pixels.isSigned ? Highest : HighestUnsigned;
  if (range.isWhole && range.low >= Lowest && range.high <= most)
  {
    return;
  }
  pixels.isSigned = true;
  const double width = range.high - range.low;
  pixels.rescaling.slope = width > 0.0 ? asWritten(width / (Highest - Lowest)) : 1.0;
  pixels.rescaling.intercept = asWritten(range.low - Lowest * pixels.rescaling.slope);
}

// Stations show the first row on top and the first column on the left side of the screen: there
// belong the patient's front or head, and right side or front.
void turnUpright(DerivedPixels& pixels)
{
  Grid& grid = pixels.grid;
  for (int axis = 0; axis < 2; ++axis)
  {
    const glm::dvec3 size = glm::abs(grid.direction[axis]);
    const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const double toward = grid.direction[axis][along];
    pixels.reversed[axis] = along == 2 ? toward > 0.0 : toward < 0.0;
    if (pixels.reversed[axis])
    {
      const double length = grid.spacing[axis] * (grid.dimensions[axis] - 1);
      grid.origin += grid.direction[axis] * length;
      grid.direction[axis] = -grid.direction[axis];
    }
  }
}
}

std::string decimalText(double number)
{
  char text[32];
  const double exact = std::abs(number) < 1e-12 ? 0.0 : number; // no -0, no rest of a rotation
  std::snprintf(text, sizeof(text), "%.10g", exact);
  return text;
}

void derivedPixels(const OutgoingVolume& volume, DerivedPixels& pixels)
{
  if (volume.components() != 1)
  {
    throw Problem("The input has " + std::to_string(volume.components()) +
      " components at each voxel; a DICOM series must have 1");
  }
  const glm::ivec3& sides = volume.grid.dimensions;
  if (std::max(sides.x, sides.y) > HighestUnsigned || double(sides.x) * sides.y > MostPixels)
  {
    throw Problem("The input has slices of " + std::to_string(sides.x) + " x " +
      std::to_string(sides.y) +
      " voxels; DICOM holds at most 65535 on each side and 2147483647 in a slice");
  }
  const Range range = rangeOf(volume.numbers);
  if (!range.isFinite)
  {
    throw Problem("The input has a number that is not finite, which DICOM cannot hold");
  }
  pixels.grid = withReversedXY(volume.grid);
  pixels.smallIsBright = volume.smallIsBright;
  turnUpright(pixels);
  chooseRescaling(range, pixels);
}

std::vector<std::uint16_t> derivedSlice(
  const OutgoingVolume& volume, const DerivedPixels& pixels, int slice)
{
  const glm::ivec3& sides = pixels.grid.dimensions;
  std::vector<std::uint16_t> bits;
  bits.reserve(static_cast<std::size_t>(sides.x) * sides.y);
  const double least = pixels.isSigned ? Lowest : 0.0;
  const double most = pixels.isSigned ? Highest : HighestUnsigned;
  for (int row = 0; row < sides.y; ++row)
  {
    const int j = pixels.reversed[1] ? sides.y - 1 - row : row;
    for (int column = 0; column < sides.x; ++column)
    {
      const int i = pixels.reversed[0] ? sides.x - 1 - column : column;
      const auto at = static_cast<vtkIdType>(volume.grid.offset(i, j, slice));
      const double value = volume.numbers->GetComponent(at, 0);
      const double stored =
        std::round((value - pixels.rescaling.intercept) / pixels.rescaling.slope);
      bits.push_back(
        static_cast<std::uint16_t>(static_cast<std::int32_t>(std::clamp(stored, least, most))));
    }
  }
  return bits;
}
}
