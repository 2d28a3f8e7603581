// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeLookReport.h"

#include "Common/FilledArray.h"
#include "Common/Guard.h"
#include "Filters/Looks/FirstCamera.h"
#include "Filters/Looks/Look.h"

#include "vtkAlgorithm.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <atomic>

using namespace brainshift;

namespace
{
constexpr int WindowBins = 65536; // one for each value of 16 bits

std::atomic<int> Readings{ 0 };

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

void vtkVolumeLookReport::MeasureWindow()
{
  guarded(this, [this] { this->FindWindow(); });
}

int vtkVolumeLookReport::GetReadings()
{
  return Readings;
}

vtkImageData* vtkVolumeLookReport::ReadVolume() const
{
  ++Readings;
  const bool hasPort =
    this->Source && this->Port >= 0 && this->Port < this->Source->GetNumberOfOutputPorts();
  return vtkImageData::SafeDownCast(
    hasPort ? this->Source->GetOutputDataObject(this->Port) : nullptr);
}

void vtkVolumeLookReport::FindWindow()
{
  this->Window->Reset();
  const Histogram all =
    readHistogram(this->ReadVolume(), { this->Association, this->ArrayName }, WindowBins);
  if (all.counts.empty())
  {
    return;
  }
  const Histogram tissue = withoutBackground(all);
  const double low = percentile(tissue, this->Percentiles[0] / 100.0);
  const double high = percentile(tissue, this->Percentiles[1] / 100.0);
  if (low < high)
  {
    fill(this->Window, std::vector{ std::array{ low, high } });
  }
}

vtkDoubleArray* vtkVolumeLookReport::GetCamera()
{
  this->Camera->Reset();
  if (!this->Tissue.empty())
  {
    const FirstCamera camera = firstCamera(this->Tissue, this->ViewAspect, this->ViewAngle);
    for (const glm::dvec3& vector : { camera.position, camera.focalPoint, camera.up })
    {
      append(this->Camera, vector);
    }
    this->Camera->InsertNextValue(camera.parallelScale);
  }
  return this->Camera;
}

void vtkVolumeLookReport::MakeLook()
{
  vtkImageData* volume = this->ReadVolume();
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
  this->Tissue = look.colors.empty() ? std::vector<glm::dvec3>()
    : look.drawsSegment              ? farPointsOfSegment(volume)
                                     : farPointsAbove(volume, array, look.tissue);
  this->TissuePoints->Reset();
  for (const glm::dvec3& point : this->Tissue)
  {
    append(this->TissuePoints, point);
  }
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
