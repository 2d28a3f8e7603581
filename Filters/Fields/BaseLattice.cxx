// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/BaseLattice.h"

#include "Common/FieldWord.h"
#include "Common/Numbers.h"
#include "Common/Parallel.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/ControlPoints.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Fields/TransformLattice.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <regex>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "FittedFor";
constexpr const char* DrawnWithName = "DrawnWith";
constexpr int NumberOfNumbers = 14;
constexpr double BoxTolerance = 1e-6; // of a cell
// Single precision rounds each weight. The errors of many weights add up as the root of their
// number.
constexpr double WeightTolerance = 1e-6;

// The numbers of the array, in this order.
struct FittedFor
{
  glm::dvec3 dimensions{ 0.0 };
  double kernel = 0.0;
  double samples = 0.0;
  glm::dvec3 first{ 0.0 };   // mm, corners of the box
  glm::dvec3 last{ 0.0 };    // mm
  glm::dvec3 weights{ NaN }; // sums over the mask; NaN: no mask. Old files: the plain sum alone

  bool hasMask() const { return !std::isnan(this->weights.x); }
  double nodes() const
  {
    const glm::dvec3 sides = (this->dimensions - 1.0) * (this->samples + 1.0) + 1.0;
    return sides.x * sides.y * sides.z;
  }
};
static_assert(sizeof(FittedFor) == NumberOfNumbers * sizeof(double));

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

FittedFor fittedFor(const Grid& grid, int kernel, int samples)
{
  return { glm::dvec3(grid.dimensions), double(kernel), double(samples), grid.origin,
    grid.worldFromGrid(glm::dvec3(grid.dimensions - 1)) };
}

FittedFor fittedFor(const Lattice& lattice, int samples)
{
  FittedFor result = fittedFor(lattice.grid, lattice.kernel, samples);
  if (lattice.mask && !lattice.mask->values.empty())
  {
    result.weights = glm::dvec3(0.0);
    const std::vector<float>& values = lattice.mask->values;
    for (std::size_t node = 0; node < values.size(); ++node)
    {
      if (values[node] != 0.0f) // most of a mask is empty
      {
        result.weights += double(values[node]) * factorsOf(node);
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
  FittedFor fitted = fittedFor(
    gridOf(image), parts[4] == "B-Spline" ? KernelBSpline : KernelCatmullRom, std::stoi(parts[5]));
  fitted.dimensions = { std::stoi(parts[1]), std::stoi(parts[2]), std::stoi(parts[3]) };
  if (parts[7].matched)
  {
    fitted.weights = { std::stod(parts[7]) / 100.0 * fitted.nodes(), NaN, NaN };
  }
  return fitted;
}

std::optional<FittedFor> numbersOf(vtkDataObject* base, const char* name)
{
  auto* array =
    base ? vtkDoubleArray::SafeDownCast(base->GetFieldData()->GetAbstractArray(name)) : nullptr;
  if (!array || array->GetNumberOfValues() != NumberOfNumbers)
  {
    return {};
  }
  FittedFor fitted;
  std::memcpy(static_cast<void*>(&fitted), array->GetPointer(0), sizeof(fitted));
  return fitted;
}

std::optional<FittedFor> fittedForOf(vtkDataObject* base)
{
  const std::optional<FittedFor> fitted = numbersOf(base, ArrayName);
  return fitted ? fitted : oldFittedFor(base);
}

void attachNumbers(vtkDataObject* image, const char* name, const FittedFor& numbers)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(NumberOfNumbers);
  std::memcpy(array->GetPointer(0), &numbers, sizeof(numbers));
  image->GetFieldData()->AddArray(array);
}

// The kernel of an image of control points; none of a field.
std::optional<int> kernelOf(vtkImageData* image)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(KernelName);
  const std::optional<FittedFor> fitted = fittedForOf(image); // files of former versions
  if (!array && !fitted)
  {
    return {};
  }
  double number = fitted ? fitted->kernel : NaN;
  if (array)
  {
    number = array->GetNumberOfValues() == 1 ? array->GetTuple1(0) : NaN;
  }
  if (number != KernelCatmullRom && number != KernelBSpline && number != AnyKernel)
  {
    throw Problem(std::string("Field array ") + KernelName + " is " + numberText(number) +
      "; of control points it must be 0, 1 or -1");
  }
  return static_cast<int>(number);
}

// To rounding: on several MPI ranks each knows its box from its own piece.
bool hasSamePoints(const Grid& one, const Grid& other)
{
  const double tolerance = BoxTolerance * glm::length(one.spacing);
  const glm::dvec3 end(one.dimensions - 1);
  const auto isSame = [&](const glm::dvec3& index) {
    return glm::distance(one.worldFromGrid(index), other.worldFromGrid(index)) <= tolerance;
  };
  return one.dimensions == other.dimensions && isSame(glm::dvec3(0.0)) &&
    isSame({ end.x, 0.0, 0.0 }) && isSame({ 0.0, end.y, 0.0 }) && isSame({ 0.0, 0.0, end.z });
}

// A displacement field at the points of another grid.
std::vector<glm::vec3> fieldAt(const Grid& points, const Grid& from, vtkDataArray* field)
{
  const auto value = [&](const glm::ivec3& at) {
    double tuple[3];
    field->GetTuple(static_cast<vtkIdType>(from.offset(at.x, at.y, at.z)), tuple);
    return glm::dvec3(tuple[0], tuple[1], tuple[2]);
  };
  std::vector<glm::vec3> found;
  found.reserve(points.count());
  forEachIndex(glm::ivec3(0), points.dimensions - 1, [&](const glm::ivec3& index) {
    const glm::dvec3 position = from.gridFromWorld(points.worldFromGrid(glm::dvec3(index)));
    glm::dvec3 sum(0.0);
    forEachCorner(
      from, position, [&](const glm::ivec3& at, double weight) { sum += weight * value(at); });
    found.emplace_back(sum);
  });
  return found;
}

struct PlacedPoints // control points
{
  Grid grid;
  int kernel;
  std::vector<glm::vec3> displacements;
};

// The cubic of control points at the points of another grid.
std::vector<glm::vec3> cubicAt(const Grid& points, const PlacedPoints& from)
{
  std::vector<glm::vec3> found(points.count());
  const auto count = static_cast<std::int64_t>(found.size());
  parallelFor(0, count, MappedOfThread, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t point = first; point < last; ++point)
    {
      const glm::dvec3 index(indexOf(points, static_cast<std::size_t>(point)));
      found[point] = cubicDisplacement(from.grid.dimensions, from.kernel, from.displacements.data(),
        from.grid.gridFromWorld(points.worldFromGrid(index)));
    }
  });
  return found;
}

