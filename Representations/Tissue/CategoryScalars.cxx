// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/CategoryScalars.h"

#include "Common/PiecedArray.h"
#include "Representations/Gpu/ShaderSource.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArrayRange.h"
#include "vtkFloatArray.h"
#include "vtkPiecewiseFunction.h"
#include "vtkUnsignedShortArray.h"
#include "vtkVariant.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace brainshift
{
namespace
{
constexpr std::size_t MostCategories = TransferEntries - 1; // one entry is left to all others

// Distinct values but NaN, ascending; `hasNaN`: whether there is one. Stops above MostCategories.
template <typename Range>
std::vector<double> distinctValues(const Range& values, bool& hasNaN)
{
  std::unordered_set<double> found;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values)
  {
    if (value == last) // labels come in runs
    {
      continue;
    }
    last = value;
    hasNaN = hasNaN || std::isnan(value);
    if (!std::isnan(value) && found.insert(value).second && found.size() > MostCategories)
    {
      break;
    }
  }
  std::vector<double> sorted(found.begin(), found.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

template <typename Array, typename Range>
vtkSmartPointer<vtkDataArray> numbered(const Range& values, const std::vector<double>& distinct)
{
  auto numbers = vtkSmartPointer<Array>::New();
  numbers->SetNumberOfValues(values.size());
  double last = std::numeric_limits<double>::quiet_NaN();
  typename Array::ValueType number = 0;
  vtkIdType i = 0;
  for (const double value : values)
  {
    if (value != last)
    {
      last = value;
      const auto found = std::lower_bound(distinct.begin(), distinct.end(), value);
      const bool isKnown = found != distinct.end() && *found == value;
      const auto place = (isKnown ? found : distinct.end()) - distinct.begin();
      number = std::isnan(value) ? std::numeric_limits<typename Array::ValueType>::quiet_NaN()
                                 : static_cast<typename Array::ValueType>(place);
    }
    numbers->SetValue(i++, number);
  }
  return numbers;
}

// One number of each tuple, as VTK's ranges of values.
class ComponentValues
{
public:
  ComponentValues(vtkDataArray* scalars, int component)
    : Scalars(scalars)
    , Component(component)
  {
  }

  vtkIdType size() const { return this->Scalars->GetNumberOfTuples(); }

  struct Iterator
  {
    const ComponentValues* values;
    vtkIdType at;
    double operator*() const { return values->Scalars->GetComponent(at, values->Component); }
    Iterator& operator++()
    {
      ++at;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at != other.at; }
  };
  Iterator begin() const { return { this, 0 }; }
  Iterator end() const { return { this, this->size() }; }

private:
  vtkDataArray* Scalars;
  int Component;
};

// Ascending.
std::vector<double> annotatedValues(vtkColorTransferFunction* map)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < map->GetNumberOfAnnotatedValues(); ++i)
  {
    bool isNumber = false;
    const double value = map->GetAnnotatedValue(i).ToDouble(&isNumber);
    if (isNumber && !std::isnan(value))
    {
      values.push_back(value);
    }
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::array<double, 3> colorOf(vtkColorTransferFunction* map, double value)
{
  std::array<double, 4> color{};
  const vtkIdType annotation = map->GetAnnotatedValueIndex(vtkVariant(value));
  if (annotation >= 0)
  {
    map->GetIndexedColor(annotation, color.data());
  }
  else
  {
    map->GetNanColor(color.data());
  }
  return { color[0], color[1], color[2] };
}
}

CategoryScalars::CategoryScalars() = default;
CategoryScalars::~CategoryScalars() = default;

bool CategoryScalars::areWanted(vtkVolumeProperty* property)
{
  return property->GetRGBTransferFunction()->GetIndexedLookup() != 0;
}

bool CategoryScalars::update(vtkDataArray* scalars, int component, vtkVolumeProperty* property)
{
  vtkColorTransferFunction* map = property->GetRGBTransferFunction();
  if (this->Counted != scalars || this->CountedTime != scalars->GetMTime() ||
    this->CountedComponent != component ||
    (this->IsOfAnnotations && this->CountedMapTime != map->GetMTime()))
  {
    this->count(scalars, component, map);
    this->CountedMapTime = map->GetMTime();
    this->Counted = scalars;
    this->CountedTime = scalars->GetMTime();
    this->CountedComponent = component;
    this->ColoredTime = 0;
  }
  if (!this->Numbers)
  {
    return false;
  }
  const unsigned long long time =
    std::max({ property->GetMTime(), map->GetMTime(), property->GetScalarOpacity()->GetMTime() });
  if (this->ColoredTime != time)
  {
    this->color(property);
    this->ColoredTime = time;
  }
  return true;
}

void CategoryScalars::count(vtkDataArray* scalars, int component, vtkColorTransferFunction* map)
{
  const vtkSmartPointer<vtkDataArray> inOrder = contiguous(scalars); // each value is read alone
  const ComponentValues values(inOrder, component);
  bool hasNaN = false;
  this->Values = distinctValues(values, hasNaN);
  this->IsOfAnnotations = this->Values.size() > MostCategories;
  if (this->IsOfAnnotations)
  {
    hasNaN = true; // perhaps: the count ended before
    this->Values = annotatedValues(map);
  }
  this->Numbers = this->Values.size() > MostCategories ? nullptr
    : hasNaN ? numbered<vtkFloatArray>(values, this->Values)
             : numbered<vtkUnsignedShortArray>(values, this->Values);
}

void CategoryScalars::color(vtkVolumeProperty* property)
{
  vtkNew<vtkColorTransferFunction> colors;
  vtkNew<vtkPiecewiseFunction> opacities;
  for (std::size_t i = 0; i < this->Values.size(); ++i)
  {
    const std::array<double, 3> color =
      colorOf(property->GetRGBTransferFunction(), this->Values[i]);
    const double number = static_cast<double>(i);
    colors->AddRGBPoint(number, color[0], color[1], color[2]);
    opacities->AddPoint(number, property->GetScalarOpacity()->GetValue(this->Values[i]));
  }
  double others[3];
  property->GetRGBTransferFunction()->GetNanColor(others);
  // An entry of the texture for each number, so that no two are blended.
  for (const double number : { static_cast<double>(this->Values.size()), TransferEntries - 1.0 })
  {
    colors->AddRGBPoint(number, others[0], others[1], others[2]);
    opacities->AddPoint(number, 0.0);
  }
  this->Property->DeepCopy(property);
  this->Property->SetColor(colors);
  this->Property->SetScalarOpacity(opacities);
}
}
