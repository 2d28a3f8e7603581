// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/DeformableVolume.h"

#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr const char* DisplacementsName = "FFDDisplacements";
constexpr const char* DimensionsName = "FFDDimensions";
constexpr const char* BoxName = "FFDBox";
constexpr const char* SamplesName = "FFDSamples";
constexpr const char* InverseName = "FFDInverse";
constexpr const char* StrengthName = "FFDStrength";
constexpr const char* MaskName = "FFDMaskWeights";
constexpr const char* DeviationsName = "FFDDeviations";
constexpr const char* AllNames[] = { DisplacementsName, DimensionsName, BoxName, KernelName,
  SamplesName, InverseName, StrengthName, MaskName, DeviationsName };

// One tuple of numbers under a name.
template <typename ArrayType>
void attachTuple(vtkFieldData* fields, const char* name, const std::vector<double>& values)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTuple(values.data());
  fields->AddArray(array);
}

void attachDisplacements(vtkFieldData* fields, const Lattice& lattice)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(DisplacementsName);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(lattice.displacements.size()));
  std::memcpy(array->GetPointer(0), lattice.displacements.data(),
    lattice.displacements.size() * sizeof(glm::vec3));
  fields->AddArray(array);
}

// One number each. None: removes those of a deformation before this one.
void attachNumbers(vtkFieldData* fields, const char* name, const std::vector<float>& numbers)
{
  if (numbers.empty())
  {
    fields->RemoveArray(name);
    return;
  }
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), array->GetPointer(0));
  fields->AddArray(array);
}

// Throws a Problem about a field array.
[[noreturn]] void refuse(const char* name, const std::string& reason)
{
  throw Problem(std::string("Field array ") + name + reason);
}

// The numbers of a field array that must hold `count` of them.
std::vector<double> readNumbers(vtkFieldData* fields, const char* name, std::size_t count)
{
  vtkDataArray* array = fields->GetArray(name);
  const std::size_t found = array
    ? static_cast<std::size_t>(array->GetNumberOfTuples()) * array->GetNumberOfComponents()
    : 0;
  if (found != count)
  {
    refuse(
      name, " holds " + std::to_string(found) + " numbers; it must hold " + std::to_string(count));
  }
  std::vector<double> numbers(count);
  const int components = array->GetNumberOfComponents();
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers[i] =
      array->GetComponent(static_cast<vtkIdType>(i / components), static_cast<int>(i % components));
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); }))
  {
    refuse(name, " holds a number that is not finite");
  }
  return numbers;
}

// A whole number from `low` to `high`.
int readInteger(vtkFieldData* fields, const char* name, int low, int high)
{
  const double value = readNumbers(fields, name, 1)[0];
  if (!isWhole(value, low, high))
  {
    refuse(name,
      " is " + numberText(value) + "; it must be a whole number from " + std::to_string(low) +
        " to " + std::to_string(high));
  }
  return static_cast<int>(value);
}

// The numbers of a field array that holds `count` floats; none without the array.
std::vector<float> readFloats(vtkFieldData* fields, const char* name, std::size_t count)
{
  if (!fields->HasArray(name))
  {
    return {};
  }
  auto array = vtkFloatArray::FastDownCast(fields->GetArray(name));
  if (!array || array->GetNumberOfValues() != static_cast<vtkIdType>(count))
  {
    refuse(name, " must hold " + std::to_string(count) + " numbers of type float");
  }
  return { array->GetPointer(0), array->GetPointer(0) + count };
}

// The mask's weights; null without a mask.
std::shared_ptr<const NodeWeights> readWeights(
  vtkFieldData* fields, const Grid& lattice, int samples)
{
  const FieldNodes nodes = forwardNodes(lattice, samples);
  const std::size_t count = static_cast<std::size_t>(nodes.count.x) * nodes.count.y * nodes.count.z;
  NodeWeights weights{ nodes.perCell, readFloats(fields, MaskName, count) };
  const auto wrong = std::find_if_not(weights.values.begin(), weights.values.end(),
    [](float weight) { return weight >= 0 && weight <= 1; });
  if (wrong != weights.values.end())
  {
    refuse(MaskName, " holds " + roundedText(*wrong) + "; weights must be from 0 to 1");
  }
  return weights.values.empty() ? nullptr : std::make_shared<const NodeWeights>(std::move(weights));
}