void add(Lattice& lattice, const std::vector<glm::vec3>& displacements)
{
  std::transform(displacements.begin(), displacements.end(), lattice.displacements.begin(),
    lattice.displacements.begin(), std::plus<>());
}

// To rounding: on several MPI ranks each knows the box from its own piece.
bool coversSameBox(const FittedFor& one, const FittedFor& two)
{
  const double tolerance = BoxTolerance * glm::length((two.last - two.first) / two.dimensions);
  return glm::distance(one.first, two.first) <= tolerance &&
    glm::distance(one.last, two.last) <= tolerance;
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

bool hasOtherNodes(const FittedFor& one, const FittedFor& other)
{
  return one.dimensions != other.dimensions || one.samples != other.samples ||
    !coversSameBox(one, other);
}

template <typename... Parts>
std::string joined(const Parts&... parts)
{
  std::ostringstream words;
  (words << ... << parts);
  return words.str();
}

std::string wordsOnSides(const FittedFor& fitted)
{
  const glm::dvec3& sides = fitted.dimensions;
  return joined("Lattice Dimensions ", sides.x, " x ", sides.y, " x ", sides.z);
}

std::string wordsOnKernel(const FittedFor& fitted)
{
  return joined("Kernel ", fitted.kernel == KernelCatmullRom ? "Catmull-Rom" : "B-Spline");
}

std::string wordsOnSamples(const FittedFor& fitted)
{
  return joined("Samples ", fitted.samples);
}

std::string wordsOnMask(const FittedFor& fitted)
{
  return fitted.hasMask()
    ? joined("a mask that lets ", 100.0 * fitted.weights.x / fitted.nodes(), " % move")
    : "no mask";
}

std::string wordsOnBox(const FittedFor& fitted)
{
  const glm::dvec3& from = fitted.first;
  const glm::dvec3& to = fitted.last;
  return joined(
    "the box from ", from.x, " ", from.y, " ", from.z, " to ", to.x, " ", to.y, " ", to.z, " mm");
}

// Words on a setting that differs from one that may have the same words, "a mask" and so on.
std::string besides(const std::string& one, const std::string& other)
{
  return other == one ? "another" + other.substr(other.find(' ')) : other;
}

// The settings that differ, with the value of either side.
struct Differences
{
  std::string fitted;
  std::string wanted;
};

Differences differencesOf(const FittedFor& fitted, const FittedFor& wanted)
{
  Differences found;
  const auto add = [&](bool differs, std::string (*wordsOn)(const FittedFor&)) {
    if (differs)
    {
      const char* comma = found.fitted.empty() ? "" : ", ";
      found.fitted += comma + wordsOn(fitted);
      found.wanted += comma + besides(wordsOn(fitted), wordsOn(wanted));
    }
  };
  add(fitted.dimensions != wanted.dimensions, wordsOnSides);
  add(fitted.kernel != wanted.kernel, wordsOnKernel);
  add(fitted.samples != wanted.samples, wordsOnSamples);
  // Weights can be compared only at the same nodes.
  const bool areComparable =
    fitted.dimensions == wanted.dimensions && fitted.samples == wanted.samples;
  add(areComparable ? !hasSameMask(fitted, wanted) : fitted.hasMask() != wanted.hasMask(),
    wordsOnMask);
  add(!coversSameBox(fitted, wanted), wordsOnBox);
  return found;
}
}

