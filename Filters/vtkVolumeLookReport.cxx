// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeLookReport.h"

#include "Filters/Attached/Guard.h"
#include "Filters/Looks/Intensities.h"
#include "Filters/Looks/Look.h"

#include "vtkAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <vector>

using namespace brainshift;

namespace
{
template <typename Points>
void fill(vtkDoubleArray* array, const Points& points)
{
  array->Reset();
  for (const auto& point : points)
  {
    for (const double number : point)
    {
      array->InsertNextValue(number);
    }
  }
}
}

vtkStandardNewMacro(vtkVolumeLookReport);

vtkVolumeLookReport::vtkVolumeLookReport() = default;
vtkVolumeLookReport::~vtkVolumeLookReport() = default;

void vtkVolumeLookReport::SetSource(vtkAlgorithm* source)
{
  this->Source = source;
}

void vtkVolumeLookReport::Measure()
{
  guarded(this, [this] { this->MakeLook(); });
}

void vtkVolumeLookReport::MakeLook()
{
  const bool hasPort =
    this->Source && this->Port >= 0 && this->Port < this->Source->GetNumberOfOutputPorts();
  auto volume =
    vtkImageData::SafeDownCast(hasPort ? this->Source->GetOutputDataObject(this->Port) : nullptr);
  const ArrayChoice array{ this->Association, this->ArrayName };
  const Intensities values = readIntensities(volume, array);
  const std::vector<std::string> names = looksOf(values);
  this->Kind = values.empty() ? "" : nameOf(kindOf(values));
  this->Names.clear();
  for (const std::string& name : names)
  {
    this->Names += (this->Names.empty() ? "" : "\n") + name;
  }
  const bool isFirst = this->Look.empty() && !names.empty();
  const brainshift::Look look = makeLook(isFirst ? names.front() : this->Look, values);
  fill(this->Colors, look.colors);
  fill(this->Opacities, look.opacities);
  this->DrawsSegment = look.drawsSegment;
  const Box box = look.colors.empty() ? Box()
    : look.drawsSegment               ? boxOfSegment(volume)
                                      : boxAbove(volume, array, look.tissue);
  std::copy_n(box.bounds, 6, this->TissueBounds);
}

void vtkVolumeLookReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Port: " << this->Port << "\n";
  os << indent << "Association: " << this->Association << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "Look: " << this->Look << "\n";
  os << indent << "Kind: " << this->Kind << "\n";
}
