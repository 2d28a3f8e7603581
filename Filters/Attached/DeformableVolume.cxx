// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/DeformableVolume.h"

#include "Common/FieldDirection.h"
#include "Common/FieldWord.h"
#include "Common/ImageGrid.h"
#include "Filters/Deformation/OffsetField.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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
constexpr const char* KernelName = "FFDKernel";
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

// The numbers of a field array that must hold `count` of them; empty, with `error` set, otherwise.
std::vector<double> readNumbers(
  vtkFieldData* fields, const char* name, std::size_t count, std::string& error)
{
  vtkDataArray* array = fields->GetArray(name);
  const std::size_t found = array
    ? static_cast<std::size_t>(array->GetNumberOfTuples()) * array->GetNumberOfComponents()
    : 0;
  if (found != count)
  {
    error = std::string("Field array ") + name + " holds " + std::to_string(found) +
      " numbers; it must hold " + std::to_string(count);
    return {};
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
    error = std::string("Field array ") + name + " holds a number that is not finite";
    return {};
  }
  return numbers;
}

// A whole number within its limits, or false with `error` set.
bool readInteger(
  vtkFieldData* fields, const char* name, int low, int high, int& value, std::string& error)
{
  const std::vector<double> numbers = readNumbers(fields, name, 1, error);
  if (numbers.empty())
  {
    return false;
  }
  value = static_cast<int>(numbers[0]);
  if (value < low || value > high)
  {
    error = std::string("Field array ") + name + " is " + std::to_string(value) +
      "; it must be from " + std::to_string(low) + " to " + std::to_string(high);
    return false;
  }
  return true;
}

// The mask's weights, if there are any; false, with `error` set, if they cannot be.
bool readMask(vtkFieldData* fields, int samples, Lattice& lattice, std::string& error)
{
  lattice.mask = nullptr;
  if (!fields->HasArray(MaskName))
  {
    return true;
  }
  const FieldNodes nodes = forwardNodes(lattice.grid, samples);
  const vtkIdType count = static_cast<vtkIdType>(nodes.count.x) * nodes.count.y * nodes.count.z;
  auto array = vtkFloatArray::FastDownCast(fields->GetArray(MaskName));
  if (!array || array->GetNumberOfValues() != count)
  {
    error = std::string("Field array ") + MaskName + " must hold " + std::to_string(count) +
      " numbers of type float";
    return false;
  }
  const float* const first = array->GetPointer(0);
  const float* const wrong =
    std::find_if_not(first, first + count, [](float weight) { return weight >= 0 && weight <= 1; });
  if (wrong != first + count)
  {
    error = std::string("Field array ") + MaskName + " holds " + std::to_string(*wrong) +
      "; weights must be from 0 to 1";
    return false;
  }
  lattice.mask = std::make_shared<const NodeWeights>(
    NodeWeights{ nodes.perCell, std::vector<float>(first, first + count) });
  return true;
}

// How far places can be believed, if that is known; false, with `error` set, if it cannot be.
bool readDeviations(
  vtkFieldData* fields, std::size_t count, std::vector<float>& deviations, std::string& error)
{
  deviations.clear();
  if (!fields->HasArray(DeviationsName))
  {
    return true;
  }
  auto array = vtkFloatArray::FastDownCast(fields->GetArray(DeviationsName));
  if (!array || array->GetNumberOfValues() != static_cast<vtkIdType>(count))
  {
    error = std::string("Field array ") + DeviationsName + " must hold " + std::to_string(count) +
      " numbers of type float";
    return false;
  }
  deviations.assign(array->GetPointer(0), array->GetPointer(0) + count);
  // A comparison with NaN is false.
  if (!std::all_of(deviations.begin(), deviations.end(), [](float mm) { return mm >= 0.0f; }))
  {
    error = std::string("Field array ") + DeviationsName +
      " holds a number that is not 0 or more; deviations must be";
    return false;
  }
  return true;
}

bool readGrid(vtkFieldData* fields, Grid& grid, std::string& error)
{
  const std::vector<double> sides = readNumbers(fields, DimensionsName, 3, error);
  const std::vector<double> box =
    sides.empty() ? std::vector<double>() : readNumbers(fields, BoxName, 15, error);
  if (box.empty())
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (sides[axis] < SmallestLatticeSide || sides[axis] > LargestLatticeSide)
    {
      error = std::string("Field array ") + DimensionsName + " has a side of " +
        std::to_string(static_cast<int>(sides[axis])) + " points; it must have from " +
        std::to_string(SmallestLatticeSide) + " to " + std::to_string(LargestLatticeSide);
      return false;
    }
    grid.dimensions[axis] = static_cast<int>(sides[axis]);
    grid.origin[axis] = box[axis];
    grid.spacing[axis] = box[3 + axis];
    for (int column = 0; column < 3; ++column)
    {
      grid.direction[column][axis] = box[6 + 3 * axis + column];
    }
  }
  const std::string problem = problemOfGrid(grid);
  error = problem.empty() ? problem : std::string("In field array ") + BoxName + ", the " + problem;
  return problem.empty();
}
}