void setLattice(vtkImageData* image, const Lattice& lattice)
{
  setField(image, lattice.grid, lattice.displacements, Direction::Forward);
  vtkNew<vtkIntArray> kernel;
  kernel->SetName(KernelName);
  kernel->InsertNextValue(lattice.kernel);
  image->GetFieldData()->AddArray(kernel);
}

void addBase(Lattice& lattice, vtkImageData* base)
{
  if (!base || base->GetNumberOfPoints() == 0)
  {
    return;
  }
  if (directionOf(base) == Direction::Backward)
  {
    throw Problem("The base lattice is a backward field; it must be a forward field. Invert "
                  "Displacement Field makes a forward field");
  }
  vtkDataArray* field = fieldOf(base);
  if (!field)
  {
    throw Problem("The base lattice has no point array of 3 components (mm)");
  }
  const Grid grid = gridOf(base);
  requirePosition(grid, "The base lattice's ");
  std::optional<int> kernel = kernelOf(base);
  kernel = kernel == AnyKernel ? lattice.kernel : kernel;
  if (kernel == lattice.kernel && hasSamePoints(grid, lattice.grid))
  {
    add(lattice, vectorsOf(field));
  }
  else
  {
    Lattice sampled = makeLattice(lattice.grid, lattice.kernel);
    sampled.displacements = kernel ? cubicAt(lattice.grid, { grid, *kernel, vectorsOf(field) })
                                   : fieldAt(lattice.grid, grid, field);
    interpolateAtPoints(sampled);
    add(lattice, sampled.displacements);
  }
  const auto finite = [](const glm::vec3& d) {
    return std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z);
  };
  const std::string array =
    std::string("base lattice's array ") + (field->GetName() ? field->GetName() : "without a name");
  if (!std::all_of(lattice.displacements.begin(), lattice.displacements.end(), finite))
  {
    throw Problem("The " + array + " holds a number that is not finite");
  }
  requireDisplacements(lattice, "the " + array);
}

std::vector<glm::vec3> displacementsOfTissue(vtkImageData* image, vtkDataArray* field)
{
  std::vector<glm::vec3> displacements = vectorsOf(field);
  if (kernelOf(image) != KernelBSpline) // the other one passes through its control points
  {
    return displacements;
  }
  const Grid grid = gridOf(image);
  return cubicAt(grid, { grid, KernelBSpline, std::move(displacements) });
}

void attachFittedFor(vtkDataObject* image, const Lattice& lattice, int samples)
{
  attachNumbers(image, ArrayName, fittedFor(lattice, samples));
}

void attachDrawnWith(vtkDataObject* image, const Lattice& lattice, int samples)
{
  const FittedFor drawn = fittedFor(lattice, samples);
  if (drawn.hasMask())
  {
    attachNumbers(image, DrawnWithName, drawn);
  }
}

std::string wordsOnDrawnWith(vtkDataObject* base, const Lattice& lattice, int samples)
{
  const std::optional<FittedFor> drawn = numbersOf(base, DrawnWithName);
  if (!drawn)
  {
    return {};
  }
  const FittedFor wanted = fittedFor(lattice, samples);
  if (!(wanted.hasMask() && hasOtherNodes(*drawn, wanted)) && !hasSameMask(*drawn, wanted))
  {
    return "The base lattice was drawn with " + wordsOnMask(*drawn) + ". This deformation has " +
      besides(wordsOnMask(*drawn), wordsOnMask(wanted)) +
      ", so other tissue moves. Choose the same Mask, Mask Labels, Mask Growth and Feather";
  }
  return {};
}

std::string wordsOnFittedFor(vtkDataObject* base, const Lattice& lattice, int samples)
{
  const std::optional<FittedFor> fitted = fittedForOf(base);
  const Differences found =
    fitted ? differencesOf(*fitted, fittedFor(lattice, samples)) : Differences();
  return found.fitted.empty()
    ? std::string()
    : "The base lattice was fitted for " + found.fitted + ". This deformation has " + found.wanted +
      ". The figures of the fit are not valid for it. Give Fit Deformation the same settings and "
      "Input";
}
}