// Standard deviations of the control points' positions; empty if they are not known.
std::vector<float> readDeviations(vtkFieldData* fields, std::size_t count)
{
  std::vector<float> deviations = readFloats(fields, DeviationsName, count);
  // A comparison with NaN is false.
  if (!std::all_of(deviations.begin(), deviations.end(), [](float mm) { return mm >= 0.0f; }))
  {
    refuse(DeviationsName, " holds a number that is not 0 or more; deviations must be");
  }
  return deviations;
}

Grid readLatticeGrid(vtkFieldData* fields)
{
  const std::vector<double> sides = readNumbers(fields, DimensionsName, 3);
  const std::vector<double> box = readNumbers(fields, BoxName, 15);
  Grid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!isWhole(sides[axis], SmallestLatticeSide, LargestLatticeSide))
    {
      refuse(DimensionsName,
        " has a side of " + numberText(sides[axis]) + " points; it must be a whole number from " +
          std::to_string(SmallestLatticeSide) + " to " + std::to_string(LargestLatticeSide));
    }
    grid.dimensions[axis] = static_cast<int>(sides[axis]);
  }
  setBox(grid, box.data());
  requirePosition(grid, std::string("In field array ") + BoxName + ", the ");
  return grid;
}

double product(const glm::dvec3& sides)
{
  return sides.x * sides.y * sides.z;
}

glm::dvec3 forwardSides(const Grid& lattice, int samples)
{
  return glm::dvec3(lattice.dimensions - 1) * (samples + 1.0) + 1.0;
}

glm::dvec3 backwardSides(const Lattice& lattice, int samples)
{
  return glm::dvec3(backwardNodes(lattice.grid, displacementsInCells(lattice), samples).count);
}

bool isFinite(const glm::dvec3& vector)
{
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}
}

void attach(vtkDataObject* volume, const Deformation& deformation)
{
  vtkFieldData* fields = volume->GetFieldData();
  const Grid& grid = deformation.lattice.grid;
  const std::array<double, 15> box = boxOf(grid);
  forgetDirection(volume);
  attachDisplacements(fields, deformation.lattice);
  const auto& mask = deformation.lattice.mask;
  attachNumbers(fields, MaskName, mask ? mask->values : std::vector<float>());
  attachNumbers(fields, DeviationsName, deformation.deviations);
  attachTuple<vtkIntArray>(fields, DimensionsName,
    { double(grid.dimensions.x), double(grid.dimensions.y), double(grid.dimensions.z) });
  attachTuple<vtkDoubleArray>(fields, BoxName, { box.begin(), box.end() });
  attachTuple<vtkIntArray>(fields, KernelName, { double(deformation.lattice.kernel) });
  attachTuple<vtkIntArray>(fields, SamplesName, { double(deformation.samples) });
  attachTuple<vtkIntArray>(fields, InverseName, { double(static_cast<int>(deformation.inverse)) });
  attachTuple<vtkDoubleArray>(fields, StrengthName, { deformation.strength });
}

bool carriesDeformation(vtkDataObject* volume)
{
  return volume && volume->GetFieldData()->HasArray(DisplacementsName) && !directionOf(volume);
}

Deformation readDeformation(vtkDataObject* volume)
{
  if (!carriesDeformation(volume))
  {
    throw Problem(
      "The volume carries no deformation; it must be the output of Free-Form Deformation");
  }
  vtkFieldData* fields = volume->GetFieldData();
  Deformation deformation;
  Lattice& lattice = deformation.lattice;
  lattice.grid = readLatticeGrid(fields);
  lattice.kernel = readInteger(fields, KernelName, 0, 1);
  deformation.samples = readInteger(fields, SamplesName, SmallestSamples, LargestSamples);
  deformation.inverse = static_cast<Inverse>(readInteger(fields, InverseName, 0, 1));
  lattice.mask = readWeights(fields, lattice.grid, deformation.samples);
  deformation.deviations = readDeviations(fields, lattice.grid.count());
  deformation.strength = readNumbers(fields, StrengthName, 1)[0];
  const std::vector<double> numbers =
    readNumbers(fields, DisplacementsName, 3 * lattice.grid.count());
  if (deformation.strength < 0.0 || deformation.strength > 1.0)
  {
    std::ostringstream value;
    value << " is " << deformation.strength << "; it must be from 0 to 1";
    refuse(StrengthName, value.str());
  }
  lattice.displacements.resize(lattice.grid.count());
  for (std::size_t point = 0; point < lattice.displacements.size(); ++point)
  {
    lattice.displacements[point] =
      glm::vec3(numbers[3 * point], numbers[3 * point + 1], numbers[3 * point + 2]);
  }
  requireDisplacements(lattice, std::string("field array ") + DisplacementsName);
  return deformation;
}