void attach(vtkDataObject* volume, const Deformation& deformation)
{
  vtkFieldData* fields = volume->GetFieldData();
  const Grid& grid = deformation.lattice.grid;
  std::vector<double> box{ grid.origin.x, grid.origin.y, grid.origin.z, grid.spacing.x,
    grid.spacing.y, grid.spacing.z };
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      box.push_back(grid.direction[column][row]);
    }
  }
  forgetDirection(volume);
  attachDisplacements(fields, deformation.lattice);
  const auto& mask = deformation.lattice.mask;
  attachNumbers(fields, MaskName, mask ? mask->values : std::vector<float>());
  attachNumbers(fields, DeviationsName, deformation.deviations);
  attachTuple<vtkIntArray>(fields, DimensionsName,
    { double(grid.dimensions.x), double(grid.dimensions.y), double(grid.dimensions.z) });
  attachTuple<vtkDoubleArray>(fields, BoxName, box);
  attachTuple<vtkIntArray>(fields, KernelName, { double(deformation.lattice.kernel) });
  attachTuple<vtkIntArray>(fields, SamplesName, { double(deformation.samples) });
  attachTuple<vtkIntArray>(fields, InverseName, { double(static_cast<int>(deformation.inverse)) });
  attachTuple<vtkDoubleArray>(fields, StrengthName, { deformation.strength });
}

void detach(vtkDataObject* volume)
{
  removeFieldArrays(volume, DeformationPrefix);
}

bool carriesDeformation(vtkDataObject* volume)
{
  return volume && volume->GetFieldData()->HasArray(DisplacementsName) && !directionOf(volume);
}

bool readDeformation(vtkDataObject* volume, Deformation& deformation, std::string& error)
{
  if (!carriesDeformation(volume))
  {
    error = "The volume carries no deformation; it must be the output of Free-Form Deformation";
    return false;
  }
  vtkFieldData* fields = volume->GetFieldData();
  Lattice& lattice = deformation.lattice;
  int inverse = 0;
  if (!readGrid(fields, lattice.grid, error) ||
    !readInteger(fields, KernelName, 0, 1, lattice.kernel, error) ||
    !readInteger(
      fields, SamplesName, SmallestSamples, LargestSamples, deformation.samples, error) ||
    !readInteger(fields, InverseName, 0, 1, inverse, error) ||
    !readMask(fields, deformation.samples, lattice, error) ||
    !readDeviations(fields, lattice.grid.count(), deformation.deviations, error))
  {
    return false;
  }
  deformation.inverse = static_cast<Inverse>(inverse);
  const std::vector<double> strength = readNumbers(fields, StrengthName, 1, error);
  const std::vector<double> numbers = strength.empty()
    ? strength
    : readNumbers(fields, DisplacementsName, 3 * lattice.grid.count(), error);
  if (numbers.empty())
  {
    return false;
  }
  if (strength[0] < 0.0 || strength[0] > 1.0)
  {
    std::ostringstream value;
    value << strength[0];
    error = std::string("Field array ") + StrengthName + " is " + value.str() +
      "; it must be from 0 to 1";
    return false;
  }
  deformation.strength = strength[0];
  lattice.displacements.resize(lattice.grid.count());
  for (std::size_t point = 0; point < lattice.displacements.size(); ++point)
  {
    lattice.displacements[point] =
      glm::vec3(numbers[3 * point], numbers[3 * point + 1], numbers[3 * point + 2]);
  }
  error = problemOfDisplacements(lattice, std::string("field array ") + DisplacementsName);
  return error.empty();
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
  const glm::ivec3 last = lattice.dimensions - 1;
  const glm::dvec3 position =
    glm::clamp(lattice.gridFromWorld(rest), glm::dvec3(0.0), glm::dvec3(last));
  const glm::ivec3 low(position);
  const glm::dvec3 within = position - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 share = glm::mix(1.0 - within, within, glm::dvec3(side));
    const double weight = share.x * share.y * share.z;
    const glm::ivec3 at = glm::min(low + side, last);
    // 0 times infinity is not a number.
    sum += weight > 0.0 ? weight * deviations[lattice.offset(at.x, at.y, at.z)] : 0.0;
  }
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
}
