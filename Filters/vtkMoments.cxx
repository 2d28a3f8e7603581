// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMoments.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Traces/StrokeMarks.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

using namespace brainshift;

vtkStandardNewMacro(vtkMoments);
brainshiftGuardRequestsMacro(vtkMoments);

namespace
{
// The inputs around a time, and how far it is on the way from the earlier one to the later one.
struct Around
{
  int earlier = 0;
  int later = 0;
  double share = 0.0; // 0 to below 1
};

Around momentsAround(const std::vector<double>& times, double time)
{
  std::vector<int> order(times.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return times[a] < times[b]; });
  const auto after =
    std::find_if(order.begin(), order.end(), [&](int i) { return times[i] > time; });
  if (after == order.begin() || after == order.end())
  {
    const int only = after == order.begin() ? order.front() : order.back();
    return { only, only };
  }
  const int earlier = *(after - 1);
  return { earlier, *after, (time - times[earlier]) / (times[*after] - times[earlier]) };
}

std::optional<Deformation> deformationOf(vtkImageData* volume)
{
  if (!carriesDeformation(volume))
  {
    return std::nullopt;
  }
  return readDeformation(volume);
}

// What two lattices must share so that each control point of one is that of the other.
std::string differenceOf(const Deformation& a, const Deformation& b)
{
  if (a.lattice.grid.dimensions != b.lattice.grid.dimensions)
  {
    return "LatticeDimensions";
  }
  if (a.lattice.kernel != b.lattice.kernel)
  {
    return "Kernel";
  }
  if (a.samples != b.samples)
  {
    return "Samples";
  }
  if (a.inverse != b.inverse)
  {
    return "Inverse";
  }
  return sameMask(a.lattice.mask, b.lattice.mask) ? "" : "Mask";
}

// The deformation that is `share` on the way from one to the other. Where one is missing the volume
// is not bent. `carrier` has the settings if both are.
Deformation between(const std::optional<Deformation>& earlier,
  const std::optional<Deformation>& later, double share, vtkImageData* carrier)
{
  Deformation result = earlier ? *earlier : later ? *later : readDeformation(carrier);
  const std::string difference =
    earlier && later && share > 0.0 ? differenceOf(*earlier, *later) : std::string();
  if (!difference.empty())
  {
    throw Problem("The moments differ in " + difference +
      ", so what is between them is not known; give them the same one, or turn Interpolate off");
  }
  std::vector<glm::vec3>& displacements = result.lattice.displacements;
  for (std::size_t i = 0; i < displacements.size(); ++i)
  {
    const auto part = [&](const std::optional<Deformation>& moment, double weight) {
      return moment && weight > 0.0
        ? glm::dvec3(moment->lattice.displacements[i]) * moment->strength * weight
        : glm::dvec3(0.0);
    };
    displacements[i] = glm::vec3(part(earlier, 1.0 - share) + part(later, share));
  }
  result.strength = 1.0;
  result.deviations.clear(); // nothing was measured then
  return result;
}

// The input whose deformation, mask and segmentation count: the earlier one, or, where that is not
// bent, the later one or any other. Null if none is bent.
vtkImageData* carrierOf(const std::vector<vtkImageData*>& volumes, const Around& around)
{
  std::vector<vtkImageData*> order{ volumes[around.earlier], volumes[around.later] };
  order.insert(order.end(), volumes.begin(), volumes.end());
  const auto found = std::find_if(order.begin(), order.end(), carriesDeformation);
  return found == order.end() ? nullptr : *found;
}

void requireSamePoints(const std::vector<vtkImageData*>& volumes, const std::vector<double>& times)
{
  for (std::size_t i = 1; i < volumes.size(); ++i)
  {
    if (gridOf(volumes[i]) != gridOf(volumes[0]))
    {
      throw Problem("The volume of the moment at " + numberText(times[i]) +
        " has other points than that at " + numberText(times[0]) +
        "; the moments of a surgery are one volume, bent differently");
    }
  }
}
}

void vtkMoments::AddTime(double time)
{
  this->Times.push_back(time);
  this->Modified();
}

void vtkMoments::ClearTimes()
{
  this->Times.clear();
  this->Modified();
}

std::vector<double> vtkMoments::TimesOf(int inputs) const
{
  std::vector<double> times = this->Times;
  if (times.empty())
  {
    times.resize(inputs);
    std::iota(times.begin(), times.end(), 0.0);
  }
  if (times.size() != static_cast<std::size_t>(inputs))
  {
    throw Problem("Moments has " + std::to_string(inputs) + " inputs and " +
      std::to_string(times.size()) + " Times; give each input one time");
  }
  std::vector<double> sorted = times;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  const bool areFinite =
    std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
  if (!areFinite || twice != sorted.end())
  {
    throw Problem(areFinite
        ? "Two moments have the time " + numberText(*twice) + "; give each its own"
        : "A time of a moment is not a finite number");
  }
  return times;
}

int vtkMoments::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

int vtkMoments::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  std::vector<double> times = this->TimesOf(inputs[0]->GetNumberOfInformationObjects());
  std::sort(times.begin(), times.end());
  vtkInformation* output = outputs->GetInformationObject(0);
  output->Set(
    vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  const double range[2] = { times.front(), times.back() };
  output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  return this->Superclass::RequestInformation(request, inputs, outputs);
}

int vtkMoments::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  const int count = inputs[0]->GetNumberOfInformationObjects();
  const std::vector<double> times = this->TimesOf(count);
  for (int i = 0; i < count; ++i)
  {
    inputs[0]->GetInformationObject(i)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), times[i]);
  }
  return 1;
}

int vtkMoments::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int count = inputs[0]->GetNumberOfInformationObjects();
  const std::vector<double> times = this->TimesOf(count);
  std::vector<vtkImageData*> volumes;
  volumes.reserve(count);
  for (int i = 0; i < count; ++i)
  {
    volumes.push_back(vtkImageData::GetData(inputs[0], i));
  }
  requireSamePoints(volumes, times);
  vtkInformation* asked = outputs->GetInformationObject(0);
  const double time = asked->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    ? asked->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    : *std::min_element(times.begin(), times.end());
  const Around around = momentsAround(times, time);
  vtkImageData* earlier = volumes[around.earlier];
  vtkImageData* carrier = carrierOf(volumes, around);
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(carrier ? carrier : earlier);
  output->GetPointData()->ShallowCopy(earlier->GetPointData());
  output->GetCellData()->ShallowCopy(earlier->GetCellData());
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  const double share = this->Interpolate ? around.share : 0.0;
  std::string fold;
  if (carrier && (carrier != earlier || share > 0.0))
  {
    const std::optional<Deformation> later =
      share > 0.0 ? deformationOf(volumes[around.later]) : std::nullopt;
    const Deformation now = between(deformationOf(earlier), later, share, carrier);
    attach(output, now);
    forgetMarks(output); // they are of the carrier's own deformation
    if (share > 0.0 && minimumJacobian(now.lattice) <= 0.0)
    {
      fold = "The deformation between the moments " + numberText(times[around.earlier]) + " and " +
        numberText(times[around.later]) + " folds tissue; add a moment between them";
    }
  }
  warnAnew(this, fold, this->ToldFold);
  return 1;
}

void vtkMoments::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interpolate: " << this->Interpolate << "\n" << indent << "Times:";
  for (const double time : this->Times)
  {
    os << " " << time;
  }
  os << "\n";
}