Lattice effectiveLattice(const Deformation& deformation)
{
  Lattice lattice = deformation.lattice;
  for (glm::vec3& displacement : lattice.displacements)
  {
    displacement *= static_cast<float>(deformation.strength);
  }
  return lattice;
}

bool carriesDeviations(vtkDataObject* volume)
{
  return carriesDeformation(volume) && volume->GetFieldData()->HasArray(DeviationsName);
}

double deviationAt(
  const Grid& lattice, const std::vector<float>& deviations, const glm::dvec3& rest)
{
  double sum = 0.0;
  forEachCorner(lattice, lattice.gridFromWorld(rest), [&](const glm::ivec3& at, double weight) {
    // 0 times infinity is not a number.
    sum += weight > 0.0 ? weight * deviations[lattice.offset(at.x, at.y, at.z)] : 0.0;
  });
  return sum;
}

unsigned long long deformationTime(vtkDataObject* volume)
{
  unsigned long long latest = 0;
  for (const char* name : AllNames)
  {
    if (vtkAbstractArray* array = volume->GetFieldData()->GetAbstractArray(name))
    {
      latest = std::max<unsigned long long>(latest, array->GetMTime());
    }
  }
  return latest;
}

double offsetFieldBytes(const Lattice& lattice, int samples)
{
  // The forward field, that before its last axis is refined, and the backward field.
  const glm::dvec3 forward = forwardSides(lattice.grid, samples);
  const double nodes =
    product(forward) * (1.0 + 1.0 / (samples + 1.0)) + product(backwardSides(lattice, samples));
  return nodes * static_cast<double>(sizeof(glm::vec3));
}

void requireOffsetFieldMemory(const Lattice& lattice, int samples)
{
  requireHostMemory("The offset field of " + sizeText(backwardSides(lattice, samples)) + " nodes",
    offsetFieldBytes(lattice, samples));
}

glm::dvec3 DirectedMap::position(const glm::dvec3& from) const
{
  if (!isFinite(from))
  {
    return from;
  }
  return this->Towards == Direction::Forward ? this->Map.deformedFromRest(from)
                                             : this->Map.restFromDeformed(from);
}

glm::dmat3 DirectedMap::jacobian(const glm::dvec3& from, const glm::dvec3& to) const
{
  if (!isFinite(from))
  {
    return glm::dmat3(1.0);
  }
  if (this->Towards == Direction::Forward)
  {
    return this->Map.jacobian(from);
  }
  // Negated subtracts the displacement found at `from`, so its derivatives are those of that.
  return this->Backward == Inverse::Negated ? glm::dmat3(2.0) - this->Map.jacobian(from)
                                            : glm::inverse(this->Map.jacobian(to));
}

glm::dvec3 turnedNormal(const glm::dmat3& jacobian, const glm::dvec3& normal)
{
  // Cofactors: what cross products of tangents turn by. Needs no inverse.
  const glm::dmat3 cofactors(glm::cross(jacobian[1], jacobian[2]),
    glm::cross(jacobian[2], jacobian[0]), glm::cross(jacobian[0], jacobian[1]));
  const glm::dvec3 turned = cofactors * normal;
  const double length = glm::length(turned);
  return std::isfinite(length) && length > 0.0 ? turned * (glm::length(normal) / length) : normal;
}

DirectedMap directedMapOf(vtkDataObject* volume, Direction direction)
{
  const Deformation deformation = readDeformation(volume);
  return DirectedMap(
    PointMap(effectiveLattice(deformation), deformation.inverse), deformation.inverse, direction);
}
}
