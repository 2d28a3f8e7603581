// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/FittedFor.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/FieldWord.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "FittedFor";
constexpr int NumberOfNumbers = 14;
constexpr double BoxTolerance = 1e-6; // of a cell
// Single precision rounds each weight. The errors of many weights add up as the root of their
// number.
constexpr double WeightTolerance = 1e-6;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

struct FittedFor
{
  glm::ivec3 dimensions{ 0 };
  int kernel = 0;
  int samples = 0;
  glm::dvec3 first{ 0.0 };   // mm, corners of the box
  glm::dvec3 last{ 0.0 };    // mm
  glm::dvec3 weights{ NaN }; // sums over the mask; NaN: no mask. Old files: the plain sum alone

  bool hasMask() const { return !std::isnan(this->weights.x); }
  double nodes() const
  {
    const glm::dvec3 sides((this->dimensions - 1) * (this->samples + 1) + 1);
    return sides.x * sides.y * sides.z;
  }
};

// 1 and two numbers from -1 to 1 that look random (splitmix64 by Steele et al., 2014). Sums with
// them are equal, but for rounding, only if all weights are.
glm::dvec3 factorsOf(std::uint64_t node)
{
  std::uint64_t bits = (node + 1) * 0x9e3779b97f4a7c15U;
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebU;
  bits ^= bits >> 31;
  constexpr double Half = 2147483648.0;
  return { 1.0, double(bits & 0xffffffffU) / Half - 1.0, double(bits >> 32) / Half - 1.0 };
}

void setCorners(FittedFor& fitted, const Grid& grid)
{
  fitted.first = grid.origin;
  fitted.last = grid.worldFromGrid(glm::dvec3(grid.dimensions - 1));
}

FittedFor fittedFor(const Lattice& lattice, int samples)
{
  FittedFor result{ lattice.grid.dimensions, lattice.kernel, samples };
  setCorners(result, lattice.grid);
  if (lattice.mask && !lattice.mask->values.empty())
  {
    result.weights = glm::dvec3(0.0);
    const std::vector<float>& values = lattice.mask->values;
    for (std::size_t node = 0; node < values.size(); ++node)
    {
      if (values[node] != 0.0f)
      {
        result.weights += static_cast<double>(values[node]) * factorsOf(node);
      }
    }
  }
  return result;
}

// The string of old files, for example "19 x 19 x 19 control points, kernel Catmull-Rom, Samples 4,
// a mask that lets 12.345678 % move".
std::optional<FittedFor> oldFittedFor(vtkDataObject* base)
{
  static const std::regex form("(\\d{1,3}) x (\\d{1,3}) x (\\d{1,3}) control points, kernel "
                               "(Catmull-Rom|B-Spline), Samples (\\d{1,2}), "
                               "(no mask|a mask that lets (\\d{1,3}\\.\\d{1,9}) % move)");
  const std::string words = fieldWordOf(base, ArrayName);
  auto* image = vtkImageData::SafeDownCast(base);
  std::smatch parts;
  if (!image || !std::regex_match(words, parts, form))
  {
    return {};
  }
  FittedFor fitted;
  fitted.dimensions = { std::stoi(parts[1]), std::stoi(parts[2]), std::stoi(parts[3]) };
  fitted.kernel = parts[4] == "B-Spline" ? KernelBSpline : KernelCatmullRom;
  fitted.samples = std::stoi(parts[5]);
  setCorners(fitted, gridOf(image));
  if (parts[7].matched)
  {
    fitted.weights = { std::stod(parts[7]) / 100.0 * fitted.nodes(), NaN, NaN };
  }
  return fitted;
}

std::optional<FittedFor> fittedForOf(vtkDataObject* base)
{
  auto* array = base
    ? vtkDoubleArray::SafeDownCast(base->GetFieldData()->GetAbstractArray(ArrayName))
    : nullptr;
  if (!array || array->GetNumberOfValues() != NumberOfNumbers)
  {
    return oldFittedFor(base);
  }
  const double* numbers = array->GetPointer(0);
  return FittedFor{ glm::ivec3(glm::make_vec3(numbers)), static_cast<int>(numbers[3]),
    static_cast<int>(numbers[4]), glm::make_vec3(numbers + 5), glm::make_vec3(numbers + 8),
    glm::make_vec3(numbers + 11) };
}

// To rounding: on several MPI ranks each knows the box from its own piece.
bool coversSameBox(const FittedFor& one, const FittedFor& other)
{
  const double cell = glm::distance(other.first, other.last) /
    std::max(1, *std::max_element(&other.dimensions.x, &other.dimensions.x + 3));
  return glm::distance(one.first, other.first) <= BoxTolerance * cell &&
    glm::distance(one.last, other.last) <= BoxTolerance * cell;
}

