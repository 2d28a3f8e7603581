// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/FittedFor.h"

#include "Common/FieldWord.h"
#include "Common/ImageGrid.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"

#include <glm/geometric.hpp>

#include <numeric>

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "FittedFor";
constexpr double BoxTolerance = 1e-6; // of a cell

// A mask is named by how much it lets move: image, labels, growth and feather all change that.
std::string wordsOnMask(const Lattice& lattice)
{
  if (!lattice.mask || lattice.mask->values.empty())
  {
    return "no mask";
  }
  const std::vector<float>& shares = lattice.mask->values;
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  return "a mask that lets " + std::to_string(100.0 * sum / static_cast<double>(shares.size())) +
    " % move";
}

// To rounding: on several MPI ranks each knows the box from its own piece.
bool coversSameBox(const Grid& one, const Grid& other)
{
  const glm::dvec3 last(one.dimensions - 1);
  return glm::distance(one.origin, other.origin) <= BoxTolerance * glm::length(one.spacing) &&
    glm::distance(one.worldFromGrid(last), other.worldFromGrid(last)) <=
    BoxTolerance * glm::length(one.spacing);
}

std::string wordsOn(const Lattice& lattice, int samples)
{
  const glm::ivec3& sides = lattice.grid.dimensions;
  return std::to_string(sides.x) + " x " + std::to_string(sides.y) + " x " +
    std::to_string(sides.z) + " control points, kernel " +
    (lattice.kernel == KernelCatmullRom ? "Catmull-Rom" : "B-Spline") + ", Samples " +
    std::to_string(samples) + ", " + wordsOnMask(lattice);
}
}

void nameFittedFor(vtkDataObject* image, const Lattice& lattice, int samples)
{
  setFieldWord(image, ArrayName, wordsOn(lattice, samples));
}

std::string wordsOnFittedFor(vtkDataObject* base, const Lattice& lattice, int samples)
{
  const std::string fitted = fieldWordOf(base, ArrayName);
  const std::string wanted = wordsOn(lattice, samples);
  auto* image = vtkImageData::SafeDownCast(base);
  if (image && fitted == wanted && !coversSameBox(gridOf(image), lattice.grid))
  {
    return "The base lattice was fitted over another box than that of this volume. The figures of "
           "the fit do not hold here: give Fit Deformation the same Input";
  }
  return fitted.empty() || fitted == wanted
    ? std::string()
    : "The base lattice was fitted for " + fitted + ". This deformation has " + wanted +
      ". The figures of the fit do not hold here: give Fit Deformation the same settings";
}
}