// Of lattices with the same nodes.
bool hasSameMask(const FittedFor& one, const FittedFor& other)
{
  const glm::dvec3 away = glm::abs(one.weights - other.weights);
  if (std::isnan(one.weights.y) && one.hasMask()) // of an old file, which has six digits of percent
  {
    return away.x <= 1e-8 * one.nodes();
  }
  return one.hasMask() == other.hasMask() &&
    (!one.hasMask() ||
      glm::all(glm::lessThanEqual(away, glm::dvec3(WeightTolerance * std::sqrt(one.nodes())))));
}

std::string wordsOnMask(const FittedFor& fitted)
{
  std::ostringstream words;
  words << "a mask that lets " << 100.0 * fitted.weights.x / fitted.nodes() << " % move";
  return fitted.hasMask() ? words.str() : "no mask";
}

std::string wordsOnBox(const FittedFor& fitted)
{
  std::ostringstream words;
  words << "the box from " << fitted.first.x << " " << fitted.first.y << " " << fitted.first.z
        << " to " << fitted.last.x << " " << fitted.last.y << " " << fitted.last.z << " mm";
  return words.str();
}

// The settings that differ, with the value of either side.
struct Differences
{
  std::string fitted;
  std::string wanted;

  void add(const std::string& one, const std::string& other)
  {
    this->fitted += (this->fitted.empty() ? "" : ", ") + one;
    this->wanted += (this->wanted.empty() ? "" : ", ") + other;
  }
};

std::string wordsOnSides(const FittedFor& fitted)
{
  return "LatticeDimensions " + std::to_string(fitted.dimensions.x) + " x " +
    std::to_string(fitted.dimensions.y) + " x " + std::to_string(fitted.dimensions.z);
}

std::string wordsOnKernel(const FittedFor& fitted)
{
  return std::string("Kernel ") + (fitted.kernel == KernelCatmullRom ? "Catmull-Rom" : "B-Spline");
}

Differences differencesOf(const FittedFor& fitted, const FittedFor& wanted)
{
  Differences found;
  if (fitted.dimensions != wanted.dimensions)
  {
    found.add(wordsOnSides(fitted), wordsOnSides(wanted));
  }
  if (fitted.kernel != wanted.kernel)
  {
    found.add(wordsOnKernel(fitted), wordsOnKernel(wanted));
  }
  if (fitted.samples != wanted.samples)
  {
    found.add(
      "Samples " + std::to_string(fitted.samples), "Samples " + std::to_string(wanted.samples));
  }
  // Weights can be compared only at the same nodes.
  const bool hasSameNodes =
    fitted.dimensions == wanted.dimensions && fitted.samples == wanted.samples;
  if (hasSameNodes ? !hasSameMask(fitted, wanted) : fitted.hasMask() != wanted.hasMask())
  {
    const std::string one = wordsOnMask(fitted);
    const std::string other = wordsOnMask(wanted);
    found.add(
      one, other == one ? "another mask" + other.substr(std::string("a mask").size()) : other);
  }
  if (!coversSameBox(fitted, wanted))
  {
    found.add(wordsOnBox(fitted), wordsOnBox(wanted));
  }
  return found;
}
}

void attachFittedFor(vtkDataObject* image, const Lattice& lattice, int samples)
{
  const FittedFor fitted = fittedFor(lattice, samples);
  vtkNew<vtkDoubleArray> array;
  array->SetName(ArrayName);
  const auto add = [&array](const glm::dvec3& numbers) {
    for (int i = 0; i < 3; ++i)
    {
      array->InsertNextValue(numbers[i]);
    }
  };
  add(fitted.dimensions);
  array->InsertNextValue(fitted.kernel);
  array->InsertNextValue(fitted.samples);
  add(fitted.first);
  add(fitted.last);
  add(fitted.weights);
  image->GetFieldData()->AddArray(array);
}

std::string wordsOnFittedFor(vtkDataObject* base, const Lattice& lattice, int samples)
{
  const std::optional<FittedFor> fitted = fittedForOf(base);
  const Differences found =
    fitted ? differencesOf(*fitted, fittedFor(lattice, samples)) : Differences();
  return found.fitted.empty()
    ? std::string()
    : "The base lattice was fitted for " + found.fitted + ". This deformation has " + found.wanted +
      ". The figures of the fit do not hold here: give Fit Deformation the same settings and Input";
}
}
